//! The f64 reference on all cores: one rayon task per instance, results independent of their number.
//!
//! It judges the other engines: one instance at a time, a method of high order, steps as short as it takes.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use crate::backend::computed::Computed;
use crate::backend::{begun, take_response};
use crate::error::{Error, Result};
use crate::kernel::source::Precision;
use crate::linear::analyse;
use crate::map::{Computation, Record};
use crate::method::taylor::REFERENCE_ORDER;
use crate::outcome::Status;
use crate::response::{Plan, respond};
use crate::spec::Spec;

/// The name of the backend in a manifest.
pub const NAME: &str = "reference";

/// The eigenvalue analysis on the CPU in a manifest.
#[must_use]
pub fn linear(backend: &str) -> Computation {
    in_f64(backend, "closed form of the quartic, polished".to_owned())
}

/// The response of the reference in a manifest.
#[must_use]
pub fn response() -> Computation {
    in_f64(NAME, format!("Taylor series of order {REFERENCE_ORDER}, events located in the step"))
}

/// A method of a backend in f64.
#[must_use]
pub fn in_f64(backend: &str, method: String) -> Computation {
    let precision = Precision::F64.to_string();
    Computation { backend: backend.to_owned(), precision, method, adapter: None, strict: None }
}

/// Computes the instances `range` of a sweep; `progress` gets the number newly finished. Once `cancel` is set no
/// instance is begun; those under way are finished.
///
/// # Errors
/// When `cancel` was set before any instance was begun.
pub fn records(
    spec: &Spec,
    range: Range<usize>,
    cancel: &AtomicBool,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Computed> {
    let total = range.len();
    let records: Vec<Record> = range
        .into_par_iter()
        .map(|index| {
            if cancel.load(Ordering::Relaxed) {
                return Record::NOT_COMPUTED;
            }
            let record = record(spec, index);
            progress(1);
            record
        })
        .collect();
    let done = records.iter().filter(|record| record.status != Status::NotComputed).count();
    let ended = if done < total { Err(Error::Cancelled { done, total }) } else { Ok(()) };
    Computed::new(records, total, ended)
}

/// Computes instance `index` of a sweep.
#[must_use]
pub fn record(spec: &Spec, index: usize) -> Record {
    record_with(spec, index, &Plan::new(spec))
}

/// Computes instance `index` of a sweep by another plan than the sweep's own.
#[must_use]
pub fn record_with(spec: &Spec, index: usize, plan: &Plan) -> Record {
    let instance = spec.instance(index);
    let mut record = begun(&instance);
    let (kind, linear) = analyse(&instance);
    if spec.analysis.linear {
        (record.kind, record.linear) = (kind, linear);
    }
    if spec.analysis.response {
        take_response(&mut record, &instance, kind, &respond(&instance, plan));
    }
    record
}
