//! What friction feeds into the oscillation, from the signals alone.
//!
//! Near its equilibrium the friction force is `δT = μ δN + N δμ`. At the eigenvalue `λ = σ + iω` of one mode,
//! with the tangential velocity `ẋ = ẍ/λ`, the two parts are complex rates (in a common real unit that needs
//! no mass):
//!
//! ```text
//! ν_n = μ δN/ẋ = μ λ δN/ẍ            feedback of the normal force
//! ν_s = N δμ/ẋ = λ (δT − μ δN)/ẍ     change of the friction coefficient: −μ'N when it follows the velocity
//! r   = Re ν_n/(Re ν_n + Re ν_s)     share of the power that comes from the normal force
//! ψ   = arg ν_n                      0 when the normal force follows the velocity
//! ```
//!
//! `Re` is what counts: it is the power of the friction force on the motion, the only power that the contact
//! gives to the structure.

use num_complex::Complex64;
use std::f64::consts::TAU;

use crate::cross::{Measured, Ratio, Sums};
use crate::rig::Rig;

/// Delays that are taken out of the channels, s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Skews {
    /// Normal acceleration behind tangential acceleration.
    pub(super) acceleration: f64,
    /// Forces behind tangential acceleration.
    pub(super) force: f64,
}

/// One growing (or decaying) oscillation as the signals show it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Feedback {
    pub(super) growth: Measured,
    /// Angular frequency, rad/s.
    pub(super) omega: f64,
    /// Mean friction coefficient.
    pub(super) friction: f64,
    /// `ÿ/ẍ`.
    pub(super) normal_acceleration: Ratio,
    /// `δN/ẍ`.
    pub(super) normal_force: Ratio,
    /// `ν_n` and the standard error of its parts.
    pub(super) normal: (Complex64, f64),
    /// `ν_s` and the standard error of its parts.
    pub(super) slope: (Complex64, f64),
    /// The part of its error that no noise explains.
    pub(super) unexplained: f64,
    /// The error of its imaginary part beside that where the forces are those that move a rig: how well that is known.
    pub(super) aside: Option<f64>,
}

impl Feedback {
    /// From cross-spectra at `frequency` (Hz), with the mean friction coefficient; `share`: independent
    /// blocks per block.
    pub(super) fn new(
        sums: &Sums,
        growth: Measured,
        frequency: f64,
        friction: f64,
        skews: Skews,
        share: f64,
    ) -> Feedback {
        let ratios = [sums.normal_acceleration(share), sums.normal_force(share), sums.friction(share)];
        Feedback::from_ratios(ratios, growth, TAU * frequency, friction, skews)
    }

    /// From the ratios of normal acceleration, normal force and `T − μN` to the tangential acceleration at the angular
    /// frequency `omega` (rad/s), with the mean friction coefficient μ.
    pub(super) fn from_ratios(
        [normal_acceleration, normal_force, change]: [Ratio; 3],
        growth: Measured,
        omega: f64,
        friction: f64,
        skews: Skews,
    ) -> Feedback {
        let lambda = Complex64::new(growth.value, omega);
        // A channel that is late by τ lags by ωτ.
        let normal_force = normal_force.advanced(omega * skews.force);
        let change = change.advanced(omega * skews.force);
        Feedback {
            growth,
            omega,
            friction,
            normal_acceleration: normal_acceleration.advanced(omega * skews.acceleration),
            normal_force,
            normal: (friction * lambda * normal_force.value, friction.abs() * omega * normal_force.error),
            slope: (lambda * change.value, omega * change.error),
            unexplained: omega * change.unexplained,
            aside: None,
        }
    }

    /// By forces that move this rig, where there is one.
    pub(super) fn of(self, rig: Option<Rig>) -> Feedback {
        Feedback { aside: rig.map(|rig| rig.aside(self.omega)), ..self }
    }

    /// Phase of the normal against the tangential acceleration, degrees in (−180, 180], negative when the
    /// normal one lags.
    pub(super) fn phase(&self) -> Measured {
        angle(self.normal_acceleration.value, self.normal_acceleration.error)
    }

    /// Phase of the normal force against the tangential acceleration, degrees.
    pub(super) fn force_phase(&self) -> Measured {
        angle(self.normal_force.value, self.normal_force.error)
    }

    /// `dμ/dV` from the oscillation itself, s/m: `−Re ν_s/N`.
    pub(super) fn slope_of(&self, normal_force: f64) -> Measured {
        Measured { value: -self.slope.0.re / normal_force, error: self.slope.1 / normal_force }
    }

    /// Share of the power that comes from the normal force.
    pub(super) fn share(&self) -> Measured {
        let (normal, slope) = (self.normal.0.re, self.slope.0.re);
        let total = normal + slope;
        let share = normal / total;
        let error = ((1.0 - share) * self.normal.1).hypot(share * self.slope.1) / total.abs();
        Measured { value: share, error }
    }

    /// By how many degrees the change of the friction coefficient misses the velocity (falling or rising),
    /// where there is a change to speak of.
    pub(super) fn asynchrony(&self) -> Option<Measured> {
        /// Standard errors by which the change must stand out.
        const CLEAR: f64 = 4.0;
        /// Share of the whole feedback that it must have.
        const MATTERS: f64 = 0.1;
        let ((normal, _), (slope, error)) = (self.normal, self.slope);
        let error = error.hypot(self.aside.unwrap_or_default());
        let matters = slope.norm() > CLEAR * error && slope.norm() > MATTERS * (normal + slope).norm();
        matters.then(|| {
            let angle = angle(slope, error);
            Measured { value: folded(angle.value), ..angle }
        })
    }
}

/// Argument of a complex number whose parts have this standard error, degrees.
fn angle(value: Complex64, error: f64) -> Measured {
    let error =
        if value.norm() > 0.0 { (error / value.norm()).min(std::f64::consts::PI) } else { f64::INFINITY };
    Measured { value: value.arg().to_degrees(), error: error.to_degrees() }
}

/// An angle up to half turns, degrees in [−90, 90]: in phase and in antiphase are the same here.
pub(super) fn folded(degrees: f64) -> f64 {
    degrees - 180.0 * (degrees / 180.0).round()
}
