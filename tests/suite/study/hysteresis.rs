//! A parameter that rises and falls: the branches of the single mass jump where closed forms and independent integrations say.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::cli::program::squealmap;
use crate::store::resume::with;
use crate::sweep::bistable::highest_velocity_of_the_cycle;
use crate::synthetic::record;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::Duration;
use squealmap::engine::plan::Plan;
use squealmap::engine::record::Record;
use squealmap::engine::reference::respond::respond;
use squealmap::engine::regime::Regime;
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType;
use squealmap::model::status::Status;
use squealmap::results::figure::heading::Heading;
use squealmap::results::figure::look::Look;
use squealmap::study::cycles::branch::BranchPoint;
use squealmap::study::cycles::special::Special;
use squealmap::study::hysteresis::follow::{Direction, Hysteresis};
use squealmap::study::hysteresis::table::hysteresis_svg;
use squealmap::study::{Kind, Picture};
use squealmap::sweep::error::Error;
use squealmap::sweep::spec::Spec;

/// The single mass on a belt with m = k = N = 1 and c = 0.1: the law is to follow.
const SINGLE: &str =
    "[model]\nm1 = 0.9\nm2 = 0.1\nk1 = 1\nk2 = 1\nc1 = 0.1\nc2 = 0.1\nf_ext = 1\ntheta = 0\n[friction]\n";
const EXPONENTIAL: &str = "law = \"exponential\"\nmu_d = 0.5\nstribeck_velocity = 0.5\n";
const SETTLE: &str = "[response]\nsettle = \"auto\"\n";

pub(crate) fn parse(text: &str) -> Spec {
    Spec::parse(text, "s.toml", ".".as_ref()).unwrap()
}

/// Follows `param` over `points` values.
pub(crate) fn follow(spec: &Spec, param: Param, [from, to]: [f64; 2], points: u32) -> Hysteresis {
    let step = (to - from) / f64::from(points - 1);
    let values = (0..points).map(|at| from + step * f64::from(at)).collect();
    let instance = |value: f64| spec.instance_at(&format!("{}={value}", param.info().name));
    Hysteresis::follow::<Error>(param, values, &Plan::new(spec), instance).unwrap()
}

/// Whether a branch jumps once, in the step that `at` lies in, and away from the equilibrium or back as `direction` goes.
fn jumps_at(found: &Hysteresis, direction: Direction, at: f64) -> bool {
    let jumps = found.jumps(direction);
    let upwards = direction == Direction::Up;
    matches!(jumps[..], [[a, b]] if (a.min(b)..a.max(b)).contains(&at) && (a < b) == upwards)
}

/// With the belt velocity the equilibrium becomes stable at `V = v0 ln((μ_s − μ_d) N/(c v0))`, and the stick-slip cycle lives
/// up to 1.83660097 (physics.md, section 6): rising, the branch follows the cycle to its end; falling, the equilibrium.
/// Near its end the step of the parameter itself may throw a motion off the cycle: a step too early, never too late.
#[test]
fn the_branches_of_the_belt_velocity() {
    let spec = parse(&format!(
        "{SINGLE}{EXPONENTIAL}mu_s = 1\n[start]\nstart_velocity = 0.0001\n{SETTLE}[axes]\nbelt_velocity = {{ values = [1] }}\n"
    ));
    let (hopf, end) = (0.5 * (0.5_f64 / (0.1 * 0.5)).ln(), 1.836_600_97);
    let ends = |found: &Hysteresis, end: f64| {
        let step = found.values[1] - found.values[0];
        matches!(found.jumps(Direction::Up)[..], [[a, b]] if a < end && b > end - step && b - a < 1.01 * step)
    };
    for points in [27, 53, 261] {
        let found = follow(&spec, Param::BeltVelocity, [0.8, 2.1], points);
        assert!(ends(&found, end), "{:?}", found.jumps(Direction::Up));
        assert!(jumps_at(&found, Direction::Down, hopf), "{:?}", found.jumps(Direction::Down));
        // The comparers see a jump that is elsewhere.
        assert!(!ends(&found, 1.75) && !ends(&found, 1.95));
        assert!(!jumps_at(&found, Direction::Down, 1.02) && !jumps_at(&found, Direction::Down, 1.3));
        let step = found.values[1] - found.values[0];
        let [[first, last]] = found.apart()[..] else { panic!("{:?}", found.apart()) };
        assert!((first - hopf).abs() < 0.05 + step && (last - end).abs() < 2.01 * step, "{first} {last}");
        for (value, bistable) in found.values.iter().zip(found.bistable()) {
            // Near both limits a motion may not have settled, or have left the cycle early.
            if (hopf - 0.05..hopf).contains(value) || (end - 2.0 * step..end).contains(value) {
                continue;
            }
            assert_eq!(bistable, Some((hopf..end).contains(value)), "V = {value}");
        }
    }
    // A branch that does not come to the end of the cycle has no jump.
    let short = follow(&spec, Param::BeltVelocity, [0.8, 1.5], 8);
    assert!(!ends(&short, end), "{:?}", short.jumps(Direction::Up));
}

