//! How far an engine is from what is expected of a scene.

use super::scene::{Expected, Number, Scene};
use crate::engines::Engine;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::Plan;
use squealmap::model::instance::Instance;
use squealmap::model::status::Status;

/// What an engine made of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Found {
    /// It ended otherwise than in a result.
    Ended(Status),
    /// The largest relative error of its numbers; infinite where one is missing.
    Off(f64),
}

/// The steps per period that stand in the table: the default, and the coarsest a sweep may ask for.
pub(crate) const STEPS: [u32; 2] = [12, 4];

/// Scenes computed by an engine with other steps than their own; `None`: with their own. Those of one plan side by side, as the
/// twin carries out an operation for several in the time of one.
pub(crate) fn found(scenes: &[&Scene], engine: Engine, steps_per_period: Option<u32>) -> Vec<Found> {
    let plan = |scene: &Scene| Plan {
        steps_per_period: steps_per_period.unwrap_or(scene.plan.steps_per_period),
        ..scene.plan
    };
    let mut found = vec![None; scenes.len()];
    for first in 0..scenes.len() {
        if found[first].is_some() {
            continue;
        }
        let plan_here = plan(scenes[first]);
        let here: Vec<usize> = (first..scenes.len()).filter(|at| plan(scenes[*at]) == plan_here).collect();
        let instances: Vec<Instance> = here.iter().map(|at| scenes[*at].instance.clone()).collect();
        for (at, outcome) in here.into_iter().zip(engine.run_all(&instances, &plan_here)) {
            found[at] = Some(match outcome.status {
                Status::Ok => Found::Off(scenes[at].expected.error(&outcome)),
                status => Found::Ended(status),
            });
        }
    }
    found.into_iter().map(|one| one.expect("every scene has a plan")).collect()
}

/// The largest relative error; of what is 0 the number itself, in SI units.
pub(crate) fn error(outcome: &Outcome, expected: &[(Number, f64)]) -> f64 {
    expected.iter().fold(0.0, |worst: f64, &(number, expected)| {
        let error = match number(outcome) {
            Some(value) if value.is_finite() && expected != 0.0 => (value / expected - 1.0).abs(),
            Some(value) if value.is_finite() => value.abs(),
            _ => f64::INFINITY,
        };
        worst.max(error)
    })
}

impl Expected {
    /// How far an outcome is from what is expected of one that comes to its end.
    fn error(&self, outcome: &Outcome) -> f64 {
        match self {
            Expected::Numbers(numbers) => error(outcome, numbers),
            Expected::Ends(_) => 0.0,
        }
    }
}
