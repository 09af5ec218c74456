//! Runs until settled: what ends them, on every engine, and what their windows are.

use std::sync::atomic::AtomicBool;

use crate::common::{close, near, paper, plan};
use crate::twin;
use squealmap::engine::judged::regime;
use squealmap::engine::lanes::Lanes;
use squealmap::engine::lanes::outcomes::outcomes;
use squealmap::engine::outcome::{Ending, Outcome};
use squealmap::engine::plan::{Duration, Plan};
use squealmap::engine::reference::respond::respond;
use squealmap::engine::regime::Regime;
use squealmap::engine::scene::Scene;
use squealmap::engine::settling::Settling;
use squealmap::model::Param;
use squealmap::model::equilibrium::Units;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::linear::{analyse, eigenvalues};
use squealmap::model::status::Status;
use squealmap::sweep::spec::{AUTO_MEASURE, FIRST_SETTLE};

/// A run until settled, windows of 48 periods, for at most `limit` periods.
fn until_settled(limit: f64) -> Plan {
    Plan {
        settle: FIRST_SETTLE,
        settle_limit: Some(Duration::Periods(limit)),
        measure: AUTO_MEASURE,
        ..plan(1.0, 1.0, 12)
    }
}

fn kicked(mu_s: f64, mu_d: f64, velocity: f64, kick: f64) -> Instance {
    let mut instance = paper(mu_s, mu_d, velocity);
    instance.params.set(Param::StartVelocity, kick);
    instance
}

/// A period `2π/ω0`, s.
fn period(instance: &Instance) -> f64 {
    std::f64::consts::TAU * Units::new(&instance.params).time
}

fn in_lanes<T: Lanes>(instance: &Instance, plan: &Plan) -> Outcome {
    outcomes::<T>(std::slice::from_ref(instance), plan, &AtomicBool::new(false)).expect("nobody stops it")[0]
}

fn by_twin<T: Lanes>(instance: &Instance, plan: &Plan) -> Outcome {
    twin::outcomes::<T>(std::slice::from_ref(instance), plan)[0]
}

