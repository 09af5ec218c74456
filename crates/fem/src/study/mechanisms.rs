//! What the modes of a study would do with one mechanism alone.

use faer::c64;

use crate::Error;
use crate::assembly::Rows;
use crate::modes::{Basis, Pair, alone, pairs};
use crate::sweep::Mode;

/// Growth rates of a mode without the slope of friction, and without the feedback of the normal force, 1/s.
pub type Alone = [f64; 2];

/// For each mode, at each coefficient of friction. The feedback away, friction is in no matrix: that growth rate is the same for all.
pub(super) fn mechanisms(
    basis: &Basis,
    slope: &Rows,
    mus: &[f64],
    modes: &[Mode],
) -> Result<Vec<Vec<Alone>>, Error> {
    let mut found: Vec<Vec<Alone>> = vec![Vec::with_capacity(mus.len()); modes.len()];
    let mut frozen: Option<Vec<f64>> = None;
    for (i, mu) in mus.iter().enumerate() {
        let states = modes.iter().map(|mode| mode.states[i].lambda);
        let flat: Vec<f64> = if slope.rows.is_empty() && frozen.is_some() {
            states.map(|lambda| lambda.re).collect()
        } else {
            let own = nearest(pairs(&basis.at(*mu, slope))?, states);
            let both = alone(basis, *mu, slope, &own)?;
            frozen.get_or_insert_with(|| both.iter().map(|alone| alone.frozen.re).collect());
            both.iter().map(|alone| alone.flat.re).collect()
        };
        for (k, mode) in found.iter_mut().enumerate() {
            mode.push([flat[k], frozen.as_ref().map_or(0.0, |frozen| frozen[k])]);
        }
    }
    Ok(found)
}

/// For each eigenvalue the pair that has it, each pair once.
fn nearest(mut all: Vec<Pair>, lambdas: impl Iterator<Item = c64>) -> Vec<Pair> {
    let mut found = Vec::new();
    for lambda in lambdas {
        let apart = |pair: &Pair| (pair.lambda - lambda).norm();
        let best = (0..all.len()).min_by(|a, b| apart(&all[*a]).total_cmp(&apart(&all[*b])));
        found.extend(best.map(|best| all.swap_remove(best)));
    }
    found
}
