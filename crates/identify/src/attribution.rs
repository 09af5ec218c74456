//! Which mechanism alone would destabilise: two modes, identified from one growing oscillation.
//!
//! A tangential mode at `ω0 + Δ` and a normal one at `ω0 − Δ`, damped with the rates `d_x` and `d_y`, coupled by friction
//! (`κ`), slope feedback `γ` on the tangential one. With `z = λ − iω0`:
//!
//! ```text
//! (z + d_x − iΔ − γ)(z + d_y + iΔ) = κ          ν_n ∝ κ/(z + d_y + iΔ)        ν_s ∝ γ
//! ```
//!
//! `r` and `ψ` of `feedback.rs` and the growth rate σ then give all of it: with `P = σ + d_x`, `Q = σ + d_y`, `t = tan ψ`
//!
//! ```text
//! γ = (1 − r) P        κ = r P Q (1 + t²)        2Δ = −(Q + r P) t
//! ```
//!
//! and each mechanism alone grows with
//!
//! ```text
//! without the slope (γ = 0):              Re sqrt(κ + (b − iΔ)²) − (d_x + d_y)/2        b = (d_x − d_y)/2
//! without the normal feedback (κ = 0):    γ − d_x
//! ```
//!
//! Undamped, mode coupling alone is unstable where `4r/(1 + r)² > sin²ψ`: neither the phase nor the slope decides
//! alone, both together do. Against the eigenvalues of 3600 unstable instances of the full model the two growth
//! rates are right within 0.3 % of σ (median); the type is right in 99 %, and the rest lies at a threshold.
//!
//! A mechanism counts as a cause when it alone would give at least a tenth of the observed growth: no measurement
//! tells a slope of exactly 0 from a tiny one, and without damping the tiniest would be unstable alone.
//!
//! Beside friction the inclination θ of the structure to the contact couples the modes, without power: of `κ = ν_n (z + d_y + iΔ)`
//! only the part `1 − tan θ/μ` is there. Where the slope gives power, too, that hardly matters; where it takes power out (a
//! rising law, `r > 1`), a few per cent decide whether mode coupling alone would grow or needs the damping by the slope
//! (interaction).
//!
//! Measuring errors are carried through as a probability: the closer to a threshold, the less of it falls on one kind.
//! The dampings, which a growing oscillation does not show, are no matter of probability: a kind has the least of its
//! probabilities over all dampings, and inclinations, from 0 to a stated bound; of a known rig, over those that it may have.

use num_complex::Complex64;

use crate::cross::Measured;
use crate::feedback::Feedback;

/// Systematic error of ψ in the two-mode picture, rad: its 90th percentile over the instances above is 0.02, 1.64 standard
/// errors.
const PHASE_ALLOWANCE: f64 = 0.0125;
/// Phase by which forces may be late without anybody knowing, rad (3°: 0.6 µs at 14.5 kHz), unless the signals show it.
const FORCE_PHASE: f64 = 0.05;
/// Systematic error of the angle between friction coefficient and velocity, rad.
const ANGLE_ALLOWANCE: f64 = 0.02;
/// Systematic error of the slope's part, relative, and over the whole: the growth by the slope alone, where it is less than a third of
/// the growth, is off by 0.7 % of that in one of ten of the structures of a laboratory, 1.64 standard errors.
const SLOPE_ALLOWANCE: f64 = 0.02;
const SHARE_ALLOWANCE: f64 = 0.0045;
/// Points per uncertain quantity, in standard errors, with the weights of a normal distribution.
const FINE: &[(f64, f64)] = &[
    (-3.0, 0.0044),
    (-2.0, 0.0540),
    (-1.0, 0.2420),
    (0.0, 0.3989),
    (1.0, 0.2420),
    (2.0, 0.0540),
    (3.0, 0.0044),
];
/// Points and weights for single windows, by Gauss and Hermite: few, since a record may have a million windows.
const COARSE: &[(f64, f64)] = &[(-1.732_050_8, 1.0 / 6.0), (0.0, 2.0 / 3.0), (1.732_050_8, 1.0 / 6.0)];
/// Values of each damping, and pairs of them.
const DAMPINGS: usize = 3;
const PAIRS: usize = DAMPINGS * DAMPINGS;
/// Values of the inclination likewise.
const TILTS: usize = 3;
const CASES: usize = PAIRS * TILTS;
/// Share of the observed growth from which on a mechanism counts as a cause.
pub const CAUSE: f64 = 0.1;

/// The cause that a growing oscillation can have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cause {
    /// The oscillation does not grow.
    None,
    /// The slope alone, not mode coupling alone.
    Slope,
    /// Mode coupling alone, not the slope alone.
    Coupling,
    /// Each alone.
    Both,
    /// Neither alone, only both together.
    Interaction,
    /// Friction takes power out of an oscillation that grows: the signals contradict each other.
    Contradiction,
}

impl Cause {
    pub(super) const ALL: [Cause; 6] =
        [Cause::None, Cause::Slope, Cause::Coupling, Cause::Both, Cause::Interaction, Cause::Contradiction];
}

/// Bounds on quantities that a growing oscillation does not show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    /// The dampings that are possible along and across the contact, 1/s.
    pub(super) dampings: [[f64; DAMPINGS]; 2],
    /// Largest coupling of the modes by the inclination, over that by friction.
    pub(super) tilt: f64,
}

/// Probabilities of the causes, in the order of [`Cause::ALL`], for each pair of dampings and inclination.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Probabilities([[f64; Cause::ALL.len()]; CASES]);

