//! The response of a sweep on a GPU: stretch by stretch on the device, from stretch to stretch as jobs of the engine of the CPU
//! on the host.

use std::sync::atomic::AtomicBool;

use crate::engine::error::{Error, Result};
use crate::engine::gpu::chunks::{Session, software_chunk};
use crate::engine::gpu::device::Device;
use crate::engine::gpu::stream::Stream;
use crate::engine::instances::Instances;
use crate::engine::kernel::source::Kernel;
use crate::engine::lanes::again;
use crate::engine::lanes::again::records_again;
use crate::engine::lanes::{Lanes, ORDER, tolerance};
use crate::engine::march::flow::Asked;
use crate::engine::march::kernel::{MOST_PIECES, kernel_for};
use crate::engine::precision::Precision;
use crate::engine::record::Record;

/// Most instances at a time in one of the buffers of a GPU: the host keeps some 4 KiB of each, and 32 768 are twice what the
/// largest of today has in its registers.
const MOST_LANES: usize = 32_768;

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

/// Completes the records of the instances from `first` on of a sweep with their response; when it ends early,
/// those without are not computed. Instances in errors count from `first`.
///
/// # Errors
/// When the device fails, or the run is cancelled.
pub fn complete(
    spec: &dyn Instances,
    first: usize,
    (sessions, chunk): (&mut [Session], Option<usize>),
    cancel: &AtomicBool,
    progress: &(dyn Fn(usize) + Sync),
    records: &mut [Record],
) -> Result<()> {
    match sessions[0].device().precision() {
        Precision::F32 => {
            let ended = complete_in::<f32>(spec, first, (sessions, chunk), cancel, progress, records);
            records_again(spec, first, records, cancel);
            ended
        }
        Precision::F64 => complete_in::<f64>(spec, first, (sessions, chunk), cancel, progress, records),
    }
}

fn complete_in<R: Lanes>(
    spec: &dyn Instances,
    first: usize,
    (sessions, chunk): (&mut [Session], Option<usize>),
    cancel: &AtomicBool,
    progress: &(dyn Fn(usize) + Sync),
    records: &mut [Record],
) -> Result<()> {
    let Some((kernel, _)) = kernel_for(spec.pieces()) else {
        return Err(Error::LongTable { rows: spec.pieces(), limit: MOST_PIECES });
    };
    let most = sessions.iter().map(|session| most_lanes::<R>(session, kernel)).min().unwrap_or(1);
    let ended = Stream::<R>::new(Asked { spec, first, records }, cancel, progress)
        .run(sessions, chunk.unwrap_or(usize::MAX).min(most));
    // What a run that never came to its end would have filled.
    for record in records.iter_mut().filter(|record| record.outcome.is_none()) {
        *record = Record::NOT_COMPUTED;
    }
    ended
}

/// Most instances of a device at a time in one of its buffers.
fn most_lanes<R: Lanes>(session: &Session, kernel: &Kernel) -> usize {
    let kept = if session.device().is_software() { software_chunk() } else { MOST_LANES };
    kept.min(session.chunk_size::<R>(kernel))
}
