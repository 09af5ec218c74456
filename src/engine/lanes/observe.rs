//! Running reductions of every lane over its present stretch; a stretch ends in the job's sums in f64.
//!
//! The definitions are those of [`crate::engine::reference::observe`].

use crate::engine::lanes::angle::{rotation, turn};
use crate::engine::lanes::block::Block;
use crate::engine::lanes::constants::{N0, R, T0, W};
use crate::engine::lanes::cycle::Cycle;
use crate::engine::lanes::expand::Expansion;
use crate::engine::lanes::motion::SINGLE;
use crate::engine::lanes::nodes::{NODES, SAMPLE_TIMES, WEIGHTS};
use crate::engine::lanes::polynomial::{soon_to, value_soon};
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::spectrum::{Nodes, Spectrum, moving, seen};
use crate::engine::lanes::vector::{Mask, Vector};
use crate::engine::sums::{growth, peak, sum};
use pulp::Simd;

/// Reductions of the present stretches.
#[derive(Clone, Copy, Debug)]
pub struct Sums<S: Simd, T: Scalar<S>> {
    /// Sums of the window, see [`sum`].
    pub window: [Vector<S, T>; sum::WORDS],
    /// `x2` and `y1` at the start of the window, from which its sums count.
    pub origin: [Vector<S, T>; 2],
    /// Largest values, see [`peak`].
    pub peaks: [Vector<S, T>; peak::WORDS],
    /// `ẋ2` at the end of the step before.
    pub previous: Vector<S, T>,
    /// Upward crossings of `ẋ2`.
    pub crossings: Vector<S, T>,
    /// Time of the first crossing since the stretch began.
    pub first: Vector<S, T>,
    /// Time of the last.
    pub last: Vector<S, T>,
    /// Impacts.
    pub impacts: Vector<S, T>,
    /// 1 as long as the stretch has no event.
    pub quiet: Vector<S, T>,
    /// The last cycle of what is followed in closed form.
    pub cycle: Cycle<S, T>,
    /// Time since the stretch began.
    pub time: Vector<S, T>,
    /// 1 where the section of the return map is reached in the present step.
    pub section: Vector<S, T>,
    /// A number that stands for the events since the last return to it.
    pub order: Vector<S, T>,
    /// Sums before the first event.
    pub growth: [Vector<S, T>; growth::WORDS],
    /// 1 until the first event.
    pub growing: Vector<S, T>,
    /// Fourier components at a guessed frequency.
    pub spectrum: Spectrum<S, T>,
    /// Angular frequency of the second pass.
    pub omega: Vector<S, T>,
    /// `exp(−iωt)`.
    pub carrier: [Vector<S, T>; 2],
    /// Fourier components of `ẍ2` and `ÿ1`.
    pub phase: [Vector<S, T>; 4],
}