/// With `μ_s` the equilibrium loses its stability where the slope eats up the damping: `μ_s = μ_d + c v0 exp(V/v0)/N`.
#[test]
fn the_rising_friction_leaves_the_equilibrium_where_it_loses_stability() {
    let spec = parse(&format!(
        "{SINGLE}{EXPONENTIAL}[belt]\nbelt_velocity = 1.5\n{SETTLE}[axes]\nmu_s = {{ values = [1] }}\n"
    ));
    let found = follow(&spec, Param::MuS, [0.6, 1.8], 25);
    let hopf = 0.5 + 0.1 * 0.5 * (1.5_f64 / 0.5).exp();
    assert!(jumps_at(&found, Direction::Up, hopf), "{:?}", found.jumps(Direction::Up));
    // The cycle outlives the way back: at μ_s = 1 it exists at this velocity.
    let [[above, below]] = found.jumps(Direction::Down)[..] else { panic!("one jump") };
    assert!(below < above && above < 1.0 + 1e-9, "{above} {below}");
}

/// Law `constant` with `μ_s > μ_d`: nothing ever leaves the equilibrium, and the cycle ends where the slip that begins at
/// release no longer comes back to the velocity of the belt: between the two values at which the closed form says so.
#[test]
fn the_cycle_of_a_jump_of_friction_ends_at_its_closed_form() {
    let spec = parse(&format!(
        "{SINGLE}law = \"constant\"\nmu_d = 0.25\n[belt]\nbelt_velocity = 0.4\n[start]\nstart_velocity = 0.001\n{SETTLE}\
         [axes]\nmu_s = {{ values = [1] }}\n"
    ));
    let [from, to] = [0.3, 1.2];
    let found = follow(&spec, Param::MuS, [from, to], 37);
    assert_eq!(found.jumps(Direction::Up), [[0.0; 2]; 0]);
    assert_eq!(found.jumps(Direction::Down), [[0.0; 2]; 0], "nothing has started a cycle");
    // A kick to the belt's velocity at the highest value starts one.
    let values: Vec<f64> = (0..37).map(|at| from + (to - from) / 36.0 * f64::from(at)).collect();
    let instance = |value: f64| {
        let mut instance = spec.instance_at(&format!("mu_s={value}"))?;
        if value > to - 0.01 {
            instance.params.set(Param::StartVelocity, 0.4);
        }
        Ok(instance)
    };
    let found = Hysteresis::follow::<Error>(Param::MuS, values, &Plan::new(&spec), instance).unwrap();
    let comes_back = |mu_s: f64| highest_velocity_of_the_cycle(0.1, mu_s - 0.25) >= 0.4;
    let [_, end] = (0..60).fold([from, to], |[low, high], _| {
        let middle = 0.5 * (low + high);
        if comes_back(middle) { [low, middle] } else { [middle, high] }
    });
    // A step too early at most, as in the other direction.
    let [[last, first]] = found.jumps(Direction::Down)[..] else {
        panic!("{:?}", found.jumps(Direction::Down))
    };
    assert!(last > end && first < last && last - end < 0.05, "{last} {first} instead of {end}");
}

