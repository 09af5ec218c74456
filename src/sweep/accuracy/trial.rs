//! What was chosen for an accuracy, tried on some of the sweep's own instances before it computes all of them.
//!
//! The table that a choice is made from was measured on other sweeps. Parameters far from theirs make other errors, and
//! only the sweep itself can tell.

use serde::{Deserialize, Serialize};

use crate::engine::choice::Options;
use crate::engine::record::Record;
use crate::error::Result;
use crate::sweep::accuracy::check::finer;
use crate::sweep::accuracy::configuration::Configuration;
use crate::sweep::accuracy::errors::{is_settled_oscillation, quantile, scatter, worst};
use crate::sweep::accuracy::frontier::Choice;
use crate::sweep::accuracy::sample::{records, subset};
use crate::sweep::draw::spread;
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

/// The part of the oscillations of a trial that may break the bound, half of what the promise allows: several choices are
/// tried on one sample, of which none is to pass by luck. What breaks the bound in 10 % of all cases passes a trial of 100
/// oscillations one time in 500, one of 40 one time in 70.
const BROKEN: f64 = 0.025;

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
    /// How many of them break the bound.
    pub broken: usize,
}

impl Trial {
    /// Whether the bound was kept, as far as so few can tell.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.broken as f64 <= (BROKEN * self.settled_oscillations as f64 - 0.5).max(0.0)
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
            "warning: {sample}: {found}, but {} break {bound:e}, more than half of what may, and nothing measured is more \
             accurate; the checks in the summary say what the whole sweep has",
            self.broken
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
