//! The band of frequencies that a study asks for.

use super::Study;
use crate::sweep::Mode;

/// Whether a mode lies in the band at any coefficient of friction.
#[must_use]
pub fn in_band(study: &Study, mode: &Mode) -> bool {
    let [low, high] = study.document.modes.band;
    mode.states.iter().any(|state| (low..=high).contains(&(state.lambda.im / std::f64::consts::TAU)))
}
