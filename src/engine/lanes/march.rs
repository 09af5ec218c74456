//! The lanes of a pass and the instances they work on: lanes are refilled as soon as they are done.

use std::f64::consts::TAU;
use std::sync::atomic::{AtomicBool, Ordering};

use pulp::{Arch, Simd};

use crate::engine::lanes::block::{Block, event_of};
use crate::engine::lanes::cycle::NEVER;
use crate::engine::lanes::job::{Job, Part};
use crate::engine::lanes::observe::Sums;
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::spectrum::{COMPONENTS, Spectrum};
use crate::engine::lanes::vector::Vector;
use crate::engine::plan::Plan;
use crate::engine::scene::MOST_STEPS;
use crate::model::status::Status;

/// Steps of all lanes after which a wish to stop is looked for: some milliseconds.
const TURNS: u32 = 4096;

/// On what terms an engine runs: no result that comes to its end depends on them.
#[derive(Clone, Copy, Debug)]
pub struct Terms {
    /// Most steps of an instance.
    pub most_steps: u32,
    /// The instruction set of the lanes.
    pub instructions: Arch,
}

impl Default for Terms {
    /// As many steps as a run may have, in the widest registers of this machine.
    fn default() -> Terms {
        Terms { most_steps: MOST_STEPS, instructions: Arch::new() }
    }
}

/// The settings that all instances of a pass share.
#[derive(Clone, Copy, Debug)]
pub struct Settings<'a> {
    /// How long they run, and in which steps.
    pub plan: &'a Plan,
    /// Bound on the truncation of a step.
    pub tolerance: f64,
    /// Most steps of an instance, and the instruction set.
    pub terms: Terms,
    /// Set to stop early; results that are under way are lost then.
    pub cancel: &'a AtomicBool,
}

/// Lanes and the instances they work on.
pub struct Lanes<'a, S: Simd, T: Scalar<S>> {
    /// The state that the steps need.
    pub block: Block<S, T>,
    /// The sums of the lanes.
    pub sums: Sums<S, T>,
    /// The instances.
    pub jobs: &'a mut [Job<T>],
    /// Whether they are all single masses with straight laws.
    pub single: bool,
    /// Whether these lanes are stepped in closed form.
    swings: bool,
    /// The job of each lane; `usize::MAX` for a lane that rests.
    of_lane: Vec<usize>,
    /// The jobs in the order in which they are taken.
    order: Vec<usize>,
    next: usize,
    /// Lanes that do not rest.
    running: usize,
    /// The part of the run.
    pub part: Part,
    settings: Settings<'a>,
    /// Steps of all lanes so far.
    turns: u32,
}

impl<'a, S: Simd, T: Scalar<S>> Lanes<'a, S, T> {
    /// Lanes with the first instances of an order; they all have laws of the form of the block.
    pub fn new(
        block: Block<S, T>,
        jobs: &'a mut [Job<T>],
        [single, swings]: [bool; 2],
        order: Vec<usize>,
        part: Part,
        settings: Settings<'a>,
    ) -> Self {
        let sums = Sums::new(block.simd);
        let of_lane = vec![usize::MAX; Vector::<S, T>::LANES];
        let mut all = Lanes {
            block,
            sums,
            jobs,
            single,
            swings,
            of_lane,
            order,
            next: 0,
            running: 0,
            part,
            settings,
            turns: 0,
        };
        for lane in 0..Vector::<S, T>::LANES {
            refill::<S, T>(&mut all, lane);
        }
        all
    }

    /// Loads the scene of the instance of a lane.
    fn load(&mut self, lane: usize) {
        let job = &self.jobs[self.of_lane[lane]];
        if self.swings {
            self.block.load_swing(lane, &job.constants);
        } else {
            self.block.load_scene(lane, &job.constants, &job.words);
        }
    }

