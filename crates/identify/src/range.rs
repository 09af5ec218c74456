//! Range of one channel: mean and deviation, extremes, and whether it is cut off at one of them.

use crate::lanes::{highest, lowest, sizes, squares, steps, sum};

/// Equal samples in a row that look cut off: at a smooth peak two may be equal by rounding.
const RUN: u64 = 3;
/// Samples that are looked at together.
const AT_ONCE: usize = 64;
/// From this many runs at one extreme value on they are no chance.
const RUNS: u64 = 3;
/// A smooth peak leaves its highest value by far less than the signal's mean step, a cut one by about it.
const ABRUPT: f64 = 0.25;

/// Running statistics of a channel.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Range {
    count: u64,
    mean: f64,
    sizes: f64,
    squares: f64,
    steps: f64,
    last: f64,
    high: Extreme,
    low: Extreme,
}

/// Samples at the highest (or, negated, lowest) value so far.
#[derive(Clone, Copy, Debug, Default)]
struct Extreme {
    value: f64,
    /// Length of the run that the last sample belongs to, 0 when it is not at the extreme.
    run: u64,
    /// Completed runs of at least [`RUN`].
    runs: u64,
    /// Index of the first sample of the first such run.
    first: u64,
    /// The steps that led out of them.
    exits: f64,
}

impl Extreme {
    fn take(&mut self, value: f64, index: u64) {
        if index == 0 || value > self.value {
            *self = Extreme { value, run: 1, ..Extreme::default() };
        } else if value.to_bits() == self.value.to_bits() {
            self.run += 1;
        } else {
            if self.run >= RUN {
                if self.runs == 0 {
                    self.first = index - self.run;
                }
                self.runs += 1;
                self.exits += self.value - value;
            }
            self.run = 0;
        }
    }

    /// Whether samples, the largest of which is `top`, change anything of it.
    fn is_reached(&self, top: f64) -> bool {
        self.run > 0 || top >= self.value
    }

    fn clipped(&self, mean_step: f64) -> Option<Clipping> {
        let abrupt = self.exits > ABRUPT * mean_step * self.runs as f64;
        (self.runs >= RUNS && abrupt).then_some(Clipping {
            value: self.value,
            runs: self.runs,
            first: self.first,
        })
    }
}

/// Where a channel is cut off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Clipping {
    pub(super) value: f64,
    pub(super) runs: u64,
    /// Index of the first sample that is cut off.
    pub(super) first: u64,
}

impl Range {
    /// Takes the next samples, one or more.
    pub(super) fn take(&mut self, values: &[f64]) {
        let (count, own) = (values.len() as f64, sum(values) / values.len() as f64);
        for (some, at) in values.chunks(AT_ONCE).zip((self.count..).step_by(AT_ONCE)) {
            // Most samples are no extremes.
            if at == 0 || self.high.is_reached(highest(some)) {
                some.iter().zip(at..).for_each(|(value, index)| self.high.take(*value, index));
            }
            if at == 0 || self.low.is_reached(-lowest(some)) {
                some.iter().zip(at..).for_each(|(value, index)| self.low.take(-value, index));
            }
        }
        if self.count > 0 {
            self.steps += (values[0] - self.last).abs();
        }
        self.steps += steps(values)[0];
        self.last = values[values.len() - 1];
        self.sizes += sizes(values);
        // Means and squares of both parts together (Chan, Golub and LeVeque 1983).
        let (before, off) = (self.count as f64, own - self.mean);
        self.mean += off * count / (before + count);
        self.squares += squares(values, own) + off * off * before * count / (before + count);
        self.count += values.len() as u64;
    }

    pub(super) fn mean(&self) -> f64 {
        self.mean
    }

    /// Parts of the sum of all sizes that positive and negative values have; 0 where all are 0.
    pub(super) fn parts(&self) -> [f64; 2] {
        let surplus = self.mean * self.count as f64 / self.sizes.max(f64::MIN_POSITIVE);
        if self.sizes > 0.0 { [0.5 * (1.0 + surplus), 0.5 * (1.0 - surplus)] } else { [0.0; 2] }
    }

    pub(super) fn deviation(&self) -> f64 {
        (self.squares / self.count.max(1) as f64).sqrt()
    }

    pub(super) fn is_constant(&self) -> bool {
        self.high.value.to_bits() == (-self.low.value).to_bits() || self.high.value <= -self.low.value
    }

    /// Where the channel is cut off, if it is. Forces that end at 0 have lost contact, which is no fault.
    pub(super) fn clipping(&self) -> Option<Clipping> {
        let mean_step = self.steps / self.count.saturating_sub(1).max(1) as f64;
        let low = self.low.clipped(mean_step).map(|low| Clipping { value: -low.value, ..low });
        self.high.clipped(mean_step).into_iter().chain(low).find(|clipping| clipping.value != 0.0)
    }
}