#[test]
fn the_program_writes_both_branches() {
    let sweep = format!(
        "title = \"Loop\"\n{SINGLE}{EXPONENTIAL}mu_s = 1\n{SETTLE}[axes]\nbelt_velocity = {{ values = [1] }}\n"
    );
    let directory = with(&sweep);
    let all = ["trace", "s.toml", "--sweep-up-down", "belt_velocity=1..2", "--points", "5"];
    let ended = squealmap(directory.path(), &all);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(ended.out.starts_with("belt_velocity up: a jump between 1."), "{}", ended.out);
    assert!(ended.out.contains("belt_velocity down: a jump between 1.25 and 1\n"), "{}", ended.out);
    let read = |name: &str| std::fs::read(directory.path().join("out/s").join(name)).unwrap();
    let table = String::from_utf8(read("hysteresis.csv")).unwrap();
    let rows: Vec<&str> = table.lines().collect();
    assert!(rows[0].starts_with("branch,belt_velocity,type,"), "{}", rows[0]);
    let starts: Vec<String> =
        rows[1..].iter().map(|row| row.split(',').take(3).collect::<Vec<_>>().join(" ")).collect();
    assert_eq!(
        starts,
        [
            "up 1 negative_slope",
            "up 1.25 stable",
            "up 1.5 stable",
            "up 1.75 stable",
            "up 2 stable",
            "down 2 stable",
            "down 1.75 stable",
            "down 1.5 stable",
            "down 1.25 stable",
            "down 1 negative_slope"
        ]
    );
    let svg = String::from_utf8(read("hysteresis.svg")).unwrap();
    assert!(svg.contains("class=\"stable\"") && svg.contains("class=\"unstable\""));
    assert_eq!(svg.matches("class=\"bistable\"").count(), 1 + 1, "one area and the legend");
    assert_eq!(svg.matches("class=\"jump\"").count(), 2);
    assert!(read("hysteresis.png").starts_with(b"\x89PNG"));
}

/// Inside the bistable band a small kick stays at the equilibrium all the way: no jump, and a word on why.
#[test]
fn a_range_inside_the_band_says_where_to_begin() {
    let sweep = format!(
        "{SINGLE}{EXPONENTIAL}mu_s = 1\n[start]\nstart_velocity = 0.0001\n{SETTLE}[axes]\nbelt_velocity = {{ values = [1] }}\n"
    );
    let hint = "begin outside of it (a wider range), or with a larger start";
    for (range, hinted) in [("belt_velocity=1.3..1.7", true), ("belt_velocity=1..2", false)] {
        let directory = with(&sweep);
        let ended =
            squealmap(directory.path(), &["trace", "s.toml", "--sweep-up-down", range, "--points", "3"]);
        assert_eq!((ended.code, ended.out.contains(hint)), (Some(0), hinted), "{range}: {}", ended.out);
    }
}

/// What has not settled is a cross, and the key says so.
#[test]
fn unsettled_values_are_marked() {
    let short = "[response]\nsettle = \"1 periods\"\nmeasure = \"2 periods\"\n";
    for (response, marked) in [(short, true), (SETTLE, false)] {
        let spec = parse(&format!(
            "{SINGLE}{EXPONENTIAL}mu_s = 1\n[start]\nstart_velocity = 0.1\n{response}[axes]\nbelt_velocity = {{ values = [1] }}\n"
        ));
        let found = follow(&spec, Param::BeltVelocity, [0.6, 1.0], 3);
        let svg = hysteresis_svg(&found, &Heading::new("", ""), &Look::default());
        let shown = svg.contains("class=\"unsettled\"") && svg.contains("not settled");
        assert_eq!(shown, marked, "{response}");
    }
}

