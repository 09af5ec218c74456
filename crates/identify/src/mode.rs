//! One growing oscillation fitted to samples: its course and its complex amplitude in every channel at once.
//!
//! Every channel is `c + d τ + Re(A z) + e |z|² + Re(C z²)` and white noise, with one course `z(τ)` (shape.rs; at first
//! `exp(λτ)`) for all: the last two terms are what friction adds that is quadratic in the motion. For a given course that
//! is linear, so its parameters alone are iterated (Gauss and Newton, linear part projected out: Golub and Pereyra 1973),
//! each channel weighted by its own noise. An oscillation that grows by e in five periods has nearly all it tells in its last five: no window
//! may fade them out.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use crate::cross::{Measured, Ratio};
use crate::shape::Shape;

/// Most rounds for the course; five are usual.
const ROUNDS: usize = 24;
/// The course is found when its parameters change by less than this part of their standard errors.
const FOUND: f64 = 1e-2;
/// Most halvings of a step.
const HALVINGS: i32 = 5;
/// A step may lose this much of twice the logarithm of the likelihood, by rounding.
const SAME: f64 = 1e-3;
/// Added to the squares of columns of norm 1, so that near copies of one another do no harm.
const RIDGE: f64 = 1e-9;
/// Periods over the fit by which the second harmonic must miss the oscillation as sampled.
const ALIASED: f64 = 4.0;
/// Samples per unknown below which nothing is fitted.
const LEAST_PER_UNKNOWN: usize = 3;

/// Standard errors are this much larger than white noise alone would leave: the end of the growth is chosen from the same
/// samples, and a trace of the second mode is in them (measured on synthetic strokes, docs/identify.md).
const CHOSEN: f64 = 1.2;

/// The columns that are fitted to every channel. `AMPLITUDE` and the next one are those of the oscillation.
const AMPLITUDE: usize = 2;
const COLUMNS: usize = 7;

/// A channel of a fitted mode.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Fitted {
    /// Complex amplitude at the last sample.
    pub(super) amplitude: Complex64,
    /// Standard error of each of its parts.
    pub(super) error: f64,
    /// Mean at the last sample, without what the motion adds.
    pub(super) mean: f64,
    /// Standard deviation of the samples from the fit.
    pub(super) noise: f64,
}

/// A growing oscillation as samples show it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Mode {
    /// The course.
    pub(super) shape: Shape,
    /// Growth rate of the linear motion, 1/s.
    pub(super) growth: Measured,
    /// Angular frequency, rad/s.
    pub(super) omega: f64,
    /// The channels in the order given.
    pub(super) channels: Vec<Fitted>,
    /// The samples less the fit, channel by channel.
    pub(super) residuals: Vec<DVector<f64>>,
}

impl Mode {
    /// Fits channels of equal length, sampled at `rate` (Hz), from a first guess of the course; `None` where there are too
    /// few samples or no such oscillation is found.
    pub(super) fn fit(channels: &[&[f64]], rate: f64, guess: Shape) -> Option<Mode> {
        let signals = vectors(channels)?;
        let mut best = linearised(&signals, rate, guess)?;
        for _ in 0..ROUNDS {
            let (mode, steps, errors) = &best;
            if steps.iter().zip(errors).all(|(step, error)| step.abs() < FOUND * error) {
                return Some(best.0);
            }
            // Shorter steps where the whole one leads away from what is likely.
            best = (0..HALVINGS).find_map(|halved| {
                let steps: Vec<f64> = steps.iter().map(|step| step * 0.5_f64.powi(halved)).collect();
                let next = linearised(&signals, rate, mode.shape.moved(&steps)?)?;
                (next.0.likelier_than(mode) > -SAME).then_some(next)
            })?;
        }
        None
    }

    /// The mode with a given course, fitted to the samples.
    pub(super) fn held(channels: &[&[f64]], rate: f64, shape: Shape) -> Option<Mode> {
        linearised(&vectors(channels)?, rate, shape).map(|(mode, ..)| mode)
    }

    /// Twice the logarithm by which the samples are more likely under `self` than under another mode of the same samples.
    pub(super) fn likelier_than(&self, other: &Mode) -> f64 {
        let pairs = self.channels.iter().zip(&other.channels).zip(&self.residuals);
        pairs.map(|((own, other), left)| 2.0 * left.len() as f64 * (other.noise / own.noise).ln()).sum()
    }

    /// Channel `q` against channel `x`.
    pub(super) fn ratio(&self, q: usize, x: usize) -> Ratio {
        let (q, x) = (self.channels[q], self.channels[x]);
        let value = q.amplitude / x.amplitude;
        let error = q.error.hypot(value.norm() * x.error) / x.amplitude.norm();
        // What the noise takes from the amplitudes that the ratio rests on.
        let share =
            |of: Fitted| of.amplitude.norm_sqr() / (of.amplitude.norm_sqr() + 2.0 * of.error * of.error);
        Ratio { value, error, unexplained: 0.0, coherence: share(q) * share(x) }
    }
}

