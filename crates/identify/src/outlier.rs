//! Values that belong to no vibration: single samples far outside their neighbourhood, and the numbers that loggers
//! write where they have none.
//!
//! Samples are taken in blocks; equal ones in a row count once, so that steps of a converter and pauses of a signal do not
//! look like silence. A sample is judged by the medians and scatters of its own block and of both beside it. The scatter
//! leaves out the two samples of a block that are farthest off: a sensor that follows an impact, or a filter before a
//! converter, moves more of them. Growth over decades, steps and impacts are thus no outliers, and nothing is held but two blocks. A value that
//! stands for more than a block is a rest, as of a velocity that is commanded: [`crate::still`] looks after it.

use std::collections::BTreeMap;

use crate::lanes::{larger, smaller};

/// Samples of a block.
const BLOCK: usize = 16;
/// Fewest samples of the last block that have a scatter of their own.
const LEAST: usize = 8;
/// Samples of a block that its scatter leaves out.
const LEFT_OUT: usize = 2;
/// A sample this many times the scatter around it away from all around it is alone (synthetic strokes with sticking,
/// flights and impacts reach 9) …
const ALONE: f64 = 50.0;
/// … and an outlier, when it is also this many times the largest median scatter of the record away.
const BEYOND: f64 = 3.0;
/// A number that loggers write where they have none is one from this many times the median scatter around it.
const WRITTEN: f64 = 10.0;

/// Samples far from all others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Outliers {
    /// The value of the first.
    pub(super) value: f64,
    /// Index of the first.
    pub(super) first: u64,
    pub(super) count: u64,
}

impl Outliers {
    fn with(self, other: Outliers) -> Outliers {
        let earlier = if other.first < self.first { other } else { self };
        Outliers { count: self.count + other.count, ..earlier }
    }
}

/// Samples that follow each other; equal ones in a row are one.
#[derive(Clone, Copy, Debug, Default)]
struct Few {
    values: [f64; BLOCK],
    /// The index of each, and how many are equal to it.
    firsts: [u64; BLOCK],
    counts: [u64; BLOCK],
    len: usize,
}

impl Few {
    fn values(&self) -> &[f64] {
        &self.values[..self.len]
    }

    /// Takes the sample `first` where there is room for it or it is one with the last; whether it was taken.
    fn take(&mut self, value: f64, first: u64) -> bool {
        if self.len > 0 && self.values[self.len - 1].to_bits() == value.to_bits() {
            self.counts[self.len - 1] += 1;
            return true;
        }
        if self.len == BLOCK {
            return false;
        }
        (self.values[self.len], self.firsts[self.len], self.counts[self.len]) = (value, first, 1);
        self.len += 1;
        true
    }
}

/// Where the samples of a block lie.
#[derive(Clone, Copy, Debug)]
struct Level {
    median: f64,
    /// Median distance from the median.
    scatter: f64,
    /// The largest one without those left out.
    widest: f64,
}

/// What a sample is judged by: the levels around it together.
#[derive(Clone, Copy, Debug)]
struct Surroundings {
    /// The lowest and the highest median.
    medians: [f64; 2],
    widest: f64,
    scatter: f64,
}

impl Surroundings {
    fn new(levels: &[Option<Level>]) -> Surroundings {
        let over = |of: fn(&Level) -> f64| {
            let values = levels.iter().flatten().map(of);
            values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
        };
        let [_, widest] = over(|level| level.widest);
        let [_, scatter] = over(|level| level.scatter);
        Surroundings { medians: over(|level| level.median), widest, scatter }
    }
}

/// Looks for outliers in a channel, sample by sample.
#[derive(Clone, Debug, Default)]
pub(super) struct Watch {
    taken: u64,
    filling: Few,
    /// The block before `filling`, to be judged when that is full.
    waiting: Few,
    /// Levels of the block before `waiting`, and of that.
    levels: [Option<Level>; 2],
    /// The largest scatter so far.
    largest: f64,
    /// Samples that are alone by the binary exponent of their distance: the largest scatter is known at the end.
    alone: BTreeMap<i64, Outliers>,
    written: Option<Outliers>,
}

impl Watch {
    /// Takes the next samples.
    pub(super) fn take(&mut self, values: &[f64]) {
        for value in values {
            self.one(*value);
        }
    }

    fn one(&mut self, value: f64) {
        if !self.filling.take(value, self.taken) {
            self.turn();
            self.filling.take(value, self.taken);
        }
        self.taken += 1;
    }

    /// The outliers of the record, if it has any.
    pub(super) fn finish(mut self) -> Option<Outliers> {
        self.turn();
        self.turn();
        let far = self.alone.iter().filter(|(exponent, _)| power_of_two(**exponent) > BEYOND * self.largest);
        let far = far.map(|(_, found)| *found).chain(self.written);
        far.reduce(Outliers::with)
    }

    /// Judges the waiting block and lets the filling one wait.
    fn turn(&mut self) {
        let next = Level::of(&self.filling);
        let [before, own] = self.levels;
        let mut around = [before, own, next];
        if around.iter().all(Option::is_none) {
            around[0] = Level::still(&self.waiting);
        }
        self.judge(Surroundings::new(&around));
        self.largest = next.map_or(self.largest, |level| self.largest.max(level.scatter));
        self.waiting = std::mem::take(&mut self.filling);
        self.levels = [own, next];
    }

