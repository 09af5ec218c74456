//! The response of a sweep on a GPU: scenes on the host in f64, narrowed once, outcomes in SI.

use std::collections::BTreeMap;
use std::ops::Range;

use rayon::prelude::*;

use crate::engine::error::{Error, Result};
use crate::engine::fields;
use crate::engine::gpu::chunks::{Batch, Session, software_chunk};
use crate::engine::gpu::columns::{lane_words, word_major};
use crate::engine::gpu::device::Device;
use crate::engine::gpu::marched;
use crate::engine::gpu::run::{ChunkResult, Drive};
use crate::engine::instances::Instances;
use crate::engine::judged::{kind_of, take_response};
use crate::engine::kernel::lane::Lane;
use crate::engine::kernel::record;
use crate::engine::kernel::response::{KERNEL, MOST_PIECES, choices, kernel_for, words};
use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::scene::Segments;
use crate::engine::kernel::source::{FLAG_STATUS, SETTING_WORDS};
use crate::engine::kernel::steps::{ORDER, TOLERANCE};
use crate::engine::kernel::table::segment;
use crate::engine::kernel::windows::Windows;
use crate::engine::lanes::again;
use crate::engine::lanes::again::records_again;
use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::engine::precision::Precision;
use crate::engine::record::Record;
use crate::engine::scene::Scene;
use crate::model::instance::Instance;
use crate::model::piece::LawForm;
use crate::model::status::Status;
use std::sync::atomic::AtomicBool;

/// The method in a manifest.
#[must_use]
pub fn method(device: &Device, steps_per_period: u32) -> String {
    let again = again::note(device.precision());
    let marched = if marched::is_for(device) { marched::method(steps_per_period) } else { String::new() };
    format!(
        "{marched}Taylor series of order {ORDER}, truncation below {TOLERANCE:e}, events located in the step{again}"
    )
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
            let marches = marched::takes(session.device(), spec, first, records.len());
            let complete = if marches { marched::complete } else { complete_in::<f32> };
            let ended = complete(spec, first, (session, chunk), cancel, progress, records);
            records_again(spec, first, records, cancel);
            ended
        }
        Precision::F64 => complete_in::<f64>(spec, first, (session, chunk), cancel, progress, records),
    }
}

/// Most instances of one chunk.
fn chunk_size<R: Real>(spec: &dyn Instances, session: &Session, chunk: Option<usize>) -> usize {
    let largest = kernel_for(spec.pieces()).map_or(&KERNEL, |(kernel, _)| kernel);
    let kept = if session.device().is_software() { software_chunk() } else { usize::MAX };
    chunk.unwrap_or(usize::MAX).min(kept).min(session.chunk_size::<R>(largest))
}

/// The form of a scene, which selects the kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Form {
    law: LawForm,
    pieces: usize,
    ramp: bool,
}

fn complete_in<R: Real>(
    spec: &dyn Instances,
    first: usize,
    (session, chunk): (&mut Session, Option<usize>),
    cancel: &AtomicBool,
    progress: &(dyn Fn(usize) + Sync),
    records: &mut [Record],
) -> Result<()> {
    let plan = spec.plan();
    let chunk = chunk_size::<R>(spec, session, chunk);
    let mut settings = [0; SETTING_WORDS];
    settings[0] = TOLERANCE.to_bits();
    let drive = Drive {
        offset: 0,
        settings,
        steps: None,
        // Every lane ends by itself: its steps, their parts and its events are counted.
        most_dispatches: u64::MAX,
        cancel,
        // A lane ends with every window.
        counts: plan.settle_limit.is_none(),
        progress,
    };
    let total = records.len();
    let prepare = |range: Range<usize>| {
        let prepared: Vec<_> =
            range.into_par_iter().filter_map(|index| begin(spec, [first, index], &plan)).collect();
        let mut batches: BTreeMap<Form, Vec<Ready<R>>> = BTreeMap::new();
        for (form, ready) in prepared {
            batches.entry(form).or_default().push(ready);
        }
        batches.into_iter().map(|(form, ready)| batch(form, ready)).collect()
    };
    let accept = |range: Range<usize>, again: bool, results: Vec<(Vec<Running>, ChunkResult<R>)>| {
        let mut live = vec![again; range.len()];
        let mut batches = BTreeMap::new();
        for (running, result) in results {
            let count = running.len();
            let ends: Vec<End<R>> = running
                .into_par_iter()
                .enumerate()
                .map(|(lane, one)| {
                    let sizes = [fields::words(KERNEL.state), fields::words(KERNEL.flags)];
                    let words = lane_words(&result, sizes, lane, count);
                    end(spec, &plan, first, one, result.cancelled, &words)
                })
                .collect::<Result<_>>()?;
            for end in ends {
                match end {
                    End::NotComputed(index) => {
                        live[index - range.start] = true;
                        records[index] = Record::NOT_COMPUTED;
                    }
                    End::Outcome(index, outcome) => {
                        live[index - range.start] = true;
                        take(spec, &spec.instance(first + index), &mut records[index], &outcome);
                    }
                    End::Again(form, ready) => {
                        live[ready.running.index - range.start] = true;
                        batches.entry(form).or_insert_with(Vec::new).push(*ready);
                    }
                }
            }
        }
        for index in range.clone().filter(|index| !live[index - range.start]) {
            let instance = spec.instance(first + index);
            let status = Scene::planned(&instance, &plan).err().unwrap_or(Status::Unwritten);
            take(spec, &instance, &mut records[index], &Outcome { status, ..Outcome::default() });
        }
        Ok(batches.into_iter().map(|(form, ready)| batch(form, ready)).collect())
    };
    let ended = session.each(total, chunk, &drive, prepare, accept);
    // What a chunk that never came to its end would have filled.
    for record in records.iter_mut().filter(|record| record.outcome.is_none()) {
        *record = Record::NOT_COMPUTED;
    }
    ended
}

