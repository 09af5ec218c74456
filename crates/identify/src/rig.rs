//! A rig as two masses on springs, and the contact forces that its accelerations show.
//!
//! `m2` slides on the belt, `m1` lies on it on a spring; both stand on a spring and a damper along the belt, inclined by θ. While the
//! contact is closed, the motion `x` of `m2` along the belt and `y` of `m1` give what the forces deviate by from their means
//! (docs/physics.md, section 1):
//!
//! ```text
//! δT = (m2 + m1 cos² θ) ẍ + cos² θ (k1 x + c1 ẋ) + sin θ m1 ÿ
//! δN = cos θ m1 ÿ − sin θ cos θ (m1 ẍ + k1 x + c1 ẋ)
//! ```
//!
//! `m1` touches nothing but its spring, so `m1 ÿ = k2 (x sin θ − y) + c2 (ẋ sin θ − ẏ)` whatever the friction does: at each frequency
//! both accelerations show `k2` and `c2`.

use num_complex::Complex64;

use crate::cross::{Measured, Ratio};

/// How well a rig is known: the parts of its masses, of its damping, and of the sine of its inclination that they may be off.
const MASS: f64 = 0.01;
const DAMPING: f64 = 0.1;
const INCLINATION: f64 = 0.1;
/// That of the inertia along the contact less the stiffness over ω², as a part of that inertia: half a per cent of each.
const TUNING: f64 = 0.01;
/// Delay between the accelerations that is not known, as an angle of the oscillation, rad: 3°.
const LATE: f64 = 0.052;

/// The structure of a rig.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rig {
    /// Mass that lies on the sliding one, kg.
    pub m1: f64,
    /// Mass that slides, kg.
    pub m2: f64,
    /// Stiffness along the belt, N/m.
    pub k1: f64,
    /// Stiffness across it, N/m.
    pub k2: f64,
    /// Damping along the belt, N s/m.
    pub c1: f64,
    /// Damping across it, N s/m.
    pub c2: f64,
    /// Inclination to the belt, rad.
    pub theta: f64,
    /// The force that presses the masses to the belt, N.
    pub load: f64,
    /// The friction coefficient at which its modes coalesce, for strokes forwards and backwards; beyond all friction where they do not.
    pub critical: [Measured; 2],
}

impl Rig {
    /// The larger damping ratio of its two directions without friction.
    #[must_use]
    pub fn damping_ratio(&self) -> f64 {
        let ratio = |damping: f64, stiffness: f64, mass: f64| damping / (2.0 * (stiffness * mass).sqrt());
        ratio(self.c1, self.k1, self.m1 + self.m2).max(ratio(self.c2, self.k2, self.m1))
    }

    /// The rates (1/s) with which its two directions die out: the least, the likely, and the most.
    pub(super) fn decays(&self) -> [[f64; 3]; 2] {
        [self.c1 / (self.m1 + self.m2), self.c2 / self.m1]
            .map(|double| [1.0 - DAMPING, 1.0, 1.0 + DAMPING].map(|part| 0.5 * part * double))
    }

    /// The rig as a belt sees it that goes the other way.
    pub(super) fn turned(self) -> Rig {
        let [forwards, backwards] = self.critical;
        Rig { theta: -self.theta, critical: [backwards, forwards], ..self }
    }

    /// Deviations of `T` and `N` (N) by displacement, velocity and acceleration along the belt, and the acceleration `ÿ` of `m1`.
    pub(super) fn forces(&self, [x, v, a]: [f64; 3], normal: f64) -> [f64; 2] {
        let Rig { m1, m2, k1, c1, theta, .. } = *self;
        let (sin, cos) = theta.sin_cos();
        let spring = k1 * x + c1 * v;
        [
            (m2 + m1 * cos * cos) * a + cos * cos * spring + sin * m1 * normal,
            cos * m1 * normal - sin * cos * (m1 * a + spring),
        ]
    }

    /// `δT/ẍ` and `δN/ẍ` of a mode that grows (1/s) at the angular frequency `omega` (rad/s), by its `ÿ/ẍ`. Their errors are those of the
    /// parts that give power, where the mode is known by that much and the rig as usual.
    pub(super) fn ratios(&self, growth: Measured, omega: f64, normal: Ratio) -> [Ratio; 2] {
        let lambda = Complex64::new(growth.value, omega);
        let (v, x) = (lambda.inv(), (lambda * lambda).inv());
        let real = self.forces([x.re, v.re, 1.0], normal.value.re);
        let imaginary = self.forces([x.im, v.im, 0.0], normal.value.im);
        let [pulled, pressed] = [0, 1].map(|k| Complex64::new(real[k], imaginary[k]));
        // Along the contact the power is that of 2 m σ + c.
        let inertia = self.m1 + self.m2;
        let power = (2.0 * inertia * growth.error)
            .hypot(2.0 * MASS * inertia * growth.value)
            .hypot(DAMPING * self.c1);
        let across = self.m1 * normal.error.hypot(MASS * normal.value.norm());
        let ratio = |value, error| Ratio { value, error, unexplained: 0.0, coherence: normal.coherence };
        let pulled_error = (power / omega).hypot(self.theta.sin() * across);
        [ratio(pulled, pulled_error), ratio(pressed, self.theta.cos() * across)]
    }

    /// The error of the part of `ν_s` that gives no power, kg/s: that of inertia and stiffness along the contact, which all but cancel.
    pub(super) fn aside(&self, omega: f64) -> f64 {
        TUNING * (self.m1 + self.m2) * omega
    }

    /// What it loses along the contact, N s/m.
    pub(super) fn damping(&self) -> Measured {
        let value = self.c1 * self.theta.cos().powi(2);
        Measured { value, error: DAMPING * value }
    }

    /// Stiffness and damping across the contact that both accelerations show at the angular frequency `omega` (rad/s), each over that of the
    /// rig. What the vibration grows by, `growth` (1/s), is taken for damping: an error.
    pub(super) fn across(&self, omega: f64, growth: f64, normal: Ratio) -> [Measured; 2] {
        let detuned = self.theta.sin() / normal.value;
        let shown = self.m1 * omega * omega / (1.0 - detuned);
        let noise = normal.error / normal.value.norm();
        let detuning = detuned.norm() * INCLINATION.hypot(noise);
        let late = (LATE * detuned.norm()).hypot(2.0 * growth / omega);
        let damping = omega * self.c2;
        [
            Measured { value: shown.re / self.k2, error: detuning },
            Measured { value: shown.im / damping, error: detuning.hypot(late) * self.k2 / damping },
        ]
    }
}