    /// Judges the waiting block.
    fn judge(&mut self, Surroundings { medians: [low, high], widest, scatter }: Surroundings) {
        let [written, alone] = [WRITTEN * (scatter + (high - low)), ALONE * (widest + (high - low))];
        let distance = |value: f64| (low - value).max(value - high);
        let block = self.waiting;
        for (number, value) in block.values().iter().enumerate() {
            let distance = distance(*value);
            if distance <= written.min(alone) {
                continue;
            }
            let found = Outliers { value: *value, first: block.firsts[number], count: block.counts[number] };
            let join = |so_far: Option<Outliers>| so_far.map_or(found, |so_far| so_far.with(found));
            if distance > written && stands_for_nothing(*value) {
                self.written = Some(join(self.written));
            } else if distance > alone && found.count <= BLOCK as u64 {
                let bin = exponent(distance);
                let joined = join(self.alone.get(&bin).copied());
                self.alone.insert(bin, joined);
            }
        }
    }
}

impl Level {
    /// The level of a channel that hardly moves: its most frequent value, which is its scatter, too.
    fn still(block: &Few) -> Option<Level> {
        let most = (0..block.len).max_by_key(|number| block.counts[*number])?;
        let (median, scatter) = (block.values[most], block.values[most].abs());
        Some(Level { median, scatter, widest: f64::INFINITY })
    }

    fn of(block: &Few) -> Option<Level> {
        if block.len < LEAST {
            return None;
        }
        let mut all = block.values;
        let values = &mut all[..block.len];
        if let Ok(full) = <&mut [f64; BLOCK]>::try_from(&mut *values) {
            sort(full);
        } else {
            values.sort_unstable_by(f64::total_cmp);
        }
        let middle = values.len() / 2;
        let median = values[middle];
        // The smallest distance within which there are so many beside the median.
        let within = |others: usize| {
            let reach = |from: usize| larger(median - values[from], values[from + others] - median);
            (0..values.len() - others).map(reach).fold(f64::INFINITY, smaller)
        };
        Some(Level { median, scatter: within(middle), widest: within(values.len() - 1 - LEFT_OUT) })
    }
}

/// Sorts without a branch (Batcher's odd-even merge sort).
fn sort(values: &mut [f64; BLOCK]) {
    let mut sorted = 1;
    while sorted < BLOCK {
        let mut apart = sorted;
        while apart > 0 {
            let mut from = apart % sorted;
            while from + apart < BLOCK {
                for low in from..(from + apart).min(BLOCK - apart) {
                    let high = low + apart;
                    if low / (2 * sorted) == high / (2 * sorted) {
                        let (a, b) = (values[low], values[high]);
                        (values[low], values[high]) = (smaller(a, b), larger(a, b));
                    }
                }
                from += 2 * apart;
            }
            apart /= 2;
        }
        sorted *= 2;
    }
}

#[expect(clippy::cast_possible_truncation, reason = "exponents lie within ±1100")]
fn exponent(distance: f64) -> i64 {
    distance.log2().floor() as i64
}

#[expect(clippy::cast_precision_loss, reason = "exponents lie within ±1100")]
fn power_of_two(exponent: i64) -> f64 {
    (exponent as f64).exp2()
}

/// Numbers that loggers write where they have none: nines (999, −9999, 99999), the ends of integers and of floating
/// numbers, large powers of ten.
fn stands_for_nothing(value: f64) -> bool {
    /// Powers of ten from here on are no measurement.
    const LARGE: f64 = 1e15;
    const ENDS: [f64; 7] =
        [32767.0, 32768.0, 65535.0, 2_147_483_647.0, 2_147_483_648.0, f32::MAX as f64, f64::MAX];
    let size = value.abs();
    let is_power = |x: f64| (x.log10() - x.log10().round()).abs() < 1e-12;
    let nines = (999.0..LARGE).contains(&size) && size.fract() == 0.0 && is_power(size + 1.0);
    nines || ENDS.contains(&size) || (size >= LARGE && is_power(size))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What sorts all zeros and ones by comparisons sorts everything (Knuth, The Art of Computer Programming 3, 5.3.4).
    #[test]
    fn zeros_and_ones_are_sorted() {
        for bits in 0..1_u32 << BLOCK {
            let mut values = std::array::from_fn(|k| f64::from(bits >> k & 1));
            sort(&mut values);
            assert!(values.is_sorted(), "{bits:b}");
        }
    }

    /// Against distances that are sorted.
    #[test]
    fn a_level_is_the_median_and_distances_from_it() {
        for seed in 0..500_u64 {
            let len = LEAST + (seed % 9) as usize;
            let mut block = Few { len, ..Few::default() };
            for (k, value) in (0..).zip(&mut block.values[..len]) {
                let mixed = (seed * 31 + k).wrapping_mul(0x9E37_79B9_7F4A_7C15);
                *value = (mixed >> 40) as f64;
            }
            let level = Level::of(&block).expect("there are enough");
            let mut values = block.values()[..].to_vec();
            values.sort_by(f64::total_cmp);
            let median = values[len / 2];
            let mut off: Vec<f64> = values.iter().map(|value| (value - median).abs()).collect();
            off.sort_by(f64::total_cmp);
            let found = [level.median, level.scatter, level.widest].map(f64::to_bits);
            assert_eq!(found, [median, off[len / 2], off[len - 1 - LEFT_OUT]].map(f64::to_bits));
        }
    }
}
