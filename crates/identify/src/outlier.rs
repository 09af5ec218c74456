//! Values that belong to no vibration: single samples far outside their neighbourhood, and the numbers that loggers
//! write where they have none.
//!
//! Samples are taken in blocks; equal ones in a row count once, so that steps of a converter and pauses of a signal do not
//! look like silence. A sample is judged by the medians and scatters of its own block and of both beside it. The scatter
//! leaves out the two samples of a block that are farthest off: a sensor that follows an impact, or a filter before a
//! converter, moves more of them. Growth over decades, steps and impacts are thus no outliers, and nothing is held but two blocks.

use std::collections::BTreeMap;

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

/// Equal samples in a row.
#[derive(Clone, Copy, Debug)]
struct Held {
    value: f64,
    first: u64,
    count: u64,
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
    filling: Vec<Held>,
    /// The block before `filling`, to be judged when that is full.
    waiting: Vec<Held>,
    /// Levels of the block before `waiting`, and of that.
    levels: [Option<Level>; 2],
    /// The largest scatter so far.
    largest: f64,
    /// Samples that are alone by the binary exponent of their distance: the largest scatter is known at the end.
    alone: BTreeMap<i64, Outliers>,
    written: Option<Outliers>,
}

impl Watch {
    pub(super) fn take(&mut self, value: f64) {
        let first = self.taken;
        self.taken += 1;
        if let Some(held) = self.filling.last_mut().filter(|held| held.value.to_bits() == value.to_bits()) {
            held.count += 1;
            return;
        }
        if self.filling.len() == BLOCK {
            self.turn();
        }
        self.filling.push(Held { value, first, count: 1 });
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
        // Both blocks change places, so that neither is made anew.
        let mut judged = std::mem::take(&mut self.waiting);
        self.judge(&judged, Surroundings::new(&around));
        judged.clear();
        self.largest = next.map_or(self.largest, |level| self.largest.max(level.scatter));
        self.waiting = std::mem::replace(&mut self.filling, judged);
        self.levels = [own, next];
    }

    fn judge(
        &mut self,
        block: &[Held],
        Surroundings { medians: [low, high], widest, scatter }: Surroundings,
    ) {
        for held in block {
            let distance = (low - held.value).max(held.value - high);
            let found = Outliers { value: held.value, first: held.first, count: held.count };
            let join = |so_far: Option<Outliers>| so_far.map_or(found, |so_far| so_far.with(found));
            if distance > WRITTEN * (scatter + (high - low)) && stands_for_nothing(held.value) {
                self.written = Some(join(self.written));
            } else if distance > ALONE * (widest + (high - low)) {
                let bin = exponent(distance);
                let joined = join(self.alone.get(&bin).copied());
                self.alone.insert(bin, joined);
            }
        }
    }
}

impl Level {
    /// The level of a channel that hardly moves: its most frequent value, which is its scatter, too.
    fn still(block: &[Held]) -> Option<Level> {
        let most = block.iter().max_by_key(|held| held.count)?;
        let scatter = most.value.abs();
        Some(Level { median: most.value, scatter, widest: f64::INFINITY })
    }

    fn of(block: &[Held]) -> Option<Level> {
        if block.len() < LEAST {
            return None;
        }
        let mut all = [[0.0; BLOCK]; 2];
        let [values, off] = all.each_mut().map(|all| &mut all[..block.len()]);
        for (value, held) in values.iter_mut().zip(block) {
            *value = held.value;
        }
        values.sort_unstable_by(f64::total_cmp);
        let middle = values.len() / 2;
        let median = values[middle];
        // On either side of the median the distances are in order already.
        let (mut low, mut high) = (middle, middle);
        for off in off.iter_mut() {
            let below = low.checked_sub(1).map_or(f64::INFINITY, |k| median - values[k]);
            let above = values.get(high).map_or(f64::INFINITY, |value| value - median);
            *off = below.min(above);
            (low, high) = if below < above { (low - 1, high) } else { (low, high + 1) };
        }
        Some(Level { median, scatter: off[middle], widest: off[off.len() - 1 - LEFT_OUT] })
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
