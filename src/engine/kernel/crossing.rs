//! Twin: shaders/crossing.wgsl
//!
//! The first downward crossing of an event function inside a step.
//!
//! A lower bound by Bernstein coefficients settles most steps; the rest is sampled and solved.

#![expect(clippy::needless_range_loop, reason = "the loops are those of the WGSL twin")]

use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::series::Series;
use crate::engine::kernel::steps::ORDER;

/// Samples of an event function inside a step that the bound does not clear.
pub const SAMPLES: usize = 8;

/// A sample lower than both its neighbours is followed to the minimum when it is below this part of their second
/// difference: that of a parabola is no deeper than an eighth of it.
pub const DIP: f64 = 0.25;

/// Iterations that follow it: each leaves some tenth of the distance.
pub const DIP_ITERATIONS: usize = 3;

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

/// The place of the minimum around a sample that is lower than both its neighbours, from their second difference.
pub fn lowest<S: Real>(b: &Series<S>, degree: usize, from: usize, sample: S, curvature: S) -> S {
    let gap = S::from_f64(1.0 / SAMPLES as f64);
    let mut t = sample;
    for _ in 0..DIP_ITERATIONS {
        let slope = deflated(b, degree, from, t)[1];
        let next = t - slope * (gap * gap) / curvature;
        t = next.max(sample - gap).min(sample + gap);
    }
    t
}

/// The time of the first downward crossing of `Σ g_k τ^k` in `(0, step]`, 0 when it is negative from the
/// start, [`NEVER`] when it stays positive.
///
/// With `from_zero` the function begins at zero by construction. Physics makes its first coefficients non-negative, so they
/// count as zero when they are negative by no more than `rounding`, an absolute bound. A function below zero by no more than
/// `near` begins there too, and falls at once if its slope is negative. For a function above zero the crossing lies ahead,
/// however near.
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
        // A force that stays where it is does not fall.
        while from <= HIGHEST_ORDER && g[from] == S::ZERO {
            from += 1;
        }
        if from > HIGHEST_ORDER {
            return never;
        }
    }
    if b[from] <= S::ZERO {
        return S::ZERO;
    }
    let mut low = S::ZERO;
    let mut high = S::ZERO;
    let (two, gap, dip) = (S::from_f64(2.0), S::from_f64(1.0 / SAMPLES as f64), S::from_f64(DIP));
    let mut before = b[from];
    let mut here = before;
    for i in 1..=SAMPLES {
        let t = S::from_f64(i as f64 / SAMPLES as f64);
        if high <= S::ZERO {
            let value = deflated(&b, degree, from, t)[0];
            // Lowest in the middle, or at the start on its way down: it may dip below zero in between.
            let mut curvature = before - two * here + value;
            let mut falls = before - here;
            if i == 1 {
                falls = -(b[from + 1] * gap);
                curvature = two * ((value - here) + falls);
            }
            if value <= S::ZERO {
                high = t;
            } else if falls > S::ZERO && here <= value && here <= dip * curvature {
                let bottom = lowest(&b, degree, from, t - gap, curvature);
                if deflated(&b, degree, from, bottom)[0] <= S::ZERO {
                    high = bottom;
                    low = (t - two * gap).max(S::ZERO);
                }
            }
            if high <= S::ZERO {
                low = t;
            }
            before = here;
            here = value;
        }
    }
    if high <= S::ZERO {
        // Lowest at the end, on its way up.
        let rise = deflated(&b, degree, from, S::ONE)[1] * gap;
        let curvature = two * (rise + (before - here));
        if rise > S::ZERO && here < before && here <= dip * curvature {
            let bottom = lowest(&b, degree, from, S::ONE, curvature);
            if deflated(&b, degree, from, bottom)[0] <= S::ZERO {
                high = bottom;
                low = S::ONE - gap;
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
