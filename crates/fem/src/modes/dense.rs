//! Complex eigenvalues of a small dense problem.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side, c64};

use super::Small;
use super::pair::{Pair, likeness, matched};
use crate::Error;

/// All pairs of (λ² M + λ C + K) x = 0 with a frequency of 0 or more, one for each mode. They rise with the frequency, where something
/// damps with the one |λ| that they had without damping: of what damping slows down the frequency itself may be next to nothing.
/// A mode that damping keeps from vibrating has two real eigenvalues, of which the larger one is taken, as that is what lasts; its place is
/// that of the frequency √(xᴴ K x / xᴴ M x) of the shape of the slower one.
///
/// # Errors
/// Where the iteration for the eigenvalues does not converge.
pub fn pairs(small: &Small) -> Result<Vec<Pair>, Error> {
    let mut pairs = match &small.damping {
        None => undamped(small)?.into_iter().map(|pair| (pair.lambda.im, pair)).collect(),
        Some(damping) => placed(small, damped(small, damping)?),
    };
    pairs.sort_by(|a, b| {
        (a.0, a.1.lambda.re).partial_cmp(&(b.0, b.1.lambda.re)).unwrap_or(std::cmp::Ordering::Equal)
    });
    Ok(pairs.into_iter().map(|(_, pair)| pair).collect())
}

/// One pair for each mode, with the frequency (1/s) of its place.
///
/// With e = xᴴ K x / xᴴ M x the other eigenvalue of an oscillator of the shape x is e/λ: λ is the slow one of both where λ² ≤ e, which damping
/// and stiffness make, or the fast one, which inertia and damping make. Each fast one belongs to the slow one whose shape is most like its own.
fn placed(small: &Small, all: Vec<Pair>) -> Vec<(f64, Pair)> {
    let (real, vibrating): (Vec<Pair>, Vec<Pair>) = all.into_iter().partition(|pair| pair.lambda.im == 0.0);
    let mut placed: Vec<(f64, Pair)> = vibrating.into_iter().map(|pair| (pair.lambda.norm(), pair)).collect();
    let real: Vec<(f64, Pair)> = real.into_iter().map(|pair| (energy(small, &pair.vector), pair)).collect();
    let mut left: Vec<&Pair> = real.iter().filter(|one| one.0 <= 0.0).map(|one| &one.1).collect();
    for grows in [false, true] {
        let of_sign = real.iter().filter(|one| (one.1.lambda.re > 0.0) == grows && one.0 > 0.0);
        let (slow, fast): (Vec<_>, Vec<_>) = of_sign.partition(|one| one.1.lambda.re.powi(2) <= one.0);
        let offers = (0..slow.len())
            .flat_map(|s| (0..fast.len()).map(move |f| (s, f)))
            .map(|(s, f)| (likeness(&slow[s].1.vector, &fast[f].1.vector), s, f))
            .collect();
        let partner = matched(offers, [slow.len(), fast.len()]);
        for (slow, partner) in slow.iter().zip(&partner) {
            match partner {
                Some(f) => {
                    let lasting = if grows { fast[*f] } else { slow };
                    placed.push((slow.0.sqrt(), lasting.1.clone()));
                }
                None => left.push(&slow.1),
            }
        }
        let alone = fast.iter().enumerate().filter(|(f, _)| !partner.contains(&Some(*f)));
        left.extend(alone.map(|(_, one)| &one.1));
    }
    // Of what is left, such as what stiffness itself drives away, each mode has two as well.
    left.sort_by(|a, b| a.lambda.norm().total_cmp(&b.lambda.norm()));
    for some in left.chunks(2) {
        let product: f64 = some.iter().map(|pair| pair.lambda.re).product();
        let lasting = some.iter().max_by(|a, b| a.lambda.re.total_cmp(&b.lambda.re));
        placed.extend(lasting.map(|pair| (product.max(0.0).sqrt(), (*pair).clone())));
    }
    placed
}

