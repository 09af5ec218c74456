//! Windowed spectra of real signals.

use std::f64::consts::{LN_2, TAU};
use std::sync::Arc;

use num_complex::Complex64;
use realfft::{RealFftPlanner, RealToComplex};

use crate::lanes::{add_line, moment, sum};

/// The Hann window of this length: 0 at its first sample and one after its last.
pub(super) fn hann(length: usize) -> Vec<f64> {
    (0..length).map(|k| 0.5 - 0.5 * (TAU * k as f64 / length as f64).cos()).collect()
}

/// Takes mean and slope (least squares) out of a signal, so that they do not leak into its spectrum.
pub(super) fn detrend(values: &mut [f64]) {
    let n = values.len() as f64;
    let middle = 0.5 * (n - 1.0);
    let mean = sum(values) / n.max(1.0);
    for value in values.iter_mut() {
        *value -= mean;
    }
    // Of values whose mean is 0 the moment is the same about every point; Σ (k − middle)² = n (n² − 1)/12.
    let slope = moment(values) * 12.0 / (n * (n * n - 1.0)).max(1.0);
    add_line(values, [middle * slope, -slope]);
}

/// Power spectra of windows of one length.
pub(super) struct Spectra {
    transform: Arc<dyn RealToComplex<f64>>,
    window: Vec<f64>,
    input: Vec<f64>,
    output: Vec<Complex64>,
    scratch: Vec<Complex64>,
}

impl Spectra {
    /// Spectra under this window.
    pub(super) fn new(window: Vec<f64>) -> Spectra {
        let length = window.len();
        Spectra::padded(window, length)
    }

    /// Spectra under this window, with zeros behind it where a length with small factors takes less time.
    pub(super) fn quick(window: Vec<f64>) -> Spectra {
        let is_quick = |length: &usize| {
            let rest = [2, 3, 5, 7].into_iter().fold(*length, |mut rest, factor| {
                while rest.is_multiple_of(factor) {
                    rest /= factor;
                }
                rest
            });
            rest == 1
        };
        // A power of two is among them.
        let even = window.len().next_multiple_of(2);
        let length = (even..=2 * even).step_by(2).find(is_quick).unwrap_or(even);
        Spectra::padded(window, length)
    }

    fn padded(window: Vec<f64>, length: usize) -> Spectra {
        let transform = RealFftPlanner::new().plan_fft_forward(length);
        let (input, output) = (transform.make_input_vec(), transform.make_output_vec());
        let scratch = transform.make_scratch_vec();
        Spectra { transform, window, input, output, scratch }
    }

    /// Samples, with the zeros behind them: bins are the sampling rate over this apart.
    pub(super) fn length(&self) -> usize {
        self.input.len()
    }

    /// `|F_k|²` for `k = 0 …  length/2` of `values` (as many as the window), trend removed.
    pub(super) fn power(&mut self, values: &[f64], power: &mut Vec<f64>) {
        let (own, zeros) = self.input.split_at_mut(values.len());
        own.copy_from_slice(values);
        detrend(own);
        own.iter_mut().zip(&self.window).for_each(|(value, weight)| *value *= weight);
        zeros.fill(0.0);
        self.transformed(power);
    }

    /// The same of values that have no trend.
    pub(super) fn power_of_level(&mut self, values: &[f64], power: &mut Vec<f64>) {
        let (own, zeros) = self.input.split_at_mut(values.len());
        let weighted = values.iter().zip(&self.window).map(|(value, weight)| value * weight);
        own.iter_mut().zip(weighted).for_each(|(input, value)| *input = value);
        zeros.fill(0.0);
        self.transformed(power);
    }

    fn transformed(&mut self, power: &mut Vec<f64>) {
        self.transform
            .process_with_scratch(&mut self.input, &mut self.output, &mut self.scratch)
            .expect("the buffers are those that the transform made");
        power.clear();
        power.extend(self.output.iter().map(Complex64::norm_sqr));
    }
}

/// Position of the peak at bin `k` between bins, from a parabola through the logarithms of three bins: for
/// Hann windows within 0.02 bins.
pub(super) fn refine(power: &[f64], k: usize) -> f64 {
    let at = |k: usize| power.get(k).copied().unwrap_or(0.0).max(f64::MIN_POSITIVE).ln();
    if k == 0 || k + 1 >= power.len() {
        return k as f64;
    }
    let (left, middle, right) = (at(k - 1), at(k), at(k + 1));
    let curvature = left - 2.0 * middle + right;
    if curvature < 0.0 { k as f64 + (0.5 * (left - right) / curvature).clamp(-0.5, 0.5) } else { k as f64 }
}

/// Mean noise power per bin: the median of the bins away from the peak at `peak` (bins) and its harmonics;
/// powers of noise are exponentially distributed, so their mean is the median over ln 2.
pub(super) fn noise_floor(power: &[f64], peak: f64) -> f64 {
    Beside::new(power.len(), peak).noise_floor(power)
}

/// The bins of spectra that hold noise alone, away from an oscillation.
#[derive(Default)]
pub(super) struct Beside {
    bins: Vec<usize>,
    powers: Vec<f64>,
}

impl Beside {
    /// Of spectra of so many bins with a peak at `peak` (bins) and its harmonics.
    pub(super) fn new(bins: usize, peak: f64) -> Beside {
        let mut beside = Beside::default();
        beside.set(bins, peak);
        beside
    }

    /// As if made anew.
    pub(super) fn set(&mut self, bins: usize, peak: f64) {
        /// Bins that mean and slow drift reach.
        const DRIFT: usize = 3;
        /// Bins on either side that the main lobe of a growing oscillation under a Hann window reaches.
        const LOBE: f64 = 4.0;
        /// Harmonics that are left out, the fundamental included.
        const HARMONICS: usize = 3;
        let near = |k: usize| (1..=HARMONICS).any(|h| (k as f64 - h as f64 * peak).abs() < LOBE);
        self.bins.clear();
        self.bins.extend((DRIFT..bins).filter(|k| !near(*k)));
    }

    /// Mean noise power per bin of one of the spectra, see [`noise_floor`].
    pub(super) fn noise_floor(&mut self, power: &[f64]) -> f64 {
        self.powers.clear();
        self.powers.extend(self.bins.iter().map(|k| power[*k]));
        if self.powers.is_empty() {
            return 0.0;
        }
        let middle = self.powers.len() / 2;
        let (_, median, _) = self.powers.select_nth_unstable_by(middle, f64::total_cmp);
        *median / LN_2
    }
}
