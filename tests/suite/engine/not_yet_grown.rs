//! What is unstable and has not met an event has not shown what it does: it is `not_yet_grown`, on every engine.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::Path;

use crate::cli::program::{squealmap, unwrapped};
use crate::common::{bilinear, instance, paper, plan};
use crate::engines::Engine;
use crate::synthetic::{map, record, span};
use squealmap::engine::judged::regime;
use squealmap::engine::options::Options;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::{Duration, Plan, StartKind};
use squealmap::engine::record::{Attractor, Basin, differ};
use squealmap::engine::regime::{Regime, about_unstable};
use squealmap::model::Param;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::kind::InstabilityType as Kind;
use squealmap::model::linear::analyse;
use squealmap::model::status::Status;
use squealmap::results::figure::map::map_svg;
use squealmap::sweep::accuracy::errors::oscillates;
use squealmap::sweep::grid::Grid;
use squealmap::sweep::map::Map;
use squealmap::sweep::onset::time_to_first_event;
use squealmap::sweep::run;
use squealmap::sweep::spec::{AUTO_MEASURE, FIRST_SETTLE, Spec};

fn kicked(mu_s: f64, mu_d: f64, velocity: f64, kick: f64) -> Instance {
    instance(bilinear(mu_s, mu_d), &[(Param::BeltVelocity, velocity), (Param::StartVelocity, kick)])
}

fn until_settled() -> Plan {
    Plan {
        settle: FIRST_SETTLE,
        settle_limit: Some(Duration::Periods(300.0)),
        measure: AUTO_MEASURE,
        ..plan(1.0, 1.0, 12)
    }
}

/// The regime on every engine, all the same.
#[track_caller]
fn on_all(instance: &Instance, plan: &Plan) -> (Regime, bool) {
    let (kind, _) = analyse(instance);
    let found = Engine::ALL.map(|engine| {
        let outcome = engine.run(instance, plan);
        assert_eq!(outcome.status, Status::Ok, "{}", engine.name());
        regime(instance, kind, &outcome)
    });
    assert!(found.iter().all(|one| *one == found[0]), "{found:?}");
    found[0]
}

#[test]
fn slow_growth_is_no_equilibrium_on_any_engine() {
    // Grows e-fold in some 50 s.
    let slow = kicked(0.021, 0.02, 4.0, 1e-3);
    assert!((1e-3..0.1).contains(&analyse(&slow).1.unwrap().growth_rate));
    for plan in [plan(3.0, 1.0, 12), plan(0.0, 2.0, 12), until_settled()] {
        assert_eq!(on_all(&slow, &plan), (Regime::NotYetGrown, false));
    }
    // Fast enough to be seen, and not there yet: not a sustained slip oscillation.
    let fast = kicked(0.15, 0.05, 1.0, 1e-3);
    assert_eq!(on_all(&fast, &plan(1.0, 0.3, 12)), (Regime::NotYetGrown, false));
    assert_eq!(on_all(&fast, &plan(12.0, 3.0, 12)).0, Regime::StickSlip);
    // From rest nothing grows, but by the rounding of an engine; of a stable one that is an equilibrium.
    let [rest, stable] = [0.05, 0.15].map(|mu_d| kicked(0.15, mu_d, 3.0, 0.0));
    for plan in [plan(3.0, 1.0, 12), until_settled()] {
        assert_eq!(on_all(&stable, &plan), (Regime::Equilibrium, true));
        let found = regime(&rest, analyse(&rest).0, &Engine::Reference.run(&rest, &plan));
        assert_eq!(found, (Regime::NotYetGrown, false));
    }
    assert_eq!(on_all(&rest, &plan(3.0, 1.0, 12)), (Regime::NotYetGrown, false));
}

/// Events before the window and in it, of stable and unstable equilibria, of two masses and of one.
#[test]
fn every_engine_tells_whether_an_event_was_met() {
    let mut all = Vec::new();
    for theta in [0.01, 0.0] {
        for (mu_s, mu_d) in [(0.1, 0.1), (0.15, 0.05), (0.4, 0.4)] {
            for kick in [1e-3, 0.5, 2.0, 2.9, 3.1, 4.0] {
                let mut one = kicked(mu_s, mu_d, 3.0, kick);
                one.params.set(Param::Theta, theta);
                all.push(one);
            }
        }
    }
    let mut met = [0, 0];
    for plan in [plan(0.0, 0.5, 12), plan(0.5, 0.5, 12), until_settled()] {
        let found = Engine::ALL.map(|engine| engine.run_all(&all, &plan));
        for (at, one) in all.iter().enumerate() {
            let found = found.each_ref().map(|of_engine| of_engine[at].met_event);
            assert_eq!(found, [found[0]; 5], "{one:?} {plan:?}");
            met[usize::from(found[0])] += 1;
        }
    }
    assert!(met[0] > 20 && met[1] > 40, "{met:?}");
}

