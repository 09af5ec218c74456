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
    /// The mean part over a range of speeds (m/s), for this velocity of the law (m/s).
    pub(super) fn over(self, [low, high]: [f64; 2], velocity: f64) -> f64 {
        let width = high - low;
        match self {
            Part::Straight if low < velocity && velocity < high => {
                let below = (velocity - low) * 0.5 * (low + velocity) / velocity;
                (below + high - velocity) / width
            }
            Part::Straight => (0.5 * (low + high) / velocity).min(1.0),
            Part::Exponential => {
                let mean = (-0.5 * (low + high) / velocity).exp();
                1.0 - mean * sinh_over(0.5 * width / velocity)
            }
        }
    }

    /// How it changes with the velocity of the law, s/m.
    pub(super) fn shift(self, [low, high]: [f64; 2], velocity: f64) -> f64 {
        let (width, part) = (high - low, 0.5 * (low + high) / velocity);
        match self {
            Part::Straight if low < velocity && velocity < high => {
                0.5 * ((low / velocity).powi(2) - 1.0) / width
            }
            Part::Straight if part < 1.0 => -part / velocity,
            // At and beyond the knee.
            Part::Straight => 0.0,
            Part::Exponential => {
                let half = 0.5 * width / velocity;
                let curved = half.cosh() - sinh_over(half);
                -(-part).exp() / velocity * (part * sinh_over(half) - curved)
            }
        }
    }
}

/// `sinh x / x`.
fn sinh_over(x: f64) -> f64 {
    if x.abs() < 1e-4 { 1.0 + x * x / 6.0 } else { x.sinh() / x }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against sums over the range, and its derivative against a difference.
    #[test]
    fn means_over_a_range_are_those_of_its_speeds() {
        let at = |part: Part, speed: f64, velocity: f64| match part {
            Part::Straight => (speed / velocity).min(1.0),
            Part::Exponential => 1.0 - (-speed / velocity).exp(),
        };
        for part in [Part::Straight, Part::Exponential] {
            for range in [[2.0, 2.0], [1.0, 1.7], [1.0, 4.0], [2.9, 3.3], [5.0, 6.0], [0.0, 9.0]] {
                let [low, high] = range;
                let sum: f64 = (0..20000)
                    .map(|k| at(part, low + (high - low) * (f64::from(k) + 0.5) / 20000.0, 3.0))
                    .sum();
                let mean = part.over(range, 3.0);
                assert!((mean - sum / 20000.0).abs() < 1e-8, "{part:?} {range:?}: {mean}");
                let step = 1e-5;
                let expected = (part.over(range, 3.0 + step) - part.over(range, 3.0 - step)) / (2.0 * step);
                let found = part.shift(range, 3.0);
                assert!((found - expected).abs() < 1e-8, "{part:?} {range:?}: {found} {expected}");
            }
        }
    }
}
