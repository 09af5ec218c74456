//! The response of a sweep on a GPU by the method of the engine of the CPU: stretch by stretch on the device, from stretch to
//! stretch as jobs on the host.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::atomic::AtomicBool;

use rayon::prelude::*;

use crate::engine::error::{Error, Result};
use crate::engine::fields;
use crate::engine::gpu::chunks::{Batch, Session, software_chunk};
use crate::engine::gpu::columns::{lane_words, word_major};
use crate::engine::gpu::device::Device;
use crate::engine::gpu::run::{ChunkResult, Drive};
use crate::engine::instances::Instances;
use crate::engine::judged::{kind_of, take_response};
use crate::engine::kernel::source::{FLAG_STATUS, SETTING_WORDS};
use crate::engine::lanes::job::{Job, Part};
use crate::engine::lanes::march::{Settings, Terms};
use crate::engine::lanes::{Lanes, ORDER, tolerance};
use crate::engine::march::kernel::{PIECES, choices, kernel_for};
use crate::engine::march::table::{flag, head, state};
use crate::engine::march::words::{Words, begin, take};
use crate::engine::method::pace::Turns;
use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::engine::precision::Precision;
use crate::engine::record::Record;
use crate::engine::scene::Scene;
use crate::model::status::Status;

/// What selects the kernel of a stretch: the part of the run, the pieces of the law, and whether the belt has a ramp.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Form {
    part: u32,
    pieces: usize,
    ramp: bool,
}

/// An instance on its way.
#[derive(Debug)]
struct Marching {
    index: usize,
    job: Box<Job<f32>>,
    /// The part of its run that it has come to; `None` before the first.
    part: Option<Part>,
    /// Whether that part may have another stretch.
    open: bool,
    /// How many pieces its kernel holds.
    pieces: usize,
}

impl Marching {
    /// Its next stretch and the kernel for it; `None` when nothing is left but a second pass over the window.
    fn next(&mut self, plan: &Plan, tolerance: f64) -> Option<(Form, Words<f32>)> {
        loop {
            if let Some(part) = self.part.filter(|_| self.open)
                && let Some(words) = begin(&mut self.job, part, plan, self.pieces)
            {
                let ramp = words.inputs[head::DRIVE] != 0.0;
                return Some((Form { part: part as u32, pieces: self.pieces, ramp }, words));
            }
            let part = match self.part {
                None => Part::Growth,
                Some(Part::Growth) => Part::Settle,
                Some(Part::Settle) => Part::Window,
                Some(_) if self.job.goes_on(plan) => Part::Growth,
                Some(_) => return None,
            };
            self.part = Some(part);
            self.open = self.job.enter(part, tolerance, false);
        }
    }

    /// Takes what has come of its stretch; `None` when the kernel cannot have made it.
    fn take(&mut self, (words, flags): &(Vec<f32>, Vec<u32>)) -> Option<()> {
        let part = self.part?;
        take(&mut self.job, part, words, flags)?;
        let ended = part == Part::Growth && !self.job.growing;
        self.open = self.job.state.status == Status::Unwritten && !ended;
        Some(())
    }
}

/// Whether a device may take this way: in f32, where operations need not be rounded by themselves.
#[must_use]
pub fn is_for(device: &Device) -> bool {
    device.precision() == Precision::F32 && !device.strict()
}

/// Whether it takes this way for some instances of a sweep: all their laws are of straight pieces.
pub fn takes(device: &Device, spec: &dyn Instances, first: usize, count: usize) -> bool {
    let straight = |index: usize| spec.instance(index).law.kind().form().is_straight();
    is_for(device) && (first..first + count).all(straight)
}

/// The method in a manifest, before that of other laws.
#[must_use]
pub fn method(steps_per_period: u32) -> String {
    let bound = tolerance(Precision::F32, steps_per_period);
    format!("laws of straight pieces: Taylor series of order {ORDER}, truncation below {bound:e}; others: ")
}

