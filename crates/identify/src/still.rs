//! Whether a channel stands still for a while, as one whose sensor or cable drops out.

use crate::lanes::steps;

/// Fewest equal samples in a row that are looked at.
const LEAST: u64 = 64;
/// Samples that are looked at together.
const AT_ONCE: usize = 64;
/// A channel that stops, or starts again, with a step this many times its smallest one has not come to rest by itself.
const ABRUPT: f64 = 20.0;

/// Equal samples in a row.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Stand {
    pub(super) value: f64,
    /// How many.
    pub(super) count: u64,
    /// Index of the first.
    pub(super) first: u64,
    /// The larger of the steps into and out of it.
    step: f64,
}

/// Looks for them in a channel.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Stillness {
    index: u64,
    now: Stand,
    longest: Stand,
    smallest: Option<f64>,
}

impl Stillness {
    /// Takes the next samples.
    pub(super) fn take(&mut self, values: &[f64]) {
        for some in values.chunks(AT_ONCE) {
            let [first, .., before, last] = some else {
                for value in some {
                    self.one(*value);
                }
                continue;
            };
            let [_, least] = steps(some);
            self.one(*first);
            if least > 0.0 {
                // Each differs from the one before: between the ends nothing stands.
                self.one(some[1]);
                self.index += some.len() as u64 - 3;
                self.smallest = self.smallest.map(|smallest| smallest.min(least));
                self.now.value = *before;
                self.one(*last);
            } else {
                some[1..].iter().for_each(|value| self.one(*value));
            }
        }
    }

    fn one(&mut self, value: f64) {
        let step = (value - self.now.value).abs();
        if self.index > 0 && step > 0.0 {
            self.close(step);
            self.smallest = Some(self.smallest.map_or(step, |smallest| smallest.min(step)));
            self.now = Stand { value, count: 0, first: self.index, step };
        } else if self.index == 0 {
            self.now.value = value;
        }
        self.now.count += 1;
        self.index += 1;
    }

    fn close(&mut self, step: f64) {
        let stand = Stand { step: self.now.step.max(step), ..self.now };
        if stand.count > self.longest.count {
            self.longest = stand;
        }
    }

    /// The longest stand of a channel that moves, if it is at least so many samples long and no end of a decay.
    pub(super) fn finish(mut self, least: f64) -> Option<Stand> {
        self.close(0.0);
        let Stillness { longest, smallest, .. } = self;
        let abrupt = longest.step > ABRUPT * smallest?;
        (abrupt && longest.count as f64 >= least.max(LEAST as f64)).then_some(longest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The chunks that are looked at together hide no stand, wherever it begins and ends.
    #[test]
    fn a_stand_is_found_wherever_it_lies() {
        for (from, count) in [(0, 64), (1, 70), (63, 64), (64, 64), (65, 127), (100, 200), (129, 64)] {
            let moves = |k: u64| 1e-3 * (k as f64 + (k % 7) as f64);
            let sample = |k: u64| if (from..from + count).contains(&k) { 5.0 } else { moves(k) };
            let values: Vec<f64> = (0..400).map(sample).collect();
            let mut still = Stillness::default();
            values.chunks(90).for_each(|some| still.take(some));
            let found = still.finish(0.0).map(|stand| (stand.value, stand.first, stand.count));
            assert_eq!(found, Some((5.0, from, count)));
            let mut moving = Stillness::default();
            (0..400).for_each(|k| moving.take(&[moves(k)]));
            assert_eq!(moving.finish(0.0), None);
        }
    }
}
