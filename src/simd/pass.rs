//! One part of the run for many instances: lanes are refilled as soon as they are done.

use std::f64::consts::TAU;
use std::ops::Not;
use std::sync::atomic::{AtomicBool, Ordering};

use pulp::{NullaryFnOnce, Simd};

use super::block::{Block, event_of};
use super::crossings::{Track, cross_upwards};
use super::events::first_event;
use super::expand::{CLOSED, Expansion, FLIGHT, PIECES, SINGLE, expand};
use super::functions::{Functions, functions};
use super::job::{Job, Part, STRETCH};
use super::observe::{Sums, change};
use super::polynomial::value_soon;
use super::reach::{LONGER, reach};
use super::spectrum::{COMPONENTS, Spectrum, accelerations};
use super::transitions::transitions;
use super::vector::{Scalar, Vector};
use crate::kernel::lane::MAX_PARTS;
use crate::outcome::Status;

/// Steps of all lanes after which a wish to stop is looked for: some milliseconds.
const TURNS: u32 = 4096;

/// Steps of the single mass that one of them may take while it sticks to a belt of one velocity: its motion is a straight
/// line, which every formula here is exact for, but for the turn of the Fourier sums' carriers, good up to a whole one.
const STICK_STEPS: f64 = 4.0;

/// Most steps of a stretch; f32 counts them.
const MOST_STEPS: f64 = STRETCH * MAX_PARTS as f64;

/// What all instances of a pass share.
#[derive(Clone, Copy, Debug)]
pub struct Settings<'a> {
    /// Steps per period `2π/ω0`.
    pub steps_per_period: u32,
    /// Bound on the truncation of a step.
    pub tolerance: f64,
    /// Set to stop early; what is under way is then of no use.
    pub cancel: &'a AtomicBool,
}

/// Lanes and the instances they work on.
struct Lanes<'a, S: Simd, T: Scalar<S>, const K: usize> {
    block: Block<S, T, K>,
    sums: Sums<S, T, K>,
    jobs: &'a mut [Job<T>],
    /// Whether they are all single masses with straight laws, stepped as [`SINGLE`].
    single: bool,
    /// The job of each lane; `usize::MAX` for a lane that rests.
    of_lane: Vec<usize>,
    /// The jobs in the order in which they are taken.
    order: Vec<usize>,
    next: usize,
    running: usize,
    part: Part,
    settings: Settings<'a>,
}

impl<S: Simd, T: Scalar<S>, const K: usize> Lanes<'_, S, T, K> {
    /// Whether growth before the first event is measured.
    fn sees_growth(&self) -> bool {
        matches!(self.part, Part::Growth | Part::Window) || self.single && self.part == Part::Settle
    }
}

/// Runs one part of all instances that have one.
#[inline(always)]
pub fn pass<S: Simd, T: Scalar<S>, const K: usize, const N: usize, const LAW: bool>(
    simd: S,
    jobs: &mut [Job<T>],
    part: Part,
    settings: Settings,
) {
    let Some(law) = jobs.first().map(Job::law) else { return };
    let single = LAW == PIECES && jobs.iter().all(Job::is_single);
    let lanes = Vector::<S, T, K>::LANES;
    let mut order: Vec<usize> = (0..jobs.len()).collect();
    order.sort_by_key(|index| jobs[*index].habit);
    let mut all = Lanes {
        block: Block::idle(simd, law),
        sums: Sums::new(simd),
        jobs,
        single,
        of_lane: vec![usize::MAX; lanes],
        order,
        next: 0,
        running: 0,
        part,
        settings,
    };
    for lane in 0..lanes {
        refill::<S, T, K>(&mut all, lane);
    }
    let tolerance = Vector::constant(simd, settings.tolerance);
    let mut e = Expansion::new(simd);
    let mut g = Functions::new(simd);
    let mut turn = 0_u32;
    while all.running > 0 {
        turn = turn.wrapping_add(1);
        if turn.is_multiple_of(TURNS) && settings.cancel.load(Ordering::Relaxed) {
            return;
        }
        // A function of its own for each motion: one body of all of them takes the compiler far longer.
        let (all, e, g) = (&mut all, &mut e, &mut g);
        if single {
            simd.vectorize(Step::<S, T, K, N, LAW, SINGLE> { all, e, g, tolerance });
        } else if all.block.free().any() {
            simd.vectorize(Step::<S, T, K, N, LAW, FLIGHT> { all, e, g, tolerance });
        } else {
            simd.vectorize(Step::<S, T, K, N, LAW, CLOSED> { all, e, g, tolerance });
        }
    }
}

