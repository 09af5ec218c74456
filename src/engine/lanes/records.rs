//! Sweeps on all cores, many instances at a time in the lanes of vector registers ([`crate::engine::lanes`]).
//!
//! One rayon task takes a batch of instances; results depend neither on batches nor on the number of threads.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use pulp::Arch;
use rayon::prelude::*;

use crate::engine::Engine;
use crate::engine::backend::Backend;
use crate::engine::computation::Computation;
use crate::engine::computed::Computed;
use crate::engine::error::{Error, Result};
use crate::engine::instances::Instances;
use crate::engine::judged::take_response;
use crate::engine::kernel::linear::METHOD;
use crate::engine::lanes::again::outcomes_again;
use crate::engine::lanes::linear::examined_many;
use crate::engine::lanes::outcomes::outcomes;
use crate::engine::lanes::{ORDER, again, tolerance};
use crate::engine::plan::Plan;
use crate::engine::precision::Precision;
use crate::engine::record::Record;
use crate::engine::reference::records::in_f64;
use crate::model::instance::Instance;
use crate::model::status::Status;

/// Most instances of a batch: many per lane, so that few lanes rest at its end, and not more than a core's cache holds
/// (1.5 MiB).
const MOST: usize = 512;

/// Fewest, where a sweep has enough for all threads: the lanes of two vectors.
const FEWEST: usize = 32;

/// Instances for each thread that keep it busy: two batches.
pub(crate) const BUSY: usize = 2 * FEWEST;

/// The eigenvalue analysis in a manifest.
#[must_use]
pub fn linear() -> Computation {
    in_f64(Backend::Cpu, METHOD.to_owned())
}

/// The response of a sweep in a manifest.
#[must_use]
pub fn response(precision: Precision, steps_per_period: u32) -> Computation {
    let bound = tolerance(precision, steps_per_period);
    Computation {
        backend: Backend::Cpu.name().to_owned(),
        precision: precision.to_string(),
        method: format!(
            "Taylor series of order {ORDER}, truncation below {bound:.1e}, events located in the step, single masses \
             with constant friction in closed form{}{}",
            again::note(precision),
            rounding(Arch::new())
        ),
        adapter: None,
        strict: None,
    }
}

/// What a method says of how an instruction set rounds. Whatever their widths, registers give the same bits, but for those
/// of machines that cannot add a product unrounded: a directory is not gone on with on the other kind.
#[must_use]
pub fn rounding(instructions: Arch) -> &'static str {
    // Elsewhere than on x86 every machine can, but for those without any vector registers.
    if matches!(instructions, Arch::Scalar) { ", products rounded before they are added" } else { "" }
}

/// The CPU engine in a precision.
#[derive(Clone, Copy, Debug)]
pub struct Cpu(pub Precision);

impl Engine for Cpu {
    fn backend(&self) -> Backend {
        Backend::Cpu
    }

    fn precision(&self) -> Precision {
        self.0
    }

    fn computations(&self, instances: &dyn Instances) -> [Computation; 2] {
        [linear(), response(self.0, instances.plan().steps_per_period)]
    }

    fn records(
        &mut self,
        instances: &dyn Instances,
        range: Range<usize>,
        cancel: &AtomicBool,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Computed> {
        records(instances, range, self.0, cancel, progress)
    }

    fn busy_with(&self, tile: usize, _: usize) -> usize {
        BUSY.min(tile) * rayon::current_num_threads()
    }
}

/// Computes the instances `range` of a sweep; `progress` gets the number newly finished. Once `cancel` is set no
/// batch is begun, and those under way are dropped.
///
/// # Errors
/// When `cancel` was set before any batch was finished.
pub fn records(
    spec: &dyn Instances,
    range: Range<usize>,
    precision: Precision,
    cancel: &AtomicBool,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Computed> {
    let total = range.len();
    let plan = spec.plan();
    let threads = rayon::current_num_threads();
    let size = (total / (4 * threads)).clamp(FEWEST, MOST).min(total.div_ceil(threads)).max(1);
    let mut records = vec![Record::NOT_COMPUTED; total];
    records.par_chunks_mut(size).enumerate().for_each(|(index, batch)| {
        self::batch(spec, range.start + index * size, &plan, precision, cancel, batch);
        if !cancel.load(Ordering::Relaxed) {
            progress(batch.len());
        }
    });
    let done = records.iter().filter(|record| record.status != Status::NotComputed).count();
    let ended = if done < total { Err(Error::Cancelled { done, total }) } else { Ok(()) };
    Computed::new(records, total, ended)
}

/// Computes the records of the instances from `first` on; none of them when `cancel` is set on the way.
fn batch(
    spec: &dyn Instances,
    first: usize,
    plan: &Plan,
    precision: Precision,
    cancel: &AtomicBool,
    records: &mut [Record],
) {
    if cancel.load(Ordering::Relaxed) {
        return;
    }
    let instances: Vec<Instance> = (first..first + records.len()).map(|index| spec.instance(index)).collect();
    let mut kinds = Vec::with_capacity(instances.len());
    for (record, (examined, kind)) in records.iter_mut().zip(examined_many(&instances, spec.linear())) {
        *record = examined;
        kinds.push(kind);
    }
    if !spec.response() {
        return;
    }
    let outcomes = match precision {
        Precision::F32 => outcomes::<f32>(&instances, plan, cancel)
            .and_then(|made| outcomes_again(&instances, plan, made, cancel)),
        Precision::F64 => outcomes::<f64>(&instances, plan, cancel),
    };
    let Some(outcomes) = outcomes else { return records.fill(Record::NOT_COMPUTED) };
    for (((record, instance), kind), outcome) in records.iter_mut().zip(&instances).zip(kinds).zip(&outcomes)
    {
        take_response(record, instance, kind, outcome);
    }
}
