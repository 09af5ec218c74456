//! One part of the run for many instances, step by step.

use crate::engine::lanes::block::{Block, RATE};
use crate::engine::lanes::carry::carry_out;
use crate::engine::lanes::contact::SLIP;
use crate::engine::lanes::crossings::{Track, cross_upwards};
use crate::engine::lanes::events::first_event;
use crate::engine::lanes::expand::{Expansion, expand};
use crate::engine::lanes::functions::{Functions, functions};
use crate::engine::lanes::job::{Job, Part};
use crate::engine::lanes::march::{Lanes, Settings, fail};
use crate::engine::lanes::motion::{CLOSED, FLIGHT, PIECES, SINGLE};
use crate::engine::lanes::observe::change;
use crate::engine::lanes::polynomial::value_soon;
use crate::engine::lanes::reach::{LONGER, reach};
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::section::section;
use crate::engine::lanes::spectrum::accelerations;
use crate::engine::lanes::swing_step::swing_step;
use crate::engine::lanes::vector::Vector;
use std::f64::consts::TAU;
use std::ops::Not;

use pulp::{NullaryFnOnce, Simd};

/// Steps of the single mass that one of them may take while it sticks to a belt of one velocity: its motion is a straight
/// line, which every formula here is exact for, but for the turn of the Fourier sums' carriers, good up to a whole one.
const STICK_STEPS: f64 = 4.0;

/// Runs one part of all instances that have one; `single` says whether they are all single masses.
#[inline(always)]
pub fn pass<S: Simd, T: Scalar<S>, const N: usize, const LAW: bool>(
    simd: S,
    jobs: &mut [Job<T>],
    part: Part,
    single: bool,
    settings: Settings,
) {
    let Some(law) = jobs.first().map(Job::law) else { return };
    let mut order: Vec<usize> = (0..jobs.len()).collect();
    order.sort_by_key(|index| jobs[*index].habit);
    // Each its own way, whatever its neighbours are. Whole cycles that are added at once would leave nothing to hunt for.
    let closed = single && !settings.plan.hunts;
    let (swings, steps): (Vec<usize>, Vec<usize>) =
        order.into_iter().partition(|index| closed && jobs[*index].swings());
    let block = Block::idle(simd, law);
    // What cannot be is not compiled: both conditions are known before.
    if const { LAW == PIECES } && part == Part::Window && !swings.is_empty() {
        let mut all = Lanes::new(block, jobs, [single, true], swings, part, settings);
        while all.go_on() {
            simd.vectorize(Swings::<S, T> { all: &mut all });
        }
    }
    if steps.is_empty() {
        return;
    }
    let mut all = Lanes::new(block, jobs, [single, false], steps, part, settings);
    let tolerance = Vector::constant(simd, settings.tolerance);
    let (mut e, mut g) = (Expansion::new(simd), Functions::new(simd));
    while all.go_on() {
        // A function of its own for each motion: one body of all of them takes the compiler far longer.
        let (all, e, g) = (&mut all, &mut e, &mut g);
        if const { LAW == PIECES } && single {
            simd.vectorize(Step::<S, T, N, LAW, SINGLE> { all, e, g, tolerance });
        } else if all.block.free().any() {
            simd.vectorize(Step::<S, T, N, LAW, FLIGHT> { all, e, g, tolerance });
        } else {
            simd.vectorize(Step::<S, T, N, LAW, CLOSED> { all, e, g, tolerance });
        }
    }
}

/// One step of every lane in closed form.
struct Swings<'a, 'b, S: Simd, T: Scalar<S>> {
    all: &'a mut Lanes<'b, S, T>,
}

impl<S: Simd, T: Scalar<S>> NullaryFnOnce for Swings<'_, '_, S, T> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        swing_step::<S, T>(self.all);
    }
}

/// One step of every lane.
struct Step<'a, 'b, S: Simd, T: Scalar<S>, const N: usize, const LAW: bool, const MOTION: u8> {
    all: &'a mut Lanes<'b, S, T>,
    e: &'a mut Expansion<S, T, N>,
    g: &'a mut Functions<S, T, N>,
    tolerance: Vector<S, T>,
}

