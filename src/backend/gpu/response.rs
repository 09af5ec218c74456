//! The response of a sweep on a GPU: scenes on the host in f64, narrowed once, outcomes in SI.

use std::collections::BTreeMap;
use std::num::NonZero;
use std::ops::Range;
use std::thread::available_parallelism;

use rayon::prelude::*;

use super::chunks::{Batch, Session};
use super::run::{ChunkResult, Drive};
use crate::backend::choice::Options;
use crate::backend::take_response;
use crate::error::{Error, Result};
use crate::kernel::record;
use crate::kernel::response::{
    KERNEL, MOST_PIECES, TOLERANCE, choices, kernel_for, law_of, outcome, segments, words,
};
use crate::kernel::scalar::Real;
use crate::kernel::scene::Law;
use crate::kernel::series::ORDER;
use crate::kernel::source::{self, FLAG_STATUS, Precision, SETTING_WORDS, WORKGROUP_SIZE};
use crate::linear;
use crate::map::Record;
use crate::outcome::{Outcome, Status};
use crate::response::{Plan, Scene};
use crate::spec::{Instance, Spec};

/// The method in a manifest.
#[must_use]
pub fn method() -> String {
    format!("Taylor series of order {ORDER}, truncation below {TOLERANCE:e}, events located in the step")
}

/// Whether a GPU computes the response of a sweep, where it is asked for.
///
/// # Errors
/// When no kernel holds its friction table.
pub fn check(spec: &Spec) -> Result<()> {
    let rows = pieces_of(spec);
    if spec.analysis.response && rows > MOST_PIECES {
        return Err(Error::LongTable { rows, limit: MOST_PIECES });
    }
    Ok(())
}

/// The pieces of the longest law of a sweep.
fn pieces_of(spec: &Spec) -> usize {
    spec.table.as_ref().map_or(0, |table| table.velocity.len()).max(2)
}

/// Completes the records of the instances from `first` on of a sweep with their response; when it ends early,
/// those without are not computed. Instances in errors count from `first`.
///
/// # Errors
/// When the device fails, or the run is cancelled.
pub fn complete(
    spec: &Spec,
    first: usize,
    session: &mut Session,
    options: &Options,
    progress: &(dyn Fn(usize) + Sync),
    records: &mut [Record],
) -> Result<()> {
    match session.device().precision() {
        Precision::F32 => complete_in::<f32>(spec, first, session, options, progress, records),
        Precision::F64 => complete_in::<f64>(spec, first, session, options, progress, records),
    }
}

/// Most instances of one chunk on a software adapter. Its lanes advance together and come to their ends
/// together: in one chunk of a whole sweep nothing would be finished for a run that is stopped to keep. Eight
/// workgroups for each core cost no time against such a chunk (four cost 5 %, two a quarter).
#[must_use]
pub fn software_chunk() -> usize {
    8 * WORKGROUP_SIZE as usize * available_parallelism().map_or(1, NonZero::get)
}

/// Most instances of one chunk.
fn chunk_size<R: Real>(spec: &Spec, session: &Session, options: &Options) -> usize {
    let largest = kernel_for(pieces_of(spec)).map_or(&KERNEL, |(kernel, _)| kernel);
    let kept = if session.device().is_software() { software_chunk() } else { usize::MAX };
    options.chunk.unwrap_or(usize::MAX).min(kept).min(session.chunk_size::<R>(largest))
}

/// What selects a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Form {
    law: Law,
    pieces: usize,
    ramp: bool,
}

fn complete_in<R: Real>(
    spec: &Spec,
    first: usize,
    session: &mut Session,
    options: &Options,
    progress: &(dyn Fn(usize) + Sync),
    records: &mut [Record],
) -> Result<()> {
    let plan = Plan::new(spec);
    let chunk = chunk_size::<R>(spec, session, options);
    let mut settings = [0; SETTING_WORDS];
    settings[0] = TOLERANCE.to_bits();
    let drive = Drive {
        offset: 0,
        settings,
        steps: None,
        // Every lane ends by itself: its steps, their parts and its events are counted.
        most_dispatches: u64::MAX,
        cancel: options.cancel(),
        progress,
    };
    let total = records.len();
    let prepare = |range: Range<usize>| {
        let words = |index: usize| words_of(&spec.instance(first + index), &plan);
        let prepared: Vec<Option<(Form, Vec<R>)>> = range.clone().into_par_iter().map(words).collect();
        let mut batches: BTreeMap<Form, (Vec<usize>, Vec<Vec<R>>)> = BTreeMap::new();
        for (index, one) in range.zip(prepared) {
            if let Some((form, words)) = one {
                let (indices, rows) = batches.entry(form).or_default();
                indices.push(index);
                rows.push(words);
            }
        }
        batches.into_iter().map(|(form, (indices, rows))| batch(form, indices, &rows)).collect()
    };
    let accept = |range: Range<usize>, results: Vec<(Vec<usize>, ChunkResult<R>)>| {
        let mut live = vec![false; range.len()];
        for (indices, result) in results {
            let done: Vec<Record> = (0..indices.len())
                .into_par_iter()
                .map(|lane| {
                    let index = indices[lane];
                    let words = lane_words(&result, lane, indices.len());
                    finished(spec, &plan, [first, index], records[index], result.cancelled, &words)
                })
                .collect::<Result<_>>()?;
            for (index, record) in indices.into_iter().zip(done) {
                live[index - range.start] = true;
                records[index] = record;
            }
        }
        for index in range.clone().filter(|index| !live[index - range.start]) {
            let instance = spec.instance(first + index);
            let status = Scene::new(&instance, plan.start).err().unwrap_or(Status::Unwritten);
            take(spec, &instance, &mut records[index], &Outcome { status, ..Outcome::default() });
        }
        Ok(())
    };
    let ended = session.each(total, chunk, &drive, prepare, accept);
    // What a chunk that never came to its end would have filled.
    for record in records.iter_mut().filter(|record| record.outcome.is_none()) {
        *record = Record::NOT_COMPUTED;
    }
    ended
}

