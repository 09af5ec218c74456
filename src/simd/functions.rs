//! The event functions of every lane's step, and which of them may fall to zero.

use std::ops::Not;

use pulp::Simd;

use super::block::{Block, LOWER, UPPER};
use super::constants::{CONE, KAPPA, MU_STICK, R, W};
use super::expand::{Expansion, FLIGHT, SINGLE};
use super::vector::{Mask, Scalar, Vector};

/// The event functions of a step. Each is `m n_k + s d_k` for `k > 0`, with the series `n` of the normal force
/// (of the gap for lanes that fly) and one more; the rest differs from lane to lane.
#[derive(Clone, Copy, Debug)]
pub struct Functions<S: Simd, T: Scalar<S>, const K: usize, const N: usize> {
    /// Their values at the beginning, in the order of [`super::block::FIRST`] to
    /// [`super::block::THIRD`].
    pub start: [Vector<S, T, K>; 3],
    /// The second series, from degree 1 on: sliding speed in slip, less the tangential force in stick.
    pub second: [Vector<S, T, K>; N],
    /// `m` of the second and third function: the limit of stick for lanes that stick.
    pub share: Vector<S, T, K>,
}

impl<S: Simd, T: Scalar<S>, const K: usize, const N: usize> Functions<S, T, K, N> {
    /// No function.
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        let zero = Vector::constant(simd, 0.0);
        Functions { start: [zero; 3], second: [zero; N], share: zero }
    }
}

/// The event functions; the series of the normal force becomes that of the gap in lanes that fly.
#[inline(always)]
pub fn functions<S: Simd, T: Scalar<S>, const K: usize, const N: usize, const MOTION: u8>(
    b: &Block<S, T, K>,
    e: &mut Expansion<S, T, K, N>,
    g: &mut Functions<S, T, K, N>,
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
            let mut t = vx.fma(e.v[0][k + 1], x * e.p[0][k]);
            if MOTION != SINGLE {
                t = x.fma(e.p[0][k], w * e.p[2][k]);
                t = vx.fma(e.v[0][k + 1], vw.fma(e.v[2][k + 1], t));
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
                g.second[k] = sticks.select(-t, g.second[k]);
            }
        }
        g.second[N - 2] = g.second[N - 2].only(sticks.not());
    }
    if MOTION == FLIGHT {
        let free = b.free();
        for k in 0..N {
            let force = if k < N - 2 { e.n[k] } else { zero };
            e.n[k] = free.select(e.p[1][k], force);
        }
    } else if MOTION != SINGLE {
        e.n[N - 2] = zero;
        e.n[N - 1] = zero;
    }
    g.start[0] = e.n[0];
}

/// The Bernstein coefficients on [0, 1] of the part of a series from degree 1 to 4, but for the first, which is 0.
#[inline(always)]
fn bernstein<S: Simd, T: Scalar<S>, const K: usize, const N: usize>(
    b: &[Vector<S, T, K>; N],
) -> [Vector<S, T, K>; 4] {
    let (c1, c2, c3) = (b[1] * b[1].like(0.25), b[2] * b[1].like(1.0 / 6.0), b[3] * b[1].like(0.25));
    let second = c1.like(2.0).fma(c1, c2);
    let third = c1.like(3.0).fma(c1 + c2, c3);
    [c1, second, third, (b[1] + b[2]) + (b[3] + b[4])]
}

/// The sum of the magnitudes from degree 5 on.
#[inline(always)]
fn tail<S: Simd, T: Scalar<S>, const K: usize, const N: usize>(
    b: &[Vector<S, T, K>; N],
    end: usize,
) -> Vector<S, T, K> {
    let mut rest = [b[5].abs(), b[6].abs()];
    for k in 7..end {
        rest[(k + 1) % 2] += b[k].abs();
    }
    rest[0] + rest[1]
}

/// Lanes in which each event function may fall to zero in the step.
#[inline(always)]
pub fn may_fall<S: Simd, T: Scalar<S>, const K: usize, const N: usize, const MOTION: u8>(
    b: &Block<S, T, K>,
    e: &Expansion<S, T, K, N>,
    g: &Functions<S, T, K, N>,
) -> [Mask<S, T, K>; 3] {
    let zero = e.step.like(0.0);
    let mut rest = tail(&g.second, N - 1);
    let (mut first, mut of_force) = (e.n[0], [zero; 4]);
    if MOTION != SINGLE {
        let force_rest = tail(&e.n, if MOTION == FLIGHT { N } else { N - 2 });
        of_force = bernstein(&e.n);
        let least = of_force[0].min(of_force[1]).min(of_force[2].min(of_force[3])).min(zero);
        first = e.n[0] + least - force_rest;
        rest = g.share.fma(force_rest, rest);
    }
    let along = bernstein(&g.second);
    let (mut ahead, mut back) = (zero, zero);
    for i in 0..4 {
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
