//! The sliding equilibrium and the dimensionless model around it.
//!
//! Lengths are measured in `F_ext/k2`, times in `1/ω0`, masses in `m2 + m1 c²`, as deviations from the
//! sliding equilibrium at the initial belt velocity:
//!
//! ```text
//! ω0² = k1 c²/(m2 + m1 c²)      N0 = F_ext/(c + μ0 s)      k1 c x2 = F_ext (μ0 c − s)/(c + μ0 s)
//! ```

use crate::model::instance::Instance;
use crate::model::status::Status;
use crate::model::{Param, Params};

/// The SI value of each dimensionless unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    /// `1/ω0`, s.
    pub time: f64,
    /// `F_ext/k2`, m.
    pub length: f64,
    /// m/s.
    pub velocity: f64,
    /// m/s².
    pub acceleration: f64,
    /// N.
    pub force: f64,
}

impl Units {
    /// The units of an instance.
    #[must_use]
    pub fn new(params: &Params) -> Units {
        let cos = params.require(Param::Theta).cos();
        let mass = sliding_mass(params);
        let time = (mass / params.require(Param::K1)).sqrt() / cos;
        let length = params.require(Param::FExt) / params.require(Param::K2);
        let velocity = length / time;
        let acceleration = velocity / time;
        Units { time, length, velocity, acceleration, force: mass * acceleration }
    }

    /// The period `2π/ω0`, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        std::f64::consts::TAU * self.time
    }
}

/// `m2 + m1 c²`, kg.
pub(super) fn sliding_mass(params: &Params) -> f64 {
    params.require(Param::M2) + params.require(Param::M1) * params.require(Param::Theta).cos().powi(2)
}

/// The sliding equilibrium at a constant belt velocity, SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equilibrium {
    /// μ at the belt velocity.
    pub mu: f64,
    /// `dμ/d|v|` there, s/m.
    pub slope: f64,
    /// Normal contact force, N.
    pub normal_force: f64,
    /// Position of `m2` along the belt, m.
    pub x2: f64,
    /// Height of `m1`, m.
    pub y1: f64,
}

impl Equilibrium {
    /// The sliding equilibrium of an instance at its (initial) belt velocity.
    ///
    /// # Errors
    /// [`Status::InvalidLaw`] for an ill-posed law, [`Status::NoEquilibrium`] for `c + μ0 s ≤ 0`.
    pub fn new(instance: &Instance) -> Result<Equilibrium, Status> {
        if !instance.law.is_valid() {
            return Err(Status::InvalidLaw);
        }
        let params = &instance.params;
        let velocity = params.require(Param::BeltVelocity);
        let (sin, cos) = params.require(Param::Theta).sin_cos();
        let (mu, slope) = (instance.law.mu(velocity), instance.law.slope(velocity));
        let reach = cos + mu * sin;
        if reach <= 0.0 {
            return Err(Status::NoEquilibrium);
        }
        let force = params.require(Param::FExt);
        let x2 = force * (mu * cos - sin) / reach / (params.require(Param::K1) * cos);
        let y1 = x2 * sin - force / params.require(Param::K2);
        Ok(Equilibrium { mu, slope, normal_force: force / reach, x2, y1 })
    }
}
