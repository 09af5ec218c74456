//! Event functions that are watched within a step, and those that are not.

/// An event function that begins at zero because it started the present contact state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Disarmed {
    Nothing,
    Rest,
    LowerKink,
    UpperKink,
    Gap,
}

/// The event functions; each is positive inside its contact state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Watched {
    Rest,
    LowerKink,
    UpperKink,
    LiftOff,
    StickLimit { sigma: f64 },
    Gap,
}
