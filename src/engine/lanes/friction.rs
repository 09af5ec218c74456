//! Friction of every lane at the beginning of a step, and the exponential that it needs.

use pulp::Simd;

use crate::engine::lanes::block::{AT_ZERO, Block, OFFSET, RATE, SLOPE};
use crate::engine::lanes::constants::MU0;
use crate::engine::lanes::motion::PIECES;
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::Vector;
use crate::engine::lanes::words::{DOUBLINGS, DOWN, EXP_DEGREE, FARTHEST, POWER};
use crate::model::piece::{FAR, LawForm};

/// Friction at the beginning of a step.
#[derive(Clone, Copy)]
pub struct AtStart<S: Simd, T: Scalar<S>> {
    /// `q = σ μ`.
    pub(super) q: Vector<S, T>,
    /// `q − μ0`.
    pub(super) less: Vector<S, T>,
    /// What the recurrence of a curved law carries along: of an exponential its distance from the floor, to the last digits
    /// however far down; of others `q`.
    pub(super) law: Vector<S, T>,
}

/// Friction at the relative velocity `v`, see [`crate::engine::lanes::words::Words::friction`].
#[inline(always)]
pub fn friction<S: Simd, T: Scalar<S>, const LAW: bool>(
    b: &Block<S, T>,
    sigma: Vector<S, T>,
    v: Vector<S, T>,
    lag: Vector<S, T>,
) -> AtStart<S, T> {
    let one = v.like(1.0);
    let forward = one.at_most(sigma);
    let (at_zero, slope, rate, offset) = (b.piece[AT_ZERO], b.piece[SLOPE], b.piece[RATE], b.piece[OFFSET]);
    let (q, less) = if LAW == PIECES {
        (slope.fma(v, sigma * at_zero), slope.fnma(lag, offset))
    } else {
        match b.law {
            LawForm::Exponential => {
                let ahead = rate * lag;
                let near = forward.and(ahead.at_most(one.like(FAR)));
                let base = near.select(offset, slope);
                let [change, ratio] = exponential(near.select(ahead, -(rate * (sigma * v).max(v.like(0.0)))));
                let law = base * ratio;
                let q = sigma * (at_zero + law);
                return AtStart { q, less: near.select(base * change, q - b.scene[MU0]), law };
            }
            LawForm::Pieces | LawForm::Rational => {
                let reciprocal = one / (rate * sigma).fma(v, one);
                (sigma * at_zero * reciprocal, at_zero * rate * lag * reciprocal * offset)
            }
        }
    };
    AtStart { q, less: forward.select(less, q - b.scene[MU0]), law: q }
}

/// `exp(x) − 1`, see [`crate::engine::lanes::words::exp_m1`].
#[inline(always)]
pub fn exp_m1<S: Simd, T: Scalar<S>>(x: Vector<S, T>) -> Vector<S, T> {
    let [e, _] = exponential(x);
    e
}

/// `exp(x) − 1` and `exp(x)`, each to its own last digits.
///
/// Below [`DOWN`] the sum of one and the first has lost what is left of the second: there it is the 16th power of `exp(x/16)`,
/// on the way to the first, and 0 below −[`FARTHEST`].
#[inline(always)]
fn exponential<S: Simd, T: Scalar<S>>(x: Vector<S, T>) -> [Vector<S, T>; 2] {
    let unbounded = x;
    let x = x.max(x.like(-FARTHEST)).min(x.like(FARTHEST));
    let large = x.like(0.5).less(x.abs());
    let doubled = large.any();
    let y = if doubled { large.select(x * x.like(0.5_f64.powi(DOUBLINGS)), x) } else { x };
    let mut sum = x.like(1.0);
    let mut k = EXP_DEGREE;
    while k >= 2 {
        sum = (y * y.like(1.0 / f64::from(k))).fma(sum, y.like(1.0));
        k -= 1;
    }
    let mut e = y * sum;
    let one = x.like(1.0);
    if !doubled {
        return [e, one + e];
    }
    let small = e;
    let mut power = one;
    for doubling in 0..DOUBLINGS {
        if doubling == DOUBLINGS - POWER {
            power = one + e;
        }
        e = e * (e + e.like(2.0));
    }
    for _ in 0..POWER {
        power = power * power;
    }
    e = large.select(e, small);
    let power = power.only(x.like(-FARTHEST).at_most(unbounded));
    [e, x.less(x.like(DOWN)).select(power, one + e)]
}