impl<S: Simd, T: Scalar<S>> Sums<S, T> {
    /// Nothing yet.
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        let zero = Vector::constant(simd, 0.0);
        Sums {
            window: [zero; sum::WORDS],
            origin: [zero; 2],
            peaks: [zero; peak::WORDS],
            previous: zero,
            crossings: zero,
            first: zero,
            last: zero,
            impacts: zero,
            quiet: zero,
            cycle: Cycle::new(simd),
            time: zero,
            section: zero,
            order: zero,
            growth: [zero; growth::WORDS],
            growing: zero,
            spectrum: Spectrum::new(simd),
            omega: zero,
            carrier: [zero; 2],
            phase: [zero; 4],
        }
    }

    /// Adds the part of the step up to `at` to the window. Returns `ẋ2` at the nodes.
    #[inline(always)]
    pub fn observe_window<const N: usize, const MOTION: u8>(
        &mut self,
        b: &Block<S, T>,
        e: &Expansion<S, T, N>,
        nodes: &Nodes<S, T>,
        at: Vector<S, T>,
    ) -> [Vector<S, T>; 3] {
        let zero = at.like(0.0);
        let tau = at * e.step;
        let mut velocities = [zero; 3];
        let free = b.free();
        self.window[sum::TIME] += tau;
        self.window[sum::STICK] += tau.only(b.stick());
        self.window[sum::FREE] += tau.only(free);
        self.window[sum::REVERSE] += tau.only(b.reverse());
        let rate_square = e.rate * e.rate;
        let (flying, t0) = (free.any(), free.select(zero, b.scene[T0]));
        let moving = moving(MOTION);
        let mut samples = [[zero; 5]; 3];
        for i in 0..5 {
            let t = at * at.like(SAMPLE_TIMES[i]);
            let mut accelerations = [zero; 2];
            // A closure here would not be inlined: the arithmetic in it would be calls.
            for j in 0..moving {
                accelerations[j] = match i {
                    0 => e.a[j][0] * rate_square,
                    4 => soon_to(&e.a[j], 0, N - 3, at) * rate_square,
                    _ => nodes[i - 1][j],
                };
            }
            let [ax, ay] = accelerations;
            samples[0][i] = ax.abs();
            samples[1][i] = ay.abs();
            if i == 0 || i == 4 {
                if MOTION != SINGLE {
                    let n = if i == 0 { e.n[0] } else { soon_to(&e.n, 0, N - 3, t) };
                    // In flight the series is that of the gap.
                    samples[2][i] = free.select(zero, n * rate_square);
                }
                continue;
            }
            let degree = seen(N - 1, i - 1);
            let (x, vx) = (soon_to(&e.p[0], 0, degree, t), soon_to(&e.v[0], 1, degree, t) * e.rate);
            velocities[i - 1] = vx;
            let (mut w, mut vw) = (zero, zero);
            if MOTION != SINGLE {
                (w, vw) = (soon_to(&e.p[2], 0, degree, t), soon_to(&e.v[2], 1, degree, t) * e.rate);
            }
            // Those of lanes in contact, whose y2 is 0.
            let mut forces = [zero; 2];
            for (force, c) in [(0, R), (1, W)] {
                if MOTION == SINGLE {
                    forces[force] = b.scene[c + 3].fma(vx, b.scene[c] * x);
                    continue;
                }
                let mut sum = b.scene[c].fma(x, b.scene[c + 2] * w);
                sum = b.scene[c + 3].fma(vx, b.scene[c + 5].fma(vw, sum));
                forces[force] = sum;
            }
            let mut normal =
                b.scene[crate::engine::lanes::constants::KAPPA].fnma(ax, forces[1] + b.scene[N0]);
            let mut tangential = forces[0] + ax + t0;
            if flying {
                normal = free.select(zero, normal);
                tangential = free.select(zero, tangential);
            }
            samples[2][i] = normal;
            let weight = tau * at.like(WEIGHTS[i - 1]);
            let sums = &mut self.window;
            let dx = x - self.origin[0];
            sums[sum::X] = weight.fma(dx, sums[sum::X]);
            sums[sum::XX] = weight.fma(dx * dx, sums[sum::XX]);
            sums[sum::AX] = weight.fma(ax * ax, sums[sum::AX]);
            if MOTION == SINGLE {
                sums[sum::SPEED] = weight.fma(vx * vx, sums[sum::SPEED]);
            } else {
                let dw = w - self.origin[1];
                sums[sum::Y] = weight.fma(dw, sums[sum::Y]);
                sums[sum::YY] = weight.fma(dw * dw, sums[sum::YY]);
                sums[sum::AY] = weight.fma(ay * ay, sums[sum::AY]);
                sums[sum::SPEED] = weight.fma(vx.fma(vx, vw * vw), sums[sum::SPEED]);
            }
            sums[sum::TANGENTIAL] = weight.fma(tangential, sums[sum::TANGENTIAL]);
            sums[sum::NORMAL] = weight.fma(normal, sums[sum::NORMAL]);
        }
        self.peaks[peak::AX] = self.peaks[peak::AX].max(maximum(&samples[0]));
        if MOTION == SINGLE {
            self.peaks[peak::NORMAL] = self.peaks[peak::NORMAL].max(b.scene[N0]);
        } else {
            self.peaks[peak::AY] = self.peaks[peak::AY].max(maximum(&samples[1]));
            self.peaks[peak::NORMAL] = self.peaks[peak::NORMAL].max(maximum(&samples[2]));
        }
        velocities
    }

    /// Counts upward crossings of `ẋ2` from end to end of the steps, on straight lines: a guess at the frequency.
    #[inline(always)]
    pub fn guess_crossings(&mut self, before: Vector<S, T>, after: Vector<S, T>, tau: Vector<S, T>) {
        let zero = tau.like(0.0);
        let jumped = self.previous.less(zero).and(zero.at_most(before));
        let rises = before.less(zero).and(zero.at_most(after)).and(zero.less(tau));
        let crossed = jumped.or(rises);
        if crossed.any() {
            let part = rises.select(before / (before - after).min(tau.like(-1e-30)), zero);
            self.note(crossed, part * tau);
        }
        self.previous = after;
    }

    /// Notes one upward crossing of some lanes, this long after the step began.
    #[inline(always)]
    pub fn note(&mut self, crossed: Mask<S, T>, after: Vector<S, T>) {
        let moment = self.time + after;
        let is_first = crossed.and(self.crossings.not_positive());
        let (first, last) = (is_first.select(moment, self.first), crossed.select(moment, self.last));
        self.first.put(first);
        self.last.put(last);
        self.crossings += after.like(1.0).only(crossed);
    }

    /// Adds a step before the first event; `x` and `vx` are position and velocity at its end.
    #[inline(always)]
    pub fn observe_growth<const N: usize, const MOTION: u8>(
        &mut self,
        e: &Expansion<S, T, N>,
        at: Vector<S, T>,
        x: Vector<S, T>,
        vx: Vector<S, T>,
    ) {
        let rate_square = e.rate * e.rate;
        let mut sample = [x, vx, soon_to(&e.a[0], 0, N - 3, at) * rate_square, at.like(0.0)];
        if MOTION != SINGLE {
            sample[3] = soon_to(&e.a[1], 0, N - 3, at) * rate_square;
        }
        self.add_growth::<MOTION>(at * e.step, &sample);
    }

    /// Adds `x2`, its velocity, its acceleration and that of `y1` for a time `tau` to the lanes that grow.
    #[inline(always)]
    pub fn add_growth<const MOTION: u8>(&mut self, tau: Vector<S, T>, sample: &[Vector<S, T>; 4]) {
        let tau = tau * self.growing;
        self.growth[growth::TIME] += tau;
        let mut word = growth::PRODUCTS;
        for i in 0..growth::SAMPLED {
            if MOTION == SINGLE && i == 3 {
                break;
            }
            let weighted = tau * sample[i];
            self.growth[growth::SAMPLES + i] += weighted;
            for j in i..growth::SAMPLED {
                if MOTION != SINGLE || j < 3 {
                    self.growth[word] = weighted.fma(sample[j], self.growth[word]);
                }
                word += 1;
            }
        }
    }

    /// Adds the part of the step up to `at` to the Fourier components.
    #[inline(always)]
    pub fn observe_phase<const N: usize>(&mut self, e: &Expansion<S, T, N>, at: Vector<S, T>) {
        let rate_square = e.rate * e.rate;
        let tau = at * e.step;
        let angle = self.omega * tau;
        let (outer, inner) =
            (rotation(angle * at.like(NODES[0])), rotation(angle * at.like(NODES[1] - NODES[0])));
        let mut carrier = self.carrier;
        for i in 0..3 {
            carrier = turn(carrier, if i == 0 { outer } else { inner });
            let t = at * at.like(NODES[i]);
            let weight = tau * rate_square * at.like(WEIGHTS[i]);
            let (ax, ay) = (soon_to(&e.a[0], 0, N - 3, t) * weight, soon_to(&e.a[1], 0, N - 3, t) * weight);
            self.phase[0] = ax.fma(carrier[0], self.phase[0]);
            self.phase[1] = ax.fma(carrier[1], self.phase[1]);
            self.phase[2] = ay.fma(carrier[0], self.phase[2]);
            self.phase[3] = ay.fma(carrier[1], self.phase[3]);
        }
        self.carrier = turn(carrier, outer);
    }
}

