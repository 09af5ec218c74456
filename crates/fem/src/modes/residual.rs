//! How well a pair of the projected problem solves the full one, and a better space where it does not.

use faer::{Mat, Side, c64};

use super::columns::{column, times};
use super::{Basis, Factor, Pair, dense};
use crate::Error;
use crate::assembly::{Pencil, Rows};

/// A vector of the basis' coordinates as real and imaginary part of all unknowns.
#[must_use]
pub fn lift(basis: &Basis, vector: &[c64]) -> [Vec<f64>; 2] {
    let parts = Mat::from_fn(vector.len(), 2, |i, j| if j == 0 { vector[i].re } else { vector[i].im });
    let lifted = &basis.vectors * parts;
    [0, 1].map(|part| lifted.col(part).iter().copied().collect())
}

/// P(λ, μ) x of some pairs whose shapes are given as pairs of columns, real and imaginary part.
fn defects(pencil: &Pencil, mu: f64, slope: &Rows, pairs: &[Pair], shapes: &Mat<f64>) -> Mat<f64> {
    let damped = pencil.is_damped() || !slope.rows.is_empty();
    let mut sum = times(&pencil.stiffness, shapes);
    let mass = times(&pencil.mass, shapes);
    for (k, pair) in pairs.iter().enumerate() {
        let x = [0, 1].map(|part| column(shapes, 2 * k + part));
        let mut add = |factor: c64, image: [Vec<f64>; 2]| {
            for i in 0..image[0].len() {
                let value = factor * c64::new(image[0][i], image[1][i]);
                sum[(i, 2 * k)] += value.re;
                sum[(i, 2 * k + 1)] += value.im;
            }
        };
        let squared = pair.lambda * pair.lambda;
        add(squared, [0, 1].map(|part| column(&mass, 2 * k + part)));
        if mu != 0.0 {
            let friction = |normal: &Rows, part: usize| {
                let force: Vec<f64> = normal.times(&x[part]).iter().map(|n| mu * n).collect();
                let mut image = vec![0.0; x[part].len()];
                pencil.slip.add_transposed(&force, &mut image);
                image
            };
            add(c64::new(1.0, 0.0), [0, 1].map(|part| friction(&pencil.normal_stiffness, part)));
            add(squared, [0, 1].map(|part| friction(&pencil.normal_mass, part)));
        }
        if damped {
            add(pair.lambda, [0, 1].map(|part| pencil.damping_times(mu, slope, &x[part])));
        }
    }
    sum
}

/// What pairs of the projected problem leave of the full one, as pairs of columns, real and imaginary part.
pub(super) struct Left {
    /// r = P x.
    pub(super) forces: Mat<f64>,
    /// (K − σ M)⁻¹ r.
    pub(super) corrections: Mat<f64>,
    /// xᴴ (K − σ M) x of each pair.
    energies: Vec<f64>,
    /// Of each pair.
    pub(super) residual: Vec<f64>,
}

pub(super) fn left(
    pencil: &Pencil,
    factor: &Factor,
    basis: &Basis,
    mu: f64,
    slope: &Rows,
    pairs: &[Pair],
) -> Left {
    let parts = Mat::from_fn(basis.vectors.ncols(), 2 * pairs.len(), |i, j| {
        let x = pairs[j / 2].vector[i];
        if j % 2 == 0 { x.re } else { x.im }
    });
    let forces = defects(pencil, mu, slope, pairs, &(&basis.vectors * &parts));
    // Shapes of stable modes without damping are real: nothing is left of their imaginary parts.
    let some: Vec<usize> = (0..forces.ncols()).filter(|j| forces.col(*j).norm_max() > 0.0).collect();
    let mut solved = Mat::from_fn(forces.nrows(), some.len(), |i, j| forces[(i, some[j])]);
    factor.solve(solved.as_mut());
    let mut corrections = Mat::zeros(forces.nrows(), forces.ncols());
    for (j, from) in some.iter().zip(solved.col_iter()) {
        corrections.col_mut(*j).copy_from(from);
    }
    let energy = basis.energy(factor.shift);
    let energies: Vec<f64> = (0..pairs.len())
        .map(|k| (2 * k..2 * k + 2).map(|j| parts.col(j).transpose() * &energy * parts.col(j)).sum())
        .collect();
    let residual = energies
        .iter()
        .enumerate()
        .map(|(k, energy)| {
            let left: f64 = (2 * k..2 * k + 2).map(|j| forces.col(j).transpose() * corrections.col(j)).sum();
            (left.max(0.0) / energy).sqrt()
        })
        .collect();
    Left { forces, corrections, energies, residual }
}

