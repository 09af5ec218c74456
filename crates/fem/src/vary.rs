//! Modes over any parameter of a model: friction, its slope, contact stiffness, stiffness of a material, damping, load.
//!
//! Each value has matrices of its own where the parameter is in them. Modes are followed by their shapes on the nodes.

use faer::c64;

use crate::Error;
use crate::assembly::{Loads, Model, Numbering, Pencil, Rows, assemble};
use crate::mesh::FaceRef;
use crate::modes::{
    Basis, Factor, Ordering, Pair, follow_by, lift, lowest, nearby, pairs, refine, residuals,
};
use crate::statics::settle;
use crate::sweep::{Mode, State};

/// A model with its load and its friction.
#[derive(Debug, Clone, Default)]
pub struct Setup {
    /// Bodies and contact.
    pub model: Model,
    /// Faces of the slaves.
    pub faces: Vec<FaceRef>,
    /// Loads of the static step; there is one where they or prescribed displacements move anything.
    pub loads: Loads,
    /// Coefficient of friction.
    pub mu: f64,
    /// That of the static step; none: the same.
    pub static_mu: Option<f64>,
    /// μ'(V), s/m.
    pub slope: f64,
    /// Whether the stress of the static step stiffens the bodies.
    pub stiffened: bool,
}

/// What is varied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parameter {
    /// The coefficient of friction.
    Friction,
    /// μ'(V), s/m.
    Slope,
    /// The contact stiffness, Pa/m.
    ContactStiffness,
    /// A factor of all moduli of the material with this index.
    Stiffness(usize),
    /// A factor of loads and prescribed displacements.
    Load,
    /// A factor of the Rayleigh damping of all materials.
    Damping,
}

/// Modes at one value.
struct Station {
    pairs: Vec<(Pair, f64)>,
    /// Displacements of the nodes, of length 1 as a whole.
    shapes: Vec<Vec<c64>>,
}

impl Setup {
    /// The setup with another value of a parameter.
    ///
    /// # Errors
    /// A contact stiffness where displacements are tied, a material that there is not.
    pub fn with(&self, parameter: Parameter, value: f64) -> Result<Self, Error> {
        let mut setup = self.clone();
        match parameter {
            Parameter::Friction => setup.mu = value,
            Parameter::Slope => setup.slope = value,
            Parameter::ContactStiffness => {
                let what =
                    "the contact has no stiffness, its normal displacements are tied: give it one to vary";
                let penalty = setup.model.penalty.as_mut();
                penalty.ok_or_else(|| Error::Contact { what: what.to_owned() })?.stiffness = value;
            }
            Parameter::Stiffness(index) => {
                let count = setup.model.materials.len();
                let what = format!("material {index} is to be varied, but there are only {count}");
                let material = setup.model.materials.get_mut(index).ok_or(Error::Mesh { what })?;
                if !(value > 0.0 && value.is_finite()) {
                    let what = format!("its moduli are to be multiplied by {value}, which must be above 0");
                    return Err(Error::Material { name: material.name.clone(), what });
                }
                material.stiffness.iter_mut().flatten().for_each(|modulus| *modulus *= value);
            }
            Parameter::Damping => {
                setup.model.materials.iter_mut().flat_map(|m| &mut m.rayleigh).for_each(|c| *c *= value);
            }
            Parameter::Load => {
                setup.loads.pressure.iter_mut().for_each(|(_, pressure)| *pressure *= value);
                setup.loads.forces.iter_mut().flat_map(|(_, f)| f).for_each(|force| *force *= value);
                setup.model.supports.prescribed.values_mut().for_each(|u| *u *= value);
            }
        }
        Ok(setup)
    }