/// Completes records as [`crate::engine::gpu::response::complete`] does.
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
    let plan = spec.plan();
    let bound = tolerance(Precision::F32, plan.steps_per_period);
    let turns = Turns::new(ORDER, bound);
    let mut settings = [0; SETTING_WORDS];
    #[expect(clippy::cast_possible_truncation, reason = "the narrowing of a tolerance")]
    let narrow = bound as f32;
    settings[0] = narrow.to_bits();
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
    let (chunk, total) = (chunk_size(spec, session, chunk), records.len());
    let prepare = |range: Range<usize>| {
        let begun: Vec<_> = range
            .into_par_iter()
            .filter_map(|index| {
                let instance = spec.instance(first + index);
                let scene = Scene::planned(&instance, &plan).ok()?;
                let (_, pieces) = kernel_for(scene.model.law.pieces.len())?;
                let job = Box::new(Job::new(&instance, scene, &plan, &turns));
                let mut marching = Marching { index, job, part: None, open: false, pieces };
                let next = marching.next(&plan, bound);
                Some((marching, next))
            })
            .collect();
        batches(begun.into_iter().filter_map(|(marching, next)| Some((marching, next?))))
    };
    let accept = |range: Range<usize>, again: bool, results: Vec<(Vec<Marching>, ChunkResult<f32>)>| {
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
                    let next = one.next(&plan, bound);
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
        for (index, outcome) in outcomes(over, &plan, bound, cancel) {
            let instance = spec.instance(first + index);
            let kind = kind_of(spec, &instance, &records[index]);
            take_response(&mut records[index], &instance, kind, &outcome);
        }
        for index in range.clone().filter(|index| !live[index - range.start]) {
            let instance = spec.instance(first + index);
            let status = Scene::planned(&instance, &plan).err().unwrap_or(Status::Unwritten);
            let kind = kind_of(spec, &instance, &records[index]);
            let outcome = Outcome { status, ..Outcome::default() };
            take_response(&mut records[index], &instance, kind, &outcome);
        }
        Ok(batches(going.into_iter()))
    };
    let ended = session.each(total, chunk, &drive, prepare, accept);
    // What a chunk that never came to its end would have filled.
    for record in records.iter_mut().filter(|record| record.outcome.is_none()) {
        *record = Record::NOT_COMPUTED;
    }
    ended
}

/// Most instances of one chunk.
fn chunk_size(spec: &dyn Instances, session: &Session, chunk: Option<usize>) -> usize {
    let most = PIECES[PIECES.len() - 1];
    let largest = kernel_for(spec.pieces().min(most))
        .map_or(usize::MAX, |(kernel, _)| session.chunk_size::<f32>(kernel));
    let kept = if session.device().is_software() { software_chunk() } else { usize::MAX };
    chunk.unwrap_or(usize::MAX).min(kept).min(largest)
}

/// The outcomes of runs that are over. What the Fourier sums of the one pass do not tell, a second pass does, on the CPU: it
/// is rarely needed.
fn outcomes(
    mut over: Vec<Marching>,
    plan: &Plan,
    tolerance: f64,
    cancel: &AtomicBool,
) -> Vec<(usize, Outcome)> {
    let settings = Settings { plan, tolerance, terms: Terms::default(), cancel };
    over.par_iter_mut().for_each(|one| {
        f32::run(std::slice::from_mut(&mut *one.job), &[Part::Phase], false, settings);
    });
    over.into_iter().map(|one| (one.index, one.job.outcome(plan))).collect()
}

/// Stretches that share a kernel.
fn batches(
    stretches: impl Iterator<Item = (Marching, (Form, Words<f32>))>,
) -> Vec<Batch<f32, Vec<Marching>>> {
    let mut forms: BTreeMap<Form, (Vec<Marching>, Vec<Words<f32>>)> = BTreeMap::new();
    for (marching, (form, words)) in stretches {
        let (all, rows) = forms.entry(form).or_default();
        all.push(marching);
        rows.push(words);
    }
    forms
        .into_iter()
        .filter_map(|(form, (memory, rows))| {
            let (kernel, _) = kernel_for(form.pieces)?;
            let part = memory.first()?.part?;
            let inputs = word_major(fields::words(kernel.inputs), rows.len(), |row| &rows[row].inputs);
            let state = word_major(state::WORDS, rows.len(), |row| &rows[row].state);
            let flags = word_major(flag::WORDS, rows.len(), |row| &rows[row].flags);
            let choices = choices(part, form.ramp);
            Some(Batch { kernel: *kernel, choices, inputs, before: Some((state, flags)), memory })
        })
        .collect()
}
