//! The eigenvalue analysis of a sweep on a GPU: words on the host in f64, narrowed once, results in SI.

use std::ops::Range;

use rayon::prelude::*;

use crate::engine::error::{Error, Result};
use crate::engine::gpu::chunks::{Batch, Session};
use crate::engine::gpu::run::{ChunkResult, Drive};
use crate::engine::instances::Instances;
use crate::engine::judged::begun;
use crate::engine::kernel::linear::KERNEL;
use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::source::{FLAG_STATUS, FLAG_STEPS, SETTING_WORDS};
use crate::engine::kernel::words::{INPUT_WORDS, STATE_WORDS, Words};
use crate::engine::precision::Precision;
use crate::engine::record::Record;
use crate::model::kind::InstabilityType;
use crate::model::linear::prepare;
use crate::model::status::Status;
use std::sync::atomic::AtomicBool;

/// The flag word of the type.
const FLAG_TYPE: usize = 2;

/// One dispatch finishes every instance.
const MOST_DISPATCHES: u64 = 4;

/// The method in a manifest.
#[must_use]
pub fn method() -> String {
    "two quadratic factors by a bracketed Newton search".to_owned()
}

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

/// An instance before the kernel: its record so far, and its words where it needs the kernel.
type Known = (Record, Option<Words>);

fn append_in<R: Real>(
    spec: &dyn Instances,
    range: Range<usize>,
    (session, chunk): (&mut Session, Option<usize>),
    cancel: &AtomicBool,
    progress: &(dyn Fn(usize) + Sync),
    records: &mut Vec<Record>,
) -> Result<()> {
    let chunk = chunk.unwrap_or(usize::MAX).min(session.chunk_size::<R>(&KERNEL));
    let drive = Drive {
        offset: 0,
        settings: [0; SETTING_WORDS],
        steps: None,
        most_dispatches: MOST_DISPATCHES,
        cancel,
        progress,
    };
    let first = range.start;
    let prepare = |part: Range<usize>| {
        let known: Vec<Known> = part.into_par_iter().map(|index| known(spec, first + index)).collect();
        let inputs = inputs(&known);
        Batch { inputs, memory: known }
    };
    let accept = |known: Vec<Known>, result: ChunkResult<R>| take(records, known, &result);
    session.each(&KERNEL, [range.len(), chunk], &drive, prepare, accept)
}

/// Instance `index` before the kernel.
fn known(spec: &dyn Instances, index: usize) -> Known {
    let instance = spec.instance(index);
    let prepared = prepare(&instance);
    let mut record = begun(&instance, &prepared);
    match prepared {
        Ok(prepared) => (record, Some(Words::new(&prepared))),
        Err(kind) => {
            record.kind = kind;
            (record, None)
        }
    }
}

/// The word-major inputs of those instances that need the kernel.
fn inputs<R: Real>(known: &[Known]) -> Vec<R> {
    let live: Vec<&Words> = known.iter().filter_map(|(_, words)| words.as_ref()).collect();
    let word = |word: usize| live.iter().map(move |one| R::from_f64(one.inputs[word]));
    let mut inputs = Vec::with_capacity(INPUT_WORDS * live.len());
    for k in 0..INPUT_WORDS {
        inputs.extend(word(k));
    }
    inputs
}

/// Completes the records of a chunk and appends them.
fn take<R: Real>(records: &mut Vec<Record>, known: Vec<Known>, result: &ChunkResult<R>) -> Result<()> {
    let count = known.iter().filter(|(_, words)| words.is_some()).count();
    let mut next = 0;
    for (mut record, words) in known {
        if let Some(words) = words {
            let flag = |word: usize| result.flags[word * count + next];
            let done = flag(FLAG_STEPS);
            if result.cancelled && flag(FLAG_STATUS) == Status::Unwritten as u32 {
                records.push(Record::NOT_COMPUTED);
                next += 1;
                continue;
            }
            if done != crate::engine::kernel::linear::POLYNOMIALS {
                let wanted = crate::engine::kernel::linear::POLYNOMIALS as usize;
                return Err(Error::Miscounted { kernel: KERNEL.name, found: done as usize, wanted });
            }
            let state: [f64; STATE_WORDS] = std::array::from_fn(|k| result.state[k * count + next].to_f64());
            complete(&mut record, &words, state, flag(FLAG_STATUS), flag(FLAG_TYPE));
            next += 1;
        }
        records.push(record);
    }
    Ok(())
}

/// Puts the kernel's results into a record.
fn complete(record: &mut Record, words: &Words, state: [f64; STATE_WORDS], status: u32, kind: u32) {
    let results: Option<(InstabilityType, _)> =
        (status == Status::Ok as u32).then(|| words.results(state, kind)).flatten();
    match results {
        Some((kind, linear)) => (record.kind, record.linear) = (Some(kind), Some(linear)),
        // Finite on the host but beyond the kernel's scalar.
        None => record.status = Status::NonFinite,
    }
}