/// A curved law can hold a motion at an amplitude that meets no event at all: it has stopped growing.
#[test]
fn a_slip_cycle_without_any_event_is_one() {
    let law = FrictionLaw::Exponential { mu_s: 0.5071, mu_d: 0.7862, stribeck_velocity: 0.145 };
    let values = [
        (Param::Theta, 0.5314),
        (Param::C1, 0.339),
        (Param::C2, 7.261),
        (Param::K2, 50_343.0),
        (Param::BeltVelocity, 3.1426),
        (Param::StartVelocity, 0.01),
    ];
    let cycle = instance(law, &values);
    let (kind, linear) = analyse(&cycle);
    let rate = linear.unwrap().growth_rate;
    assert!(kind == Some(Kind::ModeCoupling) && (0.8..1.0).contains(&rate), "{rate}");
    let long = plan(24.0, 3.0, 12);
    assert!(!Engine::CpuF64.run(&cycle, &long).met_event);
    assert_eq!(on_all(&cycle, &long), (Regime::Slip, true));
    assert_eq!(on_all(&cycle, &plan(2.0, 3.0, 12)), (Regime::NotYetGrown, false));
    let auto = Plan { settle_limit: Some(Duration::Periods(2000.0)), ..until_settled() };
    assert_eq!(on_all(&cycle, &auto), (Regime::Slip, true));
}

#[test]
fn both_sides_of_what_stops_growing() {
    let outcome = |speeds: [f64; 2], x2: [f64; 2], met_event: bool| Outcome {
        status: Status::Ok,
        speed_rms_halves: speeds,
        x2_std_halves: x2,
        ay_rms_halves: [1.0; 2],
        window: 2.0,
        simulated_time: 100.0,
        met_event,
        ..Outcome::default()
    };
    let same = [1.0; 2];
    // With a growth rate of 0.1 the halves, 1 s apart, would differ by 10 %, and 100 s are 10 e-folds.
    for (one, rate, found, expected) in [
        (outcome(same, same, false), 0.1, Regime::Slip, (Regime::Slip, true)),
        // ln 1.05 in a second, ln 1000 in 100 s.
        (outcome(same, same, false), 0.0692, Regime::Slip, (Regime::Slip, true)),
        (outcome(same, same, false), 0.0689, Regime::Slip, (Regime::NotYetGrown, false)),
        (
            Outcome { window: 0.97, ..outcome(same, same, false) },
            0.1,
            Regime::Slip,
            (Regime::NotYetGrown, false),
        ),
        (Outcome { window: 0.98, ..outcome(same, same, false) }, 0.1, Regime::Slip, (Regime::Slip, true)),
        (outcome(same, [1.0, 1.02], false), 0.1, Regime::Slip, (Regime::NotYetGrown, false)),
        // Small and without an event it is linear; with one it is a small cycle.
        (outcome([0.01; 2], same, false), 0.1, Regime::Equilibrium, (Regime::NotYetGrown, false)),
        (outcome([0.01; 2], same, true), 0.1, Regime::Equilibrium, (Regime::Slip, true)),
        (outcome([0.01; 2], same, true), 0.01, Regime::Equilibrium, (Regime::NotYetGrown, false)),
        (outcome([0.0; 2], same, true), 0.1, Regime::Equilibrium, (Regime::NotYetGrown, false)),
        // After an event it may be small again, and grows from there.
        (outcome([0.009, 0.0095], same, true), 0.01, Regime::Slip, (Regime::NotYetGrown, false)),
        // What has met an event and is large is what it is.
        (outcome(same, same, true), 0.01, Regime::Slip, (Regime::Slip, true)),
        (outcome(same, same, true), 0.01, Regime::StickSlip, (Regime::StickSlip, true)),
        (outcome(same, same, false), 0.01, Regime::Stuck, (Regime::Stuck, true)),
    ] {
        assert_eq!(
            about_unstable(&one, 2.0, || Some(rate), (found, true)),
            expected,
            "{rate} {found:?} {one:?}"
        );
    }
}