impl Probabilities {
    /// The mean over the cases: what there is to choose from.
    pub(super) fn mean(&self, cause: Cause) -> f64 {
        self.0.iter().map(|of| of[cause as usize]).sum::<f64>() / CASES as f64
    }

    /// The least probability of a cause over all cases: so much is sure.
    pub(super) fn least(&self, cause: Cause) -> f64 {
        self.0.iter().map(|of| of[cause as usize]).fold(1.0, f64::min)
    }
}

/// Growth rates (1/s) of mode coupling alone and of the slope alone, from the observed growth rate (1/s), the share `r`
/// of the power that comes from the normal force, the angle ψ of the normal force before the velocity (rad) and the
/// dampings `d_x`, `d_y` (1/s).
#[must_use]
pub fn alone(growth: f64, share: f64, psi: f64, [d_x, d_y]: [f64; 2]) -> [f64; 2] {
    let (p, q, t) = (growth + d_x, growth + d_y, psi.tan());
    let kappa = share * p * q * (1.0 + t * t);
    let apart = Complex64::new(0.5 * (d_x - d_y), 0.5 * (q + share * p) * t);
    let coupled = (kappa + apart * apart).sqrt().re;
    [coupled - 0.5 * (d_x + d_y), (1.0 - share) * p - d_x]
}

/// The probabilities; with `fine` at 29 times the work.
pub(super) fn probabilities(feedback: &Feedback, bounds: &Bounds, fine: bool) -> Probabilities {
    let nodes = if fine { FINE } else { COARSE };
    let (normal, normal_error) = feedback.normal;
    let (slope, slope_error) = feedback.slope;
    let total = normal + slope;
    // `T` and `N` come from sensors of their own: the errors of `ν_n` and of the sum are independent.
    let total_error = (slope_error * slope_error - normal_error * normal_error).max(0.0).sqrt();
    let total_error =
        total_error.hypot(SLOPE_ALLOWANCE * slope.re.abs()).hypot(SHARE_ALLOWANCE * total.re.abs());
    let across_error = normal_error.hypot(PHASE_ALLOWANCE * normal.norm());
    let late = lateness(feedback);
    let grows = normal_below(feedback.growth.value / feedback.growth.error);
    let growth = feedback.growth.value.max(0.0);
    let all = nodes.iter().map(|(_, weight)| weight).sum::<f64>().powi(4);
    let mut found = Probabilities::default();
    for (k, of) in found.0.iter_mut().enumerate() {
        let [along, across] = bounds.dampings;
        let dampings = [along[k / DAMPINGS % DAMPINGS], across[k % DAMPINGS]];
        let tilt = bounds.tilt * (k / PAIRS) as f64 / (TILTS - 1) as f64;
        of[Cause::None as usize] = 1.0 - grows;
        for (l, weight_l) in nodes.iter().copied() {
            let turn = Complex64::cis(-(late.value + l * late.error));
            let (normal, total) = (normal * turn, (total * turn).re);
            for (a, weight_a) in nodes.iter().copied() {
                for (b, weight_b) in nodes.iter().copied() {
                    for (c, weight_c) in nodes.iter().copied() {
                        let fed = Complex64::new(normal.re + a * normal_error, normal.im + b * across_error);
                        let slope = total + c * total_error - fed.re;
                        let cause = cause(growth, tilted(fed, slope, tilt), slope, dampings);
                        of[cause as usize] += grows * weight_l * weight_a * weight_b * weight_c / all;
                    }
                }
            }
        }
    }
    found
}

/// The angle by which the forces turn `ν_n` and `ν_s` because they are late, rad. It is known beforehand within bounds;
/// where there is a slope, that shows more of it.
fn lateness(feedback: &Feedback) -> Measured {
    let Some(off) = feedback.asynchrony() else { return Measured { value: 0.0, error: FORCE_PHASE } };
    let (angle, error) = (off.value.to_radians(), off.error.to_radians().hypot(ANGLE_ALLOWANCE));
    let weight = FORCE_PHASE * FORCE_PHASE / (FORCE_PHASE * FORCE_PHASE + error * error);
    Measured { value: weight * angle, error: error * weight.sqrt() }
}

/// The feedback of the normal force less the coupling by this part of it that gives no power, where the slope takes power
/// out and an oscillation could still grow.
fn tilted(normal: Complex64, slope: f64, tilt: f64) -> Complex64 {
    let less = normal * (1.0 - tilt);
    if slope < 0.0 && less.re + slope > 0.0 { less } else { normal }
}

/// The cause when everything is known.
fn cause(growth: f64, normal: Complex64, slope: f64, dampings: [f64; 2]) -> Cause {
    let total = normal.re + slope;
    if total <= 0.0 {
        return Cause::Contradiction;
    }
    let rates = alone(growth, normal.re / total, normal.arg(), dampings);
    match rates.map(|rate| rate > CAUSE * growth) {
        [false, true] => Cause::Slope,
        [true, false] => Cause::Coupling,
        [true, true] => Cause::Both,
        [false, false] => Cause::Interaction,
    }
}

/// The share of a normal distribution below `z`: logistic, within 0.01.
pub(super) fn normal_below(z: f64) -> f64 {
    /// The factor that brings the two distributions together best.
    const LOGISTIC: f64 = 1.702;
    if z.is_nan() { 0.5 } else { 1.0 / (1.0 + (-LOGISTIC * z).exp()) }
}
