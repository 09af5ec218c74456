//! Friction tables whose rows jump up and down: between two of them friction may rise so steeply that the motion is held
//! to within a millionth of its velocity.

use std::f64::consts::TAU;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::common::{instance, plan};
use crate::engines::Engine;
use crate::instances::Uniform;
use squealmap::engine::lanes::again::outcomes_again;
use squealmap::engine::method::pace::fastest_beyond;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::{Duration, Plan, StartKind};
use squealmap::engine::reference::bounds::MAX_STEPS_PER_PERIOD;
use squealmap::engine::scene::Scene;
use squealmap::model::Param;
use squealmap::model::friction::{FrictionLaw, MuTable};
use squealmap::model::instance::Instance;
use squealmap::model::status::Status;

/// A table of 200 rows up to `top` m/s, every μ between 0 and 1.
fn table(u: &mut Uniform, top: f64) -> FrictionLaw {
    let mut velocity: Vec<f64> = (0..199).map(|_| top * u.next()).collect();
    velocity.push(0.0);
    velocity.sort_by(f64::total_cmp);
    let mu = velocity.iter().map(|_| u.next()).collect();
    FrictionLaw::Table(Arc::new(MuTable { velocity, mu }))
}

fn jagged(count: usize) -> Vec<Instance> {
    let mut u = Uniform(41);
    let one = |k: usize| {
        let top = [1.0, 3.0, 5.0][k % 3];
        let law = table(&mut u, top);
        let theta = [0.0, 0.01, 0.1, 0.3][k % 4];
        let kick = [0.01, 0.1, 1.0][(k / 3) % 3];
        let belt = top * (0.05 + 0.85 * u.next());
        instance(law, &[(Param::Theta, theta), (Param::StartVelocity, kick), (Param::BeltVelocity, belt)])
    };
    (0..count).map(one).collect()
}

/// How far a step may turn in contact at order 13, radians.
const TURN: f64 = 1.64;

/// Whether a period has more steps than it may while the motion stays on the steepest piece.
fn is_too_steep(instance: &Instance) -> bool {
    let scene = Scene::new(instance, StartKind::Kick).expect("an equilibrium");
    let pieces = 0..scene.model.law.pieces.len();
    let fastest = pieces.map(|piece| fastest_beyond(&scene.model, piece)).fold(0.0, f64::max);
    TAU * fastest > TURN * f64::from(MAX_STEPS_PER_PERIOD)
}

fn in_f64_too(instances: &[Instance], plan: &Plan, made: Vec<Outcome>) -> Vec<Outcome> {
    outcomes_again(instances, plan, made, &AtomicBool::new(false)).expect("nobody stops it")
}

#[test]
fn every_engine_comes_through_a_jagged_table() {
    let of = |settle: f64, measure: f64| Plan {
        settle: Duration::Periods(settle),
        measure: Duration::Periods(measure),
        ..plan(0.0, 1.0, 12)
    };
    let instances = jagged(48);
    for engine in Engine::ALL {
        // Kernels on the CPU take some thousand times as long for a step, and a period has many where it is steep.
        let is_kernel = matches!(engine, Engine::KernelF64 | Engine::KernelF32);
        let (instances, plan) =
            if is_kernel { (&instances[..4], of(2.0, 1.0)) } else { (&instances[..], of(20.0, 10.0)) };
        let made = engine.run_all(instances, &plan);
        // Single precision as a sweep has it.
        let again = matches!(engine, Engine::CpuF32 | Engine::KernelF32);
        let made = if again { in_f64_too(instances, &plan, made) } else { made };
        let unexpected = |(k, one): &(usize, &Outcome)| match one.status {
            Status::Ok => false,
            Status::StepTooLarge => !is_too_steep(&instances[*k]),
            _ => true,
        };
        let ended = made.iter().enumerate().filter(unexpected);
        let ended: Vec<_> = ended.map(|(k, one)| (k, one.status, one.simulated_time)).collect();
        assert!(ended.is_empty(), "{}: {ended:?}", engine.name());
        let ok = made.iter().filter(|one| one.status == Status::Ok).count();
        assert!(ok + 4 > made.len(), "{}: {ok}", engine.name());
    }
}
