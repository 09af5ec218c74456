//! Types of instability.

use serde::Serialize;

/// A mode is unstable when `Re λ` is above this fraction of `|λ|`; below it rounding would decide.
pub const UNSTABLE_ABOVE: f64 = 1e-9;

/// Type of instability by complex eigenvalue analysis and attribution (`physics`: one mechanism removed at a time).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum InstabilityType {
    /// The sliding equilibrium is stable.
    Stable,
    /// Unstable by the falling friction-velocity slope alone.
    NegativeSlope,
    /// Unstable by mode coupling alone.
    ModeCoupling,
    /// Either mechanism alone would destabilise it.
    Coexistence,
    /// Unstable although each mechanism alone is stable.
    Interaction,
    /// The belt stands still: no sliding equilibrium to analyse.
    Sticking,
    /// `c + μ0 s ≤ 0`: no sliding equilibrium exists.
    Divergence,
}

// The place of a type in its list is its number.
const _: () = {
    let mut place = 0;
    while place < InstabilityType::ALL.len() {
        assert!(InstabilityType::ALL[place] as usize == place);
        place += 1;
    }
};

impl InstabilityType {
    /// Every type, in the order of legends and summaries.
    pub const ALL: [InstabilityType; 7] = [
        InstabilityType::Stable,
        InstabilityType::NegativeSlope,
        InstabilityType::ModeCoupling,
        InstabilityType::Coexistence,
        InstabilityType::Interaction,
        InstabilityType::Sticking,
        InstabilityType::Divergence,
    ];

    /// The name in `map.csv`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            InstabilityType::Sticking => "sticking",
            InstabilityType::Divergence => "divergence",
            InstabilityType::Stable => "stable",
            InstabilityType::NegativeSlope => "negative_slope",
            InstabilityType::ModeCoupling => "mode_coupling",
            InstabilityType::Coexistence => "coexistence",
            InstabilityType::Interaction => "interaction",
        }
    }

    /// Whether there is a sliding equilibrium and a small motion about it grows.
    #[must_use]
    pub fn is_unstable(self) -> bool {
        match self {
            InstabilityType::NegativeSlope
            | InstabilityType::ModeCoupling
            | InstabilityType::Coexistence
            | InstabilityType::Interaction => true,
            InstabilityType::Stable | InstabilityType::Sticking | InstabilityType::Divergence => false,
        }
    }
}