    /// Numbering, matrices and the damping of the slope between contact points.
    fn matrices(&self) -> Result<(Numbering, Pencil, Rows), Error> {
        let moved = self.model.supports.prescribed.values().any(|u| *u != 0.0);
        if !moved && self.loads.pressure.is_empty() && self.loads.forces.is_empty() {
            if self.slope != 0.0 {
                let what =
                    "friction has a slope, but no load presses the bodies together: give one".to_owned();
                return Err(Error::Contact { what });
            }
            let (numbering, pencil) = assemble(&self.model)?;
            return Ok((numbering, pencil, Rows::default()));
        }
        let settled = settle(&self.model, &self.faces, &self.loads, self.static_mu.unwrap_or(self.mu))?;
        let field: Vec<f64> = settled.pressures.iter().map(|p| p * self.slope).collect();
        let slope = if self.slope == 0.0 { Rows::default() } else { settled.surface.matrix(&field) };
        let pencil = if self.stiffened { settled.stiffened()? } else { settled.pencil };
        Ok((settled.numbering, pencil, slope))
    }

    fn station(&self, count: usize, bound: f64) -> Result<Station, Error> {
        /// A mode that is followed may move above the lowest `count` by so many others.
        const ABOVE: usize = 4;
        /// The last modes couple with modes above them.
        const MORE: usize = 8;
        const ROUNDS: usize = 12;
        let count = count + ABOVE;
        let (numbering, pencil, slope) = self.matrices()?;
        let pattern = &pencil.stiffness.pattern;
        let ordering = Ordering::best(pattern, &numbering.places(&self.model.mesh))?;
        let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0)?;
        let real = lowest(&pencil, &factor, (count + MORE).min(pencil.size()))?;
        let mut basis = Basis::new(&pencil, &real.shapes);
        refine(&pencil, &factor, &mut basis, &[self.mu], &slope, count, bound, ROUNDS)?;
        let mut found = pairs(&basis.at(self.mu, &slope))?;
        found.truncate(count);
        let known = residuals(&pencil, &factor, &basis, self.mu, &slope, &found);
        let mut station = Station { pairs: Vec::new(), shapes: Vec::new() };
        for (mut pair, mut residual) in found.into_iter().zip(known) {
            if residual > bound {
                (pair, residual) =
                    nearby(&pencil, &ordering, &factor, &mut basis, self.mu, &slope, &pair, bound)?;
            }
            pair.vector.resize(basis.vectors.ncols(), c64::new(0.0, 0.0));
            let [real, imaginary] = lift(&basis, &pair.vector).map(|part| numbering.spread(&part));
            let parts = real.iter().flatten().zip(imaginary.iter().flatten());
            let mut shape: Vec<c64> = parts.map(|(re, im)| c64::new(*re, *im)).collect();
            let length = shape.iter().map(c64::norm_sqr).sum::<f64>().sqrt();
            for u in &mut shape {
                *u /= length;
            }
            station.shapes.push(shape);
            station.pairs.push((pair, residual));
        }
        Ok(station)
    }
}

/// The `count` lowest modes of the first value over the values of a parameter, to a residual of `bound`. A mode that more than four others
/// overtake is lost: ask for more then.
///
/// # Errors
/// A value that the parameter cannot have; modes that do not converge.
pub fn vary(
    setup: &Setup,
    parameter: Parameter,
    values: &[f64],
    count: usize,
    bound: f64,
) -> Result<Vec<Mode>, Error> {
    let stations: Result<Vec<Station>, Error> =
        values.iter().map(|value| setup.with(parameter, *value)?.station(count, bound)).collect();
    let stations = stations?;
    let steps: Vec<Vec<c64>> =
        stations.iter().map(|station| station.pairs.iter().map(|(pair, _)| pair.lambda).collect()).collect();
    let alike = |step: usize, old: usize, new: usize| {
        let (x, y) = (&stations[step].shapes[old], &stations[step + 1].shapes[new]);
        x.iter().zip(y).map(|(a, b)| a.conj() * b).sum::<c64>().norm_sqr()
    };
    let state = |step: usize, at: usize| {
        let (pair, residual) = &stations[step].pairs[at];
        State { lambda: pair.lambda, residual: *residual, direct: false }
    };
    let mode = |at: &[usize]| Mode { states: at.iter().enumerate().map(|(i, k)| state(i, *k)).collect() };
    Ok(follow_by(&steps, count, alike).iter().map(|branch| mode(&branch.at)).collect())
}