/// Puts an outcome into its record; the type of the equilibrium is that of the linear analysis, where there
/// is one.
fn take(spec: &Spec, instance: &Instance, record: &mut Record, outcome: &Outcome) {
    let kind = if spec.analysis.linear { record.kind } else { linear::analyse(instance).0 };
    take_response(record, instance, kind, outcome);
}

/// The kernel and the words of an instance; `None` when it cannot start.
fn words_of<R: Real>(instance: &Instance, plan: &Plan) -> Option<(Form, Vec<R>)> {
    let scene = Scene::new(instance, plan.start).ok()?;
    let &(_, pieces) = kernel_for(scene.model.law.pieces.len())?;
    let segments = segments(&scene, plan);
    let ramp = segments.iter().any(|segment| segment[3] != 0.0);
    let packed = words(&scene, &segments, pieces);
    let narrow = packed.into_iter().map(R::from_f64).collect();
    Some((Form { law: law_of(instance.law.kind()), pieces, ramp }, narrow))
}

/// The instances of a chunk that share a kernel.
fn batch<R: Real>(form: Form, indices: Vec<usize>, rows: &[Vec<R>]) -> Batch<R, Vec<usize>> {
    let kernel = kernel_for(form.pieces).map_or(KERNEL, |(kernel, _)| *kernel);
    let mut inputs = vec![R::ZERO; rows.len() * source::words(kernel.inputs)];
    inputs.par_chunks_mut(rows.len()).enumerate().for_each(|(word, column)| {
        for (value, row) in column.iter_mut().zip(rows) {
            *value = row[word];
        }
    });
    Batch { kernel, choices: choices(form.law, form.ramp).to_vec(), inputs, memory: indices }
}

/// State and flags of lane `lane` of `count`.
fn lane_words<R: Real>(result: &ChunkResult<R>, lane: usize, count: usize) -> (Vec<R>, Vec<u32>) {
    let of_lane = |word: usize| word * count + lane;
    let state = (0..source::words(KERNEL.state)).map(|word| result.state[of_lane(word)]).collect();
    let flags = (0..source::words(KERNEL.flags)).map(|word| result.flags[of_lane(word)]).collect();
    (state, flags)
}

/// The record of instance `first + index`, completed from the words of its lane; not computed when the chunk was
/// cancelled before the lane's end.
///
/// # Errors
/// Those of [`outcome_from`].
fn finished<R: Real>(
    spec: &Spec,
    plan: &Plan,
    [first, index]: [usize; 2],
    mut record: Record,
    cancelled: bool,
    (state, flags): &(Vec<R>, Vec<u32>),
) -> Result<Record> {
    if cancelled && flags[FLAG_STATUS] == Status::Unwritten as u32 {
        return Ok(Record::NOT_COMPUTED);
    }
    let instance = spec.instance(first + index);
    let Ok(scene) = Scene::new(&instance, plan.start) else {
        return Err(Error::Unwritten { instance: index });
    };
    take(spec, &instance, &mut record, &outcome_from(&scene, plan, index, state, flags)?);
    Ok(record)
}

/// The outcome of instance `index` from the words of its lane.
///
/// # Errors
/// When they are no finished lane, or one that says it came to its end and did not.
pub fn outcome_from<R: Real>(
    scene: &Scene,
    plan: &Plan,
    index: usize,
    state: &[R],
    flags: &[u32],
) -> Result<Outcome> {
    let lane = record::read(state, flags).ok_or(Error::Unwritten { instance: index })?;
    let segments = segments(scene, plan);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole numbers of steps")]
    let wanted: usize = segments.iter().map(|segment| segment[0] as usize).sum();
    let found = lane.iterations as usize;
    if lane.status == Status::Ok && (found < wanted || !lane.is_at_end(&segments)) {
        return Err(Error::Miscounted { kernel: KERNEL.name, found, wanted });
    }
    Ok(outcome(scene, plan, &segments, &lane))
}
