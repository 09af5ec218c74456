//! The eigenvalue analysis of a sweep on a GPU: words on the host in f64, narrowed once, results in SI.

use std::ops::Range;

use rayon::prelude::*;

use crate::engine::error::{Error, Result};
use crate::engine::gpu::chunks::{Batch, Session};
use crate::engine::gpu::run::{ChunkResult, Drive};
use crate::engine::instances::Instances;
use crate::engine::kernel::batch::{Known, inputs, known, take};
use crate::engine::kernel::linear::KERNEL;
use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::source::SETTING_WORDS;
use crate::engine::precision::Precision;
use crate::engine::record::Record;
use std::sync::atomic::AtomicBool;

/// One dispatch finishes every instance.
const MOST_DISPATCHES: u64 = 4;

/// As [`append`], on several devices, each with a part of the range.
///
/// # Errors
/// Those of [`append`], of the first part that has any.
pub fn on_all(
    spec: &dyn Instances,
    range: Range<usize>,
    (sessions, chunk): (&mut [Session], Option<usize>),
    cancel: &AtomicBool,
    progress: &(dyn Fn(usize) + Sync),
    records: &mut Vec<Record>,
) -> Result<()> {
    if let [session] = sessions {
        return append(spec, range, (session, chunk), cancel, progress, records);
    }
    let share = range.len().div_ceil(sessions.len()).max(1);
    let parts: Vec<(usize, Vec<Record>, Result<()>)> = sessions
        .par_iter_mut()
        .enumerate()
        .map(|(number, session)| {
            let start = (range.start + number * share).min(range.end);
            let part = start..(start + share).min(range.end);
            let mut made = Vec::with_capacity(part.len());
            let ended = append(spec, part, (session, chunk), cancel, progress, &mut made);
            (start - range.start, made, ended)
        })
        .collect();
    for (before, made, ended) in parts {
        records.extend(made);
        ended.map_err(|why| counted_behind(before, range.len(), why))?;
    }
    Ok(())
}

/// An error of a part of `total` instances that begins behind `before` of them.
fn counted_behind(before: usize, total: usize, why: Error) -> Error {
    match why {
        Error::Unwritten { instance } => Error::Unwritten { instance: before + instance },
        Error::Cancelled { done, .. } => Error::Cancelled { done: before + done, total },
        Error::DeviceLostAgain { why, done, .. } => {
            Error::DeviceLostAgain { why, done: before + done, total }
        }
        other => other,
    }
}

/// Appends the records of the instances `range` of a sweep with their linear part, in the order of its grid; when
/// it ends early, those behind them are not computed. Instances in errors count from the start of the range.
///
/// # Errors
/// When the device fails, the run is cancelled, or a result is in doubt.
pub fn append(
    spec: &dyn Instances,
    range: Range<usize>,
    (session, chunk): (&mut Session, Option<usize>),
    cancel: &AtomicBool,
    progress: &(dyn Fn(usize) + Sync),
    records: &mut Vec<Record>,
) -> Result<()> {
    match session.device().precision() {
        Precision::F32 => append_in::<f32>(spec, range, (session, chunk), cancel, progress, records),
        Precision::F64 => append_in::<f64>(spec, range, (session, chunk), cancel, progress, records),
    }
}

fn append_in<R: Real>(
    spec: &dyn Instances,
    range: Range<usize>,
    (session, chunk): (&mut Session, Option<usize>),
    cancel: &AtomicBool,
    progress: &(dyn Fn(usize) + Sync),
    records: &mut Vec<Record>,
) -> Result<()> {
    let chunk = chunk.unwrap_or(usize::MAX).min(session.chunk_size::<R>(&KERNEL));
    let drive =
        Drive { offset: 0, settings: [0; SETTING_WORDS], most_dispatches: MOST_DISPATCHES, cancel, progress };
    let first = range.start;
    let prepare = |part: Range<usize>| {
        let known: Vec<Known> = part.into_par_iter().map(|index| known(spec, first + index)).collect();
        let inputs = inputs(&known);
        Batch { inputs, memory: known }
    };
    let accept = |known: Vec<Known>, ChunkResult { state, flags, cancelled }: ChunkResult<R>| {
        take(records, known, (&state, &flags), cancelled)
    };
    session.each(&KERNEL, [range.len(), chunk], &drive, prepare, accept)
}