/// Two cycles, one of which ends: the amplitude jumps within the oscillation, and the branches differ between both jumps. A
/// rise that the steps of the parameter resolve is none.
#[test]
fn jumps_from_one_cycle_to_another_are_found() {
    let values: Vec<f64> = (0..21).map(|k| 0.1 * f64::from(k)).collect();
    let with = |size: &dyn Fn(usize) -> f64, settled: &dyn Fn(usize) -> bool| -> Vec<Record> {
        let of = |k: usize| {
            let outcome = Outcome { status: Status::Ok, x2_std: Some(size(k)), ..Outcome::default() };
            Record {
                outcome: Some(Box::new(outcome)),
                ..record(InstabilityType::NegativeSlope, Regime::StickSlip, settled(k))
            }
        };
        (0..values.len()).map(of).collect()
    };
    let of = |up: Vec<Record>, down: Vec<Record>| Hysteresis {
        param: Param::BeltVelocity,
        values: values.clone(),
        up,
        down,
        cycles: Vec::new(),
    };
    let slow = |k: usize| 1.0 + 0.02 * k as f64;
    let two = |end: usize| move |k: usize| slow(k) * if k < end { 1.0 } else { 1.5 };
    let found = of(with(&two(14), &|_| true), with(&two(8), &|_| true));
    let between = |pair: [usize; 2]| pair.map(|k| values[k]);
    assert_eq!(found.jumps_of_amplitude(Direction::Up), [between([13, 14])]);
    assert_eq!(found.jumps_of_amplitude(Direction::Down), [between([8, 7])]);
    assert!(found.jumps(Direction::Up).is_empty(), "it oscillates all the way");
    let svg = hysteresis_svg(&found, &Heading::new("", ""), &Look::default());
    assert_eq!(svg.matches("class=\"jump\"").count(), 2);
    // A value that has not settled is passed over; smooth rises and steps of a few percent are no jumps.
    let found = of(with(&two(14), &|k| k != 14), with(&slow, &|_| true));
    assert_eq!(found.jumps_of_amplitude(Direction::Up), [between([13, 15])]);
    assert!(found.jumps_of_amplitude(Direction::Down).is_empty());
    let tanh = |k: usize| 2.0 + ((k as f64 - 10.0) / 3.0).tanh();
    let root = |k: usize| (k as f64).sqrt() + 1e-3;
    let small = |k: usize| if k < 9 { 1.0 } else { 1.03 };
    for smooth in [&tanh as &dyn Fn(usize) -> f64, &root, &small] {
        let found = of(with(smooth, &|_| true), with(smooth, &|_| true));
        assert!(
            found.jumps_of_amplitude(Direction::Up).is_empty()
                && found.jumps_of_amplitude(Direction::Down).is_empty()
        );
    }
}

/// The legend has what is drawn: a stable equilibrium only where there is one, crosses in the colours of their branches.
#[test]
fn the_legend_has_what_is_drawn() {
    let blue = "stroke=\"#1F3F8F\" stroke-width=\"0.9\"";
    let orange = "stroke=\"#D55E00\" stroke-width=\"0.9\"";
    let of = |kind: InstabilityType, settled: [bool; 2]| {
        let branch = |settled: bool| -> Vec<Record> {
            let of = |k: usize| {
                let outcome = Outcome { status: Status::Ok, x2_std: Some(1.0), ..Outcome::default() };
                let settled = settled || k != 2;
                Record { outcome: Some(Box::new(outcome)), ..record(kind, Regime::Slip, settled) }
            };
            (0..5).map(of).collect()
        };
        let [up, down] = settled.map(branch);
        let found = Hysteresis {
            param: Param::MuS,
            values: vec![0.1, 0.2, 0.3, 0.4, 0.5],
            up,
            down,
            cycles: Vec::new(),
        };
        let svg = hysteresis_svg(&found, &Heading::new("", ""), &Look::default());
        let crosses = [blue, orange].map(|stroke| {
            svg.lines().filter(|line| line.contains("class=\"unsettled\"") && line.contains(stroke)).count()
        });
        (svg.contains(">stable equilibrium<"), svg.contains(">unstable equilibrium<"), crosses)
    };
    assert_eq!(of(InstabilityType::NegativeSlope, [true, true]), (false, true, [0, 0]));
    assert_eq!(
        of(InstabilityType::Stable, [true, false]),
        (true, false, [0, 2]),
        "in the plot and in the legend"
    );
    assert_eq!(of(InstabilityType::Stable, [false, true]), (true, false, [2, 0]));
    assert_eq!(of(InstabilityType::Stable, [false, false]), (true, false, [2, 2]));
}

