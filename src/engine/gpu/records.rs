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

/// They begin this many times as much ahead: of runs until settled, the last of a range take five times as long as most.
const AHEAD: usize = 2;

/// GPUs that share the work; their kernels stay compiled.
#[derive(Debug)]
pub struct Gpu {
    sessions: Vec<Session>,
    crews: Crews,
    chunk: Option<usize>,
    begun: Option<Begun>,
}

/// What was begun of the instances behind a range.
#[derive(Debug)]
struct Begun {
    /// The address of their sweep.
    of: usize,
    /// The first of them.
    first: usize,
    /// How many were taken.
    taken: usize,
    /// Their records so far.
    records: Vec<Record>,
}

/// The address of a sweep, which tells it from another one as long as it is there.
fn address(spec: &dyn Instances) -> usize {
    std::ptr::from_ref(spec).addr()
}

impl Gpu {
    /// Open devices, at least one, all of one arithmetic; `chunk` is the most of one chunk. Results depend on neither the
    /// chunks nor on which device takes them.
    #[must_use]
    pub fn new(devices: Vec<Device>, chunk: Option<usize>) -> Gpu {
        let sessions = devices.into_iter().map(Session::new).collect();
        Gpu { sessions, crews: Crews::default(), chunk, begun: None }
    }

    /// The least that they take.
    fn least(&self) -> usize {
        let is_software = self.sessions.iter().any(|session| session.device().is_software());
        if is_software { BLOCK } else { OF_HARDWARE }
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
        records(instances, [range.start, range.len(), 0], self, cancel, progress)
    }

    fn records_ahead(
        &mut self,
        instances: &dyn Instances,
        range: Range<usize>,
        ahead: usize,
        cancel: &AtomicBool,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Computed> {
        let ahead = ahead.min(self.ahead());
        records(instances, [range.start, range.len(), ahead], self, cancel, progress)
    }

    fn ahead(&self) -> usize {
        AHEAD * self.least()
    }

    fn busy_with(&self, _: usize, starts: usize) -> usize {
        self.least().div_ceil(starts)
    }

    fn at_once(&self, instances: usize) -> usize {
        instances.max(BLOCK)
    }
}

/// The records of a range from a GPU, its start and length, with so many instances ahead; only the last analysis counts as progress, and
/// only what has all of them is done.
fn records(
    spec: &dyn Instances,
    [first, wanted, ahead]: [usize; 3],
    Gpu { sessions, crews, chunk, begun }: &mut Gpu,
    cancel: &AtomicBool,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Computed> {
    let (eigenvalues, transients) = (spec.linear(), spec.response());
    let before = begun.take().filter(|begun| transients && begun.of == address(spec) && begun.first == first);
    let (taken, mut records) = before.map_or((0, Vec::new()), |begun| (begun.taken, begun.records));
    let total = if transients { records.len().max(wanted + ahead) } else { wanted };
    records.reserve(total - records.len());
    if eigenvalues {
        let progress = if transients { &|_: usize| {} } else { progress };
        let (known, devices) = (records.len(), (&mut sessions[..], *chunk));
        let ended =
            linear::on_all(spec, first + known..first + total, devices, cancel, progress, &mut records);
        if let Err(why) = ended {
            // What has only its eigenvalues is not done where more is asked for. What was begun before is, but for that which may
            // end otherwise in double precision.
            let is_done = |record: &Record| {
                !transients || record.outcome.is_some() && !record.status.may_come_through()
            };
            for record in records.iter_mut().filter(|record| !is_done(record)) {
                *record = Record::NOT_COMPUTED;
            }
            records.truncate(wanted);
            return Computed::new(records, wanted, Err(counted_from(first + known, why)));
        }
    }
    let mut ended = Ok(());
    if transients {
        records.resize(total, Record::default());
        let devices = (&mut sessions[..], crews, *chunk);
        let of_all = [first, wanted, taken];
        match response::complete(spec, of_all, devices, cancel, progress, &mut records) {
            Ok(taken) => {
                let behind = records.split_off(wanted);
                records.shrink_to_fit();
                let (of, first, taken) = (address(spec), first + wanted, taken - wanted);
                let next = Begun { of, first, taken, records: behind };
                *begun = Some(next).filter(|begun| !begun.records.is_empty());
            }
            Err(why) => {
                records.truncate(wanted);
                ended = Err(counted_from(first, why));
            }
        }
    }
    Computed::new(records, wanted, ended)
}

/// An error of a range that starts at `first`, its instance counted from the start of the sweep.
fn counted_from(first: usize, why: Error) -> Error {
    match why {
        Error::Unwritten { instance } => Error::Unwritten { instance: first + instance },
        other => other,
    }
}