/// It has come to no end: no start that has not yet grown counts as one that slides, and none makes a verdict.
#[test]
fn it_is_no_end_of_a_start() {
    let young = record(Kind::Stable, Regime::NotYetGrown, false);
    for kind in Kind::ALL {
        assert_eq!(Attractor::of(&young, Some(kind)), None);
        assert_eq!(differ(&young, &record(kind, Regime::Stuck, true), Some(kind)), None);
    }
    let mut basin = Basin::default();
    basin.add(&young, Some(Kind::NegativeSlope));
    assert_eq!(basin, Basin { other: 1, ..Basin::default() });
    assert_eq!(basin.is_bistable(), None);
    assert!(!oscillates(&young));
}

/// Drawn with the hatching of what has not settled, named and counted in the legend.
#[test]
fn figures_show_it_hatched_and_name_it() {
    let axes = vec![span(Param::MuS, 0.2, 0.6, 4), span(Param::BeltVelocity, 1.0, 4.0, 4)];
    let map = map(Grid::Axes(axes), |k, _| match k {
        0..4 => record(Kind::Stable, Regime::Equilibrium, true),
        4..7 => record(Kind::NegativeSlope, Regime::NotYetGrown, false),
        _ => record(Kind::NegativeSlope, Regime::StickSlip, true),
    });
    let svg = map_svg(&map).unwrap();
    assert_eq!(svg.matches("class=\"not_yet_grown\"").count(), 1);
    assert!(svg.contains(">not yet grown (n = 3)<") && svg.contains(">unsettled (n = 3)<"), "{svg}");
    assert_eq!(svg.matches("class=\"unsettled\"").count(), 1);
}

/// On a ramp the equilibrium of the end counts, not that of the start, which is left behind.
#[test]
fn on_a_ramp_the_equilibrium_of_its_end_counts() {
    let ramp = |from: f64, to: f64| {
        let mut one = kicked(0.04, 0.02, from, 1e-3);
        one.params.set(Param::BeltVelocityEnd, to);
        one.params.set(Param::RampDuration, 1.0);
        (analyse(&one).0.unwrap(), on_all(&one, &plan(1.0, 1.0, 12)))
    };
    assert_eq!(ramp(5.5, 5.2), (Kind::Stable, (Regime::Equilibrium, true)));
    assert_eq!(ramp(4.5, 4.0), (Kind::NegativeSlope, (Regime::NotYetGrown, false)));
    // The belt passes the knee, which is an event; the motion stays small. Unstable only at the start, and only at the end.
    assert_eq!(ramp(5.2, 4.0), (Kind::Stable, (Regime::NotYetGrown, false)));
    assert_eq!(ramp(4.0, 5.2), (Kind::NegativeSlope, (Regime::Equilibrium, true)));
}

/// By integration: no event a little before the time of the theory, one a little after it.
#[test]
fn the_first_event_comes_when_linear_theory_says() {
    let mut cases: Vec<(Instance, StartKind)> = Vec::new();
    for (mu_s, mu_d, velocity) in [(0.15, 0.05, 3.0), (0.4, 0.4, 3.0), (0.25, 0.25, 1.0), (0.07, 0.02, 2.0)] {
        cases.push((kicked(mu_s, mu_d, velocity, 1e-3), StartKind::Kick));
        let mut mode = paper(mu_s, mu_d, velocity);
        mode.params.set(Param::StartFraction, 1e-3);
        cases.push((mode, StartKind::Mode));
        let mut displaced = kicked(mu_s, mu_d, velocity, 0.0);
        displaced.params.set(Param::StartDisplacement, 1e-5);
        cases.push((displaced, StartKind::Kick));
    }
    let mut single = kicked(0.15, 0.05, 3.0, 1e-3);
    single.params.set(Param::Theta, 0.0);
    cases.push((single, StartKind::Kick));
    for (one, start) in cases {
        let time = time_to_first_event(&one, start).unwrap();
        let met = |share: f64| {
            Engine::Reference.run(&one, &Plan { start, ..plan(0.0, share * time, 12) }).met_event
        };
        assert_eq!([met(0.9), met(1.1)], [false, true], "{time} s: {one:?}");
    }
    assert_eq!(time_to_first_event(&kicked(0.1, 0.1, 3.0, 1e-3), StartKind::Kick), None, "stable");
    assert_eq!(
        time_to_first_event(&kicked(0.4, 0.4, 3.0, 0.0), StartKind::Kick),
        Some(f64::INFINITY),
        "at rest"
    );
    assert_eq!(
        time_to_first_event(&kicked(0.4, 0.4, 3.0, 5.0), StartKind::Kick),
        Some(0.0),
        "beyond the event"
    );
}

