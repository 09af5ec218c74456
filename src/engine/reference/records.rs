//! The f64 reference on all cores: one rayon task per instance, results independent of their number.
//!
//! It judges the other engines: one instance at a time, a method of high order, steps as short as it takes.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use crate::engine::Engine;
use crate::engine::backend::Backend;
use crate::engine::computation::Computation;
use crate::engine::computed::Computed;
use crate::engine::error::{Error, Result};
use crate::engine::instances::Instances;
use crate::engine::judged::{examined, take_response};
use crate::engine::method::Method;
use crate::engine::method::taylor::REFERENCE_ORDER;
use crate::engine::plan::Plan;
use crate::engine::precision::Precision;
use crate::engine::record::Record;
use crate::engine::reference::respond::respond_until;
use crate::model::status::Status;

/// The eigenvalue analysis in a manifest.
#[must_use]
fn linear(backend: Backend) -> Computation {
    in_f64(backend, "closed form of the quartic, polished".to_owned())
}

/// The response by a method in a manifest.
#[must_use]
pub fn response(method: Method) -> Computation {
    let in_words = match method {
        Method::Taylor => format!("Taylor series of order {REFERENCE_ORDER}, events located in the step"),
        Method::LocatedRk4 => "Runge–Kutta of order 4, events located in the step".to_owned(),
        Method::FixedStep => "Runge–Kutta of order 4, events at the ends of steps".to_owned(),
    };
    in_f64(Backend::of_method(method), in_words)
}

/// A method of a backend in f64.
#[must_use]
pub fn in_f64(backend: Backend, method: String) -> Computation {
    let precision = Precision::F64.to_string();
    Computation { backend: backend.name().to_owned(), precision, method, adapter: None, strict: None }
}

/// One instance at a time in f64 by a method: the reference, or one to compare with.
#[derive(Clone, Copy, Debug)]
pub struct Scalar(pub Method);

impl Engine for Scalar {
    fn backend(&self) -> Backend {
        Backend::of_method(self.0)
    }

    fn precision(&self) -> Precision {
        Precision::F64
    }

    fn computations(&self, _: &dyn Instances) -> [Computation; 2] {
        [linear(self.backend()), response(self.0)]
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

    fn busy_with(&self, _: usize, _: usize) -> usize {
        rayon::current_num_threads()
    }
}

/// Computes the instances `range` of a sweep by a method; `progress` gets the number newly finished. Once `cancel` is set no
/// instance is begun; those under way, which may have minutes to go, are dropped.
///
/// # Errors
/// When `cancel` was set before any instance was finished.
pub fn records(
    spec: &dyn Instances,
    range: Range<usize>,
    method: Method,
    cancel: &AtomicBool,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Computed> {
    let total = range.len();
    let plan = Plan { method, ..spec.plan() };
    let records: Vec<Record> = range
        .into_par_iter()
        .map(|index| {
            if cancel.load(Ordering::Relaxed) {
                return Record::NOT_COMPUTED;
            }
            let record = record_until(spec, index, &plan, cancel);
            if record.status != Status::NotComputed {
                progress(1);
            }
            record
        })
        .collect();
    let done = records.iter().filter(|record| record.status != Status::NotComputed).count();
    let ended = if done < total { Err(Error::Cancelled { done, total }) } else { Ok(()) };
    Computed::new(records, total, ended)
}

/// Computes instance `index` of a sweep.
#[must_use]
pub fn record(spec: &dyn Instances, index: usize) -> Record {
    record_with(spec, index, &spec.plan())
}

/// Computes instance `index` of a sweep by another plan than the sweep's own.
#[must_use]
pub fn record_with(spec: &dyn Instances, index: usize, plan: &Plan) -> Record {
    record_until(spec, index, plan, &AtomicBool::new(false))
}

/// Computes instance `index` of a sweep by a plan. Soon after `cancel` is set it gives up, with [`Status::NotComputed`].
fn record_until(spec: &dyn Instances, index: usize, plan: &Plan, cancel: &AtomicBool) -> Record {
    let instance = spec.instance(index);
    let (mut record, kind) = examined(&instance, spec.linear());
    if spec.response() {
        let outcome = respond_until(&instance, plan, cancel);
        if outcome.status == Status::NotComputed {
            return Record::NOT_COMPUTED;
        }
        take_response(&mut record, &instance, kind, &outcome);
    }
    record
}
