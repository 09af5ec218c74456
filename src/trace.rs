//! One instance in full: the sampled trajectory.

use crate::model::contact::ContactState;
use crate::outcome::Outcome;

/// One sample of a trajectory, SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TraceRow {
    /// Time, s.
    pub t: f64,
    /// `x2`, `y2`, `y1`, m.
    pub position: [f64; 3],
    /// `ẋ2`, `ẏ2`, `ẏ1`, m/s.
    pub velocity: [f64; 3],
    /// `ẍ2`, `ÿ2`, `ÿ1`, m/s².
    pub acceleration: [f64; 3],
    /// Normal contact force N, N.
    pub normal_force: f64,
    /// Tangential contact force T, N.
    pub tangential_force: f64,
    /// Contact state.
    pub state: ContactState,
}

/// A trajectory and its outcome.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// Samples in order of time, events included (both sides of an impact).
    pub rows: Vec<TraceRow>,
    /// The observables, as a map would hold them.
    pub outcome: Outcome,
}

/// STUB: stands in until the real function is merged.
#[must_use]
pub fn trace(
    _spec: &crate::spec::Spec,
    _instance: &crate::spec::Instance,
    _samples_per_period: u32,
) -> Trace {
    Trace { rows: Vec::new(), outcome: Outcome::default() }
}
