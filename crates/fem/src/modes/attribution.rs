//! Which mechanism makes a mode grow: the same mode with one of both taken away.

use faer::c64;

use super::{Basis, Pair, follow, pairs};
use crate::Error;
use crate::assembly::Rows;

/// λ (1/s) of a mode with one mechanism alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Alone {
    /// Without the slope of friction: mode coupling by the normal force alone.
    pub flat: c64,
    /// Without the feedback of the normal force, μ = 0 in the matrices, the slope kept at the frozen N0: falling friction alone.
    pub frozen: c64,
}

/// The modes at a coefficient of friction with one mechanism alone, each the one most alike in shape and eigenvalue.
///
/// # Errors
/// Where the eigenvalues do not converge.
pub fn alone(basis: &Basis, mu: f64, slope: &Rows, modes: &[Pair]) -> Result<Vec<Alone>, Error> {
    let like = |others: Vec<Pair>| -> Vec<c64> {
        let steps = [modes.to_vec(), others];
        follow(&steps, modes.len()).iter().map(|branch| steps[1][branch.at[1]].lambda).collect()
    };
    let flat = like(pairs(&basis.at(mu, &Rows::default()))?);
    let frozen = like(pairs(&basis.at(0.0, slope))?);
    Ok(flat.into_iter().zip(frozen).map(|(flat, frozen)| Alone { flat, frozen }).collect())
}
