//! The record of one integrated instance and its status codes.

use serde::Serialize;

use crate::settle::Ending;

/// How one instance ended. Code 0 means *unwritten*: a map that holds one is an error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
#[repr(u32)]
pub enum Status {
    /// Left out by what should have computed it; legal nowhere.
    #[default]
    Unwritten = 0,
    /// Computed to the end.
    Ok = 1,
    /// The friction law is ill-posed: `constant` with `mu_s < mu_d`.
    InvalidLaw = 2,
    /// No sliding equilibrium exists (`c + μ0 s ≤ 0`, divergence).
    NoEquilibrium = 3,
    /// `M11 ≤ 0`: the forward dynamics is not unique (Painlevé).
    Painleve = 4,
    /// Events piled up (chatter, Zeno) beyond the limit; `simulated_time` says how far it came.
    EventLimit = 5,
    /// The step needed for this instance is smaller than the integrator allows, or the run has more than
    /// [`crate::response::MOST_STEPS`], or a period more than [`crate::integrate::MAX_STEPS_PER_PERIOD`].
    StepTooLarge = 6,
    /// The state left the range of finite numbers, or its scaled parameters are beyond [`crate::response::LARGEST`].
    NonFinite = 7,
    /// The run was stopped before it came to this instance.
    NotComputed = 8,
}

impl Status {
    /// Every way in which a computed instance ends: all that an engine or a kernel may return.
    pub const ALL: [Status; 7] = [
        Status::Ok,
        Status::InvalidLaw,
        Status::NoEquilibrium,
        Status::Painleve,
        Status::EventLimit,
        Status::StepTooLarge,
        Status::NonFinite,
    ];

    /// Every status that may stand in a map: those of [`Status::ALL`], and what a stopped run leaves.
    pub const IN_MAP: [Status; 8] = [
        Status::Ok,
        Status::InvalidLaw,
        Status::NoEquilibrium,
        Status::Painleve,
        Status::EventLimit,
        Status::StepTooLarge,
        Status::NonFinite,
        Status::NotComputed,
    ];

    /// The status an engine or a kernel returned as a code; `None` when it may not return that.
    #[must_use]
    pub fn from_code(code: u32) -> Option<Status> {
        Status::ALL.into_iter().find(|status| *status as u32 == code)
    }

    /// Whether an instance ended for a reason that may lie in the arithmetic: what piles up or overflows in one may come
    /// through in another.
    #[must_use]
    pub fn may_come_through(self) -> bool {
        matches!(self, Status::EventLimit | Status::StepTooLarge | Status::NonFinite)
    }

    /// The name in `map.csv`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Status::Unwritten => "unwritten",
            Status::Ok => "ok",
            Status::InvalidLaw => "invalid_law",
            Status::NoEquilibrium => "no_equilibrium",
            Status::Painleve => "painleve",
            Status::EventLimit => "event_limit",
            Status::StepTooLarge => "step_too_large",
            Status::NonFinite => "non_finite",
            Status::NotComputed => "not_computed",
        }
    }
}

/// What the transient of one instance did, SI units; `None` is an undefined value.
///
/// Means, deviations and fractions are over the measuring window, time-weighted.
/// When `status` is not [`Status::Ok`] every observable is `None`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outcome {
    /// How the instance ended.
    pub status: Status,
    /// Mean of `x2`, m.
    pub x2_mean: Option<f64>,
    /// Standard deviation of `x2`, m.
    pub x2_std: Option<f64>,
    /// Mean of `y1`, m.
    pub y1_mean: Option<f64>,
    /// Standard deviation of `y1`, m.
    pub y1_std: Option<f64>,
    /// Root mean square of `ẍ2`, m/s².
    pub ax_rms: Option<f64>,
    /// Root mean square of `ÿ1`, m/s².
    pub ay_rms: Option<f64>,
    /// Largest `|ẍ2|`, m/s².
    pub ax_peak: Option<f64>,
    /// Largest `|ÿ1|`, m/s².
    pub ay_peak: Option<f64>,
    /// `∫T dt / ∫N dt`.
    pub friction_mean: Option<f64>,
    /// Largest normal force, N.
    pub n_peak: Option<f64>,
    /// Upward zero crossings of `ẋ2` over the time from the first to the last, Hz.
    pub response_frequency: Option<f64>,
    /// Phase of `ÿ1` against `ẍ2` at the response frequency, degrees.
    pub phase_cycle: Option<f64>,
    /// Growth rate measured before the first event, 1/s.
    pub growth_rate_measured: Option<f64>,
    /// Frequency measured before the first event, Hz.
    pub frequency_measured: Option<f64>,
    /// Phase of `ÿ1` against `ẍ2` measured before the first event, degrees.
    pub phase_measured: Option<f64>,
    /// Fraction of time in stick.
    pub stick: Option<f64>,
    /// Fraction of time in free flight.
    pub free: Option<f64>,
    /// Fraction of time in reversed slip (`ẋ2 > V`).
    pub reverse: Option<f64>,
    /// Impacts per second.
    pub impacts_per_second: Option<f64>,
    /// Impacts that gained energy (Newton restitution with Coulomb friction), over the whole run; only the
    /// reference counts them.
    pub energy_gaining_impacts: Option<u64>,
    /// Rms of `sqrt(ẋ2² + ẏ1²)` in the first and the second half of the window, m/s.
    pub speed_rms_halves: [f64; 2],
    /// Standard deviation of `x2` in the two halves, m.
    pub x2_std_halves: [f64; 2],
    /// Rms of `ÿ1` in the two halves, m/s².
    pub ay_rms_halves: [f64; 2],
    /// Length of the measuring window, s.
    pub window: f64,
    /// Whether the run met an event, from its start to its end: rest on the belt, a kink of the friction law, the end of
    /// stick, lift-off, an impact.
    pub met_event: bool,
    /// How a run until settled ended.
    pub ending: Option<Ending>,
    /// The start of its last window, s: what came before was needed to settle.
    pub settling_time: Option<f64>,
    /// Simulated time, s.
    pub simulated_time: f64,
    /// Steps taken, those ended by an event included.
    pub steps: u64,
}
