//! What was chosen for an accuracy, tried on some of the sweep's own instances before it computes all of them.
//!
//! The table that a choice is made from was measured on other sweeps. Parameters far from theirs make other errors, and
//! only the sweep itself can tell.

use serde::{Deserialize, Serialize};

use super::check::finer;
use super::configuration::Configuration;
use super::draw::spread;
use super::errors::{Judge, is_settled_oscillation, scatter, worst};
use super::frontier::Choice;
use super::sample::{records, subset};
use crate::backend::choice::Options;
use crate::error::Result;
use crate::map::Record;
use crate::spec::Spec;

/// Instances of the first draw; each further one has four times as many.
const FIRST_DRAW: usize = 128;
const GROWTH: usize = 4;

/// Beyond the first draw at most this part of the sweep.
const MOST: f64 = 0.02;

/// So many settled oscillations have a 95th percentile, and are enough.
const ENOUGH: usize = 40;
const FEWEST: usize = 20;

/// The share of the oscillations of the trial that have to keep the bound. It is more than the 95 % of the promise, as
/// a sample's quantile lies on either side of that of all.
const KEPT: f64 = 0.975;

/// Seed of the draw.
const SEED: u64 = 0x5153_5452;

/// What a configuration did on some instances of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct Trial {
    /// Instances.
    pub instances: usize,
    /// Settled oscillations among them.
    pub settled_oscillations: usize,
    /// The relative error beyond the truth's own scatter that 95 % of them keep; `None` of fewer than 20.
    pub p95: Option<f64>,
    /// The part of them that keeps the bound; `None` without any.
    pub kept: Option<f64>,
}

impl Trial {
    /// Whether the bound was kept, as far as so few can tell.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.kept.is_none_or(|kept| kept >= KEPT)
    }

    /// What it says to a user.
    #[must_use]
    pub fn sentence(&self, bound: f64) -> String {
        let Trial { instances, settled_oscillations: settled, p95, .. } = *self;
        let sample =
            format!("tried on {instances} instances of this sweep, {settled} of them settled oscillations");
        let found = match p95 {
            Some(p95) if p95 > 0.0 => format!("95 % within {p95:.1e} beyond their own scatter"),
            Some(_) => "95 % within their own scatter".to_owned(),
            None if self.passed() => {
                return format!("{sample}: too few to tell whether it keeps {bound:e} here");
            }
            None => "too few for a 95th percentile".to_owned(),
        };
        if self.passed() {
            return format!("{sample}: {found}");
        }
        format!(
            "warning: {sample}: {found}, which is not {bound:e}, and nothing measured is more accurate; the checks in the \
             summary say what the whole sweep has"
        )
    }
}

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
        let most = ((MOST * total as f64) as usize).max(FIRST_DRAW).min(total);
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
        let kept = errors.iter().filter(|error| **error <= bound).count();
        let judge = Judge::new(self.truth.clone(), vec![1.0; self.truth.len()]);
        Ok(Trial {
            instances: self.truth.len(),
            settled_oscillations: settled,
            p95: (settled >= FEWEST).then(|| judge.errors(&found).beyond_scatter),
            kept: (settled > 0).then(|| kept as f64 / settled as f64),
        })
    }
}
