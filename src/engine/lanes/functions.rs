//! The event functions of every lane's step, and which of them may fall to zero.

use std::ops::Not;

use pulp::Simd;

use crate::engine::lanes::block::{Block, LOWER, UPPER};
use crate::engine::lanes::constants::{CONE, KAPPA, MU_STICK, R, W};
use crate::engine::lanes::expand::Expansion;
use crate::engine::lanes::motion::{FLIGHT, SINGLE};
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::{Mask, Vector};

/// The event functions of a step. Each is `m n_k + s d_k` for `k > 0`, with the series `n` of the normal force
/// (of the gap for lanes that fly) and one more; the rest differs from lane to lane.
#[derive(Clone, Copy, Debug)]
pub struct Functions<S: Simd, T: Scalar<S>, const N: usize> {
    /// Their values at the beginning, in the order of [`crate::engine::lanes::block::FIRST`] to
    /// [`crate::engine::lanes::block::THIRD`].
    pub start: [Vector<S, T>; 3],
    /// The second series, from degree 1 on: sliding speed in slip, less the tangential force in stick.
    pub second: [Vector<S, T>; N],
    /// `m` of the second and third function: the limit of stick for lanes that stick.
    pub share: Vector<S, T>,
}

impl<S: Simd, T: Scalar<S>, const N: usize> Functions<S, T, N> {
    /// No function.
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        let zero = Vector::constant(simd, 0.0);
        Functions { start: [zero; 3], second: [zero; N], share: zero }
    }
}

/// The event functions; the series of the normal force becomes that of the gap in lanes that fly.
#[inline(always)]
pub fn functions<S: Simd, T: Scalar<S>, const N: usize, const MOTION: u8>(
    b: &Block<S, T>,
    e: &mut Expansion<S, T, N>,
    g: &mut Functions<S, T, N>,
) {
    let zero = e.step.like(0.0);
    let sticks = b.stick();
    let sigma = b.sigma();
    let square = e.step * e.step;
    let speed = sigma * (b.belt - b.v[0]);
    g.start[1] = e.step * (speed - b.piece[LOWER]);
    g.start[2] = e.step * (b.piece[UPPER] - speed);
    g.share = zero;
    let slower = -sigma;
    g.second[1] = slower * (e.v[0][2] - b.drive * square);
    for k in 2..N - 1 {
        g.second[k] = slower * e.v[0][k + 1];
    }
    if sticks.any() {
        let mu = b.scene[MU_STICK];
        g.share = mu.only(sticks);
        let (x, w) = (b.scene[R] * square, b.scene[R + 2] * square);
        let (vx, vw) = (b.scene[R + 3] * e.step, b.scene[R + 5] * e.step);
        for k in 0..N - 2 {
            // The belt holds x2, whose series ends with degree 2.
            let moves = k <= 2;
            let mut t = if MOTION == SINGLE { zero } else { w * e.p[2][k] };
            if moves {
                t = x.fma(e.p[0][k], t);
            }
            if MOTION != SINGLE {
                t = vw.fma(e.v[2][k + 1], t);
            }
            if moves {
                t = vx.fma(e.v[0][k + 1], t);
            }
            if k == 0 {
                // Without the static load, whose rounding would decide at the edge of the cone.
                let mut normal = zero;
                if MOTION != SINGLE {
                    normal = (b.scene[W] * square).fma(e.p[0][0], b.scene[W + 2] * square * e.p[2][0]);
                    normal = (b.scene[W + 3] * e.step).fma(e.v[0][1], normal);
                    normal = (b.scene[W + 5] * e.step).fma(e.v[2][1], normal);
                    normal = b.scene[KAPPA].fnma(b.drive * square, normal);
                }
                t += b.drive * square;
                let held = mu * normal;
                g.start[1] = sticks.select(b.scene[CONE].fma(square, held) - t, g.start[1]);
                g.start[2] = sticks.select(b.scene[CONE + 1].fma(square, held) + t, g.start[2]);
            } else {
                let second = sticks.select(-t, g.second[k]);
                g.second[k].put(second);
            }
        }
        g.second[N - 2] = g.second[N - 2].only(sticks.not());
    }
    if MOTION == FLIGHT {
        let free = b.free();
        for k in 0..N {
            let force = if k < N - 2 { e.n[k] } else { zero };
            let first = free.select(e.p[1][k], force);
            e.n[k].put(first);
        }
    } else if MOTION != SINGLE {
        e.n[N - 2] = zero;
        e.n[N - 1] = zero;
    }
    g.start[0] = e.n[0];
}

/// Terms of a series that are bounded by their Bernstein coefficients, those above by their magnitudes: of four, twice as
/// many lift-offs are looked for.
const BOUNDED: usize = 6;

