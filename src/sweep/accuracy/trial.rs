//! What was chosen for an accuracy, tried on some of the sweep's own instances before it computes all of them.
//!
//! The table that a choice is made from was measured on other sweeps. Parameters far from theirs make other errors, and
//! only the sweep itself can tell.

use crate::engine::options::Options;
use crate::engine::record::Record;
use crate::sweep::accuracy::configuration::{Configuration, finer};
use crate::sweep::accuracy::errors::{is_settled_oscillation, quantile, scatter, worst};
use crate::sweep::accuracy::frontier::Choice;
use crate::sweep::accuracy::sample::{records, subset};
use crate::sweep::accuracy::tried::Trial;
use crate::sweep::draw::spread;
use crate::sweep::error::Result;
use crate::sweep::spec::Spec;

/// Instances of the first draw; each further one has four times as many.
const FIRST_DRAW: usize = 192;
const GROWTH: usize = 4;

/// At most so many instances, or this part of the sweep.
const MOST: usize = 1024;
const MOST_PART: f64 = 0.02;

/// Fewer settled oscillations have no 95th percentile; so many are enough.
const FEWEST: usize = 20;
const ENOUGH: usize = 100;

/// Seed of the draw.
const SEED: u64 = 0x5153_5452;

/// The first of some choices, each more accurate than the one before, that keeps its bound on instances of the sweep; the
/// last where none does. Of a choice without a bound nothing is tried.
///
/// # Errors
/// When a trial cannot be computed, or is cancelled.
///
/// # Panics
/// When there is no choice.
pub fn first_that_keeps(ranked: Vec<Choice>, spec: &Spec, options: &Options) -> Result<Choice> {
    let Some(bound) = ranked[0].chosen.bound else { return Ok(ranked.into_iter().next().expect("a choice")) };
    // Finer than the most accurate of them.
    let judge =
        ranked.iter().map(|choice| finer(&choice.configuration)).max_by_key(|one| one.steps_per_period);
    let sample = Sample::draw(spec, &judge.expect("a choice"), options)?;
    let mut tried = None;
    for mut choice in ranked {
        let trial = sample.trial(&choice.configuration, bound, options)?;
        choice.chosen.trial = Some(trial);
        tried = Some(choice);
        if trial.passed() {
            break;
        }
    }
    Ok(tried.expect("a choice"))
}

/// Instances of a sweep with their true records.
struct Sample {
    sweep: Spec,
    truth: Vec<Record>,
}

impl Sample {
    /// Draws more until there are enough settled oscillations.
    fn draw(spec: &Spec, judge: &Configuration, options: &Options) -> Result<Sample> {
        let total = spec.grid.len();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a part of the total")]
        let most = ((MOST_PART * total as f64) as usize).max(MOST).min(total);
        let mut count = FIRST_DRAW.min(total);
        loop {
            let sweep = subset(spec, &spread(SEED, count, total, 0..total));
            let truth = records(judge, &sweep, options)?;
            let settled = truth.iter().filter(|one| is_settled_oscillation(one)).count();
            if settled >= ENOUGH || count >= most {
                return Ok(Sample { sweep, truth });
            }
            count = (GROWTH * count).min(most);
        }
    }

    /// How far a configuration is from the truth.
    fn trial(&self, configuration: &Configuration, bound: f64, options: &Options) -> Result<Trial> {
        let found = records(configuration, &self.sweep, options)?;
        let errors: Vec<f64> = found
            .iter()
            .zip(&self.truth)
            .filter(|(_, truth)| is_settled_oscillation(truth))
            .map(|(record, truth)| (worst(record, truth) - scatter(truth)).max(0.0))
            .collect();
        let settled = errors.len();
        Ok(Trial {
            instances: self.truth.len(),
            settled_oscillations: settled,
            p95: (settled >= FEWEST)
                .then(|| quantile(errors.iter().map(|error| (*error, 1.0)).collect(), 0.95)),
            broken: errors.iter().filter(|error| **error > bound).count(),
        })
    }
}
