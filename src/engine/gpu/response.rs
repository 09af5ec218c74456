//! The response of a sweep on a GPU: stretch by stretch on the device, from stretch to stretch as jobs of the engine of the CPU
//! on the host.

use std::ops::Range;
use std::sync::atomic::AtomicBool;

use rayon::prelude::*;

use crate::engine::error::{Error, Result};
use crate::engine::gpu::chunks::{Batch, Session, software_chunk};
use crate::engine::gpu::columns::{lane_words, word_major};
use crate::engine::gpu::device::Device;
use crate::engine::gpu::run::{ChunkResult, Drive};
use crate::engine::instances::Instances;
use crate::engine::judged::{kind_of, take_response};
use crate::engine::kernel::source::{FLAG_STATUS, SETTING_WORDS};
use crate::engine::lanes::again;
use crate::engine::lanes::again::records_again;
use crate::engine::lanes::job::Part;
use crate::engine::lanes::march::{Settings, Terms};
use crate::engine::lanes::{Lanes, ORDER, tolerance};
use crate::engine::march::kernel::{MOST_PIECES, kernel_for};
use crate::engine::march::marching::{Group, Marching, Stretch, Way, groups};
use crate::engine::march::table::{flag, state};
use crate::engine::outcome::Outcome;
use crate::engine::precision::Precision;
use crate::engine::record::Record;
use crate::model::status::Status;

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
    (session, chunk): (&mut Session, Option<usize>),
    cancel: &AtomicBool,
    progress: &(dyn Fn(usize) + Sync),
    records: &mut [Record],
) -> Result<()> {
    match session.device().precision() {
        Precision::F32 => {
            let ended = complete_in::<f32>(spec, first, (session, chunk), cancel, progress, records);
            records_again(spec, first, records, cancel);
            ended
        }
        Precision::F64 => complete_in::<f64>(spec, first, (session, chunk), cancel, progress, records),
    }
}

fn complete_in<R: Lanes>(
    spec: &dyn Instances,
    first: usize,
    (session, chunk): (&mut Session, Option<usize>),
    cancel: &AtomicBool,
    progress: &(dyn Fn(usize) + Sync),
    records: &mut [Record],
) -> Result<()> {
    let way = Way::new::<R>(spec.plan());
    let mut settings = [0; SETTING_WORDS];
    settings[0] = way.tolerance.to_bits();
    // A lane ends with every stretch.
    let drive = Drive {
        offset: 0,
        settings,
        steps: None,
        most_dispatches: u64::MAX,
        cancel,
        counts: false,
        progress,
    };
    let (chunk, total) = (chunk_size::<R>(spec, session, chunk), records.len());
    let prepare = |range: Range<usize>| {
        let begun: Vec<_> = range
            .into_par_iter()
            .filter_map(|index| {
                let mut one = Marching::<R>::new(index, &spec.instance(first + index), &way).ok()?;
                let next = one.next(&way)?;
                Some((one, next))
            })
            .collect();
        batches(begun)
    };
    let accept = |range: Range<usize>, again: bool, results: Vec<(Vec<Marching<R>>, ChunkResult<R>)>| {
        let mut live = vec![again; range.len()];
        let mut going = Vec::new();
        let mut over = Vec::new();
        for (marching, result) in results {
            let count = marching.len();
            let taken: Vec<_> = marching
                .into_par_iter()
                .enumerate()
                .map(|(lane, mut one)| {
                    let words = lane_words(&result, [state::WORDS, flag::WORDS], lane, count);
                    if result.cancelled && words.1[FLAG_STATUS] == Status::Unwritten as u32 {
                        return Ok((one, None, false));
                    }
                    one.take(&words).ok_or(Error::Unwritten { instance: one.index })?;
                    let next = one.next(&way);
                    Ok((one, next, true))
                })
                .collect::<Result<_>>()?;
            for (one, next, known) in taken {
                live[one.index - range.start] = true;
                match next {
                    Some(_) if result.cancelled => records[one.index] = Record::NOT_COMPUTED,
                    Some(next) => going.push((one, next)),
                    None if known => over.push(one),
                    None => records[one.index] = Record::NOT_COMPUTED,
                }
            }
        }
        for index in range.clone().filter(|index| !live[index - range.start]) {
            let begun = Marching::<R>::new(index, &spec.instance(first + index), &way);
            // It cannot start, or was over before its first stretch.
            match begun.map(|mut one| (one.next(&way).is_none(), one)) {
                Ok((true, one)) => over.push(one),
                Ok((false, _)) => return Err(Error::Unwritten { instance: index }),
                Err(status) => take(spec, [first, index], records, &Outcome { status, ..Outcome::default() }),
            }
        }
        for (index, outcome) in outcomes(over, &way, cancel) {
            take(spec, [first, index], records, &outcome);
        }
        Ok(batches(going))
    };
    let ended = session.each(total, chunk, &drive, prepare, accept);
    // What a chunk that never came to its end would have filled.
    for record in records.iter_mut().filter(|record| record.outcome.is_none()) {
        *record = Record::NOT_COMPUTED;
    }
    ended
}

/// Puts an outcome into its record.
fn take(spec: &dyn Instances, [first, index]: [usize; 2], records: &mut [Record], outcome: &Outcome) {
    let instance = spec.instance(first + index);
    let kind = kind_of(spec, &instance, &records[index]);
    take_response(&mut records[index], &instance, kind, outcome);
}

/// Most instances of one chunk.
fn chunk_size<R: Lanes>(spec: &dyn Instances, session: &Session, chunk: Option<usize>) -> usize {
    let largest = kernel_for(spec.pieces().min(MOST_PIECES))
        .map_or(usize::MAX, |(kernel, _)| session.chunk_size::<R>(kernel));
    let kept = if session.device().is_software() { software_chunk() } else { usize::MAX };
    chunk.unwrap_or(usize::MAX).min(kept).min(largest)
}

/// The outcomes of runs that are over. What the Fourier sums of the one pass do not tell, a second pass does, on the CPU: it
/// is rarely needed.
fn outcomes<R: Lanes>(mut over: Vec<Marching<R>>, way: &Way, cancel: &AtomicBool) -> Vec<(usize, Outcome)> {
    let settings =
        Settings { plan: &way.plan, tolerance: f64::from(way.tolerance), terms: Terms::default(), cancel };
    over.par_iter_mut().for_each(|one| {
        R::run(std::slice::from_mut(&mut *one.job), &[Part::Phase], false, settings);
    });
    over.into_iter().map(|one| (one.index, one.job.outcome(&way.plan))).collect()
}

/// The batches of some stretches.
fn batches<R: Lanes>(stretches: Vec<(Marching<R>, Stretch<R>)>) -> Vec<Batch<R, Vec<Marching<R>>>> {
    let batch = |Group { form, marching, rows }: Group<R>| {
        let (kernel, choices) = form.kernel()?;
        let inputs = word_major(form.inputs(), rows.len(), |row| &rows[row].inputs);
        let state = word_major(state::WORDS, rows.len(), |row| &rows[row].state);
        let flags = word_major(flag::WORDS, rows.len(), |row| &rows[row].flags);
        Some(Batch { kernel: *kernel, choices, inputs, before: Some((state, flags)), memory: marching })
    };
    groups(stretches).into_iter().filter_map(batch).collect()
}