/// The residual of some pairs: √(rᴴ (K − σ M)⁻¹ r / xᴴ (K − σ M) x), the energy of the forces r that are left over against that of
/// the shape. It does not depend on the mesh or the units. σ must lie below all eigenvalues.
#[must_use]
pub fn residuals(
    pencil: &Pencil,
    factor: &Factor,
    basis: &Basis,
    mu: f64,
    slope: &Rows,
    pairs: &[Pair],
) -> Vec<f64> {
    left(pencil, factor, basis, mu, slope, pairs).residual
}

/// Columns that span the corrections of the pairs with a residual above a bound: those directions whose part in them is above half the
/// bound.
struct Corrections {
    forces: Vec<Vec<f64>>,
    corrections: Vec<Vec<f64>>,
}

impl Corrections {
    fn add(&mut self, left: &Left, bound: f64) {
        for (k, _) in left.residual.iter().enumerate().filter(|(_, residual)| **residual > bound) {
            // As long as the residual, in energy.
            let scale = 1.0 / left.energies[k].sqrt();
            for j in 2 * k..2 * k + 2 {
                let scaled = |of: &Mat<f64>| of.col(j).iter().map(|x| scale * x).collect();
                self.forces.push(scaled(&left.forces));
                self.corrections.push(scaled(&left.corrections));
            }
        }
    }

    /// One mode at several μ lacks much the same: the corrections of all have few directions.
    fn directions(&self, bound: f64) -> Result<Mat<f64>, Error> {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let count = self.corrections.len();
        let energy = Mat::from_fn(count, count, |i, j| {
            let (i, j) = (i.max(j), i.min(j));
            dot(&self.corrections[i], &self.forces[j])
        });
        let failed =
            |_| Error::Solver { what: "the corrections of the projected modes are no numbers".to_owned() };
        let eigen = energy.self_adjoint_eigen(Side::Lower).map_err(failed)?;
        let kept: Vec<usize> = (0..count).filter(|k| eigen.S()[*k] > (bound / 2.0).powi(2)).collect();
        let mut directions = Mat::zeros(self.corrections.first().map_or(0, Vec::len), kept.len());
        for (j, k) in kept.iter().rev().enumerate() {
            for (i, correction) in self.corrections.iter().enumerate() {
                let weight = eigen.U()[(i, *k)];
                directions.col_mut(j).iter_mut().zip(correction).for_each(|(d, c)| *d += weight * c);
            }
        }
        Ok(directions)
    }
}

/// Enlarges the basis by corrections until the `count` lowest pairs at each of some μ have a residual of at most `bound`, or for
/// `rounds` rounds. Gives the largest residual that is left.
///
/// Modes of the body without friction have no shear stress on the sliding surface, complex modes have: without these vectors the
/// projection converges slowly.
///
/// # Errors
/// Where the eigenvalues do not converge.
#[expect(
    clippy::too_many_arguments,
    reason = "the problem, the space, and the four numbers that say how far to go"
)]
pub fn refine(
    pencil: &Pencil,
    factor: &Factor,
    basis: &mut Basis,
    mus: &[f64],
    slope: &Rows,
    count: usize,
    bound: f64,
    rounds: usize,
) -> Result<f64, Error> {
    for round in 0.. {
        let mut worst = 0.0_f64;
        let mut found = Corrections { forces: Vec::new(), corrections: Vec::new() };
        for mu in mus {
            let mut pairs = dense::pairs(&basis.at(*mu, slope))?;
            pairs.truncate(count);
            let left = left(pencil, factor, basis, *mu, slope, &pairs);
            worst = left.residual.iter().copied().fold(worst, f64::max);
            found.add(&left, bound);
        }
        if found.corrections.is_empty() || round == rounds {
            return Ok(worst);
        }
        if basis.extend(pencil, &found.directions(bound)?) == 0 {
            return Ok(worst);
        }
    }
    Ok(f64::INFINITY)
}