/// xᴴ K x / xᴴ M x, 1/s².
fn energy(small: &Small, vector: &[c64]) -> f64 {
    let form = |matrix: &Mat<f64>| -> f64 {
        let row = |i: usize| (0..vector.len()).map(|j| vector[j] * matrix[(i, j)]).sum::<c64>();
        (0..vector.len()).map(|i| (vector[i].conj() * row(i)).re).sum()
    };
    form(&small.stiffness) / form(&small.mass)
}

/// Eigenvalues, rising, and orthonormal vectors of a symmetric matrix, of which the lower triangle counts.
///
/// faer 0.24 has thresholds that do not scale with the matrix: with entries of 1e13 and more than a hundred rows its vectors are wrong in
/// the third digit. So the matrix is brought to a norm of 1 first.
pub(super) fn symmetric(matrix: &Mat<f64>) -> Result<(Vec<f64>, Mat<f64>), Error> {
    let norm = matrix.norm_max();
    let scale = if norm > 0.0 { norm } else { 1.0 };
    let scaled = Mat::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)] / scale);
    let eigen = scaled.self_adjoint_eigen(Side::Lower).map_err(|_| failed(matrix.nrows()))?;
    let values = (0..matrix.nrows()).map(|k| scale * eigen.S()[k]).collect();
    Ok((values, eigen.U().to_owned()))
}

fn failed(size: usize) -> Error {
    Error::Solver {
        what: format!(
            "the eigenvalues of a matrix of {size} rows did not converge: check the model's numbers"
        ),
    }
}

/// θ of M⁻¹ K x = θ x; λ = i √θ.
fn undamped(small: &Small) -> Result<Vec<Pair>, Error> {
    let size = small.mass.nrows();
    let matrix = small.mass.partial_piv_lu().solve(&small.stiffness);
    let eigen = matrix.eigen().map_err(|_| failed(size))?;
    let pair = |k: usize| {
        let root = eigen.S()[k].sqrt();
        let lambda = c64::new(-root.im, root.re);
        // Without a frequency the one of both that grows is the one to know of.
        let lambda = if lambda.im == 0.0 { c64::new(lambda.re.abs(), 0.0) } else { lambda };
        Pair { lambda, vector: unit((0..size).map(|i| eigen.U()[(i, k)])) }
    };
    Ok((0..size).map(pair).collect())
}

/// Of an eigenvalue, what rounding makes of no frequency.
const ROUNDING: f64 = 1e-8;

/// λ of the companion matrix [0 1; −M⁻¹K −M⁻¹C], in a unit of time in which both blocks are of one size.
fn damped(small: &Small, damping: &Mat<f64>) -> Result<Vec<Pair>, Error> {
    let size = small.mass.nrows();
    let lu = small.mass.partial_piv_lu();
    let (stiffness, damping) = (lu.solve(&small.stiffness), lu.solve(damping));
    let unit_of_time = stiffness.norm_max().sqrt();
    let companion = Mat::from_fn(2 * size, 2 * size, |i, j| match (i < size, j < size) {
        (true, true) => 0.0,
        (true, false) => f64::from(u8::from(i + size == j)),
        (false, true) => -stiffness[(i - size, j)] / (unit_of_time * unit_of_time),
        (false, false) => -damping[(i - size, j - size)] / unit_of_time,
    });
    let eigen = companion.eigen().map_err(|_| failed(2 * size))?;
    // Rounding makes a conjugate pair of a real eigenvalue that two modes have.
    let is_real = |lambda: c64| lambda.im.abs() <= ROUNDING * lambda.norm();
    let pair = |k: usize| {
        let lambda = eigen.S()[k] * unit_of_time;
        let lambda = if is_real(lambda) { c64::new(lambda.re, 0.0) } else { lambda };
        Pair { lambda, vector: unit((0..size).map(|i| eigen.U()[(i, k)])) }
    };
    Ok((0..2 * size).filter(|k| eigen.S()[*k].im >= 0.0 || is_real(eigen.S()[*k])).map(pair).collect())
}

fn unit(vector: impl Iterator<Item = c64>) -> Vec<c64> {
    let mut vector: Vec<c64> = vector.collect();
    let norm = vector.iter().map(c64::norm_sqr).sum::<f64>().sqrt();
    for x in &mut vector {
        *x /= norm;
    }
    vector
}
