//! What finding cycles saves.

use std::f64::consts::TAU;

use squealmap::engine::judged::regime;
use squealmap::engine::lanes::Lanes;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::Plan;
use squealmap::model::equilibrium::Units;
use squealmap::model::linear::analyse;
use squealmap::sweep::accuracy::clock::Clock;

use crate::Row;
use crate::maps::{Map, run};

/// Time and simulated periods of both ways, and where their classes differ.
pub(crate) fn rows(map: &Map, rounds: usize) -> Vec<Row> {
    let mut rows = of_precision::<f64>(map, rounds, "f64");
    rows.extend(of_precision::<f32>(map, rounds, "f32"));
    rows
}

fn of_precision<T: Lanes>(map: &Map, rounds: usize, precision: &str) -> Vec<Row> {
    let plans = map.plans();
    let mut times = [Vec::new(), Vec::new()];
    let mut made = [Vec::new(), Vec::new()];
    for _ in 0..rounds.max(1) {
        for way in 0..2 {
            let clock = Clock::start();
            made[way] = run::<T>(&map.instances, &plans[way]);
            times[way].push(clock.worked());
        }
    }
    let count = map.instances.len() as f64;
    let [waits, finds] = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2] / count
    });
    let [waited, found] = made.each_ref().map(|made| periods(map, made));
    let classes = |made: &[Outcome], plan: &Plan| -> Vec<_> {
        debug_assert!(plan.settle_limit.is_some());
        map.instances.iter().zip(made).map(|(one, outcome)| regime(one, analyse(one).0, outcome)).collect()
    };
    let pairs = classes(&made[0], &plans[0]).into_iter().zip(classes(&made[1], &plans[1]));
    let settled = pairs.filter(|(waited, found)| waited.1 && found.1);
    let differ = settled.filter(|(waited, found)| waited.0 != found.0).count();
    let by_shooting = made[1].iter().filter(|outcome| outcome.floquet.is_some()).count();
    let row = |quantity: &str, value: f64| Row {
        of: format!("{}, {precision}", map.name),
        quantity: quantity.to_owned(),
        value,
    };
    vec![
        row("instances", count),
        row("found by shooting", by_shooting as f64),
        row("periods per instance, auto", waited),
        row("periods per instance, cycle", found),
        row("periods, auto over cycle", waited / found),
        row("processor seconds per instance, auto", waits),
        row("processor seconds per instance, cycle", finds),
        row("processor time, auto over cycle", waits / finds),
        row("settled in both with another regime", differ as f64),
    ]
}

/// Simulated periods per instance.
fn periods(map: &Map, made: &[Outcome]) -> f64 {
    let one = map.instances.iter().zip(made);
    let sum: f64 =
        one.map(|(one, outcome)| outcome.simulated_time / (TAU * Units::new(&one.params).time)).sum();
    sum / made.len() as f64
}