/// The reference, the CPU engine and the kernel's twin, each in every precision it has.
fn on_every_engine(instance: &Instance, plan: &Plan) -> [(&'static str, Outcome); 5] {
    [
        ("reference", respond(instance, plan)),
        ("f64", in_lanes::<f64>(instance, plan)),
        ("f32", in_lanes::<f32>(instance, plan)),
        ("twin f64", by_twin::<f64>(instance, plan)),
        ("twin f32", by_twin::<f32>(instance, plan)),
    ]
}

#[test]
fn a_limit_cycle_is_measured_over_whole_cycles_as_a_long_run_would() {
    for (mu_s, mu_d, velocity) in [(0.15, 0.05, 3.0), (0.4, 0.4, 3.0), (0.15, 0.05, 1.0)] {
        let instance = kicked(mu_s, mu_d, velocity, 0.01);
        let long = respond(&instance, &plan(40.0, 20.0, 12));
        for (engine, found) in on_every_engine(&instance, &until_settled(1000.0)) {
            let what = format!("{engine} at ({mu_s}, {mu_d}), {velocity} m/s");
            assert_eq!((found.status, found.ending), (Status::Ok, Some(Ending::Settled)), "{what}");
            for (name, actual, expected) in [
                ("std x2", found.x2_std, long.x2_std),
                ("rms ax", found.ax_rms, long.ax_rms),
                ("rms ay", found.ay_rms, long.ay_rms),
                ("frequency", found.response_frequency, long.response_frequency),
            ] {
                close(
                    &format!("{name} of {what}"),
                    actual.expect("a value"),
                    expected.expect("a value"),
                    3e-3,
                );
            }
            let degrees = found.phase_cycle.expect("a value") - long.phase_cycle.expect("a value");
            assert!(degrees.abs() < 0.5, "{what}: {degrees} degrees");
            let begun = found.settling_time.expect("a time");
            let half = 0.5 * (found.simulated_time - begun) * found.response_frequency.expect("a value");
            near(&format!("cycles of half a window of {what}"), half, half.round(), 0.02);
            // The windows asked for, at least; and no more settling than a fifth of the long run.
            assert!(
                half / found.response_frequency.expect("a value") >= 24.0 * period(&instance) * 0.999,
                "{what}"
            );
            assert!(begun >= 72.0 * period(&instance) && begun < 40.0, "{what}: {begun} s");
        }
    }
}

#[test]
fn engines_settle_in_the_same_window() {
    let instance = kicked(0.4, 0.3, 3.0, 0.01);
    let [(_, reference), others @ ..] = on_every_engine(&instance, &until_settled(1000.0));
    for (engine, found) in others {
        close(engine, found.settling_time.expect("a value"), reference.settling_time.expect("a value"), 2e-4);
        let deviation = reference.x2_std.expect("a value");
        close(engine, found.x2_std.expect("a value"), deviation, 1e-3);
        // What a window counts from is its own start, not that of the first one.
        let means = [(found.x2_mean, reference.x2_mean), (found.y1_mean, reference.y1_mean)];
        for (found, reference) in means {
            near(engine, found.expect("a value"), reference.expect("a value"), 1e-3 * deviation);
        }
    }
}

#[test]
fn a_decay_without_events_is_left_to_its_eigenvalues() {
    // A decay of −0.02 1/s: a fixed window of 3 s sees hardly anything of it.
    let instance = kicked(0.2, 0.2, 3.0, 0.01);
    let (kind, linear) = analyse(&instance);
    assert!((-0.03..0.0).contains(&linear.expect("one").growth_rate));
    for (engine, found) in on_every_engine(&instance, &until_settled(1000.0)) {
        assert_eq!(found.ending, Some(Ending::Decays), "{engine}");
        near(engine, found.settling_time.expect("a value"), 24.0 * period(&instance), 1e-9);
        assert_eq!(regime(&instance, kind, &found), (Regime::Equilibrium, true), "{engine}");
    }
}

#[test]
fn rest_is_settled_at_once() {
    // Stable or not: nothing pushes it.
    for (mu_s, mu_d) in [(0.2, 0.2), (0.4, 0.4)] {
        let instance = kicked(mu_s, mu_d, 3.0, 0.0);
        let found = respond(&instance, &until_settled(1000.0));
        assert_eq!((found.status, found.ending), (Status::Ok, Some(Ending::Settled)));
        near("start of the window", found.settling_time.expect("a value"), 24.0 * period(&instance), 1e-9);
    }
}

#[test]
fn slow_growth_comes_to_its_limit_unsettled() {
    // Grows e-fold in some 50 s: no event within the limit, and no window that could be believed.
    let instance = kicked(0.04, 0.02, 4.0, 1e-3);
    let (kind, linear) = analyse(&instance);
    let rate = linear.expect("one").growth_rate;
    assert!((1e-3..1.0).contains(&rate), "{rate}");
    let limit = 150.0;
    for (engine, found) in on_every_engine(&instance, &until_settled(limit)) {
        assert_eq!((found.status, found.ending), (Status::Ok, Some(Ending::Limit)), "{engine}");
        let (begun, limit) = (found.settling_time.expect("a value"), limit * period(&instance));
        assert!(begun <= limit && found.simulated_time > limit, "{engine}: {begun}");
        assert!(!regime(&instance, kind, &found).1, "{engine}");
        // All its windows are one growth window.
        close(engine, found.growth_rate_measured.expect("no event"), rate, 0.02);
    }
}

#[test]
fn halves_are_longer_than_the_beat_of_the_modes() {
    let instance = kicked(0.1, 0.1, 3.0, 0.01);
    let mut frequencies: Vec<f64> =
        eigenvalues(&instance).expect("a moving belt").iter().map(|z| z.im).filter(|w| *w > 0.0).collect();
    frequencies.sort_by(f64::total_cmp);
    let beat = std::f64::consts::TAU / (frequencies[1] - frequencies[0]);
    let short = Plan { measure: Duration::Seconds(0.8 * beat), ..until_settled(1000.0) };
    let scene = Scene::new(&instance, short.start).expect("an equilibrium");
    let settling = Settling::new(&instance, &scene, &short).expect("until settled");
    close("half", settling.half(None) * scene.units.time, beat, 1e-12);
    // Of a motion of 2.5 cycles in that time three make a half.
    close("cycles", settling.half(Some(2.5 / settling.half(None))), 1.2 * settling.half(None), 1e-12);
}

#[test]
fn halves_are_neither_endless_nor_a_part_of_a_cycle() {
    // Next to coalescence the beat takes 780 periods; two modes of one frequency have none.
    for (mu, measure, periods) in [(0.2262, 48.0, 96.0), (0.4, 1e-3, 32.0)] {
        let instance = kicked(mu, mu, 3.0, 0.01);
        let plan = Plan { measure: Duration::Periods(measure), ..until_settled(1000.0) };
        let scene = Scene::new(&instance, plan.start).expect("an equilibrium");
        let settling = Settling::new(&instance, &scene, &plan).expect("until settled");
        let half = settling.half(None) / std::f64::consts::TAU;
        assert!((8.0..=periods * (1.0 + 1e-12)).contains(&half), "{half} periods at μ = {mu}");
    }
}

#[test]
fn a_beat_that_still_grows_into_an_event_does_not_decay() {
    // Stable, but within the beat of 780 periods x2 grows and meets its first event after many quiet windows.
    let instance = kicked(0.2262, 0.2262, 1.0, 0.0387);
    assert!(analyse(&instance).1.expect("one").growth_rate < -0.01);
    for (engine, found) in on_every_engine(&instance, &until_settled(1000.0)) {
        assert_ne!(found.ending, Some(Ending::Decays), "{engine}");
        assert!(found.free > Some(0.01) && found.stick > Some(0.01), "{engine}");
    }
}

#[test]
fn what_is_not_damped_does_not_decay() {
    let mut instance = kicked(0.3, 0.3, 3.0, 0.5);
    for param in [Param::C1, Param::C2, Param::Theta] {
        instance.params.set(param, 0.0);
    }
    let (kind, _) = analyse(&instance);
    for (engine, found) in on_every_engine(&instance, &until_settled(1000.0)) {
        assert_eq!(found.ending, Some(Ending::Settled), "{engine}");
        assert_eq!(regime(&instance, kind, &found), (Regime::Slip, true), "{engine}");
    }
}

#[test]
fn a_large_motion_under_a_curved_law_is_not_judged_by_its_eigenvalues() {
    let mut instance = kicked(0.3, 0.2, 8.75, 1.619);
    instance.law = FrictionLaw::Exponential { mu_s: 0.3, mu_d: 0.2, stribeck_velocity: 1.0 };
    let (kind, linear) = analyse(&instance);
    assert!(linear.expect("one").growth_rate < 0.0);
    // It comes to stick after more than the limit.
    let found = respond(&instance, &until_settled(1000.0));
    assert_eq!(found.ending, Some(Ending::Limit));
    assert_eq!(regime(&instance, kind, &found), (Regime::Slip, false));
}

/// What a run with these deviations of `x2` in its halves does after the second window.
fn judged(deviations: [f64; 4]) -> Option<Ending> {
    let instance = kicked(0.4, 0.3, 3.0, 0.01);
    let plan = until_settled(1000.0);
    let scene = Scene::new(&instance, plan.start).expect("an equilibrium");
    let mut settling = Settling::new(&instance, &scene, &plan).expect("until settled");
    let [a, b, c, d] = deviations;
    let window = |halves| Outcome {
        status: Status::Ok,
        stick: Some(0.2),
        speed_rms_halves: [1.0; 2],
        x2_std_halves: halves,
        ay_rms_halves: [5.0; 2],
        ..Outcome::default()
    };
    assert_eq!(settling.judge(&window([a, b]), true, 400.0), None, "one window is no comparison");
    settling.judge(&window([c, d]), true, 700.0)
}

#[test]
fn what_is_left_of_an_approach_counts_not_its_last_step() {
    // 1 + d rⁿ: the last step may be small and all that follows not.
    let approach = |d: f64, r: f64| [0, 1, 2, 3].map(|n| 1.0 + d * r.powi(n));
    assert_eq!(judged([1.0; 4]), Some(Ending::Settled));
    assert_eq!(judged(approach(0.01, 0.5)), Some(Ending::Settled), "0.1 % is left");
    assert_eq!(judged(approach(0.04, 0.9)), None, "3 % is left, the last step is 0.3 %");
    assert_eq!(judged(approach(-0.04, 0.9)), None);
    assert_eq!(judged([1.0, 1.001, 1.003, 1.007]), None, "it runs away");
    assert_eq!(judged([1.0, 1.002, 0.999, 1.001]), Some(Ending::Settled), "it only scatters");
    assert_eq!(judged([1.0, 1.0, 1.0, 1.006]), None, "the last half differs");
    assert_eq!(judged([1.0, 1.0, 1.006, 1.006]), None, "the window before differs");
}

/// At θ = 0 nothing along the belt excites `m1` across it: that it is not damped does not keep the motion from its end, on any engine.
#[test]
fn what_nothing_excites_is_not_waited_for() {
    let mut instance = kicked(0.15, 0.05, 3.0, 0.3);
    instance.law = FrictionLaw::Exponential { mu_s: 0.3, mu_d: 0.2, stribeck_velocity: 1.0 };
    for (param, value) in [(Param::Theta, 0.0), (Param::C1, 8.0), (Param::C2, 0.0)] {
        instance.params.set(param, value);
    }
    let mut damped = instance.clone();
    damped.params.set(Param::C2, 8.0);
    let plan = until_settled(1000.0);
    let both = on_every_engine(&instance, &plan).into_iter().zip(on_every_engine(&damped, &plan));
    for ((engine, found), (_, expected)) in both {
        assert_eq!((found.status, found.ending), (Status::Ok, Some(Ending::Decays)), "{engine}");
        assert_eq!(expected.ending, Some(Ending::Decays), "{engine}");
    }
    // What moves across the belt goes on.
    instance.params.set(Param::Theta, 0.02);
    assert_ne!(respond(&instance, &until_settled(60.0)).ending, Some(Ending::Decays));
}
