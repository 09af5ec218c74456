//! What no estimator can know of a synthetic stroke: from its eigenvector and its noise alone, in closed form.

use std::f64::consts::TAU;

use num_complex::Complex64;
use squealmap::model::Param;
use squealmap::model::equilibrium::Equilibrium;
use squealmap::model::instance::Instance;
use squealmap::model::linear::{Linear, leading_mode};
use squealmap_identify::{CAUSE, alone};

/// The velocity at which the bilinear law of the strokes has its kink, m/s.
const KNEE: f64 = 5.0;

/// The growing mode of a stroke per unit of `x2`, and what friction feeds into it.
struct Feeding {
    lambda: Complex64,
    /// `y1/x2`.
    ratio: Complex64,
    /// `δN/ẋ2`, N s/m.
    normal: Complex64,
    /// `ν_n = μ δN/ẋ` and `ν_s = (δT − μ δN)/ẋ`, in the same unit.
    nu: [Complex64; 2],
}

impl Feeding {
    /// The forces from the equations of motion (docs/physics.md, section 1) in contact.
    fn new(instance: &Instance) -> Option<Feeding> {
        let value = |param| instance.params.require(param);
        let (s, c) = value(Param::Theta).sin_cos();
        let (m1, m2) = (value(Param::M1), value(Param::M2));
        let (lambda, ratio) = leading_mode(instance)?;
        let h = (value(Param::C2) * lambda + value(Param::K2)) * (s - ratio);
        let g = (value(Param::C1) * lambda + value(Param::K1)) * c;
        let square = lambda * lambda;
        let normal = (c * h - s * (m1 * c * square + g)) / lambda;
        let tangential = ((m2 + m1 * c * c) * square + c * g + s * h) / lambda;
        let mu = Equilibrium::new(instance).ok()?.mu;
        Some(Feeding { lambda, ratio, normal, nu: [mu * normal, tangential - mu * normal] })
    }
}

/// The least standard error, in degrees, of the phase of `ÿ1` against `ẍ2` from samples at `rate` (Hz) with white noise of
/// these standard deviations (m/s²), whatever the estimator: Cramér and Rao for two amplitudes `A` of `exp(λt)`.
///
/// `var φ = (s_x²/A_x² + s_y²/A_y²) 2/Σ exp(2σt)`. The growth begins far below its end, so the sum is `rate/(2σ)`; the
/// frequency and the growth, common to both, cost nothing. The end is where the motion stops being linear: the mass moves
/// with the belt, the contact opens, or the law has its kink.
pub(crate) fn phase_bound(
    instance: &Instance,
    linear: &Linear,
    rate: f64,
    [along, across]: [f64; 2],
) -> Option<f64> {
    let mode = Feeding::new(instance)?;
    let belt = instance.params.require(Param::BeltVelocity);
    let opens = Equilibrium::new(instance).ok()?.normal_force / mode.normal.norm();
    let sloped = linear.growth_rate_frozen > 0.0;
    let end = belt.min(opens).min(if sloped { KNEE - belt } else { f64::INFINITY });
    let amplitude = mode.lambda.norm() * end;
    let samples = rate / (2.0 * linear.growth_rate);
    let relative = (along / amplitude).hypot(across / (amplitude * mode.ratio.norm()));
    Some((relative * (2.0 / samples).sqrt()).to_degrees())
}

/// Whether one cause holds for all dampings up to this ratio when everything else is known exactly.
pub(crate) fn decidable(instance: &Instance, linear: &Linear, damping_ratio: f64) -> bool {
    /// Values of each damping.
    const STEPS: u32 = 8;
    if linear.growth_rate < 0.0 {
        return true;
    }
    let Some(mode) = Feeding::new(instance) else { return false };
    let share = mode.nu[0].re / (mode.nu[0].re + mode.nu[1].re);
    let largest = damping_ratio * TAU * linear.frequency.unwrap_or(0.0) / f64::from(STEPS);
    let mut causes = (0..=STEPS).flat_map(|x| (0..=STEPS).map(move |y| [x, y])).map(|steps| {
        let dampings = steps.map(|step| largest * f64::from(step));
        alone(linear.growth_rate, share, mode.nu[0].arg(), dampings)
            .map(|rate| rate > CAUSE * linear.growth_rate)
    });
    let first = causes.next();
    first.is_some_and(|first| first != [false, false] && causes.all(|cause| cause == first))
}
