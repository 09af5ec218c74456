//! What engines count within a run: crossings, events, and what they say where there is nothing to count.

use std::sync::Arc;

use crate::common::{close, instance, plan};
use crate::engines::Engine;
use squealmap::engine::judged;
use squealmap::engine::plan::{Duration, Plan};
use squealmap::engine::regime::Regime;
use squealmap::model::friction::{FrictionLaw, MuTable};
use squealmap::model::instance::Instance;
use squealmap::model::motion::{Motion, MotionTable};
use squealmap::model::status::Status;
use squealmap::model::{Param, linear};

/// On a belt that comes to rest a body starts from rest and comes to rest. Whether its velocity is below 0 by a rounding then
/// says nothing: all engines count the same crossings, with any number of steps.
#[test]
fn crossings_of_what_rests_are_no_matter_of_rounding() {
    let corners: Vec<[f64; 2]> = [0.0, 0.1, 0.5, 0.6, 1.0, 1.1, 1.5, 1.6, 2.0]
        .into_iter()
        .zip([0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0])
        .map(|(time, velocity)| [time, velocity])
        .collect();
    let table = MotionTable { name: "rests.csv".to_owned(), corners: corners.into(), temperature: None };
    let motion = Motion::Table(Arc::new(table));
    let values = [(Param::BeltVelocity, 1.0), (Param::Theta, 0.1), (Param::C1, 5.0), (Param::C2, 5.0)];
    for mu_s in [0.3, 0.4364, 0.5727] {
        let law = FrictionLaw::Bilinear { mu_s, mu_d: 0.2, knee_velocity: 2.0 };
        let one = Instance { motion: motion.clone(), ..instance(law, &values) };
        let run = |engine: Engine, steps: u32| {
            let whole =
                Plan { settle: Duration::Seconds(0.0), measure: Duration::Ramp, ..plan(0.0, 1.0, steps) };
            engine.run(&one, &whole).response_frequency.expect("it oscillates")
        };
        let expected = run(Engine::Reference, 60);
        for engine in Engine::ALL {
            for steps in [12, 13] {
                close(&format!("{} {mu_s} {steps}", engine.name()), run(engine, steps), expected, 1e-3);
            }
        }
    }
}

/// A second pass over a window of more events than a period may have counts them period by period, as the first has.
#[test]
fn a_second_pass_counts_from_anew() {
    let rows = (0..800).map(|row| 1e-4 * 10.0_f64.powf(5.0 * f64::from(row) / 800.0));
    let velocity: Vec<f64> = std::iter::once(0.0).chain(rows).collect();
    let mu = velocity.iter().map(|v| 0.32 + 0.125 / (1.0 + v)).collect();
    let law = FrictionLaw::Table(Arc::new(MuTable { velocity, mu }));
    let values = [
        (Param::Theta, 0.3),
        (Param::BeltVelocity, 1.05),
        (Param::StartVelocity, 3.0),
        (Param::Restitution, 0.5),
        (Param::C1, 5.0),
        (Param::C2, 50.0),
    ];
    let one = instance(law, &values);
    let periods = |count| Duration::Periods(count);
    let long = Plan { settle: periods(60.0), measure: periods(40.0), ..plan(0.0, 1.0, 12) };
    let expected = Engine::Reference.run(&one, &long);
    assert_eq!(expected.status, Status::Ok);
    assert!(expected.steps > 60_000, "many events: {}", expected.steps);
    for engine in [Engine::CpuF64, Engine::CpuF32] {
        let outcome = engine.run(&one, &long);
        assert_eq!(outcome.status, Status::Ok, "{}", engine.name());
        close(engine.name(), outcome.x2_std.expect("a value"), expected.x2_std.expect("a value"), 1e-3);
    }
}

/// What has come to rest has neither frequency nor phase, though its last digits may still change.
#[test]
fn rest_has_no_frequency() {
    let law = FrictionLaw::Bilinear {
        mu_s: 0.277_301_059_866_139_5,
        mu_d: 0.392_256_826_063_548_3,
        knee_velocity: 0.122_459_683_849_962_63,
    };
    let values = [
        (Param::Theta, 0.0),
        (Param::C1, 1.0),
        (Param::BeltVelocity, 0.108_161_448_059_035_81),
        (Param::StartVelocity, -0.461_954_523_143_260_7),
    ];
    let rests = instance(law, &values);
    let periods = |count| Duration::Periods(count);
    let late = Plan { settle: periods(100.0), measure: periods(20.0), ..plan(0.0, 1.0, 12) };
    for engine in Engine::ALL {
        let at_rest = engine.run(&rests, &late);
        assert_eq!((at_rest.status, at_rest.x2_std), (Status::Ok, Some(0.0)), "{}", engine.name());
        assert_eq!((at_rest.response_frequency, at_rest.phase_cycle), (None, None), "{}", engine.name());
    }
}

/// Against a contact that inclines against the motion friction jams: the harder the body is drawn, the harder it is pressed. The
/// belt carries it along for ever, and nothing has settled, whether the halves of the window are alike or not.
#[test]
fn what_is_carried_along_has_not_settled() {
    let jammed = instance(
        FrictionLaw::Bilinear { mu_s: 0.98, mu_d: 0.3, knee_velocity: 0.5 },
        &[
            (Param::Theta, -0.8),
            (Param::C1, 20.0),
            (Param::C2, 20.0),
            (Param::BeltVelocity, 1.0),
            (Param::StartVelocity, 1.0),
        ],
    );
    let periods = |count| Duration::Periods(count);
    let late = Plan { settle: periods(200.0), measure: periods(20.0), ..plan(0.0, 1.0, 12) };
    for engine in Engine::ALL {
        let outcome = engine.run(&jammed, &late);
        let (kind, _) = linear::analyse(&jammed);
        assert_eq!(judged::regime(&jammed, kind, &outcome), (Regime::Stuck, false), "{}", engine.name());
    }
}