    /// Whether another step of the lanes follows: some do not rest, and nobody has asked to stop.
    pub fn go_on(&mut self) -> bool {
        self.turns = self.turns.wrapping_add(1);
        let stopped = self.turns.is_multiple_of(TURNS) && self.settings.cancel.load(Ordering::Relaxed);
        self.running > 0 && !stopped
    }

    /// Whether growth before the first event is measured.
    pub fn sees_growth(&self) -> bool {
        matches!(self.part, Part::Growth | Part::Window) || self.single && self.part == Part::Settle
    }
}

/// Gives a lane its next instance, or lets it rest.
fn refill<S: Simd, T: Scalar<S>>(all: &mut Lanes<S, T>, lane: usize) {
    if all.of_lane[lane] != usize::MAX {
        all.of_lane[lane] = usize::MAX;
        all.running -= 1;
    }
    while all.next < all.order.len() {
        let index = all.order[all.next];
        all.next += 1;
        if !all.jobs[index].enter(all.part, all.settings.tolerance, all.single) {
            continue;
        }
        all.of_lane[lane] = index;
        all.running += 1;
        all.load(lane);
        if begin::<S, T>(all, lane) {
            return;
        }
        all.of_lane[lane] = usize::MAX;
        all.running -= 1;
    }
    all.block.rest(lane);
    all.sums.growing.set(lane, T::ZERO);
}

/// Begins the next stretch of a lane; false at the end of the part.
fn begin<S: Simd, T: Scalar<S>>(all: &mut Lanes<S, T>, lane: usize) -> bool {
    let sees_growth = all.sees_growth();
    if all.jobs[all.of_lane[lane]].heat(all.settings.tolerance) {
        all.load(lane);
    }
    let job = &mut all.jobs[all.of_lane[lane]];
    if job.state.status != Status::Unwritten {
        return false;
    }
    if all.part == Part::Window {
        job.open_window();
    }
    job.sums_growth = sees_growth && job.growing;
    let stretch = job.stretch(all.part, all.settings.plan.steps_per_period, all.swings);
    let Some([length, step]) = stretch else { return false };
    // The second pass takes no step that the first has not.
    let left = match all.part {
        Part::Phase => f64::INFINITY,
        _ => f64::from(all.settings.terms.most_steps) - job.steps as f64,
    };
    let [most_steps, most_events] = job.count.most([job.time, job.until], left);
    let belt = job.warmth.seen(job.scene.belt(job.time));
    let b = &mut all.block;
    b.load_state(lane, &job.state, &job.words);
    b.belt.set(lane, T::from_f64(belt.velocity));
    b.drive.set(lane, T::from_f64(belt.acceleration));
    b.left.set(lane, T::from_f64(length));
    b.step.set(lane, T::from_f64(step));
    b.pace.set(lane, T::from_f64(step));
    b.steps.set(lane, T::ZERO);
    b.most_steps.set(lane, T::from_f64(most_steps));
    b.counted.set(lane, T::ZERO);
    b.most_events.set(lane, T::from_f64(most_events));
    b.reached.set(lane, T::ZERO);
    b.at_once.set(lane, T::ZERO);
    let sums = &mut all.sums;
    sums.time.set(lane, T::ZERO);
    sums.cycle.since.set(lane, T::from_f64(NEVER));
    if sees_growth {
        sums.growing.set(lane, T::from_f64(f64::from(u8::from(job.growing))));
        if job.sums_growth {
            sums.growth.iter_mut().for_each(|word| word.set(lane, T::ZERO));
        }
    }
    if all.part == Part::Window {
        sums.window.iter_mut().for_each(|word| word.set(lane, T::ZERO));
        sums.peaks.iter_mut().for_each(|word| word.set(lane, T::ZERO));
        for (word, position) in sums.origin.iter_mut().zip(job.origin) {
            word.set(lane, position);
        }
        sums.quiet.set(lane, T::ONE);
        sums.impacts.set(lane, T::ZERO);
        if !all.swings {
            let begun = job.seen.crossings > 0;
            sums.spectrum.begin(lane, job.guessed_omega(), job.marks[2] - job.time, begun);
        }
        if !all.single {
            sums.spectrum.turn_back(lane, 0.5 * length);
        }
    }
    if all.part == Part::Return {
        sums.section.set(lane, T::ZERO);
        sums.order.set(lane, T::from_f64(job.flight.order));
    }
    if all.part != Part::Phase {
        sums.crossings.set(lane, T::ZERO);
        sums.previous.set(lane, job.previous);
    }
    if all.part == Part::Phase {
        let omega = job.omega();
        sums.omega.set(lane, T::from_f64(omega));
        sums.phase.iter_mut().for_each(|word| word.set(lane, T::ZERO));
        // Before the first crossing nothing is added.
        let angle = omega * (job.time - job.seen.first);
        let length = if job.time < job.seen.first { 0.0 } else { 1.0 };
        sums.carrier[0].set(lane, T::from_f64(length * angle.cos()));
        sums.carrier[1].set(lane, T::from_f64(-length * angle.sin()));
    }
    true
}

