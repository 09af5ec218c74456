//! One growing oscillation fitted to samples: its eigenvalue and its complex amplitude in every channel at once.
//!
//! Every channel is `c + d τ + Re(A exp(λτ)) + e exp(2στ) + Re(C exp(2λτ))` and white noise, with one `λ = σ + iω` for
//! all: the last two terms are what friction adds that is quadratic in the motion. For a given λ that is linear, so
//! λ alone is iterated (Gauss and Newton, linear part projected out: Golub and Pereyra 1973), each channel weighted by
//! its own noise. An oscillation that grows by e in five periods has nearly all it tells in its last five: no window
//! may fade them out.

use nalgebra::{DMatrix, DVector, Matrix2, Vector2};
use num_complex::Complex64;

use super::cross::{Measured, Ratio};

/// Most rounds for the eigenvalue; five are usual.
const ROUNDS: usize = 12;
/// The eigenvalue is found when it changes by less than this part of its standard error.
const FOUND: f64 = 1e-2;
/// Added to the squares of columns of norm 1, so that near copies of one another do no harm.
const RIDGE: f64 = 1e-9;
/// Periods over the fit by which the second harmonic must miss the oscillation as sampled.
const ALIASED: f64 = 4.0;
/// Samples per unknown below which nothing is fitted.
const LEAST_PER_UNKNOWN: usize = 3;

/// Standard errors are this much larger than white noise alone would leave: the end of the growth is chosen from the same
/// samples, and a trace of the second mode is in them (measured on synthetic strokes, docs/identify.md).
const CHOSEN: f64 = 1.2;

/// What is fitted to every channel, one column each; `AMPLITUDE` and the next one are those of the oscillation.
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
    /// Standard deviation of what is left over.
    pub(super) noise: f64,
}

/// A growing oscillation as samples show it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Mode {
    /// Growth rate, 1/s.
    pub(super) growth: Measured,
    /// Angular frequency, rad/s.
    pub(super) omega: f64,
    /// The channels in the order given.
    pub(super) channels: Vec<Fitted>,
    /// What is left over, channel by channel.
    pub(super) residuals: Vec<DVector<f64>>,
}

impl Mode {
    /// Fits channels of equal length, sampled at `rate` (Hz), from a first guess of λ (1/s); `None` where there are too
    /// few samples or no growing oscillation is found.
    pub(super) fn fit(channels: &[&[f64]], rate: f64, guess: Complex64) -> Option<Mode> {
        let samples = channels.first()?.len();
        if samples < LEAST_PER_UNKNOWN * COLUMNS {
            return None;
        }
        let signals: Vec<DVector<f64>> = channels.iter().map(|q| DVector::from_column_slice(q)).collect();
        let mut lambda = guess;
        for _ in 0..ROUNDS {
            let (mode, step, errors) = linearised(&signals, rate, lambda)?;
            lambda += Complex64::new(step[0], step[1]);
            let found = step[0].abs() < FOUND * errors[0] && step[1].abs() < FOUND * errors[1];
            if !(lambda.re > 0.0 && lambda.im > 0.0) {
                return None;
            }
            if found {
                return Some(mode);
            }
        }
        None
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

/// The linear part at λ, the step that improves λ, and its standard errors.
fn linearised(signals: &[DVector<f64>], rate: f64, lambda: Complex64) -> Option<(Mode, [f64; 2], [f64; 2])> {
    let samples = signals.first()?.len();
    let length = samples as f64 / rate;
    // At a third of the sampling rate the second harmonic looks like the oscillation itself.
    let thirds = 3.0 * lambda.im / std::f64::consts::TAU / rate;
    let aliased = (thirds - 1.0).abs() * samples as f64 / 3.0 < ALIASED;
    let mut matrix = DMatrix::<f64>::zeros(samples, COLUMNS);
    // τ exp(λτ): what a change of λ adds.
    let mut change = DMatrix::<f64>::zeros(samples, 2);
    for k in 0..samples {
        let tau = (k as f64 + 1.0 - samples as f64) / rate;
        let grown = (lambda * tau).exp();
        let twice = if aliased { Complex64::ZERO } else { grown * grown };
        let row = [1.0, tau / length, grown.re, -grown.im, grown.norm_sqr(), twice.re, -twice.im];
        row.into_iter().enumerate().for_each(|(column, value)| matrix[(k, column)] = value);
        (change[(k, 0)], change[(k, 1)]) = (tau * grown.re, -tau * grown.im);
    }
    let norms: Vec<f64> = matrix.column_iter().map(|column| column.norm().max(f64::MIN_POSITIVE)).collect();
    for (mut column, norm) in matrix.column_iter_mut().zip(&norms) {
        column /= *norm;
    }
    let mut squares = matrix.tr_mul(&matrix);
    (0..COLUMNS).for_each(|k| squares[(k, k)] += RIDGE);
    let solver = squares.cholesky()?;
    let inverse = solver.inverse();
    let spread = (0..2).map(|k| inverse[(AMPLITUDE + k, AMPLITUDE + k)] / norms[AMPLITUDE + k].powi(2));
    let spread = CHOSEN * (0.5 * spread.sum::<f64>()).sqrt();
    let change = &change - &matrix * solver.solve(&matrix.tr_mul(&change));
    let inner = change.tr_mul(&change);
    let (mut normal, mut right) = (Matrix2::<f64>::zeros(), Vector2::<f64>::zeros());
    let mut mode =
        Mode { growth: Measured::default(), omega: lambda.im, channels: Vec::new(), residuals: Vec::new() };
    for signal in signals {
        let coefficients = solver.solve(&matrix.tr_mul(signal));
        let residual = signal - &matrix * &coefficients;
        let value = |k: usize| coefficients[k] / norms[k];
        let variance = residual.norm_squared() / (samples - COLUMNS) as f64;
        if !(variance > 0.0 && variance.is_finite()) {
            return None;
        }
        let amplitude = Complex64::new(value(AMPLITUDE), value(AMPLITUDE + 1));
        // Growth and frequency: Re(A τ e) and Re(iA τ e) in the two columns of `change`.
        let turned = nalgebra::matrix![amplitude.re, -amplitude.im; amplitude.im, amplitude.re];
        normal += turned.transpose() * &inner * turned / variance;
        right += turned.transpose() * change.tr_mul(&residual) / variance;
        let noise = variance.sqrt();
        mode.channels.push(Fitted { amplitude, error: noise * spread, mean: value(0), noise });
        mode.residuals.push(residual);
    }
    let covariance = normal.try_inverse()?;
    let step = covariance * right;
    let errors = [0, 1].map(|k| CHOSEN * covariance[(k, k)].sqrt());
    mode.growth = Measured { value: lambda.re, error: errors[0] };
    let fine = errors.iter().chain(step.iter()).all(|x| x.is_finite());
    fine.then_some((mode, [step[0], step[1]], errors))
}
