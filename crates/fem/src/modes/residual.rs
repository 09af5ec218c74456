//! How well a pair of the projected problem solves the full one, and a better space where it does not.

use faer::{Mat, c64};

use super::{Basis, Factor, Pair, dense};
use crate::Error;
use crate::assembly::{Pencil, Rows};

/// P(λ, μ) x as real and imaginary part.
fn defect(pencil: &Pencil, mu: f64, slope: &Rows, lambda: c64, x: &[Vec<f64>; 2]) -> [Vec<f64>; 2] {
    let squared = lambda * lambda;
    let mut defect = [0, 1].map(|part| pencil.stiffness_times(mu, &x[part]));
    let mut add = |factor: c64, image: [Vec<f64>; 2]| {
        for i in 0..image[0].len() {
            let value = factor * c64::new(image[0][i], image[1][i]);
            defect[0][i] += value.re;
            defect[1][i] += value.im;
        }
    };
    add(squared, [0, 1].map(|part| pencil.mass_times(mu, &x[part])));
    if pencil.damping.is_some() || !slope.rows.is_empty() {
        add(lambda, [0, 1].map(|part| pencil.damping_times(mu, slope, &x[part])));
    }
    defect
}

/// A vector of the basis' coordinates as real and imaginary part of all unknowns.
#[must_use]
pub fn lift(basis: &Basis, vector: &[c64]) -> [Vec<f64>; 2] {
    let parts = Mat::from_fn(vector.len(), 2, |i, j| if j == 0 { vector[i].re } else { vector[i].im });
    let lifted = &basis.vectors * parts;
    [0, 1].map(|part| lifted.col(part).iter().copied().collect())
}

/// The corrections (K − σ M)⁻¹ P x of some pairs, as pairs of columns, and the residual of each pair.
///
/// The residual is √(rᴴ (K − σ M)⁻¹ r / xᴴ (K − σ M) x): the energy of the forces r that are left over against that of the
/// shape. It does not depend on the mesh or the units. σ must lie below all eigenvalues.
#[must_use]
pub fn residuals(
    pencil: &Pencil,
    factor: &Factor,
    basis: &Basis,
    mu: f64,
    slope: &Rows,
    pairs: &[Pair],
) -> (Mat<f64>, Vec<f64>) {
    let size = pencil.size();
    let mut corrections = Mat::zeros(size, 2 * pairs.len());
    let mut energies = Vec::with_capacity(pairs.len());
    for (k, pair) in pairs.iter().enumerate() {
        let x = lift(basis, &pair.vector);
        let r = defect(pencil, mu, slope, pair.lambda, &x);
        for part in 0..2 {
            (0..size).for_each(|i| corrections[(i, 2 * k + part)] = r[part][i]);
        }
        let energy =
            |x: &Vec<f64>| dot(x, &pencil.stiffness.times(x)) - factor.shift * dot(x, &pencil.mass.times(x));
        energies.push(energy(&x[0]) + energy(&x[1]));
    }
    let forces = corrections.clone();
    factor.solve(corrections.as_mut());
    let residual = energies
        .iter()
        .enumerate()
        .map(|(k, energy)| {
            let left: f64 = (2 * k..2 * k + 2).map(|j| forces.col(j).transpose() * corrections.col(j)).sum();
            (left.max(0.0) / energy).sqrt()
        })
        .collect();
    (corrections, residual)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
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
        let mut columns: Vec<Vec<f64>> = Vec::new();
        for mu in mus {
            let mut pairs = dense::pairs(&basis.at(*mu, slope))?;
            pairs.truncate(count);
            let (corrections, residual) = residuals(pencil, factor, basis, *mu, slope, &pairs);
            for (k, residual) in residual.iter().enumerate() {
                worst = worst.max(*residual);
                if *residual > bound {
                    columns.extend((2 * k..2 * k + 2).map(|j| super::real::column(&corrections, j)));
                }
            }
        }
        if columns.is_empty() || round == rounds {
            return Ok(worst);
        }
        let new = basis.extend(pencil, &Mat::from_fn(pencil.size(), columns.len(), |i, j| columns[j][i]));
        if new == 0 {
            return Ok(worst);
        }
    }
    Ok(f64::INFINITY)
}
