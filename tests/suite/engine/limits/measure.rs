//! How far an engine is from what is expected of a scene.

use super::scene::{Expected, Number, Scene};
use crate::engines::Engine;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::Plan;
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

/// A scene computed by an engine with other steps than its own; `None`: with its own.
pub(crate) fn found(scene: &Scene, engine: Engine, steps_per_period: Option<u32>) -> Found {
    let plan =
        Plan { steps_per_period: steps_per_period.unwrap_or(scene.plan.steps_per_period), ..scene.plan };
    let outcome = engine.run(&scene.instance, &plan);
    if outcome.status != Status::Ok {
        return Found::Ended(outcome.status);
    }
    Found::Off(error(&outcome, &numbers(scene)))
}

/// What is expected of a scene that comes to its end.
fn numbers(scene: &Scene) -> Vec<(Number, f64)> {
    match &scene.expected {
        Expected::Numbers(numbers) => numbers.clone(),
        Expected::Ends(_) => Vec::new(),
        Expected::Reference(numbers) => {
            let finer = Plan { steps_per_period: 60, ..scene.plan };
            let outcome = Engine::Reference.run(&scene.instance, &finer);
            let expected = |number: &Number| (*number, number(&outcome).expect("the reference computes it"));
            numbers.iter().map(expected).collect()
        }
    }
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
