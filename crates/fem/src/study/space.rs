//! How large a space of vectors is made, and where it is made good.

/// The last modes that are followed couple with modes above them: so many more are in the space.
pub(super) const MORE: usize = 8;

/// Rounds of corrections of the space; each takes an order of magnitude off the residuals.
pub(super) const ROUNDS: usize = 12;

/// A few values over all, both ends among them: where the space is made good.
pub(super) fn spread_over(mus: &[f64]) -> Vec<f64> {
    const FEW: usize = 5;
    let last = mus.len() - 1;
    let mut some: Vec<usize> = (0..FEW).map(|i| i * last / (FEW - 1)).collect();
    some.dedup();
    some.into_iter().map(|i| mus[i]).collect()
}
