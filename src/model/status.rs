//! How an instance ends.

use serde::Serialize;

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
    /// [`crate::engine::scene::MOST_STEPS`], or a period more than [`crate::engine::reference::bounds::MAX_STEPS_PER_PERIOD`].
    StepTooLarge = 6,
    /// The state left the range of finite numbers, or its scaled parameters are beyond [`crate::engine::scene::LARGEST`].
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
