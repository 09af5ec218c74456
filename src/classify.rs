//! Outcome → regime. Every threshold of the classification stands here.

use serde::Serialize;

/// Type of instability by complex eigenvalue analysis and attribution (`physics`: one mechanism removed at a time).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum InstabilityType {
    /// The belt stands still: no sliding equilibrium to analyse.
    Sticking,
    /// `c + μ0 s ≤ 0`: no sliding equilibrium exists.
    Divergence,
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
}

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
}

/// What the system does in the measuring window.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Regime {
    /// Rest at, or decay towards, the sliding equilibrium.
    Equilibrium,
    /// Sustained oscillation that never sticks, reverses or detaches.
    Slip,
    /// Stick and slip.
    StickSlip,
    /// Oscillation with slip in both directions.
    SlipReversal,
    /// Oscillation with free flight, without stick.
    Detaching,
    /// Oscillation with free flight and stick.
    DetachingStickSlip,
    /// Stick throughout.
    Stuck,
}

impl Regime {
    /// Every regime, in the order of legends and summaries.
    pub const ALL: [Regime; 7] = [
        Regime::Equilibrium,
        Regime::Slip,
        Regime::StickSlip,
        Regime::SlipReversal,
        Regime::Detaching,
        Regime::DetachingStickSlip,
        Regime::Stuck,
    ];

    /// The name in `map.csv`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Regime::Equilibrium => "equilibrium",
            Regime::Slip => "slip",
            Regime::StickSlip => "stick_slip",
            Regime::SlipReversal => "slip_reversal",
            Regime::Detaching => "detaching",
            Regime::DetachingStickSlip => "detaching_stick_slip",
            Regime::Stuck => "stuck",
        }
    }
}
