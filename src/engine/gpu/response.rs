//! The response of a sweep on a GPU: leg by leg on the device, from leg to leg as jobs of the engine of the CPU on the host.

use std::sync::atomic::AtomicBool;

use rayon::prelude::*;

use crate::engine::error::{Error, Result};
use crate::engine::gpu::chunks::Session;
use crate::engine::gpu::device::Device;
use crate::engine::gpu::stream::{Crew, Stream};
use crate::engine::instances::Instances;
use crate::engine::lanes::again;
use crate::engine::lanes::again::records_again;
use crate::engine::lanes::{Lanes, ORDER, tolerance};
use crate::engine::march::asked::{Asked, Tally};
use crate::engine::march::kernel::{MOST_PIECES, kernel_for};
use crate::engine::precision::Precision;
use crate::engine::record::Record;

/// Most instances at a time in one of the buffers of a GPU: the host keeps some 3 KiB of each. The registers of an H100 hold 50 688 of
/// the 168 that the window takes; what is beyond waits for a second turn, as long as the first. In 65 536 each took a third longer than
/// in 131 072, which is two turns against three.
pub(super) const MOST_LANES: usize = 49_152;

/// The method in a manifest.
#[must_use]
pub fn method(device: &Device, steps_per_period: u32) -> String {
    let again = again::note(device.precision());
    let bound = tolerance(device.precision(), steps_per_period);
    format!("Taylor series of order {ORDER}, truncation below {bound:e}, events located in the step{again}")
}

/// Whether a GPU computes the response of a sweep, where it is asked for.
///
/// # Errors
/// When no kernel holds its friction table, or its cycles are to be found, which kernels do not.
pub fn check(spec: &dyn Instances) -> Result<()> {
    if spec.response() && spec.plan().hunts {
        return Err(Error::CyclesOnGpu);
    }
    let rows = spec.pieces();
    if spec.response() && rows > MOST_PIECES {
        return Err(Error::LongTable { rows, limit: MOST_PIECES });
    }
    Ok(())
}

/// The lanes of some devices from run to run: their buffers, and the places of their instances.
#[derive(Debug, Default)]
pub(super) struct Crews {
    of_f32: Vec<Crew<f32>>,
    of_f64: Vec<Crew<f64>>,
}

/// Completes the records of the first `wanted` instances from `first` on of a sweep with their response; when it ends early,
/// those without are not computed. Of the others the devices may begin some; gives how many of all they have begun, where some were
/// in the call before. Instances in errors count from `first`.
///
/// # Errors
/// When the device fails, or the run is cancelled.
pub(super) fn complete(
    spec: &dyn Instances,
    [first, wanted, begun]: [usize; 3],
    (sessions, crews, lanes): (&mut [Session], &mut Crews, usize),
    cancel: &AtomicBool,
    progress: &(dyn Fn(usize) + Sync),
    records: &mut [Record],
) -> Result<usize> {
    match sessions[0].device().precision() {
        Precision::F32 => {
            let devices = (sessions, &mut crews.of_f32, lanes);
            let ended = complete_in(spec, [first, wanted, begun], devices, cancel, progress, records);
            records_again(spec, first, &mut records[..wanted], cancel);
            ended
        }
        Precision::F64 => {
            let devices = (sessions, &mut crews.of_f64, lanes);
            complete_in(spec, [first, wanted, begun], devices, cancel, progress, records)
        }
    }
}

fn complete_in<R: Lanes>(
    spec: &dyn Instances,
    [first, wanted, begun]: [usize; 3],
    (sessions, crews, lanes): (&mut [Session], &mut Vec<Crew<R>>, usize),
    cancel: &AtomicBool,
    progress: &(dyn Fn(usize) + Sync),
    records: &mut [Record],
) -> Result<usize> {
    let Some((kernel, _)) = kernel_for(spec.pieces()) else {
        return Err(Error::LongTable { rows: spec.pieces(), limit: MOST_PIECES });
    };
    let most = sessions.iter().map(|session| session.chunk_size::<R>(kernel)).min().unwrap_or(1);
    // What an earlier call has begun of other instances is nobody's.
    if crews.is_empty() || begun == 0 && crews.iter().any(Crew::has_instances) {
        *crews = Crew::of(sessions);
    }
    let done = records[..wanted].par_iter().filter(|record| record.outcome.is_some()).count();
    let tally = Tally::begun(begun, done);
    let asked = Asked::new(spec, [first, wanted], records, &tally);
    let devices = (sessions, lanes.min(most));
    let ended = Stream::new(asked, devices, cancel, progress).run(crews);
    // What a run that never came to its end would have filled.
    let without = records[..wanted].par_iter_mut().filter(|record| record.outcome.is_none());
    without.for_each(|record| *record = Record::NOT_COMPUTED);
    for crew in crews {
        crew.count_from(wanted);
    }
    ended.map(|()| tally.taken().min(records.len()))
}
