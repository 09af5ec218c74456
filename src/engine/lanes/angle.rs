//! Angles and their cosines in every lane.

use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::Vector;
use crate::engine::precision::Precision;
use std::f64::consts::{FRAC_PI_2, PI};

use pulp::Simd;

/// `arctan x / x` on [0, 1] by powers of `x²`, off by 2e-8 at most: Abramowitz and Stegun, 4.4.49.
const ARCTAN: [f64; 9] = [
    1.0,
    -0.333_331_452_8,
    0.199_935_508_5,
    -0.142_088_994_4,
    0.106_562_639_3,
    -0.075_289_640_0,
    0.042_909_613_8,
    -0.016_165_736_7,
    0.002_866_225_7,
];

/// `arccos x / √(1 − x)` on [0, 1], off by 7e-5 at most: Abramowitz and Stegun, 4.4.45.
const ARCCOS: [f64; 4] = [1.570_728_8, -0.212_114_4, 0.074_261_0, -0.018_729_3];

/// `Σ c_k x^k` of constants.
#[inline(always)]
fn polynomial<S: Simd, T: Scalar<S>, const N: usize>(
    coefficients: &[f64; N],
    x: Vector<S, T>,
) -> Vector<S, T> {
    let mut sum = x.like(coefficients[N - 1]);
    for k in (0..N - 1).rev() {
        sum = sum.fma(x, x.like(coefficients[k]));
    }
    sum
}

/// The angle of a vector of cosine and sine, of whatever length, in `(−π, π]`; 0 of none.
#[inline(always)]
pub fn angle_of<S: Simd, T: Scalar<S>>([cosine, sine]: [Vector<S, T>; 2]) -> Vector<S, T> {
    let zero = cosine.like(0.0);
    let (wide, high) = (cosine.abs(), sine.abs());
    let (small, large) = (wide.min(high), wide.max(high));
    let known = zero.less(large);
    let ratio = small / known.select(large, zero.like(1.0));
    let mut angle = polynomial(&ARCTAN, ratio * ratio) * ratio;
    if T::PRECISION == Precision::F64 {
        // The sine of what is missing, over the length in units of the longer side.
        let [c, s] = rotation(angle);
        angle += ratio.fma(c, -s) / ratio.fma(ratio, zero.like(1.0)).sqrt();
    }
    let angle = wide.less(high).select(zero.like(FRAC_PI_2) - angle, angle);
    let angle = cosine.less(zero).select(zero.like(PI) - angle, angle);
    sine.less(zero).select(-angle, angle)
}

/// About the angle of a cosine, in `[0, π]`: off by 1e-4 at most.
#[inline(always)]
pub fn about_arccos<S: Simd, T: Scalar<S>>(cosine: Vector<S, T>) -> Vector<S, T> {
    let one = cosine.like(1.0);
    let x = cosine.abs().min(one);
    let angle = polynomial(&ARCCOS, x) * (one - x).sqrt();
    cosine.less(one.like(0.0)).select(one.like(PI) - angle, angle)
}

/// `cos φ` and `sin φ` of angles up to a turn and a little more, and what the length of the two is short of 1 by their
/// rounding: the same in every step of one length, it would let a motion grow or decay.
#[inline(always)]
pub fn far_rotation<S: Simd, T: Scalar<S>>(angle: Vector<S, T>) -> ([Vector<S, T>; 2], Vector<S, T>) {
    let [mut c, mut s] = rotation(angle * angle.like(0.25));
    for _ in 0..2 {
        (c, s) = ((c - s) * (c + s), (c + c) * s);
    }
    // Squares in two parts; the larger one subtracts from 1 without rounding, and so does the other from what is left.
    let (cosine, sine) = (c * c, s * s);
    let low = c.fma(c, -cosine) + s.fma(s, -sine);
    let short = ((angle.like(1.0) - cosine.max(sine)) - cosine.min(sine)) - low;
    ([c, s], short * angle.like(0.5))
}

/// An angle brought into `(0, period]` from one period beside it.
#[inline(always)]
pub fn folded<S: Simd, T: Scalar<S>>(angle: Vector<S, T>, period: f64) -> Vector<S, T> {
    let period = angle.like(period);
    let angle = angle.not_positive().select(angle + period, angle);
    period.less(angle).select(angle - period, angle)
}

/// `cos φ` and `sin φ` for moderate angles.
#[inline(always)]
pub fn rotation<S: Simd, T: Scalar<S>>(angle: Vector<S, T>) -> [Vector<S, T>; 2] {
    let one = angle.like(1.0);
    let square = angle * angle;
    let mut cosine = one;
    let mut sine = one;
    let mut k = match T::PRECISION {
        Precision::F32 => 6,
        Precision::F64 => 10,
    };
    while k >= 1 {
        let n = f64::from(2 * k);
        cosine = (square * one.like(1.0 / (n * (n - 1.0)))).fnma(cosine, one);
        sine = (square * one.like(1.0 / (n * (n + 1.0)))).fnma(sine, one);
        k -= 1;
    }
    [cosine, sine * angle]
}

/// `z exp(−iφ)`.
#[inline(always)]
pub fn turn<S: Simd, T: Scalar<S>>(z: [Vector<S, T>; 2], by: [Vector<S, T>; 2]) -> [Vector<S, T>; 2] {
    [z[0].fma(by[0], z[1] * by[1]), z[1].fma(by[0], -(z[0] * by[1]))]
}