/// Adds what a stretch has summed to the job.
fn flush<S: Simd, T: Scalar<S>>(all: &mut Lanes<S, T>, lane: usize) {
    let job = &mut all.jobs[all.of_lane[lane]];
    let sums = &all.sums;
    let contact = all.block.reached.get(lane).to_f64() as u32;
    job.habit = job.habit.max((contact, all.block.counted.get(lane) > T::ZERO));
    if job.sums_growth {
        for (total, word) in job.seen.growth.iter_mut().zip(&sums.growth) {
            *total += word.get(lane).to_f64();
        }
    }
    // The second pass tells nothing new, and does not look for it.
    job.growing &= all.part == Part::Phase || sums.growing.get(lane) > T::ZERO;
    if all.part == Part::Window && job.in_window() {
        let half = job.half();
        job.quiet &= sums.quiet.get(lane) > T::ZERO;
        job.seen.impacts += sums.impacts.get(lane).to_f64() as u64;
        for (total, word) in job.seen.halves[half].iter_mut().zip(&sums.window) {
            *total += word.get(lane).to_f64();
        }
        for (peak, word) in job.seen.peaks.iter_mut().zip(&sums.peaks) {
            *peak = peak.max(word.get(lane).to_f64());
        }
        let crossings = sums.crossings.get(lane).to_f64();
        if crossings > 0.0 {
            if job.seen.crossings == 0 {
                job.seen.first = job.time + sums.first.get(lane).to_f64();
            }
            job.seen.last = job.time + sums.last.get(lane).to_f64();
            job.seen.crossings += crossings as u64;
        }
        if !all.single {
            keep_spectrum(job, &sums.spectrum, lane, crossings > 0.0);
        }
    } else if all.part == Part::Return {
        job.flight.order = sums.order.get(lane).to_f64();
    } else if all.part != Part::Phase {
        let cycles = sums.crossings.get(lane).to_f64() - 1.0;
        let span = sums.last.get(lane).to_f64() - sums.first.get(lane).to_f64();
        if cycles >= 2.0 && span > 0.0 {
            job.guess = Some(TAU * cycles / span);
        }
    }
    job.keep_previous(sums.previous.get(lane), job.state.contact);
    if all.part == Part::Phase {
        for (total, word) in job.seen.phase.iter_mut().flatten().zip(&sums.phase) {
            *total += word.get(lane).to_f64();
        }
    }
    let steps = all.block.steps.get(lane).to_f64();
    job.count.add(steps, all.block.counted.get(lane).to_f64());
    job.steps += steps as u64;
}