impl<S: Simd, T: Scalar<S>, const N: usize, const LAW: bool, const MOTION: u8> NullaryFnOnce
    for Step<'_, '_, S, T, N, LAW, MOTION>
{
    type Output = ();

    #[inline(always)]
    fn call(self) {
        step::<S, T, N, LAW, MOTION>(self.all, self.e, self.g, self.tolerance);
    }
}

/// One step of every lane, up to its first event.
#[inline(always)]
fn step<S: Simd, T: Scalar<S>, const N: usize, const LAW: bool, const MOTION: u8>(
    all: &mut Lanes<S, T>,
    e: &mut Expansion<S, T, N>,
    g: &mut Functions<S, T, N>,
    tolerance: Vector<S, T>,
) {
    let b = &mut all.block;
    let zero = b.left.like(0.0);
    let one = b.left.like(1.0);
    let velocity = b.stick().select(b.belt, b.v[0]);
    b.v[0].put(velocity);
    b.reached = b.reached.max(b.contact);
    let allowed = b.longest();
    let mut pace = b.pace.min(b.step).min(allowed);
    if LAW == PIECES {
        pace = b.slip().select(pace.min(b.piece[RATE]), pace);
    }
    if MOTION == SINGLE {
        let waits = b.stick().and(b.drive.abs().not_positive());
        pace = waits.select((b.step * one.like(STICK_STEPS)).min(one.like(TAU)), pace);
    }
    let last = b.left.at_most(pace * one.like(1.0 + 1e-3));
    let h = last.select(b.left, pace);
    let ill_posed = expand::<S, T, N, LAW, MOTION>(b, h, e);
    let reach = reach::<S, T, N, MOTION>(e, tolerance);
    // Steps so short that a period does not end, or so many that the run does not.
    let failed = reach.failed.or(ill_posed).or(b.most_steps.less(b.steps));
    // Steps so short that a position stays where it is.
    let failed = failed.or((allowed * allowed).less(Vector::splat(b.simd, T::EPSILON)));
    if failed.any() {
        fail::<S, T>(all, failed.select(one, zero), ill_posed.select(one, zero));
        return;
    }
    functions::<S, T, N, MOTION>(b, e, g);
    let [at, event] = first_event::<S, T, N, MOTION>(b, e, g, tolerance);
    let (at, event) = (at.min(reach.end), event.only(at.at_most(reach.end)));
    let sums = &mut all.sums;
    let returns = all.part == Part::Return;
    let (at, event) = if returns { section(sums, e, b.v[0], [at, event]) } else { (at, event) };
    let (x, vx) = (value_soon(&e.p[0], 0, at), change(&e.v[0], at).fma(e.rate, b.v[0]));
    let vx = if returns { zero.less(sums.section).select(zero, vx) } else { vx };
    if all.part == Part::Growth {
        sums.observe_growth::<N, MOTION>(e, at, x, vx);
        sums.guess_crossings(b.v[0], vx, at * e.step);
    } else if matches!(all.part, Part::Approach | Part::Settle) {
        sums.guess_crossings(b.v[0], vx, at * e.step);
        if MOTION == SINGLE && sums.growing.not_positive().not().any() {
            sums.observe_growth::<N, MOTION>(e, at, x, vx);
        }
    } else if all.part == Part::Window {
        let nodes = accelerations::<S, T, N, MOTION>(e, at);
        let velocities = sums.observe_window::<N, MOTION>(b, e, &nodes, at);
        let track = Track::new(e, at, b.v[0], vx, velocities, &nodes);
        cross_upwards::<S, T, N, MOTION>(sums, e, &track, at, b.up_to(SLIP).or(b.free()));
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
    let disarmed = zero.less(at).select(zero, b.disarmed);
    b.disarmed.put(disarmed);
    // A step that had to be shortened is a guess at the next one.
    let possible = reach.end * e.step;
    b.pace = possible.less(h).select(possible, reach.roomy.select(pace * one.like(LONGER), pace));
    b.steps += one;
    carry_out::<S, T, LAW, MOTION>(all, event, at);
}