/// The change of a velocity `Σ v_k t^(k − 1)`, whose coefficients carry their degree, since the start of the step. A
/// velocity that is carried on by its change is not scaled by a step and back. The rounding of that scaling is the same in
/// every step of one length and would let a motion grow or decay.
#[inline(always)]
pub fn change<S: Simd, T: Scalar<S>, const N: usize>(v: &[Vector<S, T>; N], t: Vector<S, T>) -> Vector<S, T> {
    value_soon(v, 2, t) * t
}

/// The maximum of a smooth function from its samples, as [`crate::engine::reference::observe`] finds it.
#[inline(always)]
fn maximum<S: Simd, T: Scalar<S>>(values: &[Vector<S, T>; 5]) -> Vector<S, T> {
    let zero = values[0].like(0.0);
    let mut top = values[0];
    // The slopes to both sides of the top, the way to the sample before and the inverse of that between its neighbours.
    let mut left = zero;
    let mut right = zero;
    let mut before = zero;
    let mut per_width = zero;
    for i in 1..4 {
        let higher = top.less(values[i]);
        let widths = [SAMPLE_TIMES[i] - SAMPLE_TIMES[i - 1], SAMPLE_TIMES[i + 1] - SAMPLE_TIMES[i]];
        top = higher.select(values[i], top);
        left = higher.select((values[i] - values[i - 1]) * zero.like(1.0 / widths[0]), left);
        right = higher.select((values[i + 1] - values[i]) * zero.like(1.0 / widths[1]), right);
        before = higher.select(zero.like(widths[0]), before);
        per_width = higher.select(zero.like(1.0 / (widths[0] + widths[1])), per_width);
    }
    // Inside, the slopes differ; the tangent is that of the parabola through three samples. At an end there is none.
    let curvature = (right - left) * per_width;
    let tangent = curvature.fma(before, left);
    let inside = values[4].at_most(top);
    let bent = curvature.less(zero).and(inside);
    let rise = tangent * tangent / bent.select(curvature * zero.like(-4.0), zero.like(1.0));
    bent.select(top + rise, top.max(values[4]))
}
