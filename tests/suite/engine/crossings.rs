//! `response_frequency` counts every upward zero crossing of `ẋ2`: two modes beat, and some wiggles only just cross.

use crate::common::{close, constant, instance};
use crate::engine::exact::{Crossings, crossings, sliding};
use crate::engine::limits::scene::periods;
use crate::engines::Engine;
use nalgebra::Vector4;
use squealmap::model::Param;
use squealmap::model::equilibrium::Units;
use squealmap::model::instance::Instance;

/// Periods before the window and in it.
const LENGTH: f64 = 150.0;

/// Where a wiggle comes closer to zero than this, relative to the motion, the error of 300 periods decides whether an
/// engine sees it cross (the kernels' series end at order 8); the reference has to see all.
const TOUCH: f64 = 2e-3;

/// Undamped sliding without a slope, both modes under way.
fn beating(theta: f64, k2: f64, displacement: f64) -> Instance {
    let values = [
        (Param::Theta, theta),
        (Param::K2, k2),
        (Param::C1, 0.0),
        (Param::C2, 0.0),
        (Param::BeltVelocity, 5.0),
        (Param::StartVelocity, 1e-3),
        (Param::StartDisplacement, displacement),
    ];
    instance(constant(0.05), &values)
}

fn expected(one: &Instance) -> Crossings {
    let time = LENGTH * Units::new(&one.params).period();
    let value = |param| one.params.get(param).expect("a value");
    let start = Vector4::new(value(Param::StartDisplacement), 0.0, value(Param::StartVelocity), 0.0);
    crossings(&sliding(one, 0.05, 0.0), start, time, time)
}

/// Counted at the ends of steps alone, one instance in four is off by 1 to 14 %.
#[test]
fn crossings_within_a_step_count() {
    let mut instances = Vec::new();
    for theta in [0.2, 0.4, 0.7] {
        for k2 in [2.5e5, 5e5, 8e5, 1.3e6] {
            for displacement in [-8e-6, -4e-6, -2e-6, 0.0, 2e-6, 4e-6, 8e-6] {
                instances.push(beating(theta, k2, displacement));
            }
        }
    }
    let expected: Vec<Crossings> = instances.iter().map(expected).collect();
    let clear = expected.iter().filter(|one| one.closest > TOUCH).count();
    assert!(2 * clear > expected.len(), "too few instances are clear: {clear} of {}", expected.len());
    for engine in Engine::ALL {
        let bound = match engine {
            Engine::Reference => 1e-11,
            Engine::CpuF64 | Engine::KernelF64 => 2e-6,
            Engine::CpuF32 | Engine::KernelF32 => 1e-5,
        };
        let outcomes = engine.run_all(&instances, &periods(LENGTH, LENGTH, 12));
        for ((one, outcome), expected) in instances.iter().zip(outcomes).zip(&expected) {
            if engine == Engine::Reference || expected.closest > TOUCH {
                let found = outcome.response_frequency.expect("a frequency");
                close(&format!("{} {:?}", engine.name(), one.params), found, expected.frequency, bound);
            }
        }
    }
}