#[test]
fn what_cannot_be_followed_is_named() {
    let sweep =
        format!("{SINGLE}{EXPONENTIAL}mu_s = 1\n{SETTLE}[axes]\nbelt_velocity = {{ values = [1] }}\n");
    for (argument, part) in [
        ("belt_velocity", "write name=from..to, such as mu_s=0.1..0.6"),
        ("belt_velocity=1", "write name=from..to"),
        ("speed=1..2", "`speed` is no parameter"),
        ("start_velocity=1..2", "`start_velocity` says how a motion starts or ends, and cannot be followed"),
        ("belt_velocity=2..1", "the range from 2 to 1 does not rise"),
        ("belt_velocity=-1..1", "`belt_velocity` is `-1`, but has to be a finite number not below 0"),
        ("belt_velocity=1..x", "`belt_velocity` is `x`"),
        ("decay=1..2", "`decay` would have no effect"),
    ] {
        let directory = with(&sweep);
        let ended = squealmap(
            directory.path(),
            &["trace", "s.toml", "--at", "belt_velocity=1", "--sweep-up-down", argument],
        );
        assert_eq!(ended.code, Some(2), "{argument}: {}", ended.err);
        assert!(ended.err.contains(part), "{argument}: {}", ended.err);
        assert!(!directory.path().join("out").exists(), "{argument}");
    }
    let ramp = format!(
        "{SINGLE}{EXPONENTIAL}mu_s = 1\n[belt]\nbelt_velocity = 2\nbelt_velocity_end = 1\nramp_duration = 5\n"
    );
    let directory = with(&ramp);
    let ended = squealmap(directory.path(), &["trace", "s.toml", "--sweep-up-down", "f_ext=1..2"]);
    assert_eq!(ended.code, Some(2));
    assert!(ended.err.contains("here it has a ramp, `ramp_duration` = 5 s"), "{}", ended.err);
}

/// The special points of the only branch of cycles, in its order.
fn special(found: &Hysteresis) -> Vec<(Special, f64)> {
    let [branch] = &found.cycles[..] else { panic!("{} branches", found.cycles.len()) };
    branch.points.iter().filter_map(|point| Some((point.special?, point.value))).collect()
}

pub(crate) fn is(found: (Special, f64), special: Special, value: f64) -> bool {
    found.0 == special && (found.1 - value).abs() < 1e-8
}

