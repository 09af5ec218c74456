//! A GPU as an engine: the eigenvalue analysis, then the response, by its kernels.

use std::ops::Range;
use std::sync::atomic::AtomicBool;

use crate::engine::Engine;
use crate::engine::backend::Backend;
use crate::engine::computation::Computation;
use crate::engine::computed::Computed;
use crate::engine::error::{Error, Result};
use crate::engine::gpu::chunks::Session;
use crate::engine::gpu::device::Device;
use crate::engine::gpu::{linear, response};
use crate::engine::instances::Instances;
use crate::engine::precision::Precision;
use crate::engine::record::Record;

/// The least that a GPU takes, which takes a range at once.
const BLOCK: usize = 65_536;

/// A GPU, whose kernels stay compiled.
#[derive(Debug)]
pub struct Gpu {
    session: Session,
    chunk: Option<usize>,
}

impl Gpu {
    /// An open device; `chunk` is the most of one chunk, on which results do not depend.
    #[must_use]
    pub fn new(device: Device, chunk: Option<usize>) -> Gpu {
        Gpu { session: Session::new(device), chunk }
    }
}

impl Engine for Gpu {
    fn backend(&self) -> Backend {
        Backend::Gpu
    }

    fn precision(&self) -> Precision {
        self.session.device().precision()
    }

    fn computations(&self, steps_per_period: u32) -> [Computation; 2] {
        let device = self.session.device();
        [linear::method(), response::method(device, steps_per_period)].map(|method| Computation {
            backend: Backend::Gpu.name().to_owned(),
            precision: device.precision().to_string(),
            method,
            adapter: Some(device.describe().to_string()),
            strict: Some(device.strict()),
        })
    }

    fn records(
        &mut self,
        instances: &dyn Instances,
        range: Range<usize>,
        cancel: &AtomicBool,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Computed> {
        records(instances, range, (&mut self.session, self.chunk), cancel, progress)
    }

    fn busy_with(&self, _: usize, starts: usize) -> usize {
        BLOCK.div_ceil(starts)
    }

    fn at_once(&self, instances: usize) -> usize {
        instances.max(BLOCK)
    }
}

/// The records of a range from a GPU; only the last analysis counts as progress, and only what has all of
/// them is done.
fn records(
    spec: &dyn Instances,
    range: Range<usize>,
    (session, chunk): (&mut Session, Option<usize>),
    cancel: &AtomicBool,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Computed> {
    let (eigenvalues, transients) = (spec.linear(), spec.response());
    let (first, total) = (range.start, range.len());
    let mut records = Vec::with_capacity(total);
    let mut ended = Ok(());
    if eigenvalues {
        let progress = if transients { &|_: usize| {} } else { progress };
        ended = linear::append(spec, range, (session, chunk), cancel, progress, &mut records)
            .map_err(|why| counted_from(first, why));
    }
    if transients {
        ended?;
        records.resize(total, Record::default());
        ended = response::complete(spec, first, (session, chunk), cancel, progress, &mut records)
            .map_err(|why| counted_from(first, why));
    }
    Computed::new(records, total, ended)
}

/// An error of a range that starts at `first`, its instance counted from the start of the sweep.
fn counted_from(first: usize, why: Error) -> Error {
    match why {
        Error::Unwritten { instance } => Error::Unwritten { instance: first + instance },
        other => other,
    }
}
