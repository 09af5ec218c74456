//! Small motions about a kink of the friction law, where the slope of neither side holds.
//!
//! A motion `ẋ2 = A sin ωt` that passes a kink at the distance `d` from the belt velocity has the slope beyond it for a part of each cycle.
//! Its describing function (the part of friction in phase with the motion, over the motion) is a slope again: beyond the kink it changes by
//! the part `(arccos x − x √(1 − x²))/π` of what the law's slope changes by, `x = d/A`; one half on the kink itself, for motions of any size
//! (Gelb and Vander Velde, Multiple-Input Describing Functions and Nonlinear System Design, 1968).

use std::f64::consts::{PI, SQRT_2};

use crate::engine::outcome::Outcome;
use crate::model::Param;
use crate::model::friction::FrictionLaw;
use crate::model::instance::Instance;

/// The part of a kink that a motion sees which passes it at `x` of its amplitude.
fn part(x: f64) -> f64 {
    (x.acos() - x * (1.0 - x * x).sqrt()) / PI
}

/// The instance with the law that a motion of the amplitude `amplitude` (m/s) of `ẋ2` sees: a line; `None` where it passes no kink.
#[must_use]
pub(super) fn seen(instance: &Instance, amplitude: f64) -> Option<Instance> {
    let velocity = instance.params.require(Param::BeltVelocity);
    let law = instance.law.pieces(1.0);
    let mut slope = law.slope(velocity);
    let own = slope;
    for (number, kink) in law.kinks.iter().enumerate() {
        let distance = (kink - velocity).abs();
        if distance > 0.0 && distance >= amplitude {
            continue;
        }
        let [below, above] = [number, number + 1].map(|piece| law.pieces[piece].slope(*kink));
        // On the kink the law has the slope above it.
        let beyond = if *kink > velocity { above - below } else { below - above };
        slope += beyond * if distance > 0.0 { part(distance / amplitude) } else { 0.5 };
    }
    let change = slope - own;
    let mu = law.mu(velocity);
    (change != 0.0 && velocity > 0.0).then(|| Instance {
        law: FrictionLaw::Bilinear {
            mu_s: mu - slope * velocity,
            mu_d: mu + slope * velocity,
            knee_velocity: 2.0 * velocity,
        },
        ..instance.clone()
    })
}

/// Whether the belt velocity is that of a kink of the law.
pub(super) fn is_on_one(instance: &Instance) -> bool {
    instance.law.pieces(1.0).kinks.contains(&instance.params.require(Param::BeltVelocity))
}

/// The amplitude of `ẋ2` (m/s) at the end of a window, if it is all of the motion and a sine.
#[must_use]
pub(super) fn amplitude(outcome: &Outcome) -> f64 {
    SQRT_2 * outcome.speed_rms_halves[1]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The describing function of a kink by its integral.
    #[test]
    fn the_part_of_a_kink_is_its_describing_function() {
        const STEPS: u32 = 200_000;
        for x in [0.0, 0.1, 0.5, 0.9, 1.0] {
            let step = 2.0 * PI / f64::from(STEPS);
            let beyond = |sine: f64| (sine - x).max(0.0) * sine;
            let integral: f64 = (0..STEPS).map(|k| beyond((f64::from(k) * step).sin())).sum::<f64>() * step;
            assert!((integral / PI - part(x)).abs() < 1e-9, "{x}: {} {}", integral / PI, part(x));
        }
    }
}
