//! How to integrate: how transients start, how long they are, and in which steps.

use crate::engine::method::Method;
use crate::engine::method::taylor::REFERENCE_ORDER;

/// Bound on the last two terms of the series relative to its leading terms; the error of a step is the
/// first term left out, one to two orders smaller.
pub const STEP_TOLERANCE: f64 = 1e-11;

/// How the transient starts; amplitudes are instance parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StartKind {
    /// At the sliding equilibrium plus `start_velocity` and `start_displacement`.
    Kick,
    /// On the most unstable eigenmode with `start_fraction` or `start_event_fraction`.
    Mode,
}

/// A length of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Duration {
    /// Seconds.
    Seconds(f64),
    /// Periods `2π/ω0` of the instance.
    Periods(f64),
    /// The instance's `ramp_duration`.
    Ramp,
}

/// How to integrate: what of the sweep is common to all instances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// How transients start.
    pub start: StartKind,
    /// Time before the measuring window, or before the first of a run until settled.
    pub settle: Duration,
    /// The latest start of a window in a run until settled.
    pub settle_limit: Option<Duration>,
    /// Whether a run until settled looks for its cycle, see [`crate::engine::cycle`].
    pub hunts: bool,
    /// Length of the measuring window.
    pub measure: Duration,
    /// Largest step: this many per period `2π/ω0`.
    pub steps_per_period: u32,
    /// How the reference takes a step; the other engines have their own way.
    pub method: Method,
    /// Order of the Taylor series.
    pub order: usize,
    /// Bound on the truncation of a step; infinite for steps of fixed length.
    pub tolerance: f64,
}

impl Plan {
    /// The method of the reference, from a kick, without a time.
    pub const REFERENCE: Plan = Plan {
        start: StartKind::Kick,
        settle: Duration::Seconds(0.0),
        settle_limit: None,
        hunts: false,
        measure: Duration::Seconds(0.0),
        steps_per_period: 0,
        method: Method::Taylor,
        order: REFERENCE_ORDER,
        tolerance: STEP_TOLERANCE,
    };
}