/// One step of every lane.
struct Step<'a, 'b, S: Simd, T: Scalar<S>, const K: usize, const N: usize, const LAW: bool, const MOTION: u8>
{
    all: &'a mut Lanes<'b, S, T, K>,
    e: &'a mut Expansion<S, T, K, N>,
    g: &'a mut Functions<S, T, K, N>,
    tolerance: Vector<S, T, K>,
}

impl<S: Simd, T: Scalar<S>, const K: usize, const N: usize, const LAW: bool, const MOTION: u8> NullaryFnOnce
    for Step<'_, '_, S, T, K, N, LAW, MOTION>
{
    type Output = ();

    #[inline(always)]
    fn call(self) {
        step::<S, T, K, N, LAW, MOTION>(self.all, self.e, self.g, self.tolerance);
    }
}

/// One step of every lane, up to its first event.
#[inline(always)]
fn step<S: Simd, T: Scalar<S>, const K: usize, const N: usize, const LAW: bool, const MOTION: u8>(
    all: &mut Lanes<S, T, K>,
    e: &mut Expansion<S, T, K, N>,
    g: &mut Functions<S, T, K, N>,
    tolerance: Vector<S, T, K>,
) {
    let b = &mut all.block;
    let zero = b.left.like(0.0);
    let one = b.left.like(1.0);
    b.v[0] = b.stick().select(b.belt, b.v[0]);
    b.reached = b.reached.max(b.contact);
    let allowed = b.longest();
    let mut pace = b.pace.min(b.step).min(allowed);
    if MOTION == SINGLE {
        let waits = b.stick().and(b.drive.abs().not_positive());
        pace = waits.select((b.step * one.like(STICK_STEPS)).min(one.like(TAU)), pace);
    }
    let last = b.left.at_most(pace * one.like(1.0 + 1e-3));
    let h = last.select(b.left, pace);
    let ill_posed = expand::<S, T, K, N, LAW, MOTION>(b, h, e);
    let reach = reach::<S, T, K, N, MOTION>(e, tolerance);
    // Steps so short that a stretch does not end.
    let failed = reach.failed.or(ill_posed).or(one.like(MOST_STEPS).less(b.steps));
    // Steps so short that a position stays where it is.
    let failed = failed.or((allowed * allowed).less(Vector::splat(b.simd, T::EPSILON)));
    if failed.any() {
        fail::<S, T, K>(all, failed.select(one, zero), ill_posed.select(one, zero));
        return;
    }
    functions::<S, T, K, N, MOTION>(b, e, g);
    let [at, event] = first_event::<S, T, K, N, MOTION>(b, e, g, tolerance);
    let (at, event) = (at.min(reach.end), event.only(at.at_most(reach.end)));
    let (x, vx) = (value_soon(&e.p[0], 0, at), change(&e.v[0], at).fma(e.rate, b.v[0]));
    let sums = &mut all.sums;
    if all.part == Part::Growth {
        sums.observe_growth::<N, MOTION>(e, at, x, vx);
        sums.guess_crossings(b.v[0], vx, at * e.step);
    } else if matches!(all.part, Part::Approach | Part::Settle) {
        sums.guess_crossings(b.v[0], vx, at * e.step);
        if MOTION == SINGLE && sums.growing.not_positive().not().any() {
            sums.observe_growth::<N, MOTION>(e, at, x, vx);
        }
    } else if all.part == Part::Window {
        let nodes = accelerations::<S, T, K, N, MOTION>(e, at);
        let velocities = sums.observe_window::<N, MOTION>(b, e, &nodes, at);
        let track = Track::new(e, at, b.v[0], vx, velocities, &nodes);
        cross_upwards::<S, T, K, N, MOTION>(sums, e, &track, at);
        if MOTION != SINGLE {
            sums.spectrum.observe::<N, MOTION>(e, &nodes, at, sums.time);
        }
        if sums.growing.not_positive().not().any() {
            sums.observe_growth::<N, MOTION>(e, at, x, vx);
        }
    } else if all.part == Part::Phase {
        sums.observe_phase(e, at);
    }
    let tau = at * e.step;
    sums.time += tau;
    b.p[0] = x;
    b.v[0] = vx;
    if MOTION != SINGLE {
        b.p[2] = value_soon(&e.p[2], 0, at);
        b.v[2] = change(&e.v[2], at).fma(e.rate, b.v[2]);
    }
    if MOTION == FLIGHT {
        b.p[1] = value_soon(&e.p[1], 0, at);
        b.v[1] = change(&e.v[1], at).fma(e.rate, b.v[1]);
    }
    let whole = one.at_most(at).and(h.at_most(e.step)).and(last);
    b.left = whole.select(zero, b.left - tau);
    b.belt = b.drive.fma(tau, b.belt);
    b.disarmed = zero.less(at).select(zero, b.disarmed);
    // A step that had to be shortened is a guess at the next one.
    let possible = reach.end * e.step;
    b.pace = possible.less(h).select(possible, reach.roomy.select(pace * one.like(LONGER), pace));
    b.steps += one;
    let mut look = b.left.not_positive();
    let happened = zero.less(event);
    let mut pending = zero;
    if happened.any() {
        sums.growing = happened.select(zero, sums.growing);
        sums.quiet = happened.select(zero, sums.quiet);
        let hits = b.free().and(happened);
        let rare = if all.part == Part::Growth {
            happened
        } else {
            transitions::<S, T, K, LAW, MOTION>(b, event, at)
        };
        if MOTION == FLIGHT && all.part == Part::Window {
            sums.impacts += one.only(hits.and(rare.not()));
        }
        pending = rare.select(event, zero);
        look = look.or(rare);
    }
    if look.any() {
        visit::<S, T, K>(all, &look.select(one, zero), &pending);
    }
}

