//! What of a friction law can be fitted: `μ = μ_s (1 − w) + μ_d w` with a part `w` of the speed.

use crate::model::Param;
use crate::model::friction::LawKind;

/// A law as a fit sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    /// `μ = μ_d`.
    Level,
    /// From `μ_s` to `μ_d` with this part, whose velocity is this parameter.
    Falling(Part, Param),
    /// Not fitted.
    Other,
}

impl Shape {
    /// That of a law.
    pub(super) fn of(law: LawKind) -> Shape {
        match law {
            LawKind::Constant => Shape::Level,
            LawKind::Bilinear => Shape::Falling(Part::Straight, Param::KneeVelocity),
            LawKind::Exponential => Shape::Falling(Part::Exponential, Param::StribeckVelocity),
            LawKind::Rational | LawKind::Table => Shape::Other,
        }
    }
}

/// How the part of `μ_d` grows with speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// `min(|v|/v_k, 1)`.
    Straight,
    /// `1 − exp(−|v|/v_0)`.
    Exponential,
}

impl Part {
    /// The part at a speed (m/s), for this velocity of the law (m/s).
    pub(super) fn at(self, speed: f64, velocity: f64) -> f64 {
        match self {
            Part::Straight => (speed / velocity).min(1.0),
            Part::Exponential => 1.0 - (-speed / velocity).exp(),
        }
    }

    /// How it changes with the velocity of the law, s/m.
    pub(super) fn shift(self, speed: f64, velocity: f64) -> f64 {
        let part = speed / velocity;
        match self {
            Part::Straight if part < 1.0 => -part / velocity,
            // At and beyond the knee.
            Part::Straight => 0.0,
            Part::Exponential => -part / velocity * (-part).exp(),
        }
    }
}
