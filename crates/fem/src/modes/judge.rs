//! The residuals of pairs at many coefficients of friction, at the price of a few.
//!
//! For every λ and μ the forces that a shape V y leaves over are a sum of M V y, Sᵀ K_n V y, Sᵀ M_n V y and so on, each with a factor; with
//! A = K − σ M, K V is A V + σ M V. The energies of these forces are computed once. As the pairs solve the projected problem, what is left
//! has no part in V, and A V none at all.

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, MatRef, Side, c64};

use super::columns::times;
use super::modal::damping_columns;
use super::{Basis, Factor, Pair};
use crate::Error;
use crate::assembly::{Pencil, Rows};

/// The factor of one kind of force: of λ⁰, λ and λ², without and with μ.
#[derive(Debug, Clone, Copy)]
struct Term {
    power: i32,
    friction: bool,
    /// What is added: σ, where the force comes from K, too.
    shift: f64,
}

/// Knows the residual of every pair on a basis.
#[derive(Debug)]
pub struct Judge {
    terms: Vec<Term>,
    /// Vᵀ A V.
    energy: Mat<f64>,
    /// Fᵀ A⁻¹ F of all forces, without their parts in V.
    left: Mat<f64>,
}

impl Judge {
    /// Solves with the forces of all vectors of the basis: as many times as it has vectors, for each kind of force.
    ///
    /// # Errors
    /// A factor whose shift lies above an eigenvalue.
    pub fn new(pencil: &Pencil, factor: &Factor, basis: &Basis, slope: &Rows) -> Result<Self, Error> {
        let (vectors, size) = (&basis.vectors, basis.vectors.ncols());
        let spread = |forces: MatRef<'_, f64>| {
            let mut all = Mat::zeros(pencil.size(), size);
            for j in 0..size {
                for (row, force) in pencil.slip.rows.iter().zip(forces.col(j).iter()) {
                    for (i, s) in row {
                        all[(*i, j)] += s * force;
                    }
                }
            }
            all
        };
        let term = |power, friction| Term { power, friction, shift: 0.0 };
        let mut terms = vec![Term { shift: factor.shift, ..term(2, false) }];
        let mut forces = vec![times(&pencil.mass, vectors)];
        for (power, normal) in [(0, 0), (2, 1), (1, 2)] {
            let normal = &basis.normal()[normal];
            if normal.norm_max() > 0.0 {
                terms.push(term(power, true));
                forces.push(spread(normal.as_ref()));
            }
        }
        if let Some(damping) = damping_columns(pencil, vectors) {
            terms.push(term(1, false));
            forces.push(damping);
        }
        if !slope.rows.is_empty() {
            terms.push(term(1, false));
            forces.push(spread(basis.damped(slope).as_ref()));
        }
        let energy = basis.energy(factor.shift);
        let cholesky = energy.llt(Side::Lower).map_err(|_| Error::Solver {
            what: format!(
                "the shift {:.6e} 1/s2 of the factor lies above an eigenvalue: move it below",
                factor.shift
            ),
        })?;
        // What lies in V is taken from forces and responses first: differences of energies would lose half of the digits.
        let mut images = forces[0].clone();
        images *= faer::Scale(-factor.shift);
        images += times(&pencil.stiffness, vectors);
        let mut left = Mat::zeros(terms.len() * size, terms.len() * size);
        for b in 0..terms.len() {
            let mut responses = forces[b].clone();
            factor.solve(responses.as_mut());
            let inside = cholesky.solve(vectors.transpose() * &forces[b]);
            responses -= vectors * &inside;
            forces[b] -= &images * &inside;
            for a in 0..=b {
                let block = forces[a].transpose() * &responses;
                for (i, j) in (0..size).flat_map(|j| (0..size).map(move |i| (i, j))) {
                    left[(a * size + i, b * size + j)] = block[(i, j)];
                    left[(b * size + j, a * size + i)] = block[(i, j)];
                }
            }
        }
        Ok(Self { terms, energy, left })
    }

    /// The residual of a pair of the projected problem, as [`super::residuals`] has it. What is below 1e-8 may be rounding of the energies.
    #[must_use]
    pub fn residual(&self, mu: f64, pair: &Pair) -> f64 {
        let size = pair.vector.len();
        let factors: Vec<c64> = self
            .terms
            .iter()
            .map(|term| (pair.lambda.powi(term.power) + term.shift) * if term.friction { mu } else { 1.0 })
            .collect();
        let form = |matrix: &Mat<f64>, vector: &[c64]| -> f64 {
            let parts: [fn(&c64) -> f64; 2] = [|x| x.re, |x| x.im];
            let part = |of: fn(&c64) -> f64| {
                let x: Col<f64> = vector.iter().map(of).collect();
                x.transpose() * (matrix * &x)
            };
            parts.map(part).iter().sum()
        };
        let stacked: Vec<c64> =
            factors.iter().flat_map(|f| (0..size).map(move |i| f * pair.vector[i])).collect();
        (form(&self.left, &stacked).max(0.0) / form(&self.energy, &pair.vector)).sqrt()
    }
}