/// The belt velocity from which on the motion that is released with the velocity of the belt does not come back to it, by steps of Runge
/// and Kutta: `ẍ = −x − c ẋ + μ(V − ẋ)` with `μ(v) = 1/2 (1 + exp(−2 v))`.
pub(crate) fn last_velocity_of_the_cycle(damping: f64) -> f64 {
    let friction = |v: f64| 0.5 * (1.0 + (-2.0 * v).exp());
    let comes_back = |belt: f64| {
        let rate = |[x, v]: [f64; 2]| [v, -x - damping * v + friction(belt - v)];
        let add = |s: [f64; 2], k: [f64; 2], h: f64| [s[0] + h * k[0], s[1] + h * k[1]];
        let step = |s: [f64; 2], h: f64| {
            let a = rate(s);
            let b = rate(add(s, a, 0.5 * h));
            let c = rate(add(s, b, 0.5 * h));
            let d = rate(add(s, c, h));
            std::array::from_fn(|i| s[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]))
        };
        // Released where the spring holds what friction gives at most.
        let mut state = [1.0 - damping * belt, belt];
        let (mut falls, h) = (true, 1e-3);
        loop {
            let next: [f64; 2] = step(state, h);
            let [before, after] = [rate(state)[1], rate(next)[1]];
            if falls && after > 0.0 {
                falls = false;
            } else if !falls && after <= 0.0 {
                // The top of the velocity, between the two.
                let (mut low, mut high) = (0.0, h);
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if rate(step(state, middle))[1] > 0.0 { low = middle } else { high = middle }
                }
                return step(state, low)[1] >= belt;
            }
            assert!(before.is_finite());
            state = next;
        }
    };
    let [_, end] = (0..60).fold([1.2, 2.5], |[low, high], _| {
        let middle = 0.5 * (low + high);
        if comes_back(middle) { [middle, high] } else { [low, middle] }
    });
    end
}

/// The stick-slip cycle ends where an unstable cycle of pure slip reaches the velocity of the belt; that cycle is born at the Hopf
/// point. No multiplier is +1 where they meet, as the stick-slip cycle forgets all in its stick.
#[test]
fn the_branch_of_stick_slip_turns_back_as_an_unstable_cycle_to_its_hopf_point() {
    for damping in [0.1_f64, 0.15] {
        let text = format!(
            "{SINGLE}{EXPONENTIAL}mu_s = 1\n[start]\nstart_velocity = 0.0001\n{SETTLE}[axes]\nbelt_velocity = {{ values = [1] }}\n"
        );
        let spec = parse(&text.replace("c1 = 0.1", &format!("c1 = {damping}")));
        let (hopf, end) = (0.5 * (0.5 / (damping * 0.5)).ln(), last_velocity_of_the_cycle(damping));
        let found = follow(&spec, Param::BeltVelocity, [0.5, 2.1], 5);
        let special = special(&found);
        let [corner, birth] = special[..] else { panic!("{special:?}") };
        assert!(
            is(corner, Special::Corner, end) && is(birth, Special::Hopf, hopf),
            "{special:?}: {end} {hopf}"
        );
        // The comparer sees a corner that is elsewhere, or is something else.
        assert!(!is(corner, Special::Corner, end + 2e-8) && !is(corner, Special::Fold, end));
        let points = &found.cycles[0].points;
        let turn = points.iter().position(|point| point.special == Some(Special::Corner)).unwrap();
        assert!(points[..turn].iter().all(|point| point.unstable == 0));
        assert!(points[turn + 1..].iter().all(|point| point.unstable == 1));
        let floquet = |point: &BranchPoint| point.record.outcome.as_ref().and_then(|outcome| outcome.floquet);
        assert!(points[..turn].iter().all(|point| floquet(point).unwrap() < 1e-6), "it sticks");
        assert!(points[turn + 1..points.len() - 1].iter().all(|point| floquet(point).unwrap() > 1.0));
    }
    let known = last_velocity_of_the_cycle(0.1);
    assert!((known - 1.836_600_97).abs() < 5e-9, "{known}");
}

/// Law `constant`: slip alone decays, so that beyond its end the cycle has no neighbour, stable or not.
#[test]
fn the_cycle_of_a_jump_of_friction_has_no_unstable_one_beside_it() {
    for (damping, difference) in [(0.1, 0.3), (0.05, 0.15)] {
        let spec = parse(&format!(
            "{SINGLE}law = \"constant\"\nmu_s = {}\nmu_d = 0.25\n[start]\nstart_velocity = 0.2\n{SETTLE}[axes]\nbelt_velocity = {{ values = [1] }}\n",
            0.25 + difference
        ).replace("c1 = 0.1", &format!("c1 = {damping}")));
        let end = highest_velocity_of_the_cycle(damping, difference);
        let found = follow(&spec, Param::BeltVelocity, [0.1, 2.0 * end], 9);
        let special = special(&found);
        let [last] = special[..] else { panic!("{special:?}") };
        assert!(is(last, Special::End, end), "{last:?} instead of {end}");
    }
}

