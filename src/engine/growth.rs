//! Growth rate, frequency and phase from the sums before the first event.
//!
//! Least squares on the samples, means removed:
//!
//! ```text
//! ẍ2 = 2σ ẋ2 − |λ|² (x2 − x2_eq)        ÿ1 = α ẍ2 + β ẋ2        φ = arg(α + β/λ)
//! ```

use std::f64::consts::TAU;

use num_complex::Complex64;

use crate::engine::sums::growth::{PRODUCTS, SAMPLED, SAMPLES, TIME, WORDS};
use crate::model::scaled::Scaled;

/// A growth window shorter than this many periods `2π/ω0` says nothing.
pub const SHORTEST_GROWTH_WINDOW: f64 = 1.0;

/// What the growth window measured, in scaled units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrowthFit {
    /// Real part of the eigenvalue.
    pub growth_rate: f64,
    /// Imaginary part of the eigenvalue.
    pub angular_frequency: f64,
    /// Phase of `ÿ1` against `ẍ2`, rad; `None` when `y1` does not follow.
    pub phase: Option<f64>,
}

/// A change of the slope of friction over the motion that changes the growth rate by more than this part of it.
const BENT: f64 = 0.1;

impl GrowthFit {
    /// Whether a curved law bends too much over a motion of this largest deviation of `x2` for its growth rate to be that of a
    /// linear one. No event tells where such growth has ended.
    #[must_use]
    pub fn is_bent(&self, model: &Scaled, words: &[f64; WORDS], deviation: f64) -> bool {
        let law = model.law.pieces[0];
        if law.form().is_straight() {
            return false;
        }
        let speed =
            2_f64.sqrt() * (deviation * self.angular_frequency).max(covariance(words, 1, 1).max(0.0).sqrt());
        let ways = [speed, -speed.min(model.v0)].map(|change| law.change(model.v0, change) / change);
        let bend =
            ways.into_iter().fold(0.0, |bend, slope| f64::max(bend, (slope - law.slope(model.v0)).abs()));
        0.5 * bend * model.n0 > BENT * self.growth_rate.abs()
    }
}

/// The fit, when the window is long enough and oscillates.
#[must_use]
pub fn fit(words: &[f64; WORDS]) -> Option<GrowthFit> {
    let [x, v, a, b] = [0, 1, 2, 3];
    if words[TIME] < SHORTEST_GROWTH_WINDOW * TAU {
        return None;
    }
    let (twice_growth, stiffness) = solve(words, a, v, x)?;
    let growth_rate = 0.5 * twice_growth;
    let square = -stiffness - growth_rate * growth_rate;
    if !(square > 0.0 && square.is_finite() && growth_rate.is_finite()) {
        return None;
    }
    let angular_frequency = square.sqrt();
    let phase = solve(words, b, a, v)
        .map(|(alpha, beta)| (alpha + beta / Complex64::new(growth_rate, angular_frequency)).arg())
        .filter(|phase| phase.is_finite());
    let follows = covariance(words, b, b) > 0.0;
    Some(GrowthFit { growth_rate, angular_frequency, phase: phase.filter(|_| follows) })
}

/// Covariance of two samples.
fn covariance(words: &[f64; WORDS], i: usize, j: usize) -> f64 {
    let (low, high) = (i.min(j), i.max(j));
    // Rows of an upper triangle.
    let product = words[PRODUCTS + low * SAMPLED - low * (low + 1) / 2 + high];
    let mean = |i: usize| words[SAMPLES + i] / words[TIME];
    product / words[TIME] - mean(i) * mean(j)
}

/// Solves `target = p u + q v` in the least-squares sense.
fn solve(words: &[f64; WORDS], target: usize, u: usize, v: usize) -> Option<(f64, f64)> {
    let covariance = |i, j| covariance(words, i, j);
    let (uu, uv, vv) = (covariance(u, u), covariance(u, v), covariance(v, v));
    let (ut, vt) = (covariance(u, target), covariance(v, target));
    let det = uu * vv - uv * uv;
    let (p, q) = ((ut * vv - vt * uv) / det, (vt * uu - ut * uv) / det);
    (det > 0.0 && p.is_finite() && q.is_finite()).then_some((p, q))
}
