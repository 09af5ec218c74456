//! A stratified sample of a sweep's own instances: some of every type, regime and status, and more near the borders between
//! them. Each comes with the number of instances that it stands for.

use std::collections::BTreeMap;

use crate::engine::choice::choose;
use crate::engine::options::Options;
use crate::engine::precision::Precision;
use crate::engine::record::Record;
use crate::sweep::accuracy::boundary::is_near;
use crate::sweep::accuracy::configuration::Configuration;
use crate::sweep::draw::{mixed, spread};
use crate::sweep::error::Result;
use crate::sweep::grid::Grid;
use crate::sweep::label::Label;
use crate::sweep::spec::{Analysis, Spec, Starts};

/// Candidates for each instance of the sample. A class that is rarer than one in so many may be missed.
const CANDIDATES: usize = 16;

/// Most candidates.
const MOST_CANDIDATES: usize = 65_536;

/// The run that finds types and regimes: labels at the least cost.
const CHEAP: (Precision, u32) = (Precision::F32, 5);

/// An instance near a border counts as so many when the sample is shared out.
const NEAR: f64 = 3.0;

/// This share of the sample is divided evenly by the strata, so that each has at least its part where it has as many.
const EVEN: f64 = 0.4;

/// A stratum: what its instances have in common, how many candidates and instances of the sample it has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stratum {
    /// Status, type, regime and whether it is settled, by the cheap run.
    pub label: Label,
    /// Whether its instances are near a border.
    pub near: bool,
    /// Candidates.
    pub candidates: usize,
    /// Instances of the sample.
    pub taken: usize,
}

/// A sample of a sweep.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The instances by their index in the sweep, rising.
    pub indices: Vec<usize>,
    /// How many instances of the sweep each stands for.
    pub weights: Vec<f64>,
    /// Where they come from.
    pub strata: Vec<Stratum>,
    /// Candidates of all strata.
    pub candidates: usize,
}

impl Sample {
    /// Draws about `size` instances of a sweep with response.
    ///
    /// # Errors
    /// When the cheap run is cancelled.
    pub fn draw(spec: &Spec, size: usize, seed: u64, options: &Options) -> Result<Sample> {
        let total = spec.grid.len();
        let candidates = size.saturating_mul(CANDIDATES).min(MOST_CANDIDATES).max(size).min(total);
        let indices = spread(seed, candidates, total, 0..total);
        let cheap = Configuration::cpu(CHEAP.0, CHEAP.1);
        let records = records(&cheap, &subset(spec, &indices), options)?;
        let mut strata: BTreeMap<(Label, bool), Vec<usize>> = BTreeMap::new();
        for (index, record) in indices.iter().zip(&records) {
            strata.entry((Label::from(record), is_near(record))).or_default().push(*index);
        }
        let counts: Vec<(usize, bool)> =
            strata.iter().map(|((_, near), members)| (members.len(), *near)).collect();
        let taken = shares(&counts, size);
        let mut chosen: Vec<(usize, f64)> = Vec::new();
        let mut described = Vec::new();
        for (((label, near), mut members), taken) in strata.into_iter().zip(taken) {
            let each = members.len() as f64 * total as f64 / (candidates as f64 * taken as f64);
            described.push(Stratum { label, near, candidates: members.len(), taken });
            members.sort_by_key(|index| mixed(!seed, *index as u64));
            chosen.extend(members.into_iter().take(taken).map(|index| (index, each)));
        }
        chosen.sort_by_key(|(index, _)| *index);
        let (indices, weights) = chosen.into_iter().unzip();
        Ok(Sample { indices, weights, strata: described, candidates })
    }
}

/// How many instances each stratum of so many candidates gives: the even part first, the rest by their number.
fn shares(strata: &[(usize, bool)], size: usize) -> Vec<usize> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a part of a small count")]
    let part = |share: f64| share.ceil() as usize;
    let even = part(EVEN * size as f64 / strata.len().max(1) as f64).max(1);
    let weight = |(count, near): (usize, bool)| count as f64 * if near { NEAR } else { 1.0 };
    let sum: f64 = strata.iter().map(|one| weight(*one)).sum();
    let rest = (1.0 - EVEN) * size as f64;
    let given = |one: (usize, bool)| (even + part(rest * weight(one) / sum)).min(one.0);
    strata.iter().map(|one| given(*one)).collect()
}

/// The sweep of some of a sweep's instances, which are not checked and have one start each, the sweep's own.
#[must_use]
pub fn subset(spec: &Spec, indices: &[usize]) -> Spec {
    let row = |index: &usize| spec.grid.coordinates(*index).into_iter().cloned().collect();
    let grid = Grid::Tuples { keys: spec.grid.keys(), rows: indices.iter().map(row).collect() };
    // Field by field: a grid of many values is not copied for a few of its instances.
    Spec {
        title: spec.title.clone(),
        analysis: Analysis { checked: false, starts: Starts::One, ..spec.analysis },
        base: spec.base,
        modal: spec.modal.clone(),
        impact_friction: spec.impact_friction,
        law: spec.law,
        material: spec.material.clone(),
        materials: spec.materials.clone(),
        table: spec.table.clone(),
        motion: spec.motion.clone(),
        grid,
        start: spec.start,
        pass: spec.pass,
        settle: spec.settle,
        settle_limit: spec.settle_limit,
        measure: spec.measure,
        steps_per_period: spec.steps_per_period,
        steps_given: None,
        refine: None,
    }
}

/// The records of a sweep by a configuration, on the rayon pool it is called in.
///
/// # Errors
/// When the configuration cannot compute the sweep, or is cancelled.
pub fn records(configuration: &Configuration, spec: &Spec, options: &Options) -> Result<Vec<Record>> {
    let spec = configuration.sweep(spec);
    let options = Options { note: None, ..configuration.options(options) };
    let total = spec.grid.len();
    let computed = choose(&options, &spec)?.records(&spec, 0..total, options.cancel(), &|_| {})?;
    match computed.stopped {
        None => Ok(computed.records),
        Some(why) => Err(why.error(0, total).into()),
    }
}

#[cfg(test)]
mod tests {
    use super::shares;

    #[test]
    fn every_stratum_has_a_share_and_none_more_than_it_has() {
        let strata = [(8000, false), (150, true), (2, false), (40, true)];
        // 50 each; the other 300 by weights 8000, 3 · 150, 2 and 3 · 40, rounded up; no more than there are, and what
        // small strata lack goes to no other.
        assert_eq!(shares(&strata, 500), [50 + 280, 50 + 16, 2, 40]);
        assert_eq!(shares(&[(10, false)], 100), [10]);
        assert!(shares(&[], 100).is_empty());
    }
}