/// The paper's model (Table 1) with `μ_s` = 0.6 at 3 m/s: two stable cycles over a band of `μ_d`, joined by an unstable one. The ends of the
/// band are those of `benches/peers/folds.py`.
#[test]
fn the_bistable_band_of_the_papers_model_has_the_ends_of_an_independent_code() {
    let spec = parse(&format!(
        "[model]\ntheta = 0.01\n[friction]\nlaw = \"bilinear\"\nmu_s = 0.6\nknee_velocity = 5\n[belt]\nbelt_velocity = 3\n{SETTLE}\
         [axes]\nmu_d = {{ values = [0.1] }}\n"
    ));
    let found = follow(&spec, Param::MuD, [0.0, 0.5], 26);
    let special = special(&found);
    let [upper, lower] = special[..] else { panic!("{special:?}") };
    assert!(is(upper, Special::Fold, 0.343_427_415), "{upper:?}");
    assert!(is(lower, Special::Fold, 0.075_381_729), "{lower:?}");
    // Rising and falling, the motion leaves its cycle in the step that has the fold.
    let [up, down] = Direction::ALL.map(|direction| found.jumps_of_amplitude(direction));
    assert!(matches!(up[..], [[a, b]] if a < upper.1 && upper.1 < b), "{up:?}");
    assert!(matches!(down[..], [[a, b]] if b < lower.1 && lower.1 < a), "{down:?}");
    // At one value of the band: two stable cycles and the unstable one between them.
    let points = &found.cycles[0].points;
    let at = |pair: &&[BranchPoint]| (pair[0].value - 0.2) * (pair[1].value - 0.2) <= 0.0;
    let unstable: Vec<usize> = points.windows(2).filter(at).map(|pair| pair[0].unstable).collect();
    assert_eq!(unstable, [0, 1, 0]);
}

