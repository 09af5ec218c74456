//! Whether any run ends elsewhere than shooting says: random instances from small and large starts.

use std::f64::consts::TAU;
use std::sync::atomic::AtomicBool;

use rayon::prelude::*;
use squealmap::engine::lanes::outcomes::outcomes;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::{Duration, Plan};
use squealmap::engine::reference::respond::respond;
use squealmap::model::equilibrium::Units;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::motion::Motion;
use squealmap::model::status::Status;
use squealmap::model::{Param, Params};
use squealmap::sweep::spec::{AUTO_MEASURE, FIRST_HUNT};

use crate::Row;

/// Periods of the runs that wait: the next one for what the one before cannot tell yet.
const WAITED: [f64; 5] = [250.0, 500.0, 1000.0, 2000.0, 4000.0];

/// An observable that differs by this part has come from another motion: a window of whole `2π/ω0` is off by less.
const ELSEWHERE: f64 = 0.01;

/// Steps per period of the reference, where the engine gives up.
const FINE_STEPS: u32 = 48;

/// What of a distance may be left for a long run to be a judge.
const FORGOTTEN: f64 = 1e-3;

/// What the long run says of a cycle.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Verdict {
    /// The multiplier keeps a distance alive for longer than the run.
    NotForgotten,
    Elsewhere,
    There,
}

/// The counts.
pub(crate) fn rows(count: usize) -> Vec<Row> {
    let all: Vec<Instance> = (0..count as u64).map(instance).collect();
    let hunts = Plan {
        settle: FIRST_HUNT,
        settle_limit: Some(Duration::Periods(1000.0)),
        hunts: true,
        measure: AUTO_MEASURE,
        ..waits(0.0)
    };
    let found: Vec<(Instance, Outcome)> =
        all.iter().cloned().zip(run(&all, hunts)).filter(|(_, outcome)| outcome.floquet.is_some()).collect();
    let several = |least: u64, most: u64| {
        found
            .iter()
            .filter(|(_, outcome)| outcome.cycle_returns.is_some_and(|n| (least..=most).contains(&n)))
            .count()
    };
    let verdicts = judged(&found);
    let counted = |verdict| verdicts.iter().filter(|other| **other == verdict).count();
    [
        ("instances", count),
        ("found by shooting", found.len()),
        ("of them not forgotten in 4000 periods", counted(Verdict::NotForgotten)),
        ("of them where a run of up to 4000 periods ends", counted(Verdict::There)),
        ("of them elsewhere in a run of 4000 periods", counted(Verdict::Elsewhere)),
        ("of them with several returns in a period", several(2, u64::MAX)),
        ("of them with two", several(2, 2)),
    ]
    .into_iter()
    .map(|(quantity, value)| Row {
        of: "random instances, f64".to_owned(),
        quantity: quantity.to_owned(),
        value: value as f64,
    })
    .collect()
}

/// A run for some periods and a window of 200 more.
fn waits(periods: f64) -> Plan {
    Plan {
        settle: Duration::Periods(periods),
        measure: Duration::Periods(200.0),
        steps_per_period: 12,
        ..Plan::REFERENCE
    }
}

fn run(instances: &[Instance], plan: Plan) -> Vec<Outcome> {
    let never = AtomicBool::new(false);
    instances
        .par_chunks(64)
        .flat_map_iter(|some| outcomes::<f64>(some, &plan, &never).unwrap_or_default())
        .collect()
}

/// Each cycle beside runs that wait until, by its multiplier, a distance from it is forgotten; a run that is somewhere else is
/// waited for longer, up to the end.
fn judged(found: &[(Instance, Outcome)]) -> Vec<Verdict> {
    let mut verdicts = vec![Verdict::NotForgotten; found.len()];
    let mut open: Vec<usize> = (0..found.len()).collect();
    for periods in WAITED {
        let (now, later): (Vec<usize>, Vec<usize>) =
            open.into_iter().partition(|index| forgotten(&found[*index], periods));
        let asked: Vec<Instance> = now.iter().map(|index| found[*index].0.clone()).collect();
        open = later;
        let waited = run(&asked, waits(periods));
        let waited: Vec<Outcome> =
            waited.par_iter().zip(&asked).map(|(one, asked)| told(one, asked, periods)).collect();
        for (index, waited) in now.into_iter().zip(waited) {
            verdicts[index] =
                if same(&found[index].1, &waited) { Verdict::There } else { Verdict::Elsewhere };
            if verdicts[index] == Verdict::Elsewhere {
                open.push(index);
            }
        }
        eprintln!("{periods} periods: {} cycles left to judge", open.len());
    }
    for (index, _) in verdicts.iter().enumerate().filter(|(_, verdict)| **verdict == Verdict::Elsewhere) {
        eprintln!("ends elsewhere: {:?}", found[index].0);
    }
    verdicts
}

/// What a run comes to; where the engine gives up, by the reference in finer steps.
fn told(waited: &Outcome, instance: &Instance, periods: f64) -> Outcome {
    match waited.status {
        Status::Ok => *waited,
        _ => respond(instance, &Plan { steps_per_period: FINE_STEPS, ..waits(periods) }),
    }
}

/// Whether a run that found this cycle and went on for so long would have forgotten a distance from it.
fn forgotten((instance, outcome): &(Instance, Outcome), periods: f64) -> bool {
    let Some((floquet, period)) = outcome.floquet.zip(outcome.period) else { return false };
    let time = periods * TAU * Units::new(&instance.params).time
        - outcome.settling_time.unwrap_or(outcome.simulated_time);
    time > 0.0 && floquet.powf(time / period) <= FORGOTTEN
}

fn same(found: &Outcome, waited: &Outcome) -> bool {
    [(found.x2_std, waited.x2_std), (found.ax_rms, waited.ax_rms), (found.ay_rms, waited.ay_rms)]
        .into_iter()
        .all(|(a, b)| a.zip(b).is_some_and(|(a, b)| (a - b).abs() <= ELSEWHERE * b))
}

/// The mixing of splitmix64.
fn mixed(state: u64) -> u64 {
    let z = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// A random instance: friction, belt, inclination, restitution and damping over wide ranges; every second start is small.
fn instance(number: u64) -> Instance {
    // Instances whose states are next to each other would have numbers in common.
    let mut state = mixed(number + 29);
    let mut draw = |low: f64, high: f64| {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        low + (high - low) * (mixed(state) >> 11) as f64 / (1_u64 << 53) as f64
    };
    let (mu_s, mu_d, belt) = (draw(0.02, 0.6), draw(0.02, 0.6), draw(0.5, 6.0));
    let mut params = Params::default();
    let kick = if number.is_multiple_of(2) { 0.02 } else { draw(0.9, 1.5) };
    for (param, value) in [
        (Param::BeltVelocity, belt),
        (Param::StartVelocity, kick * belt),
        (Param::Theta, draw(-0.06, 0.06)),
        (Param::Restitution, draw(-0.9, 0.9).max(0.0)),
        (Param::C1, 10_f64.powf(draw(-1.0, 1.7))),
        (Param::C2, 10_f64.powf(draw(-1.0, 1.7))),
    ] {
        params.set(param, value);
    }
    let law = if number % 5 == 4 {
        FrictionLaw::Exponential { mu_s, mu_d, stribeck_velocity: draw(0.2, 4.0) }
    } else {
        FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity: 5.0 }
    };
    Instance { params, law, impact_friction: true, motion: Motion::Ramp, heating: None, modal: None }
}
