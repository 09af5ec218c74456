//! Results checked while a sweep is computed: a few instances, drawn by their index alone, are computed again.
//!
//! Most of them are computed by the CPU engine in f64 with fine steps, which costs a few times the run itself. Fewer are
//! computed by the reference, which shares no code with the engines but costs about fifty times as much. The errors are
//! written beside the results. Instances of the first kind that are near a border between two labels take the finer result.

use crate::engine::backend::Backend;
use crate::engine::computation::Stopped;
use crate::engine::error::Result;
use crate::engine::method::Method;
use crate::engine::plan::Duration;
use crate::engine::record::{By, Check, Record};
use crate::engine::{lanes, reference};
use crate::model::status::Status;
use crate::sweep::accuracy::boundary::is_near;
use crate::sweep::accuracy::configuration::{Configuration, finer};
use crate::sweep::accuracy::errors::{is_settled_oscillation, worst};
use crate::sweep::accuracy::frontier::Frontier;
use crate::sweep::accuracy::sample::subset;
use crate::sweep::draw::spread;
use crate::sweep::label::Label;
use crate::sweep::spec::{Analysis, Spec};
use std::ops::Range;
use std::sync::atomic::AtomicBool;

/// Parts of the run time that the two kinds of checks may take, together below 5 %.
const FINE_SHARE: f64 = 0.03;
const REFERENCE_SHARE: f64 = 0.01;

/// Instances that a fast GPU computes per second. The speed of a GPU is not known beforehand; with a fast one assumed, the
/// checks, which the CPU makes, stay below their share on any.
const GPU_PER_SECOND: f64 = 5e6;

/// A run that waits for its cycle takes so many times as long as one that finds it: 1050 periods instead of 80 in
/// `settled_map`.
const LONGER: f64 = 13.0;

/// Seeds of the two draws.
const FINE_SEED: u64 = 0x5153_4645;
const REFERENCE_SEED: u64 = 0x5153_5245;

/// Steps per period of the reference.
const REFERENCE_STEPS: u32 = 12;

/// How many instances of a sweep are checked: by the engine that computes it and their number alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts {
    /// How many are checked by the CPU engine.
    pub fine: usize,
    /// How many are checked by the reference.
    pub reference: usize,
}

impl Counts {
    /// The counts for a sweep of `total` instances, which may find its cycles by shooting. None are checked where the reference computes the sweep, or a method
    /// that is only there to be compared with it.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a part of the total")]
    pub fn new(configuration: &Configuration, finds_cycles: bool, total: usize) -> Counts {
        if configuration.backend.method().is_some() {
            return Counts { fine: 0, reference: 0 };
        }
        let shipped = Frontier::shipped();
        let rate = |configuration: &Configuration| shipped.cpu_rate(configuration);
        let engine = if configuration.backend == Backend::Gpu { GPU_PER_SECOND } else { rate(configuration) };
        // A long run costs as much more as its record.
        let total = total as f64 / if finds_cycles { LONGER } else { 1.0 };
        let part = |share: f64, judge: &Configuration| share * rate(judge) / engine * total;
        Counts {
            // One at least: a map says something of its error however small it is.
            fine: part(FINE_SHARE, &finer(configuration)).ceil() as usize,
            reference: part(REFERENCE_SHARE, &Configuration::reference(REFERENCE_STEPS)).floor() as usize,
        }
    }
}

/// The sweep by which one is judged: a cycle that was found is compared with a run that waits for it, for as long as a run may
/// take to settle and then until its windows agree.
fn waited_for(spec: Spec) -> Spec {
    let Some(limit) = spec.settle_limit.filter(|_| spec.analysis.finds_cycles) else { return spec };
    let twice = match limit {
        Duration::Seconds(seconds) => Duration::Seconds(2.0 * seconds),
        Duration::Periods(periods) => Duration::Periods(2.0 * periods),
        Duration::Ramp => Duration::Ramp,
    };
    let analysis = Analysis { finds_cycles: false, ..spec.analysis };
    Spec { analysis, settle: limit, settle_limit: Some(twice), ..spec }
}

/// Checks the records of the instances `range`, which `configuration` has computed; gives why it stopped, if it did.
///
/// # Errors
/// When a check fails for another reason than that the run is cancelled.
pub fn check(
    spec: &Spec,
    range: Range<usize>,
    configuration: &Configuration,
    records: &mut [Record],
    cancel: &AtomicBool,
) -> Result<Option<Stopped>> {
    let (first, total) = (range.start, spec.grid.len());
    let counts = Counts::new(configuration, spec.analysis.finds_cycles, total);
    let draws = [
        (By::Fine, finer(configuration), spread(FINE_SEED, counts.fine, total, range.clone())),
        (
            By::Reference,
            Configuration::reference(REFERENCE_STEPS),
            spread(REFERENCE_SEED, counts.reference, total, range),
        ),
    ];
    for (by, judge, indices) in draws {
        if indices.is_empty() {
            continue;
        }
        let sweep = judge.sweep(&waited_for(subset(spec, &indices)));
        let all = 0..indices.len();
        let computed = match by {
            By::Fine => lanes::records::records(&sweep, all, judge.precision, cancel, &|_| {}),
            By::Reference => reference::records::records(&sweep, all, Method::Taylor, cancel, &|_| {}),
        };
        let judged = match computed {
            Ok(judged) if judged.stopped.is_none() => judged.records,
            Ok(judged) => return Ok(judged.stopped),
            Err(why) => return Stopped::try_from(why).map(Some),
        };
        for (index, truth) in indices.into_iter().zip(judged) {
            let record = &mut records[index - first];
            // Finer steps may be more than a run may have, which says nothing of the coarser ones.
            if truth.status == Status::StepTooLarge && record.status == Status::Ok {
                continue;
            }
            // What was drawn twice keeps the first check, which may have taken the finer result.
            if record.check.is_none() {
                *record = judge_one(record, &truth, by);
            }
        }
    }
    Ok(None)
}

/// The record with what its check found; near a border it is the true one.
fn judge_one(record: &Record, truth: &Record, by: By) -> Record {
    let label = |record: &Record| Label::from(record).class();
    let taken = by == By::Fine && (is_near(record) || is_near(truth));
    let error = is_settled_oscillation(truth).then(|| worst(record, truth));
    let check = Check { by, taken, changed: label(record) != label(truth), error };
    Record { check: Some(check), ..if taken { truth } else { record }.clone() }
}
