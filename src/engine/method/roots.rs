//! Zero crossings of a polynomial inside a step: the first of an event function, all of a velocity.
//!
//! Bernstein coefficients bound a polynomial on an interval: all positive, no zero; one change of sign,
//! exactly one zero. Subdivision isolates the crossings, so that none is missed however short it is
//! (variation-diminishing property; R. T. Farouki, Comput. Aided Geom. Des. 29, 379 (2012)).

use crate::engine::method::taylor::{MAX_ORDER, Series, horner_with_derivative};

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
    let scaled = scaled(series, step, 1.0);
    let mut coefficients = &scaled[..series.len()];
    if !from_zero && lower_bound(coefficients) > 0.0 {
        return Crossing::Never;
    }
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

/// A series over the fraction of the step, times `sign`.
fn scaled(series: &[f64], step: f64, sign: f64) -> Series {
    let mut scaled: Series = [0.0; MAX_ORDER + 1];
    let mut power = sign;
    for (target, g) in scaled.iter_mut().zip(series) {
        *target = g * power;
        power *= step;
    }
    scaled
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

/// A part of `[0, 1]` in which a polynomial changes its sign at most once, or that is too short to be split.
#[derive(Clone, Copy, Debug)]
struct Piece {
    low: f64,
    high: f64,
    /// Whether the polynomial is positive at `low`, and at `high`.
    positive: [bool; 2],
}

/// The pieces of `[0, 1]` in order, without those where the polynomial is positive throughout.
struct Pieces {
    degree: usize,
    waiting: Vec<(f64, f64, Series)>,
}

impl Pieces {
    fn new(coefficients: &[f64]) -> Pieces {
        let degree = coefficients.len() - 1;
        let whole = bernstein(coefficients);
        let positive = whole[..=degree].iter().all(|beta| *beta > 0.0);
        Pieces { degree, waiting: if positive { Vec::new() } else { vec![(0.0, 1.0, whole)] } }
    }
}

impl Iterator for Pieces {
    type Item = Piece;

    fn next(&mut self) -> Option<Piece> {
        while let Some((low, width, beta)) = self.waiting.pop() {
            let active = &beta[..=self.degree];
            let changes = active.windows(2).filter(|pair| (pair[0] > 0.0) != (pair[1] > 0.0)).count();
            let positive = [active[0] > 0.0, active[self.degree] > 0.0];
            if changes == 0 && positive[0] {
                continue;
            }
            if changes <= 1 || width < FINEST_INTERVAL {
                return Some(Piece { low, high: low + width, positive });
            }
            let (left, right) = split(&beta, self.degree);
            let half = 0.5 * width;
            self.waiting.push((low + half, half, right));
            self.waiting.push((low, half, left));
        }
        None
    }
}

/// The first interval in `[0, 1]` that holds a crossing from positive to not positive.
fn isolate(coefficients: &[f64]) -> Option<(f64, f64)> {
    let crosses = |piece: &Piece| piece.positive != [true, true];
    Pieces::new(coefficients).find(crosses).map(|piece| (piece.low, piece.high))
}

/// A change of sign this close to the end of a step, relative to it, may be the rounding of a zero at the end.
const END_ROUNDING: f64 = 1e-9;

/// All crossings of `Σ g_k τ^k` from below zero, for `τ` in `[0, step]` and in order.
///
/// `below` says whether the function is below zero at the start and at the end of the step, as the steps before and
/// after have it: a zero that falls on a seam then counts once.
#[must_use]
pub fn upward_crossings(series: &[f64], step: f64, below: [bool; 2]) -> Vec<f64> {
    // What is below zero is positive here: a zero itself then counts as above.
    let mirrored = scaled(series, step, -1.0);
    let upright = mirrored.map(|g| -g);
    let (mirrored, upright) = (&mirrored[..series.len()], &upright[..series.len()]);
    let quiet = match below {
        [true, true] => lower_bound(mirrored) > 0.0,
        [false, false] => lower_bound(upright) > 0.0,
        _ => false,
    };
    if quiet {
        return Vec::new();
    }
    let mut changes: Vec<(f64, bool)> = Pieces::new(mirrored)
        .filter_map(|piece| match piece.positive {
            [true, false] => Some((solve(mirrored, piece.low, piece.high), true)),
            [false, true] => Some((solve(upright, piece.low, piece.high), false)),
            _ => None,
        })
        .collect();
    let ends_below = changes.len() % 2 == usize::from(!below[0]);
    if ends_below != below[1] {
        if changes.last().is_some_and(|&(tau, _)| tau > 1.0 - END_ROUNDING) {
            changes.pop();
        } else {
            changes.push((1.0, !below[1]));
        }
    }
    changes.into_iter().filter(|&(_, upward)| upward).map(|(tau, _)| tau * step).collect()
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
