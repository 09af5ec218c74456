//! Random instances over wide ranges of every parameter, the same ones in every run.

use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::motion::Motion;
use squealmap::model::{Param, Params};

/// A small generator of uniform numbers in [0, 1): the upper bits of a linear congruence modulo 2^64.
pub(crate) struct Uniform(pub(crate) u64);

impl Uniform {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn log(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.next())
    }
}

/// The paper's masses and springs, leaning both ways, on a belt of any velocity; some belts with a ramp, impacts
/// with and without restitution.
pub(crate) fn moving(u: &mut Uniform) -> Params {
    let mut params = Params::default();
    let velocity = u.log(0.05, 10.0);
    params.set(Param::BeltVelocity, velocity);
    if u.next() < 0.25 {
        params.set(Param::BeltVelocityEnd, 2.0 * velocity * u.next());
        params.set(Param::RampDuration, u.log(1e-3, 1.0));
    }
    params.set(Param::Theta, 0.9 * u.next() - 0.3);
    params.set(Param::StartVelocity, 2.0 * velocity * u.next());
    params.set(Param::StartDisplacement, 1e-3 * (u.next() - 0.5));
    params.set(Param::Restitution, (1.5 * u.next() - 0.5).max(0.0));
    params
}

/// Instances with a bilinear law.
pub(crate) fn random(count: usize) -> Vec<Instance> {
    let mut u = Uniform(7);
    (0..count).map(|_| one(&mut u)).collect()
}

fn one(u: &mut Uniform) -> Instance {
    let (mu_s, mu_d, knee_velocity) = (0.9 * u.next(), 0.9 * u.next(), u.log(0.1, 10.0));
    let mut params = Params::default();
    for (param, low, high) in [
        (Param::M1, 0.01, 100.0),
        (Param::M2, 0.01, 100.0),
        (Param::K1, 1e3, 1e7),
        (Param::K2, 1e3, 1e7),
        (Param::C1, 1e-3, 100.0),
        (Param::C2, 1e-3, 100.0),
        (Param::FExt, 1.0, 1e4),
        (Param::BeltVelocity, 0.01, 20.0),
    ] {
        params.set(param, u.log(low, high));
    }
    params.set(Param::Theta, 1.2 * u.next() - 0.6);
    Instance {
        params,
        law: FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity },
        impact_friction: true,
        motion: Motion::Ramp,
        heating: None,
        modal: None,
    }
}