/// The Bernstein coefficients on [0, 1] of `Σ b_(before + k) t^k` for k from 1 to [`BOUNDED`], but for the first, which is 0.
#[inline(always)]
fn bernstein<S: Simd, T: Scalar<S>, const N: usize>(
    b: &[Vector<S, T>; N],
    before: usize,
) -> [Vector<S, T>; BOUNDED] {
    let like = |number: f64| b[0].like(number);
    let [b1, b2, b3] = [b[before + 1], b[before + 2], b[before + 3]];
    let [b4, b5, b6] = [b[before + 4], b[before + 5], b[before + 6]];
    // Over the binomial coefficients of the degree.
    let (sixth, fifteenth) = (like(1.0 / 6.0), like(1.0 / 15.0));
    let (c1, c2, c3) = (b1 * sixth, b2 * fifteenth, b3 * like(1.0 / 20.0));
    let (c4, c5) = (b4 * fifteenth, b5 * sixth);
    let second = like(2.0).fma(c1, c2);
    let third = like(3.0).fma(c1 + c2, c3);
    let fourth = like(4.0).fma(c1 + c3, like(6.0).fma(c2, c4));
    let fifth = like(5.0).fma(c1 + c4, like(10.0).fma(c2 + c3, c5));
    [c1, second, third, fourth, fifth, ((b1 + b2) + (b3 + b4)) + (b5 + b6)]
}

/// The sum of the magnitudes that [`bernstein`] leaves.
#[inline(always)]
fn tail<S: Simd, T: Scalar<S>, const N: usize>(
    b: &[Vector<S, T>; N],
    before: usize,
    end: usize,
) -> Vector<S, T> {
    let first = before + BOUNDED + 1;
    let mut rest = [b[first].abs(), b[first + 1].abs()];
    for k in first + 2..end {
        rest[(k - first) % 2] += b[k].abs();
    }
    rest[0] + rest[1]
}

/// The least and the largest of some numbers and 0.
#[inline(always)]
fn extremes<S: Simd, T: Scalar<S>>(b: &[Vector<S, T>; BOUNDED]) -> [Vector<S, T>; 2] {
    let zero = b[0].like(0.0);
    [
        b[0].min(b[1]).min(b[2].min(b[3])).min(b[4].min(b[5]).min(zero)),
        b[0].max(b[1]).max(b[2].max(b[3])).max(b[4].max(b[5]).max(zero)),
    ]
}

/// Lanes in which each event function may fall to zero in the step.
#[inline(always)]
pub fn may_fall<S: Simd, T: Scalar<S>, const N: usize, const MOTION: u8>(
    b: &Block<S, T>,
    e: &Expansion<S, T, N>,
    g: &Functions<S, T, N>,
) -> [Mask<S, T>; 3] {
    let zero = e.step.like(0.0);
    let mut rest = tail(&g.second, 0, N - 1);
    let (mut first, mut of_force) = (e.n[0], [zero; BOUNDED]);
    if MOTION != SINGLE {
        let force_rest = tail(&e.n, 0, if MOTION == FLIGHT { N } else { N - 2 });
        of_force = bernstein(&e.n, 0);
        let [least, _] = extremes(&of_force);
        first = e.n[0] + least - force_rest;
        rest = g.share.fma(force_rest, rest);
    }
    let along = bernstein(&g.second, 0);
    let (mut ahead, mut back) = (zero, zero);
    for i in 0..BOUNDED {
        let [mut up, mut down] = [along[i], -along[i]];
        if MOTION != SINGLE {
            [up, down] = [g.share.fma(of_force[i], up), g.share.fma(of_force[i], down)];
        }
        ahead = ahead.min(up);
        back = back.min(down);
    }
    let mut open =
        [first.not_positive(), (g.start[1] + ahead).at_most(rest), (g.start[2] + back).at_most(rest)];
    if MOTION == FLIGHT {
        let touches = b.free().not();
        open[1] = open[1].and(touches);
        open[2] = open[2].and(touches);
    }
    open
}

/// Whether the sliding speed of lanes that slip, and begin at the lower end of its piece or at the upper one (`upper`), may
/// come back to it: whether its series without that root may fall to zero. A first coefficient that is not below zero by
/// more than `bound` is taken for zero, as [`crate::engine::lanes::function::Function::deflate`] does.
#[inline(always)]
pub fn may_return<S: Simd, T: Scalar<S>, const N: usize>(
    g: &Functions<S, T, N>,
    upper: Mask<S, T>,
    bound: Vector<S, T>,
) -> Mask<S, T> {
    // c₁ + t h(t), where h is bounded.
    let c = &g.second;
    let [least, most] = extremes(&bernstein(c, 2));
    let least = upper.select(-(c[2] + most), c[2] + least) - tail(c, 2, N - 1);
    let begin = upper.select(-c[1], c[1]);
    let zero = least.like(0.0);
    (-bound).at_most(begin).and(zero.less(begin.max(zero) + least)).not()
}
