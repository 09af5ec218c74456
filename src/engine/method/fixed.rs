//! Events as codes with a fixed step see them: a contact state holds for whole steps, and what happened within one is
//! carried out at its end. The time of every transition is then wrong by up to a step.

use crate::engine::method::roots::Crossing;
use crate::engine::method::taylor::horner;

/// Whether an event function, a polynomial `Σ g_k τ^k`, is below zero at the end of the step; with the arguments of
/// [`crate::engine::method::roots::first_crossing`].
#[must_use]
pub fn at_end(series: &[f64], step: f64, _from_zero: bool) -> Crossing {
    if horner(series, step) < 0.0 { Crossing::At(step) } else { Crossing::Never }
}