/// Puts an outcome into its record.
fn take(spec: &dyn Instances, instance: &Instance, record: &mut Record, outcome: &Outcome) {
    let kind = kind_of(spec, instance, record);
    take_response(record, instance, kind, outcome);
}

/// An instance on its way through the windows of its run.
#[derive(Debug)]
struct Running {
    index: usize,
    /// `None` for the one window of a fixed time, which is as soon made again as kept.
    windows: Option<Box<Windows>>,
}

/// An instance with what a kernel is to be given of it: its inputs, and the words it has come to before.
#[derive(Debug)]
struct Ready<R> {
    running: Running,
    inputs: Vec<R>,
    before: Option<(Vec<R>, Vec<u32>)>,
}

/// How an instance ended.
enum End<R> {
    /// Nothing: the run was cancelled before.
    NotComputed(usize),
    /// Its outcome.
    Outcome(usize, Box<Outcome>),
    /// Another window.
    Again(Form, Box<Ready<R>>),
}

/// The kernel and the words of an instance at its start; `None` when it cannot start.
fn begin<R: Real>(spec: &dyn Instances, [first, index]: [usize; 2], plan: &Plan) -> Option<(Form, Ready<R>)> {
    let instance = spec.instance(first + index);
    let scene = Scene::planned(&instance, plan).ok()?;
    let windows = Windows::new(&instance, &scene, plan);
    let segments = windows.segments;
    let windows = plan.settle_limit.is_some().then(|| Box::new(windows));
    ready(&instance, &scene, &segments, Running { index, windows }, None)
}

/// The kernel and the words of an instance.
fn ready<R: Real>(
    instance: &Instance,
    scene: &Scene,
    segments: &Segments,
    running: Running,
    before: Option<(Vec<R>, Vec<u32>)>,
) -> Option<(Form, Ready<R>)> {
    let &(_, pieces) = kernel_for(scene.model.law.pieces.len())?;
    let ramp = segments.iter().any(|words| words[segment::ACCELERATION] != 0.0);
    let inputs = words(scene, segments, pieces).into_iter().map(R::from_f64).collect();
    Some((Form { law: instance.law.kind().form(), pieces, ramp }, Ready { running, inputs, before }))
}

/// The instances of a chunk that share a kernel.
fn batch<R: Real>(form: Form, ready: Vec<Ready<R>>) -> Batch<R, Vec<Running>> {
    let kernel = kernel_for(form.pieces).map_or(KERNEL, |(kernel, _)| *kernel);
    let inputs = word_major(fields::words(kernel.inputs), ready.len(), |row| &ready[row].inputs);
    let before = ready.iter().map(|one| one.before.as_ref()).collect::<Option<Vec<_>>>().map(|before| {
        (
            word_major(fields::words(kernel.state), before.len(), |row| &before[row].0),
            word_major(fields::words(kernel.flags), before.len(), |row| &before[row].1),
        )
    });
    let memory = ready.into_iter().map(|one| one.running).collect();
    Batch { kernel, choices: choices(form.law, form.ramp).to_vec(), inputs, before, memory }
}

/// How an instance ended, from the words of its lane.
///
/// # Errors
/// Those of [`read_lane`].
fn end<R: Real>(
    spec: &dyn Instances,
    plan: &Plan,
    first: usize,
    running: Running,
    cancelled: bool,
    (state, flags): &(Vec<R>, Vec<u32>),
) -> Result<End<R>> {
    let index = running.index;
    if cancelled && flags[FLAG_STATUS] == Status::Unwritten as u32 {
        return Ok(End::NotComputed(index));
    }
    let instance = spec.instance(first + index);
    let Ok(scene) = Scene::planned(&instance, plan) else {
        return Err(Error::Unwritten { instance: index });
    };
    let mut windows = running.windows.unwrap_or_else(|| Box::new(Windows::new(&instance, &scene, plan)));
    let mut lane = read_lane(&windows.segments, index, state, flags)?;
    match windows.take(&scene, &mut lane) {
        Some(outcome) => Ok(End::Outcome(index, Box::new(outcome))),
        None if cancelled => Ok(End::NotComputed(index)),
        None => {
            let segments = windows.segments;
            let running = Running { index, windows: Some(windows) };
            let (form, ready) = ready(&instance, &scene, &segments, running, Some(record::write(&lane)))
                .ok_or(Error::Unwritten { instance: index })?;
            Ok(End::Again(form, Box::new(ready)))
        }
    }
}

/// The finished lane of instance `index` from its words.
///
/// # Errors
/// When they are no finished lane, or one that says it came to its end and did not.
pub fn read_lane<R: Real>(segments: &Segments, index: usize, state: &[R], flags: &[u32]) -> Result<Lane<R>> {
    let lane = record::read(state, flags).ok_or(Error::Unwritten { instance: index })?;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole numbers of steps")]
    let wanted: usize = segments.iter().map(|words| words[segment::STEPS] as usize).sum();
    let found = lane.iterations as usize;
    if lane.state.status == Status::Ok && (found < wanted || !lane.is_at_end(segments)) {
        return Err(Error::Miscounted { kernel: KERNEL.name, found, wanted });
    }
    Ok(lane)
}
