//! The first zero crossing of a polynomial event function inside a step.
//!
//! Bernstein coefficients bound a polynomial on an interval: all positive, no zero; one change of sign,
//! exactly one zero. Subdivision isolates the first downward crossing, so that no event is missed
//! however short it is (variation-diminishing property; R. T. Farouki, Comput. Aided Geom. Des. 29, 379 (2012)).

use super::taylor::{MAX_ORDER, Series, horner_with_derivative};

/// An event function that is armed counts as beginning at zero when it is no further below, relative to
/// its own size over the step: rounding of the state that a transition has just set.
const ROUNDING: f64 = 1e-12;

/// A leading coefficient that physics makes non-negative may come out this negative by rounding,
/// relative to the function's size over the step: slow belts (1e-6 m/s) lose 9 digits against the static loads.
const LEADING_ROUNDING: f64 = 1e-6;

/// Zeros of an event function at its start are at most of this order (the gap opens with t³).
const HIGHEST_ORDER_AT_START: usize = 3;

/// Subdivision stops at this fraction of the step: two crossings closer than that are no event.
const FINEST_INTERVAL: f64 = 1e-12;

/// Iterations of the bracketed Newton solver, which bisects where Newton leaves the bracket.
const SOLVER_ITERATIONS: usize = 80;

/// Whether and where an event function crosses zero from above within a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Crossing {
    /// It stays positive.
    Never,
    /// It is negative from the start.
    Immediate,
    /// It crosses this long after the start.
    At(f64),
}

/// The first downward crossing of `Σ g_k τ^k` for `τ` in `(0, step]`.
///
/// With `from_zero` the function begins at zero by construction (the event that started this contact
/// state), and only a crossing after it has opened counts.
#[must_use]
pub fn first_crossing(series: &[f64], step: f64, from_zero: bool) -> Crossing {
    let mut scaled: Series = [0.0; MAX_ORDER + 1];
    let mut power = 1.0;
    for (target, g) in scaled.iter_mut().zip(series) {
        *target = g * power;
        power *= step;
    }
    if !from_zero && lower_bound(&scaled[..series.len()]) > 0.0 {
        return Crossing::Never;
    }
    let mut coefficients = &scaled[..series.len()];
    if from_zero || (coefficients[0] <= 0.0 && coefficients[0] >= -ROUNDING * series_size(coefficients)) {
        let opening = series_size(&coefficients[1..]);
        for _ in 0..HIGHEST_ORDER_AT_START {
            coefficients = &coefficients[1..];
            if coefficients[0] > 0.0 || coefficients[0] < -LEADING_ROUNDING * opening {
                break;
            }
        }
        if opening == 0.0 {
            return Crossing::Never;
        }
    }
    if coefficients[0] <= 0.0 {
        return Crossing::Immediate;
    }
    isolate(coefficients)
        .map_or(Crossing::Never, |(low, high)| Crossing::At(step * solve(coefficients, low, high)))
}

fn series_size(coefficients: &[f64]) -> f64 {
    coefficients.iter().fold(0.0, |size, c| size.max(c.abs()))
}

/// `1/C(n, k)` by degree `n` and `k`.
const INVERSE_BINOMIAL: [[f64; MAX_ORDER + 1]; MAX_ORDER + 1] = {
    let mut table = [[0.0; MAX_ORDER + 1]; MAX_ORDER + 1];
    let mut n = 0;
    while n <= MAX_ORDER {
        let mut binomial = 1;
        let mut k = 0;
        while k <= n {
            table[n][k] = 1.0 / binomial as f64;
            binomial = binomial * (n - k) / (k + 1);
            k += 1;
        }
        n += 1;
    }
    table
};

/// Degree up to which the cheap bound keeps the polynomial; the rest counts with its absolute value.
const BOUND_DEGREE: usize = 4;

/// A lower bound on `[0, 1]`: the smallest Bernstein coefficient of the leading part less the rest.
fn lower_bound(coefficients: &[f64]) -> f64 {
    let (leading, rest) = coefficients.split_at((BOUND_DEGREE + 1).min(coefficients.len()));
    let lowest = bernstein(leading)[..leading.len()].iter().fold(f64::INFINITY, |low, beta| low.min(*beta));
    lowest - rest.iter().map(|c| c.abs()).sum::<f64>()
}

/// Bernstein coefficients on `[0, 1]` of a polynomial given by its powers.
#[inline]
fn bernstein(coefficients: &[f64]) -> Series {
    let degree = coefficients.len() - 1;
    let mut beta: Series = [0.0; MAX_ORDER + 1];
    for (k, c) in coefficients.iter().enumerate() {
        beta[k] = c * INVERSE_BINOMIAL[degree][k];
    }
    for pass in 1..=degree {
        for i in (pass..=degree).rev() {
            beta[i] += beta[i - 1];
        }
    }
    beta
}

/// Splits at the middle (de Casteljau): left half, right half.
fn split(beta: &Series, degree: usize) -> (Series, Series) {
    let (mut left, mut right) = (*beta, *beta);
    for pass in 1..=degree {
        for i in (pass..=degree).rev() {
            left[i] = 0.5 * (left[i] + left[i - 1]);
        }
        right[degree - pass] = left[degree];
    }
    (left, right)
}

/// The first interval in `[0, 1]` that holds exactly one crossing, from positive to not positive.
fn isolate(coefficients: &[f64]) -> Option<(f64, f64)> {
    let degree = coefficients.len() - 1;
    let whole = bernstein(coefficients);
    if whole[..=degree].iter().all(|beta| *beta > 0.0) {
        return None;
    }
    let mut waiting = vec![(0.0, 1.0, whole)];
    while let Some((low, width, beta)) = waiting.pop() {
        let active = &beta[..=degree];
        let changes = active.windows(2).filter(|pair| (pair[0] > 0.0) != (pair[1] > 0.0)).count();
        let (first, last) = (active[0] > 0.0, active[degree] > 0.0);
        if changes == 0 && first {
            continue;
        }
        if !first || (changes == 1 && !last) {
            return Some((low, low + width));
        }
        if width < FINEST_INTERVAL {
            if !last {
                return Some((low, low + width));
            }
            continue;
        }
        let (left, right) = split(&beta, degree);
        let half = 0.5 * width;
        waiting.push((low + half, half, right));
        waiting.push((low, half, left));
    }
    None
}

/// The zero between `low` (positive) and `high` (not positive): Newton, bisecting where it leaves the bracket.
fn solve(coefficients: &[f64], mut low: f64, mut high: f64) -> f64 {
    if horner_with_derivative(coefficients, low).0 <= 0.0 {
        return low;
    }
    let mut tau = 0.5 * (low + high);
    for _ in 0..SOLVER_ITERATIONS {
        let (value, slope) = horner_with_derivative(coefficients, tau);
        if value > 0.0 {
            low = tau;
        } else {
            high = tau;
        }
        let newton = tau - value / slope;
        let next = if newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
        if (next - tau).abs() <= f64::EPSILON * tau || high - low <= f64::EPSILON * high {
            return next;
        }
        tau = next;
    }
    tau
}
