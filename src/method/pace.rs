//! The longest step that a Taylor series of some order may take of a mode, whether the motion shows it or not.

use crate::model::fastest::Fastest;

/// Beyond this many radians of an undamped mode a step makes it grow, for every order in use: the first excess over 1
/// of the step's amplification lies at 2.02 for order 8, 1.86 for order 12 and 2.11 for order 16.
pub const STABLE: f64 = 1.8;

/// In contact, which may last for the whole of a run, a step takes at most this part from a mode: what rings unseen
/// is still there at the end.
pub const KEPT: f64 = 5e-7;

/// The longest step of slip, reversed slip, stick and flight: no mode of it turns by more than [`STABLE`], nor so far
/// that the last term of its own series, `(|λ| h)^n/n!`, is above `tolerance` (in contact: nor above [`KEPT`]); infinite
/// for steps of fixed length.
#[must_use]
pub fn longest_steps(fastest: &Fastest, order: usize, tolerance: f64) -> [f64; 4] {
    if !tolerance.is_finite() {
        return [f64::INFINITY; 4];
    }
    let contact = turn(order, tolerance.min(KEPT));
    let [slip, reverse, stick, free] = *fastest;
    [contact / slip, contact / reverse, contact / stick, turn(order, tolerance) / free]
}

/// How far a mode may turn within a step.
fn turn(order: usize, tolerance: f64) -> f64 {
    let factorial: f64 = (1..=order).map(|k| k as f64).product();
    (tolerance * factorial).powf(1.0 / order as f64).min(STABLE)
}

/// Whether steps are so short that a scalar of that rounding stands still: `x + ẍ h²` is `x`.
#[must_use]
pub fn stands_still(longest: f64, epsilon: f64) -> bool {
    longest * longest < epsilon
}
