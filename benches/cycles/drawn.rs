//! Whether any run ends elsewhere than shooting says: random instances from small and large starts.

use std::f64::consts::TAU;
use std::sync::atomic::AtomicBool;

use rayon::prelude::*;
use squealmap::engine::lanes::outcomes::outcomes;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::{Duration, Plan};
use squealmap::model::equilibrium::Units;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::{Param, Params};
use squealmap::sweep::spec::{AUTO_MEASURE, FIRST_HUNT};

use crate::Row;

/// Periods of the runs that wait.
const WAITED: f64 = 4000.0;

/// An observable that differs by this part has come from another motion: a window of whole `2π/ω0` is off by less.
const ELSEWHERE: f64 = 0.01;

/// What of a distance may be left for a long run to be a judge.
const FORGOTTEN: f64 = 1e-3;

/// The counts.
pub(crate) fn rows(count: usize) -> Vec<Row> {
    let all: Vec<Instance> = (0..count as u64).map(instance).collect();
    let never = AtomicBool::new(false);
    let run = |plan: Plan| -> Vec<Outcome> {
        all.par_chunks(64)
            .flat_map_iter(|some| outcomes::<f64>(some, &plan, &never).unwrap_or_default())
            .collect()
    };
    let long = Plan {
        settle: Duration::Periods(WAITED),
        measure: Duration::Periods(200.0),
        steps_per_period: 12,
        ..Plan::REFERENCE
    };
    let hunts = Plan {
        settle: FIRST_HUNT,
        settle_limit: Some(Duration::Periods(1000.0)),
        hunts: true,
        measure: AUTO_MEASURE,
        ..long
    };
    let (found, waited) = (run(hunts), run(long));
    let mut counts = [0_usize; 5];
    for (one, (found, waited)) in all.iter().zip(found.iter().zip(&waited)) {
        let Some((floquet, period)) = found.floquet.zip(found.period) else { continue };
        counts[0] += 1;
        counts[3] += usize::from(found.cycle_returns > Some(1));
        let cycles = WAITED * TAU * Units::new(&one.params).time / period;
        if floquet.powf(cycles) > FORGOTTEN || waited.x2_std.is_none() {
            counts[1] += 1;
        } else if [
            (found.x2_std, waited.x2_std),
            (found.ax_rms, waited.ax_rms),
            (found.ay_rms, waited.ay_rms),
        ]
        .into_iter()
        .any(|(a, b)| a.zip(b).is_none_or(|(a, b)| (a - b).abs() > ELSEWHERE * b))
        {
            counts[2] += 1;
            eprintln!("ends elsewhere: {one:?}");
        }
        counts[4] += usize::from(found.cycle_returns == Some(2));
    }
    let names = [
        "found by shooting",
        "of them not forgotten in 4000 periods",
        "of them elsewhere in a run of 4000 periods",
        "of them with several returns in a period",
        "of them with two",
    ];
    let row = |quantity: &str, value: usize| Row {
        of: "random instances, f64".to_owned(),
        quantity: quantity.to_owned(),
        value: value as f64,
    };
    std::iter::once(row("instances", count))
        .chain(names.into_iter().zip(counts).map(|(name, count)| row(name, count)))
        .collect()
}

/// A random instance: friction, belt, inclination, restitution and damping over wide ranges; every second start is small.
fn instance(number: u64) -> Instance {
    let mut state = number.wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(29);
    let mut draw = |low: f64, high: f64| {
        // The mixing of splitmix64.
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
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
    Instance { params, law, impact_friction: true, modal: None }
}