/// Channels as vectors; `None` where there are too few samples.
fn vectors(channels: &[&[f64]]) -> Option<Vec<DVector<f64>>> {
    let enough = channels.first()?.len() >= LEAST_PER_UNKNOWN * COLUMNS;
    enough.then(|| channels.iter().map(|q| DVector::from_column_slice(q)).collect())
}

/// The linear part of the fit once the course is given: one column for each unknown, and one for the effect of each
/// parameter.
struct Columns {
    matrix: DMatrix<f64>,
    /// What a change of each parameter adds: `Re(A z')` and `−Im(A z')` side by side.
    change: DMatrix<f64>,
    norms: Vec<f64>,
}

impl Columns {
    fn new(samples: usize, rate: f64, shape: Shape) -> Columns {
        let length = samples as f64 / rate;
        // At a third of the sampling rate the second harmonic looks like the oscillation itself.
        let thirds = 3.0 * shape.omega() / std::f64::consts::TAU / rate;
        let aliased = (thirds - 1.0).abs() * samples as f64 / 3.0 < ALIASED;
        let count = shape.parameters().len();
        let mut matrix = DMatrix::<f64>::zeros(samples, COLUMNS);
        let mut change = DMatrix::<f64>::zeros(samples, 2 * count);
        for k in 0..samples {
            let tau = (k as f64 + 1.0 - samples as f64) / rate;
            let point = shape.at(tau);
            let z = point.z;
            let twice = if aliased { Complex64::ZERO } else { z * z };
            let row = [1.0, tau / length, z.re, -z.im, z.norm_sqr(), twice.re, -twice.im];
            row.into_iter().enumerate().for_each(|(column, value)| matrix[(k, column)] = value);
            for (parameter, slope) in point.slopes.iter().take(count).enumerate() {
                let added = z * slope;
                (change[(k, 2 * parameter)], change[(k, 2 * parameter + 1)]) = (added.re, -added.im);
            }
        }
        let norms: Vec<f64> =
            matrix.column_iter().map(|column| column.norm().max(f64::MIN_POSITIVE)).collect();
        for (mut column, norm) in matrix.column_iter_mut().zip(&norms) {
            column /= *norm;
        }
        Columns { matrix, change, norms }
    }
}

/// The linear part of a course, the steps that improve its parameters, and their standard errors.
fn linearised(signals: &[DVector<f64>], rate: f64, shape: Shape) -> Option<(Mode, Vec<f64>, Vec<f64>)> {
    let samples = signals.first()?.len();
    let Columns { matrix, change, norms } = Columns::new(samples, rate, shape);
    let mut squares = matrix.tr_mul(&matrix);
    (0..COLUMNS).for_each(|k| squares[(k, k)] += RIDGE);
    let solver = squares.cholesky()?;
    let inverse = solver.inverse();
    let spread = (0..2).map(|k| inverse[(AMPLITUDE + k, AMPLITUDE + k)] / norms[AMPLITUDE + k].powi(2));
    let spread = CHOSEN * (0.5 * spread.sum::<f64>()).sqrt();
    let change = &change - &matrix * solver.solve(&matrix.tr_mul(&change));
    let inner = change.tr_mul(&change);
    let count = shape.parameters().len();
    let (mut normal, mut right) = (DMatrix::<f64>::zeros(count, count), DVector::<f64>::zeros(count));
    let growth = Measured { value: shape.growth(), error: f64::INFINITY };
    let (channels, residuals) = (Vec::new(), Vec::new());
    let mut mode = Mode { shape, growth, omega: shape.omega(), channels, residuals };
    for signal in signals {
        let coefficients = solver.solve(&matrix.tr_mul(signal));
        let residual = signal - &matrix * &coefficients;
        let value = |k: usize| coefficients[k] / norms[k];
        let variance = residual.norm_squared() / (samples - COLUMNS) as f64;
        if !(variance > 0.0 && variance.is_finite()) {
            return None;
        }
        let amplitude = Complex64::new(value(AMPLITUDE), value(AMPLITUDE + 1));
        // Re(A z') of each parameter from the two columns of it.
        let mut taken = DMatrix::<f64>::zeros(2 * count, count);
        for parameter in 0..count {
            (taken[(2 * parameter, parameter)], taken[(2 * parameter + 1, parameter)]) =
                (amplitude.re, amplitude.im);
        }
        normal += taken.transpose() * &inner * &taken / variance;
        right += taken.transpose() * change.tr_mul(&residual) / variance;
        let noise = variance.sqrt();
        mode.channels.push(Fitted { amplitude, error: noise * spread, mean: value(0), noise });
        mode.residuals.push(residual);
    }
    let covariance = normal.try_inverse()?;
    let steps: Vec<f64> = (&covariance * right).iter().copied().collect();
    let errors: Vec<f64> = (0..count).map(|k| CHOSEN * covariance[(k, k)].sqrt()).collect();
    // The first parameter of all courses but powers is the growth rate.
    mode.growth.error = errors[0];
    let fine = errors.iter().chain(&steps).all(|x| x.is_finite());
    fine.then_some((mode, steps, errors))
}
