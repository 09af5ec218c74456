//! The spectrogram of the tangential acceleration, reduced to the columns of a picture while it streams.

use serde::{Deserialize, Serialize};

use crate::settings::Settings;
use crate::sliding::Sliding;
use crate::spectrum::{Spectra, hann};

/// Columns of the picture: a printer at 300 dpi resolves about this many across two columns of a journal.
const COLUMNS: usize = 1000;
/// Most rows of the picture.
const ROWS: usize = 400;
/// Periods of the dominant oscillation that a window must hold to show it as a line.
const LEAST_PERIODS: f64 = 8.0;
/// A record holds at least this many windows side by side.
const LEAST_WINDOWS: u64 = 8;
/// The picture reaches up to this many times the dominant frequency.
const ABOVE: f64 = 4.0;
/// Windows that are this part of their length apart weigh the power of every sample alike, as they are tapered by Hann …
const APART: usize = 4;
/// … so that they are no closer where the picture has this many of them in each of its columns all the same.
const IN_A_COLUMN: u64 = 4;
/// Fewest samples of a window.
const LEAST_SAMPLES: usize = 16;

/// A spectrogram.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
pub struct Spectrogram {
    /// Time of the left and right edge, s.
    pub time: [f64; 2],
    /// Frequency of the lower and upper edge, Hz.
    pub frequency: [f64; 2],
    /// Window, s.
    pub window: f64,
    /// Number of columns.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
    /// Amplitude over the largest one of the same window, column by column, lowest frequency first.
    #[serde(skip)]
    pub normalised: Vec<f32>,
    /// Power over the largest one of the record, dB, in the same order.
    #[serde(skip)]
    pub decibel: Vec<f32>,
}

/// Builds a spectrogram from samples in order.
pub(super) struct Builder {
    spectra: Spectra,
    length: usize,
    hop: usize,
    sliding: Sliding,
    windows: u64,
    expected: u64,
    rate: f64,
    start: f64,
    /// Bins per row, and rows.
    stride: usize,
    rows: usize,
    columns: usize,
    counts: Vec<u32>,
    normalised: Vec<f32>,
    power: Vec<f64>,
    scratch: Vec<f64>,
}

impl Builder {
    /// For a record of `samples` at `rate` (Hz) from `start` (s), with its dominant frequency.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "positive numbers of samples"
    )]
    pub(super) fn new(
        settings: &Settings,
        samples: u64,
        rate: f64,
        start: f64,
        dominant: Option<f64>,
    ) -> Builder {
        let seconds = settings.window.max(LEAST_PERIODS / dominant.unwrap_or(f64::INFINITY));
        let longest = (samples / LEAST_WINDOWS).min(1 << 20) as usize;
        let length = ((seconds * rate).round() as usize).min(longest).max(LEAST_SAMPLES);
        let hop = (((1.0 - settings.overlap) * length as f64).round() as usize).max(1);
        let hop = hop.max((length / APART).min((samples / (IN_A_COLUMN * COLUMNS as u64)) as usize));
        let expected = (samples.saturating_sub(length as u64) / hop as u64 + 1).max(1);
        let top = dominant.map_or(rate / 2.0, |f| (ABOVE * f).min(rate / 2.0));
        let bins = ((top / rate * length as f64).ceil() as usize).clamp(1, length / 2);
        let stride = bins.div_ceil(ROWS);
        let rows = bins.div_ceil(stride);
        let columns = COLUMNS.min(expected as usize);
        Builder {
            spectra: Spectra::new(hann(length)),
            length,
            hop,
            sliding: Sliding::new(length, hop),
            windows: 0,
            expected,
            rate,
            start,
            stride,
            rows,
            columns,
            counts: vec![0; columns],
            normalised: vec![0.0; rows * columns],
            power: vec![0.0; rows * columns],
            scratch: Vec::new(),
        }
    }

    /// Takes the next samples.
    pub(super) fn take(&mut self, values: &[f64]) {
        self.sliding.take(values);
        while let Some(window) = self.sliding.window() {
            self.spectra.power(window, &mut self.scratch);
            let column = (self.windows.saturating_mul(self.columns as u64) / self.expected)
                .min(self.columns as u64 - 1);
            self.add(usize::try_from(column).unwrap_or(0));
            self.windows += 1;
            self.sliding.leave();
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "a picture has no use for more digits than f32")]
    fn add(&mut self, column: usize) {
        // Bin 0 holds what detrending left.
        let loudest = self.scratch.iter().skip(1).fold(0.0, |top: f64, p| top.max(*p));
        let from = column * self.rows;
        for row in 0..self.rows {
            let bins = 1 + row * self.stride..(1 + (row + 1) * self.stride).min(self.scratch.len());
            let power = self.scratch[bins].iter().fold(0.0, |top: f64, p| top.max(*p));
            if loudest > 0.0 {
                self.normalised[from + row] += (power / loudest).sqrt() as f32;
            }
            self.power[from + row] += power;
        }
        self.counts[column] += 1;
    }

    /// The finished spectrogram.
    #[expect(clippy::cast_possible_truncation, reason = "a picture has no use for more digits than f32")]
    pub(super) fn finish(mut self) -> Spectrogram {
        for column in 0..self.columns {
            let count = self.counts[column].max(1);
            let cells = column * self.rows..(column + 1) * self.rows;
            self.normalised[cells.clone()].iter_mut().for_each(|cell| *cell /= count as f32);
            self.power[cells].iter_mut().for_each(|cell| *cell /= f64::from(count));
        }
        let loudest = self.power.iter().fold(0.0, |top: f64, p| top.max(*p));
        let decibel = |power: &f64| (10.0 * (power / loudest).log10()) as f32;
        let (window, width) = (self.length as f64 / self.rate, self.rate / self.length as f64);
        let steps = (self.windows.max(1) - 1) as f64 * self.hop as f64 / self.rate;
        // A column stands for the middles of its windows.
        let half = 0.5 * self.hop as f64 / self.rate;
        let middle = self.start + 0.5 * window;
        Spectrogram {
            time: [middle - half, middle + steps + half],
            frequency: [0.5 * width, (0.5 + (self.rows * self.stride) as f64) * width],
            window,
            columns: self.columns,
            rows: self.rows,
            normalised: self.normalised,
            decibel: self.power.iter().map(decibel).collect(),
        }
    }
}
