//! The dimensionless model about its equilibrium.

use crate::model::Param;
use crate::model::equilibrium::{Equilibrium, Units, sliding_mass};
use crate::model::fastest::{Fastest, fastest};
use crate::model::instance::Instance;
use crate::model::piece::PieceChain;
use crate::model::status::Status;

/// The dimensionless model: everything the equations of motion hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Scaled {
    /// `sin θ`.
    pub s: f64,
    /// `cos θ`.
    pub c: f64,
    /// `m1`; `m2` follows from `m2 + m1 c² = 1`.
    pub m1: f64,
    /// `k1`.
    pub k1: f64,
    /// `k2`, which equals the scaled `F_ext`.
    pub k2: f64,
    /// `c1`.
    pub c1: f64,
    /// `c2`.
    pub c2: f64,
    /// `κ = m1 s c`, the inertia that couples tangential motion to the normal force.
    pub kappa: f64,
    /// Determinant of the mass matrix of `(x2, y2)`: `m2 (m1 + m2)` before scaling.
    pub det: f64,
    /// Mass of `y2`: `m2 + m1 s²`.
    pub normal_mass: f64,
    /// Normal force of the equilibrium.
    pub n0: f64,
    /// μ of the equilibrium.
    pub mu0: f64,
    /// Belt velocity of the equilibrium.
    pub v0: f64,
    /// The friction law in scaled speeds.
    pub law: PieceChain,
    /// Newton restitution.
    pub restitution: f64,
    /// Whether impacts carry a Coulomb impulse.
    pub impact_friction: bool,
    /// How fast the quickest mode of each contact state is.
    pub fastest: Fastest,
}

impl Scaled {
    /// The dimensionless model of an instance around `equilibrium`.
    #[must_use]
    pub fn new(instance: &Instance, units: &Units, equilibrium: &Equilibrium) -> Scaled {
        let params = &instance.params;
        let mass = sliding_mass(params);
        let (s, c) = params.require(Param::Theta).sin_cos();
        let stiffness = mass / units.time.powi(2);
        let damping = mass / units.time;
        let m1 = params.require(Param::M1) / mass;
        let m2 = params.require(Param::M2) / mass;
        Scaled {
            s,
            c,
            m1,
            k1: params.require(Param::K1) / stiffness,
            k2: params.require(Param::K2) / stiffness,
            c1: params.require(Param::C1) / damping,
            c2: params.require(Param::C2) / damping,
            kappa: m1 * s * c,
            det: m2 * (m1 + m2),
            normal_mass: m2 + m1 * s * s,
            n0: equilibrium.normal_force / units.force,
            mu0: equilibrium.mu,
            v0: params.require(Param::BeltVelocity) / units.velocity,
            law: instance.law.pieces(units.velocity),
            restitution: params.require(Param::Restitution),
            impact_friction: instance.impact_friction,
            fastest: fastest(params, units, equilibrium),
        }
    }

    /// The status an integration ended with, as it is told. On a piece too narrow for an arithmetic a speed may lie beyond its
    /// ends, and friction with it beyond all that the law has: where that alone makes `M11` vanish, nothing is Painlevé's.
    #[must_use]
    pub fn told(&self, status: Status) -> Status {
        if status == Status::Painleve && !self.may_be_painleve() { Status::StepTooLarge } else { status }
    }

    /// Whether friction may make `M11` vanish, at whatever speed: `|κ| μ ≥ 1`.
    #[must_use]
    pub fn may_be_painleve(&self) -> bool {
        self.kappa.abs() * self.law.highest() >= 1.0 - PAINLEVE_ROUNDING
    }

    /// `σ μ(v) − μ0` in slip on a piece of the law, with the belt faster than at the equilibrium by `ahead` and the body
    /// moving at `velocity`: to the last digits of small motions about the equilibrium.
    #[must_use]
    pub fn friction_beyond_equilibrium(&self, sigma: f64, piece: usize, ahead: f64, velocity: f64) -> f64 {
        let (own, law) = (piece == self.law.index(self.v0), self.law.pieces[piece]);
        if sigma > 0.0 && own {
            law.change(self.v0, ahead - velocity)
        } else {
            sigma * law.mu(sigma * (self.v0 + ahead - velocity)) - self.mu0
        }
    }
}

/// In single precision `M11` may vanish this much early.
pub(super) const PAINLEVE_ROUNDING: f64 = 1e-5;