/// The picture that `plot` draws is that of the command, with branches and shading; a table of branches that is wrong is named.
#[test]
fn the_figure_is_drawn_again_from_its_files() {
    let sweep = format!(
        "[model]\ntheta = 0.01\n[friction]\nlaw = \"bilinear\"\nmu_s = 0.6\nknee_velocity = 5\n[belt]\nbelt_velocity = 3\n{SETTLE}\
         [axes]\nmu_d = {{ values = [0.1] }}\n"
    );
    let directory = with(&sweep);
    let ended =
        squealmap(directory.path(), &["trace", "s.toml", "--sweep-up-down", "mu_d=0..0.5", "--points", "26"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let said = "a branch of cycles from mu_d = 0 to 0.5: fold at 0.343427415, fold at 0.075381729\n";
    assert!(ended.out.contains(said), "{}", ended.out);
    let folder = directory.path().join("out/s");
    let read = |name: &str| String::from_utf8(std::fs::read(folder.join(name)).unwrap()).unwrap();
    let drawn = || Picture::read(&folder, Kind::Hysteresis).and_then(|picture| picture.svg(&Look::default()));
    let svg = drawn().unwrap();
    assert!(svg == read("hysteresis.svg"));
    assert!(
        svg.contains("class=\"unstable-cycle\"")
            && svg.contains(">fold (LP)<")
            && svg.matches(">LP<").count() == 2
    );
    let table = read("cycles.csv");
    for (from, to, part) in [
        (",fold,", ",flod,", "`special` is `flod`"),
        ("\n0,1,", "\n0,0.5,", "`unstable_multipliers` is 0.5"),
        ("\n0,0,", "\n3,0,", "`cycle_branch` is 3 without the branches before it"),
    ] {
        std::fs::write(folder.join("cycles.csv"), table.replacen(from, to, 1)).unwrap();
        let error = drawn().unwrap_err();
        assert!(error.to_string().contains(part) && error.to_string().contains("cycles.csv"), "{error}");
    }
    // A directory of an earlier version has none.
    std::fs::remove_file(folder.join("cycles.csv")).unwrap();
    assert!(!drawn().unwrap().contains("unstable-cycle"));
}

/// Kicks to one side of an unstable cycle come to rest, those to the other side to stick-slip: the last that comes to rest goes round
/// on the unstable cycle itself.
#[test]
fn the_unstable_cycle_parts_the_basins() {
    let text = |value: f64| {
        format!(
            "{SINGLE}{EXPONENTIAL}mu_s = 1\n[belt]\nbelt_velocity = {value}\n{SETTLE}[axes]\nstart_velocity = {{ values = [1] }}\n"
        )
    };
    let along = parse(&format!(
        "{SINGLE}{EXPONENTIAL}mu_s = 1\n{SETTLE}[axes]\nbelt_velocity = {{ values = [1] }}\n"
    ));
    let found = follow(&along, Param::BeltVelocity, [0.5, 2.1], 5);
    let unstable =
        found.cycles[0].points.iter().filter(|point| point.unstable > 0 && point.special.is_none());
    let cycle = unstable.min_by(|a, b| (a.value - 1.5).abs().total_cmp(&(b.value - 1.5).abs())).unwrap();
    let outcome = cycle.record.outcome.as_ref().unwrap();
    let spec = parse(&text(cycle.value));
    let kicked = |kick: f64, plan: &Plan| {
        let instance = spec.instance_at(&format!("start_velocity={kick}")).unwrap();
        respond(&instance, plan).x2_std.unwrap()
    };
    let long = Plan::new(&spec);
    let kick = (0..45).fold([0.0, cycle.value], |[low, high], _| {
        let middle = 0.5 * (low + high);
        // Stick-slip at this velocity has about 1 m.
        if kicked(middle, &long) > 0.8 { [low, middle] } else { [middle, high] }
    })[0];
    let once = Plan { settle_limit: None, measure: Duration::Seconds(outcome.period.unwrap()), ..long };
    let once = Plan { settle: Duration::Seconds(0.0), ..once };
    let (on_border, of_cycle) = (kicked(kick, &once), outcome.x2_std.unwrap());
    assert!((on_border / of_cycle - 1.0).abs() < 1e-8, "{on_border} {of_cycle}");
    assert!((kicked(1.001 * kick, &once) / of_cycle - 1.0).abs() > 1e-4, "another kick is another motion");
}

/// A closed branch is gone round once, also where a lap ends at another of the returns of its cycle: each of its folds is told once. The way round
/// goes up and down over the parameter as often.
#[test]
fn a_closed_branch_is_gone_round_once() {
    let spec = parse(&format!(
        "[friction]\nmu_s = 0.5\nmu_d = 0.3\n[belt]\nbelt_velocity = 2\n{SETTLE}[axes]\nk2 = {{ values = [241500] }}\n"
    ));
    let found = follow(&spec, Param::K2, [228_000.0, 255_000.0], 7);
    let mut closed = 0;
    for branch in &found.cycles {
        let ends = [branch.points.first(), branch.points.last()].map(|end| end.expect("points").value);
        let turns: Vec<f64> = branch
            .points
            .iter()
            .filter(|point| matches!(point.special, Some(Special::Fold | Special::Corner)))
            .map(|point| point.value)
            .collect();
        for (i, a) in turns.iter().enumerate() {
            assert!(turns[i + 1..].iter().all(|b| (a / b - 1.0).abs() > 1e-7), "{turns:?}");
        }
        if (ends[0] / ends[1] - 1.0).abs() < 1e-9 {
            closed += 1;
            assert!(turns.len().is_multiple_of(2) && !turns.is_empty(), "{turns:?}");
        }
    }
    assert_eq!(closed, 2, "{:?}", found.cycles.len());
}