/// Unstable equilibria of an exponential law that grow in 1 to 300 s.
const SLOW: &str = "\
[friction]\nlaw = \"exponential\"\nmu_d = 0.2\nstribeck_velocity = 1.0\n\
[axes]\nmu_s = { from = 0.2, to = 0.6, points = 9 }\nbelt_velocity = { from = 0.25, to = 6.0, points = 9 }\n[response]\n";

fn swept(settle: &str) -> Map {
    let spec = Spec::parse(&format!("{SLOW}check = false\n{settle}"), "s.toml", Path::new(".")).unwrap();
    run::run(spec, &Options::default(), &|_| {}).unwrap()
}

#[test]
fn a_run_until_settled_has_the_classes_of_a_long_one_but_for_what_it_says_is_unsettled() {
    let [short, auto, long] = [
        "settle = \"3 s\"\nmeasure = \"1 s\"\n",
        "settle = \"auto\"\n",
        "settle = \"200 s\"\nmeasure = \"1 s\"\n",
    ]
    .map(swept);
    let count = |map: &Map, selects: &dyn Fn(Regime, bool) -> bool| {
        let one = |record: &&squealmap::engine::record::Record| {
            selects(record.regime.unwrap(), record.settled.unwrap())
        };
        map.records.iter().filter(one).count()
    };
    for map in [&short, &auto, &long] {
        for record in &map.records {
            let stands = record.regime == Some(Regime::Equilibrium);
            assert!(!stands || record.kind == Some(Kind::Stable), "{record:?}");
        }
        assert_eq!(count(map, &|regime, settled| regime == Regime::NotYetGrown && settled), 0);
    }
    let young = [&short, &auto, &long].map(|map| count(map, &|regime, _| regime == Regime::NotYetGrown));
    assert!(young[0] > 3 * young[1] && young[1] > young[2], "{young:?}");
    let (mut same, mut other) = (0, Vec::new());
    for (auto, long) in auto.records.iter().zip(&long.records) {
        if auto.settled == Some(true) {
            same += usize::from(auto.regime == long.regime);
            other.extend((auto.regime != long.regime).then_some((auto.regime, long.regime)));
        }
    }
    assert!(other.is_empty() && same > 60, "{same} {other:?}");
}

#[test]
fn check_and_the_summary_of_a_run_say_which_time_to_settle_would_do() {
    let directory = tempfile::tempdir().unwrap();
    let write = |settle: &str| {
        std::fs::write(directory.path().join("s.toml"), format!("{SLOW}{settle}")).unwrap();
    };
    write("settle = \"3 s\"\nmeasure = \"1 s\"\n");
    let check = unwrapped(&squealmap(directory.path(), &["check", "s.toml"]).out);
    let sentence = check.split("grows ").nth(1).unwrap();
    assert!(sentence.contains("unstable instances grow too slowly to show what they do"), "{check}");
    let run = squealmap(directory.path(), &["run", "s.toml", "--backend", "cpu"]);
    assert!(run.out.contains("not_yet_grown"), "{}", run.out);
    assert!(unwrapped(&run.out).contains(sentence.trim()), "{} {sentence}", run.out);
    // What it says does.
    let limit = sentence.split("`settle_limit = \"").nth(1).unwrap().split('"').next().unwrap();
    write(&format!("settle = \"auto\"\nsettle_limit = \"{limit}\"\n"));
    let again = squealmap(directory.path(), &["run", "s.toml", "--backend", "cpu", "-o", "again"]);
    let table = std::fs::read_to_string(directory.path().join("again/map.csv")).unwrap();
    let young = table.matches(",not_yet_grown,").count();
    assert!(young <= 1, "{young} of 81 with {limit}: {}", again.out);
    write("settle = \"auto\"\nsettle_limit = \"2000 s\"\n");
    assert!(!squealmap(directory.path(), &["check", "s.toml"]).out.contains("\ngrows "));
}
