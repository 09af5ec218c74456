//! Whether a channel stands still for a while, as one whose sensor or cable drops out.

/// Fewest equal samples in a row that are looked at.
const LEAST: u64 = 64;
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
    /// Takes the next sample.
    pub(super) fn take(&mut self, value: f64) {
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
