//! Contact states, transitions and impact.

/// The state of the contact between `m2` and the belt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactState {
    /// Sliding, `v = V − ẋ2 > 0`.
    Slip,
    /// Sliding with `v < 0`: the mass overtakes the belt.
    Reverse,
    /// No relative velocity.
    Stick,
    /// Detached: `y2 > 0`, no contact forces.
    Free,
}

impl ContactState {
    /// The name in a trace file.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            ContactState::Slip => "slip",
            ContactState::Reverse => "reverse",
            ContactState::Stick => "stick",
            ContactState::Free => "free",
        }
    }
}
