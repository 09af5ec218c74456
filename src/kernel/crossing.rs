//! Twin: shaders/crossing.wgsl
//!
//! The first downward crossing of an event function inside a step.
//!
//! A lower bound by Bernstein coefficients settles most steps; the rest is sampled and solved.

#![expect(clippy::needless_range_loop, reason = "the loops are those of the WGSL twin")]

use super::scalar::Real;
use super::series::{ORDER, Series};

/// Samples of an event function inside a step that the bound does not clear: a dip shorter than an eighth
/// of a step may be missed.
pub const SAMPLES: usize = 8;

/// Iterations of the bracketed Newton solver.
pub const SOLVER_ITERATIONS: usize = 12;

/// Zeros of an event function at its start are at most of this order (the gap opens with t³).
pub const HIGHEST_ORDER: usize = 3;

/// A time that means no crossing.
pub const NEVER: f64 = -1.0;

/// A lower bound of `Σ b_k t^k` on [0, 1]: Bernstein coefficients of the part up to degree 4 less the rest.
pub fn lower_bound<S: Real>(b: &Series<S>, degree: usize) -> S {
    let c1 = b[1] * S::from_f64(0.25);
    let c2 = b[2] * S::from_f64(1.0 / 6.0);
    let c3 = b[3] * S::from_f64(0.25);
    let two = S::from_f64(2.0);
    let three = S::from_f64(3.0);
    let b1 = b[0] + c1;
    let b2 = b[0] + two * c1 + c2;
    let b3 = b[0] + three * c1 + three * c2 + c3;
    let b4 = b[0] + b[1] + b[2] + b[3] + b[4];
    let mut rest = S::ZERO;
    for k in 5..=degree {
        rest += b[k].abs();
    }
    b[0].min(b1).min(b2).min(b3).min(b4) - rest
}

/// `Σ_{k ≥ from} b_k t^(k − from)` and its derivative.
pub fn deflated<S: Real>(b: &Series<S>, degree: usize, from: usize, t: S) -> [S; 2] {
    let mut value = S::ZERO;
    let mut slope = S::ZERO;
    for k in (from..=degree).rev() {
        slope = slope * t + value;
        value = value * t + b[k];
    }
    [value, slope]
}

/// The time of the first downward crossing of `Σ g_k τ^k` in `(0, step]`, 0 when it is negative from the
/// start, [`NEVER`] when it stays positive.
///
/// With `from_zero` it begins at zero by construction, and its first coefficients, which physics makes
/// non-negative, count as zero when they are negative by no more than `rounding`, an absolute bound. A
/// function below zero by no more than `near` begins there too, and falls at once if its slope is negative;
/// one above zero has its crossing ahead, however near.
#[must_use]
pub fn first_crossing<S: Real>(
    g: &Series<S>,
    degree: usize,
    step: S,
    from_zero: bool,
    near: S,
    rounding: S,
) -> S {
    let never = S::from_f64(NEVER);
    let mut b = [S::ZERO; ORDER + 1];
    let mut power = S::ONE;
    for k in 0..=degree {
        b[k] = g[k] * power;
        power *= step;
    }
    if !from_zero && lower_bound(&b, degree) > S::ZERO {
        return never;
    }
    let mut from = 0;
    if from_zero {
        from = 1;
        while from <= HIGHEST_ORDER && g[from] <= S::ZERO && g[from] >= -rounding {
            from += 1;
        }
        if from > HIGHEST_ORDER {
            return never;
        }
    } else if g[0] <= S::ZERO && g[0] >= -near {
        from = 1;
    }
    if b[from] <= S::ZERO {
        return S::ZERO;
    }
    let mut low = S::ZERO;
    let mut high = S::ZERO;
    for i in 1..=SAMPLES {
        let t = S::from_f64(i as f64 / SAMPLES as f64);
        if high <= S::ZERO {
            if deflated(&b, degree, from, t)[0] <= S::ZERO {
                high = t;
            } else {
                low = t;
            }
        }
    }
    if high <= S::ZERO {
        return never;
    }
    let mut t = S::from_f64(0.5) * (low + high);
    for _ in 0..SOLVER_ITERATIONS {
        let [value, slope] = deflated(&b, degree, from, t);
        if value > S::ZERO {
            low = t;
        } else {
            high = t;
        }
        let middle = S::from_f64(0.5) * (low + high);
        let mut next = middle;
        if slope < S::ZERO {
            let newton = t - value / slope;
            if newton >= low && newton <= high {
                next = newton;
            }
        }
        t = next;
    }
    t * step
}
