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
use crate::engine::gpu::response::Crews;
use crate::engine::gpu::{linear, response};
use crate::engine::instances::Instances;
use crate::engine::precision::Precision;
use crate::engine::record::Record;

/// The least that a GPU takes, which takes a range at once; of a program on the CPU, which takes minutes for it.
const BLOCK: usize = 65_536;

/// The least that hardware takes: some times as many as it has places for, whose records take 200 MB.
const OF_HARDWARE: usize = 4 * BLOCK;

/// GPUs that share the work; their kernels stay compiled.
#[derive(Debug)]
pub struct Gpu {
    sessions: Vec<Session>,
    crews: Crews,
    chunk: Option<usize>,
}

impl Gpu {
    /// Open devices, at least one, all of one arithmetic; `chunk` is the most of one chunk. Results depend on neither the
    /// chunks nor on which device takes them.
    #[must_use]
    pub fn new(devices: Vec<Device>, chunk: Option<usize>) -> Gpu {
        let sessions = devices.into_iter().map(Session::new).collect();
        Gpu { sessions, crews: Crews::default(), chunk }
    }
}

impl Engine for Gpu {
    fn backend(&self) -> Backend {
        Backend::Gpu
    }

    fn precision(&self) -> Precision {
        self.sessions[0].device().precision()
    }

    fn computations(&self, steps_per_period: u32) -> [Computation; 2] {
        let device = self.sessions[0].device();
        let names: Vec<String> =
            self.sessions.iter().map(|one| one.device().describe().to_string()).collect();
        [linear::method(), response::method(device, steps_per_period)].map(|method| Computation {
            backend: Backend::Gpu.name().to_owned(),
            precision: device.precision().to_string(),
            method,
            adapter: Some(names.join("; ")),
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
        records(instances, range, self, cancel, progress)
    }

    fn busy_with(&self, _: usize, starts: usize) -> usize {
        let is_software = self.sessions.iter().any(|session| session.device().is_software());
        let least = if is_software { BLOCK } else { OF_HARDWARE };
        least.div_ceil(starts)
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
    Gpu { sessions, crews, chunk }: &mut Gpu,
    cancel: &AtomicBool,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Computed> {
    let (eigenvalues, transients) = (spec.linear(), spec.response());
    let (first, total) = (range.start, range.len());
    let mut records = Vec::with_capacity(total);
    let mut ended = Ok(());
    if eigenvalues {
        let progress = if transients { &|_: usize| {} } else { progress };
        ended = linear::on_all(spec, range, (sessions, *chunk), cancel, progress, &mut records)
            .map_err(|why| counted_from(first, why));
    }
    if transients {
        ended?;
        records.resize(total, Record::default());
        ended = response::complete(spec, first, (sessions, crews, *chunk), cancel, progress, &mut records)
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
