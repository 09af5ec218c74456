//! A GPU as an engine: the eigenvalue analysis, then the response, by its kernels.

use std::ops::Range;
use std::sync::atomic::AtomicBool;

use rayon::prelude::*;

use crate::engine::Engine;
use crate::engine::backend::Backend;
use crate::engine::computation::Computation;
use crate::engine::computed::Computed;
use crate::engine::error::{Error, Result};
use crate::engine::gpu::chunks::{Session, software_chunk};
use crate::engine::gpu::device::Device;
use crate::engine::gpu::response::{Crews, MOST_LANES};
use crate::engine::gpu::{linear, response};
use crate::engine::instances::Instances;
use crate::engine::kernel::linear::METHOD;
use crate::engine::lanes::records::linear as on_cpu;
use crate::engine::precision::Precision;
use crate::engine::record::Record;

/// A GPU in software takes so many at once, for which it needs minutes, and whatever takes several starts of each.
const BLOCK: usize = 65_536;

/// How much devices take at once.
#[derive(Clone, Copy, Debug)]
struct Room {
    /// The least instances of a range.
    range: usize,
    /// Most of those behind it that each device begins.
    ahead: usize,
    /// The same of runs until settled, of which the last of a range take five times as long as most.
    ahead_unsettled: usize,
    /// Most lanes in one of the buffers of a device.
    lanes: usize,
}

impl Room {
    /// Where one of the devices is software.
    fn of_software() -> Room {
        Room { range: BLOCK, ahead: 2 * BLOCK, ahead_unsettled: 2 * BLOCK, lanes: software_chunk() }
    }

    /// Where all are hardware: begun behind a range are as many as there are lanes in three buffers, or four times as many.
    const OF_HARDWARE: Room =
        Room { range: BLOCK, ahead: 3 * MOST_LANES, ahead_unsettled: 12 * MOST_LANES, lanes: MOST_LANES };
}

/// GPUs that share the work; their kernels stay compiled.
#[derive(Debug)]
pub struct Gpu {
    sessions: Vec<Session>,
    crews: Crews,
    chunk: Option<usize>,
    room: Room,
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
        let room =
            if devices.iter().any(Device::is_software) { Room::of_software() } else { Room::OF_HARDWARE };
        let sessions = devices.into_iter().map(Session::new).collect();
        Gpu { sessions, crews: Crews::default(), chunk, room, begun: None }
    }

    /// These, which take as much at once as hardware whatever they are: what that needs of memory can be measured without any.
    #[must_use]
    pub fn as_hardware(self) -> Gpu {
        Gpu { room: Room::OF_HARDWARE, ..self }
    }
}

impl Engine for Gpu {
    fn backend(&self) -> Backend {
        Backend::Gpu
    }

    fn precision(&self) -> Precision {
        self.sessions[0].device().precision()
    }

    fn computations(&self, instances: &dyn Instances) -> [Computation; 2] {
        let device = self.sessions[0].device();
        let names: Vec<String> =
            self.sessions.iter().map(|one| one.device().describe().to_string()).collect();
        let on_device = |method| Computation {
            backend: Backend::Gpu.name().to_owned(),
            precision: device.precision().to_string(),
            method,
            adapter: Some(names.join("; ")),
            strict: Some(device.strict()),
        };
        let eigenvalues = if instances.response() { on_cpu() } else { on_device(METHOD.to_owned()) };
        [eigenvalues, on_device(response::method(device, instances.plan().steps_per_period))]
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
        let ahead = ahead.min(self.ahead(instances));
        records(instances, [range.start, range.len(), ahead], self, cancel, progress)
    }

    fn ahead(&self, instances: &dyn Instances) -> usize {
        let Room { ahead, ahead_unsettled, .. } = self.room;
        let each = if instances.plan().settle_limit.is_some() { ahead_unsettled } else { ahead };
        each * self.sessions.len()
    }

    fn busy_with(&self, _: usize, starts: usize) -> usize {
        self.room.range.div_ceil(starts)
    }

    fn at_once(&self, instances: usize) -> usize {
        instances.max(BLOCK)
    }
}

/// The records of a range from a GPU, its start and length, with so many instances ahead. Eigenvalues alone are computed there, those
/// beside transients on the host, which has the instance at hand when its transient is over: they take no longer than what the host does
/// to send them.
fn records(
    spec: &dyn Instances,
    [first, wanted, ahead]: [usize; 3],
    Gpu { sessions, crews, chunk, room, begun }: &mut Gpu,
    cancel: &AtomicBool,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Computed> {
    if !spec.response() {
        let (mut records, devices) = (Vec::with_capacity(wanted), (&mut sessions[..], *chunk));
        let ended = linear::on_all(spec, first..first + wanted, devices, cancel, progress, &mut records);
        return Computed::new(records, wanted, ended.map_err(|why| counted_from(first, why)));
    }
    let before = begun.take().filter(|begun| begun.of == address(spec) && begun.first == first);
    let (taken, mut records) = before.map_or((0, Vec::new()), |begun| (begun.taken, begun.records));
    let fresh = (wanted + ahead).saturating_sub(records.len());
    // By all threads: into memory that the system has still to give.
    records.par_extend(rayon::iter::repeat_n(Record::default(), fresh));
    let devices = (&mut sessions[..], crews, chunk.unwrap_or(usize::MAX).min(room.lanes));
    let ended = response::complete(spec, [first, wanted, taken], devices, cancel, progress, &mut records);
    // Nothing was begun of those that were not taken.
    records.truncate(ended.as_ref().map_or(wanted, |taken| *taken));
    let behind: Vec<Record> = records.par_drain(wanted..).collect();
    records.shrink_to_fit();
    if let Ok(taken) = &ended {
        let (of, first, taken) = (address(spec), first + wanted, taken - wanted);
        let next = Begun { of, first, taken, records: behind };
        *begun = Some(next).filter(|begun| !begun.records.is_empty());
    }
    Computed::new(records, wanted, ended.map(|_| ()).map_err(|why| counted_from(first, why)))
}

/// An error of a range that starts at `first`, its instance counted from the start of the sweep.
fn counted_from(first: usize, why: Error) -> Error {
    match why {
        Error::Unwritten { instance } => Error::Unwritten { instance: first + instance },
        other => other,
    }
}
