//! Belt velocities on a kink of the friction law: a small motion sees the slopes of both sides.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::common::{bilinear, instance, near, plan};
use crate::engines::Engine;
use squealmap::engine::judged::regime;
use squealmap::engine::plan::{Duration, Plan};
use squealmap::engine::regime::Regime;
use squealmap::model::Param;
use squealmap::model::instance::Instance;
use squealmap::model::kind::InstabilityType as Kind;
use squealmap::model::linear::analyse;
use squealmap::model::status::Status;
use squealmap::sweep::spec::{AUTO_MEASURE, FIRST_SETTLE};

/// A law with its knee at 5 m/s.
fn kicked(mu_s: f64, mu_d: f64, velocity: f64, kick: f64, damping: f64) -> Instance {
    let all = [
        (Param::BeltVelocity, velocity),
        (Param::StartVelocity, kick),
        (Param::C1, damping),
        (Param::C2, damping),
    ];
    instance(bilinear(mu_s, mu_d), &all)
}

/// The regime on an engine.
fn on(engine: Engine, instance: &Instance, plan: &Plan) -> (Regime, bool) {
    let outcome = engine.run(instance, plan);
    assert_eq!(outcome.status, Status::Ok, "{}", engine.name());
    regime(instance, analyse(instance).0, &outcome)
}

/// Sliding is called stable there by the slope above the knee, but half of each cycle has the one below it.
#[test]
fn what_grows_about_a_kink_is_no_equilibrium() {
    for (instance, plan) in [
        (kicked(0.3, 0.1, 5.0, 1e-5, 0.1), plan(1.0, 0.3, 24)),
        (kicked(0.3, 0.1, 5.000_001, 1e-5, 0.1), plan(1.0, 0.3, 24)),
        (kicked(0.105, 0.1, 5.0, 1e-2, 0.1), plan(3.0, 1.0, 24)),
        (kicked(0.3, 0.1, 5.0, 1e-4, 20.0), plan(3.0, 1.0, 24)),
    ] {
        assert_eq!(analyse(&instance).0, Some(Kind::Stable));
        for engine in Engine::ALL {
            let found = on(engine, &instance, &plan);
            assert_eq!(found, (Regime::NotYetGrown, false), "{}", engine.name());
        }
    }
    // Far above the knee the same motion decays.
    for engine in Engine::ALL {
        let found = on(engine, &kicked(0.3, 0.1, 5.1, 1e-4, 0.1), &plan(1.0, 0.5, 24));
        assert_eq!(found, (Regime::Equilibrium, true), "{}", engine.name());
    }
}

/// The rate of growth is that of the mean slope: the describing function of a kink.
#[test]
fn growth_about_a_kink_is_that_of_the_mean_slope() {
    // As mu_s, the one whose slope is half as steep and whose level at 5 m/s is the same.
    for (mu_s, damping) in [(0.3, 0.1), (0.15, 0.1), (0.3, 20.0), (0.14, 20.0)] {
        let about = kicked(mu_s, 0.1, 5.0, 1e-4, damping);
        let half = kicked(0.5 * (mu_s + 0.1), 0.1, 5.0 - 1e-9, 1e-4, damping);
        let expected = analyse(&half).1.unwrap().growth_rate;
        let speed = |settle: f64| Engine::Reference.run(&about, &plan(settle, 0.3, 24)).speed_rms_halves[1];
        let found = (speed(1.0) / speed(0.4)).ln() / 0.6;
        near("growth", found, expected, 0.05 * expected.abs());
    }
}

/// What decays about a kink comes to rest, and is told so before its motion is lost among roundings.
#[test]
fn what_decays_about_a_kink_settles() {
    let plan = Plan {
        settle: FIRST_SETTLE,
        settle_limit: Some(Duration::Periods(1000.0)),
        measure: AUTO_MEASURE,
        ..plan(1.0, 1.0, 24)
    };
    for engine in Engine::ALL {
        let found = on(engine, &kicked(0.14, 0.1, 5.0, 1e-2, 20.0), &plan);
        assert_eq!(found, (Regime::Equilibrium, true), "{}", engine.name());
    }
}
