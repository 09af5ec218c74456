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

use crate::cross::Measured;

/// The structure of a rig.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rig {
    /// Mass that lies on the sliding one, kg.
    pub m1: f64,
    /// Mass that slides, kg.
    pub m2: f64,
    /// Stiffness along the belt, N/m.
    pub k1: f64,
    /// Damping along the belt, N s/m.
    pub c1: f64,
    /// Inclination to the belt, rad.
    pub theta: f64,
    /// The friction coefficient at which its modes coalesce, for strokes forwards and backwards; beyond all friction where they do not.
    pub critical: [Measured; 2],
}

impl Rig {
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
}
