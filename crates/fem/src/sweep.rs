//! Complex modes over many coefficients of friction, each mode followed by its shape.

use faer::c64;

use crate::Error;
use crate::assembly::{Pencil, Rows};
use crate::modes::{Basis, Factor, Judge, Near, Ordering, follow, lift, near, nearby, pairs};

/// A mode at one coefficient of friction.
#[derive(Debug, Clone, Copy)]
pub struct State {
    /// Growth rate and angular frequency, 1/s.
    pub lambda: c64,
    /// Of the full problem: see [`crate::modes::residuals`] for the projected problem, [`near`] for the direct solution.
    pub residual: f64,
    /// Whether it was computed directly, because the projected problem was not good enough.
    pub direct: bool,
}

/// A mode at each coefficient of friction.
#[derive(Debug, Clone)]
pub struct Mode {
    /// In the order of the coefficients.
    pub states: Vec<State>,
}

/// What a sweep goes over.
#[derive(Debug, Clone, Copy)]
pub struct Range<'a> {
    /// Coefficients of friction.
    pub mus: &'a [f64],
    /// Damping by a slope of friction (N s/m) between contact points; no rows for none.
    pub slope: &'a Rows,
    /// Number of modes, from the lowest on.
    pub count: usize,
    /// The largest residual that is good enough. Where the projected problem has a larger one, the mode is computed directly.
    pub bound: f64,
}

/// Computes the modes.
///
/// # Errors
/// Where eigenvalues do not converge.
pub fn sweep(
    pencil: &Pencil,
    ordering: &Ordering,
    factor: &Factor,
    basis: &Basis,
    range: Range<'_>,
) -> Result<Vec<Mode>, Error> {
    let steps: Result<Vec<_>, Error> =
        range.mus.iter().map(|mu| pairs(&basis.at(*mu, range.slope))).collect();
    let steps = steps?;
    let branches = follow(&steps, range.count);
    let undamped = !pencil.is_damped() && range.slope.rows.is_empty();
    let mut modes = vec![Mode { states: Vec::with_capacity(range.mus.len()) }; branches.len()];
    let judge = Judge::new(pencil, factor, basis, range.slope)?;
    for (i, mu) in range.mus.iter().enumerate() {
        for (mode, branch) in modes.iter_mut().zip(&branches) {
            let pair = &steps[i][branch.at[i]];
            let residual = judge.residual(*mu, pair);
            let projected = State { lambda: pair.lambda, residual, direct: false };
            let state = if residual <= range.bound {
                projected
            } else if undamped {
                directly(pencil, ordering, *mu, pair.lambda, &lift(basis, &pair.vector), range.bound)?
            } else {
                let (mut basis, slope) = (basis.clone(), range.slope);
                let (pair, residual) =
                    nearby(pencil, ordering, factor, &mut basis, *mu, slope, pair, range.bound)?;
                State { lambda: pair.lambda, residual, direct: true }
            };
            mode.states.push(state);
        }
    }
    Ok(modes)
}

/// The mode of the full problem that is most like that of the projected one, in shape and eigenvalue.
fn directly(
    pencil: &Pencil,
    ordering: &Ordering,
    mu: f64,
    guess: c64,
    shape: &[Vec<f64>; 2],
    bound: f64,
) -> Result<State, Error> {
    /// Enough to have both of a pair and its neighbours.
    const NEIGHBOURS: usize = 6;
    /// So far beside the guess, as a mode that friction does not change is one of K − σ M, too, which would be singular.
    const BESIDE: f64 = 1e-5;
    let shift = -(guess * guess).re * (1.0 - BESIDE);
    let factor = Factor::new(ordering, &pencil.stiffness, &pencil.mass, shift)?;
    let found = near(pencil, &factor, mu, NEIGHBOURS.min(pencil.size()), bound)?;
    let images = [0, 1].map(|part| pencil.mass.times(&shape[part]));
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let likeness = |mode: &Near| {
        let real = dot(&images[0], &mode.shape[0]) + dot(&images[1], &mode.shape[1]);
        let imaginary = dot(&images[0], &mode.shape[1]) - dot(&images[1], &mode.shape[0]);
        let own: f64 = mode.shape.iter().map(|part| dot(&pencil.mass.times(part), part)).sum();
        let apart = (mode.lambda - guess).norm() / guess.norm().max(f64::MIN_POSITIVE);
        (real * real + imaginary * imaginary) / own - apart
    };
    let best = found.into_iter().map(|mode| (likeness(&mode), mode)).max_by(|a, b| a.0.total_cmp(&b.0));
    best.map(|(_, mode)| State { lambda: mode.lambda, residual: mode.residual, direct: true }).ok_or_else(
        || Error::Solver {
            what: format!("no complex mode was found near {:.1} Hz", guess.im / std::f64::consts::TAU),
        },
    )
}
