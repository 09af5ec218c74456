//! The equations of motion in the belt frame, as deviations from the sliding equilibrium.
//!
//! ```text
//! δ = x2 s + y2 c − y1     h = k2 δ + c2 δ̇     g = k1 (x2 c − y2 s) + c1 (ẋ2 c − ẏ2 s)
//! R = c g + s h            W = c h − s g        m1 ÿ1 = h − F_ext
//! ẍ2 − κ ÿ2 + R = T        −κ ẍ2 + (m2 + m1 s²) ÿ2 + W = N        κ = m1 s c
//! ```
//!
//! (masses in units of `m2 + m1 c²`). The spring forces are linear in the state, so the same function
//! serves a state and every Taylor coefficient of one.

use crate::model::scaled::Scaled;

/// Spring and damper forces, or one of their Taylor coefficients, as deviations from the equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Springs {
    /// `h − F_ext`, the force on `m1`.
    pub h: f64,
    /// `R − μ0 N0`.
    pub r: f64,
    /// `W − N0`.
    pub w: f64,
}

impl Scaled {
    /// The spring forces at the positions and velocities `(x2, y2, y1)`, deviations from the equilibrium.
    #[must_use]
    #[inline]
    pub fn springs(&self, position: [f64; 3], velocity: [f64; 3]) -> Springs {
        let (s, c) = (self.s, self.c);
        let elongation = |[x2, y2, y1]: [f64; 3]| x2 * s + y2 * c - y1;
        let tangential = |[x2, y2, _]: [f64; 3]| x2 * c - y2 * s;
        let h = self.k2 * elongation(position) + self.c2 * elongation(velocity);
        let g = self.k1 * tangential(position) + self.c1 * tangential(velocity);
        Springs { h, r: c * g + s * h, w: c * h - s * g }
    }

    /// `R` and `W` themselves (not deviations) of given springs.
    #[must_use]
    pub fn contact_loads(&self, springs: Springs) -> (f64, f64) {
        (springs.r + self.mu0 * self.n0, springs.w + self.n0)
    }

    /// `M11 = 1 + κ q` of slip with the signed friction coefficient `q = σ μ`.
    #[must_use]
    pub fn slip_inertia(&self, q: f64) -> f64 {
        1.0 + self.kappa * q
    }

    /// Mechanical energy in the frame of the belt moving at `belt_velocity`, up to a constant: kinetic
    /// energy of both masses, springs, and the work of `F_ext`. In free flight it never rises.
    #[must_use]
    pub fn energy(&self, position: [f64; 3], velocity: [f64; 3]) -> f64 {
        let [vx, vy, vw] = velocity;
        let [x2, y2, y1] = position;
        let stretch = x2 * self.s + y2 * self.c - y1 + 1.0;
        let shift = (self.mu0 * self.c - self.s) / (self.c + self.mu0 * self.s) * self.k2 / self.k1;
        let x1 = x2 * self.c - y2 * self.s + shift;
        0.5 * (self.m1 * vw * vw + self.k2 * stretch * stretch + self.k1 * x1 * x1)
            + self.tangential_energy(vx, vy)
            + self.k2 * y1
    }

    /// Kinetic energy of the motion of `x2` and `y2`.
    #[must_use]
    pub fn tangential_energy(&self, vx: f64, vy: f64) -> f64 {
        0.5 * (vx * vx - 2.0 * self.kappa * vx * vy + self.normal_mass * vy * vy)
    }
}