/// Gives a lane its next instance, or lets it rest.
fn refill<S: Simd, T: Scalar<S>, const K: usize>(all: &mut Lanes<S, T, K>, lane: usize) {
    if all.of_lane[lane] != usize::MAX {
        all.of_lane[lane] = usize::MAX;
        all.running -= 1;
    }
    while all.next < all.jobs.len() {
        let index = all.order[all.next];
        all.next += 1;
        if !all.jobs[index].enter(all.part, all.settings.tolerance, all.single) {
            continue;
        }
        all.of_lane[lane] = index;
        all.running += 1;
        all.block.load_scene(lane, &all.jobs[index].constants, &all.jobs[index].words);
        if begin::<S, T, K>(all, lane) {
            return;
        }
        all.of_lane[lane] = usize::MAX;
        all.running -= 1;
    }
    all.block.rest(lane);
    all.sums.growing.set(lane, T::ZERO);
}

/// Begins the next stretch of a lane; false at the end of the part.
fn begin<S: Simd, T: Scalar<S>, const K: usize>(all: &mut Lanes<S, T, K>, lane: usize) -> bool {
    let sees_growth = all.sees_growth();
    let job = &mut all.jobs[all.of_lane[lane]];
    let Some([length, step]) = job.stretch(all.part, all.settings.steps_per_period) else { return false };
    let belt = job.scene.belt(job.time);
    let b = &mut all.block;
    b.load_state(lane, &job.lane, &job.words);
    b.belt.set(lane, T::from_f64(belt.velocity));
    b.drive.set(lane, T::from_f64(belt.acceleration));
    b.left.set(lane, T::from_f64(length));
    b.step.set(lane, T::from_f64(step));
    b.pace.set(lane, T::from_f64(step));
    b.steps.set(lane, T::ZERO);
    b.counted.set(lane, T::ZERO);
    b.reached.set(lane, T::ZERO);
    b.at_once.set(lane, T::ZERO);
    let sums = &mut all.sums;
    sums.time.set(lane, T::ZERO);
    if sees_growth {
        sums.growth.iter_mut().for_each(|word| word.set(lane, T::ZERO));
        sums.growing.set(lane, T::from_f64(f64::from(u8::from(job.growing))));
    }
    if all.part == Part::Window {
        sums.window.iter_mut().for_each(|word| word.set(lane, T::ZERO));
        sums.peaks.iter_mut().for_each(|word| word.set(lane, T::ZERO));
        for (word, position) in sums.origin.iter_mut().zip(job.origin) {
            word.set(lane, position);
        }
        sums.quiet.set(lane, T::ONE);
        sums.impacts.set(lane, T::ZERO);
        let begun = job.seen.crossings > 0;
        sums.spectrum.begin(lane, job.guessed_omega(), 0.5 * length, begun);
        if !all.single {
            sums.spectrum.turn_back(lane, 0.5 * length);
        }
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
fn flush<S: Simd, T: Scalar<S>, const K: usize>(all: &mut Lanes<S, T, K>, lane: usize) {
    let sees_growth = all.sees_growth();
    let job = &mut all.jobs[all.of_lane[lane]];
    let sums = &all.sums;
    let contact = all.block.reached.get(lane).to_f64() as u32;
    job.habit = job.habit.max((contact, all.block.counted.get(lane) > T::ZERO));
    job.growing &= sums.growing.get(lane) > T::ZERO;
    if sees_growth {
        for (total, word) in job.seen.growth.iter_mut().zip(&sums.growth) {
            *total += word.get(lane).to_f64();
        }
    }
    if all.part == Part::Window {
        let half = job.half();
        job.quiet &= sums.quiet.get(lane) > T::ZERO;
        job.seen.impacts += sums.impacts.get(lane).to_f64() as u32;
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
    } else if all.part != Part::Phase {
        let cycles = sums.crossings.get(lane).to_f64() - 1.0;
        let span = sums.last.get(lane).to_f64() - sums.first.get(lane).to_f64();
        if cycles >= 2.0 && span > 0.0 {
            job.guess = Some(TAU * cycles / span);
        }
    }
    job.previous = sums.previous.get(lane);
    if all.part == Part::Phase {
        for (total, word) in job.seen.phase.iter_mut().flatten().zip(&sums.phase) {
            *total += word.get(lane).to_f64();
        }
    }
    job.steps += all.block.steps.get(lane).to_f64() as u64;
}

/// Adds the Fourier sums of a stretch to the job; `crossed` says whether it has a crossing.
fn keep_spectrum<S: Simd, T: Scalar<S>, const K: usize>(
    job: &mut Job<T>,
    spectrum: &Spectrum<S, T, K>,
    lane: usize,
    crossed: bool,
) {
    let half = 0.5 * (job.until - job.time);
    let words = |words: &[Vector<S, T, K>; COMPONENTS]| {
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
fn visit<S: Simd, T: Scalar<S>, const K: usize>(
    all: &mut Lanes<S, T, K>,
    look: &Vector<S, T, K>,
    event: &Vector<S, T, K>,
) {
    for lane in 0..Vector::<S, T, K>::LANES {
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
        all.block.store_state(lane, &mut job.lane, &job.words);
        let function = event.as_slice()[lane].to_f64() as u32;
        if function > 0 {
            let code = event_of(function, job.lane.contact, job.lane.piece);
            let exhausted = all.block.is_exhausted(lane);
            job.event(code, exhausted, all.part == Part::Window, all.block.belt(lane));
        }
        let ended = all.part == Part::Growth && function > 0;
        if ended || job.lane.status != Status::Unwritten {
            let reached = (job.until - left.to_f64()).max(job.time);
            flush::<S, T, K>(all, lane);
            all.jobs[index].time = reached;
            refill::<S, T, K>(all, lane);
        } else if left > T::ZERO {
            all.block.load_state(lane, &job.lane, &job.words);
        } else {
            flush::<S, T, K>(all, lane);
            let job = &mut all.jobs[index];
            job.time = job.until;
            if !job.lane.body_is_finite() {
                job.lane.status = Status::NonFinite;
            }
            if job.lane.status != Status::Unwritten || !begin::<S, T, K>(all, lane) {
                refill::<S, T, K>(all, lane);
            }
        }
    }
}

/// Ends the lanes that cannot go on.
#[inline(never)]
fn fail<S: Simd, T: Scalar<S>, const K: usize>(
    all: &mut Lanes<S, T, K>,
    failed: Vector<S, T, K>,
    ill_posed: Vector<S, T, K>,
) {
    for lane in 0..Vector::<S, T, K>::LANES {
        if failed.get(lane) <= T::ZERO {
            continue;
        }
        if all.of_lane[lane] == usize::MAX {
            all.block.rest(lane);
            continue;
        }
        let job = &mut all.jobs[all.of_lane[lane]];
        all.block.store_state(lane, &mut job.lane, &job.words);
        job.lane.status = match (ill_posed.get(lane) > T::ZERO, job.lane.body_is_finite()) {
            (_, false) => Status::NonFinite,
            (true, _) => Status::Painleve,
            _ => Status::StepTooLarge,
        };
        let reached = (job.until - all.block.left.get(lane).to_f64()).max(job.time);
        flush::<S, T, K>(all, lane);
        all.jobs[all.of_lane[lane]].time = reached;
        refill::<S, T, K>(all, lane);
    }
}