/// Adds the Fourier sums of a stretch to the job; `crossed` says whether it has a crossing.
fn keep_spectrum<S: Simd, T: Scalar<S>>(
    job: &mut Job<T>,
    spectrum: &Spectrum<S, T>,
    lane: usize,
    crossed: bool,
) {
    let half = 0.5 * (job.until - job.time);
    let words = |words: &[Vector<S, T>; COMPONENTS]| {
        let mut values = [0.0; COMPONENTS];
        for (value, word) in values.iter_mut().zip(words) {
            *value = word.get(lane).to_f64();
        }
        values
    };
    job.stretches.push(
        spectrum.omega.get(lane).to_f64(),
        [job.time + half, half],
        words(&spectrum.sums),
        crossed.then(|| words(&spectrum.noted)),
    );
    if crossed && spectrum.fresh.get(lane) <= T::ZERO {
        job.stretches.forget();
    }
}

/// Looks after lanes that are at the end of their stretch or have an event that is still to be carried out.
#[inline(never)]
pub fn visit<S: Simd, T: Scalar<S>>(all: &mut Lanes<S, T>, look: &Vector<S, T>, event: &Vector<S, T>) {
    for lane in 0..Vector::<S, T>::LANES {
        if look.as_slice()[lane] <= T::ZERO {
            continue;
        }
        let index = all.of_lane[lane];
        if index == usize::MAX {
            all.block.rest(lane);
            continue;
        }
        let left = all.block.left.get(lane);
        let job = &mut all.jobs[index];
        all.block.store_state(lane, &mut job.state, &job.words);
        let function = event.as_slice()[lane].to_f64() as u32;
        if function > 0 {
            let code = event_of(function, job.state.contact, job.state.piece);
            let exhausted = all.block.is_exhausted(lane);
            job.event(code, exhausted, all.part == Part::Window, all.block.belt(lane));
        }
        let mut ended = all.part == Part::Growth && function > 0;
        if all.part == Part::Return && all.sums.section.get(lane) > T::ZERO {
            all.sums.section.set(lane, T::ZERO);
            let time = job.until - left.to_f64();
            job.flight.arrive(&job.state, time, all.sums.order.get(lane).to_f64());
            all.sums.order.set(lane, T::ZERO);
            ended = !job.flight.is_open();
        }
        if ended || job.state.status != Status::Unwritten {
            let reached = (job.until - left.to_f64()).max(job.time);
            flush::<S, T>(all, lane);
            all.jobs[index].time = reached;
            refill::<S, T>(all, lane);
        } else if left > T::ZERO {
            all.block.load_state(lane, &job.state, &job.words);
        } else {
            flush::<S, T>(all, lane);
            let job = &mut all.jobs[index];
            job.time = job.until;
            if !job.state.is_finite() {
                job.state.status = Status::NonFinite;
            }
            if job.state.status != Status::Unwritten || !begin::<S, T>(all, lane) {
                refill::<S, T>(all, lane);
            }
        }
    }
}

/// Ends the lanes that cannot go on.
#[inline(never)]
pub fn fail<S: Simd, T: Scalar<S>>(all: &mut Lanes<S, T>, failed: Vector<S, T>, ill_posed: Vector<S, T>) {
    for lane in 0..Vector::<S, T>::LANES {
        if failed.get(lane) <= T::ZERO {
            continue;
        }
        if all.of_lane[lane] == usize::MAX {
            all.block.rest(lane);
            continue;
        }
        let job = &mut all.jobs[all.of_lane[lane]];
        all.block.store_state(lane, &mut job.state, &job.words);
        job.state.status = match (ill_posed.get(lane) > T::ZERO, job.state.is_finite()) {
            (_, false) => Status::NonFinite,
            (true, _) => Status::Painleve,
            _ => Status::StepTooLarge,
        };
        let reached = (job.until - all.block.left.get(lane).to_f64()).max(job.time);
        flush::<S, T>(all, lane);
        all.jobs[all.of_lane[lane]].time = reached;
        refill::<S, T>(all, lane);
    }
}
