//! Bounds of an integration: beyond them it ends with a reason.

/// Most events at one and the same instant.
pub const MAX_EVENTS_AT_ONCE: u32 = 64;

/// Most events within one period `2π/ω0`: above the bounces of a Zeno sequence at `e = 0.999`, so that
/// only chatter without end is stopped.
pub const MAX_EVENTS_PER_PERIOD: u32 = 20_000;

/// Most halvings of the nominal step, enough for the boundary layers of extreme starts.
pub const MAX_HALVINGS: i32 = 24;

/// Most steps within one period `2π/ω0`; stiffer instances end with [`crate::model::status::Status::StepTooLarge`], on every engine.
/// Five times the finest setting of a sweep.
pub const MAX_STEPS_PER_PERIOD: u32 = 500_000;

/// Roundings of the static loads that a force may be off by.
pub const ROUNDINGS: f64 = 8.0;

/// Where `M11` vanishes the acceleration of slip diverges like the inverse root of the time left, and no
/// step is short enough to get there: an end within this many of the finest steps before it is Painlevé's.
pub const PAINLEVE_APPROACHED: f64 = 50.0;

/// Events without time between them from which on rest and release take turns.
pub(super) const RELEASED_AGAIN: u32 = 4;

/// Steps after which a wish to stop is looked for: some milliseconds.
pub(super) const STEPS_BETWEEN_LOOKS: u64 = 1024;
