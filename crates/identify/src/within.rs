//! The friction law read within the oscillation: where force sensors follow it, every sample has a friction coefficient and
//! a sliding velocity `v = V − ẋ` of its own.
//!
//! The mean of `T/N` over a vibration that reverses the sliding, sticks or lifts off is not the friction at the mean velocity.
//! The samples at which `v` passes the mean velocity have exactly that, whatever the rest of the cycle does.

use crate::cross::Measured;

/// The part of the mean sliding velocity, on either side of it, over which the law is read.
pub(super) const SIDE: f64 = 0.2;
/// Sliding velocities around the mean one, over it: the lower and the upper side.
const SIDES: [[f64; 2]; 2] = [[1.0 - SIDE, 1.0], [1.0, 1.0 + SIDE]];
/// Fewest samples per period: with fewer the jumps of friction, which are smeared over three of them, reach far into the slip.
pub(super) const PER_PERIOD: f64 = 12.0;
/// Normal force, over its mean, below which the contact is about to open: `T/N` is mostly noise there.
const PRESSED: f64 = 0.5;

/// Sums of a line `μ` over `v`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Line {
    count: f64,
    v: f64,
    mu: f64,
    vv: f64,
    vmu: f64,
    mumu: f64,
}

impl Line {
    fn take(&mut self, v: f64, mu: f64) {
        self.count += 1.0;
        self.v += v;
        self.mu += mu;
        self.vv += v * v;
        self.vmu += v * mu;
        self.mumu += mu * mu;
    }

    fn add(&mut self, other: &Line) {
        self.count += other.count;
        self.v += other.v;
        self.mu += other.mu;
        self.vv += other.vv;
        self.vmu += other.vmu;
        self.mumu += other.mumu;
    }

    /// Level at `velocity` (m/s) and slope (s/m).
    fn read(&self, velocity: f64) -> [Measured; 2] {
        /// Samples per independent one: neighbours have most of their errors in common.
        const ALIKE: f64 = 3.0;
        let [v, mu] = [self.v / self.count, self.mu / self.count];
        let spread = self.vv - self.count * v * v;
        let slope = (self.vmu - self.count * v * mu) / spread;
        let residual = (self.mumu - self.count * mu * mu - slope * slope * spread).max(0.0) / self.count;
        let independent = self.count / ALIKE;
        let level_error = (residual / independent).sqrt();
        let slope_error = (residual / independent / (spread / self.count)).sqrt();
        let level = Measured {
            value: mu + slope * (velocity - v),
            error: level_error.hypot(slope_error * (velocity - v)),
        };
        [level, Measured { value: slope, error: slope_error }]
    }
}

/// Sums on both sides of the mean velocity, each while `ẋ` falls and while it rises.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Sides([[Line; 2]; 2]);

impl Sides {
    fn take(&mut self, [v, mu]: [f64; 2], velocity: f64, rises: bool) {
        for (both, [low, high]) in self.0.iter_mut().zip(SIDES) {
            if (low * velocity..high * velocity).contains(&v) {
                both[usize::from(rises)].take(v, mu);
            }
        }
    }

    fn add(&mut self, other: &Sides) {
        self.0
            .as_flattened_mut()
            .iter_mut()
            .zip(other.0.as_flattened())
            .for_each(|(sum, line)| sum.add(line));
    }

    /// One side of the mean velocity.
    fn side(&self, side: usize) -> Line {
        let [mut both, other] = self.0[side];
        both.add(&other);
        both
    }

    /// While `ẋ` falls, or while it rises.
    fn way(&self, way: usize) -> Line {
        let [mut both, other] = [self.0[0][way], self.0[1][way]];
        both.add(&other);
        both
    }

    fn all(&self) -> Line {
        let mut both = self.side(0);
        both.add(&self.side(1));
        both
    }
}

/// The law around the mean velocity, by samples as they are and by means of neighbours.
///
/// Friction jumps where the sliding reverses, and what a recorder lets through of a jump rings at half its rate: means over three samples
/// (1 2 1) hold next to nothing of that, but smear the jump. By how much they differ from samples as they are, or from means over five
/// (1 4 6 4 1) where that is less, is what the sampling leaves open.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Within {
    raw: Sides,
    narrow: Sides,
    wide: Sides,
    /// Sum of the squared changes of `ẋ` from sample to sample, m²/s², of the samples that are read.
    steps: f64,
}

impl Within {
    /// Reads samples: motion `ẋ` (m/s), acceleration `ẍ` (m/s²), forces `T` and `N` (N), with the mean velocity (m/s) and the mean
    /// normal force (N). The two first and the two last samples only serve their neighbours.
    pub(super) fn read(
        motion: &[f64],
        [acceleration, tangential, normal]: [&[f64]; 3],
        velocity: f64,
        mean: f64,
    ) -> Within {
        let mut sums = Within::default();
        for k in 2..motion.len().saturating_sub(2) {
            let rises = acceleration[k] > 0.0;
            let beside = |of: &[f64], n: usize| of[k - n] + of[k + n];
            let narrow = [motion, tangential, normal].map(|of| 0.25 * (beside(of, 1) + 2.0 * of[k]));
            let wide = [motion, tangential, normal]
                .map(|of| 0.0625 * (beside(of, 2) + 4.0 * beside(of, 1) + 6.0 * of[k]));
            let raw = [motion[k], tangential[k], normal[k]];
            if normal[k] > PRESSED * mean && narrow[0].abs() < SIDE * velocity {
                sums.steps += (0.5 * (motion[k + 1] - motion[k - 1])).powi(2);
            }
            let Within { raw: one, narrow: three, wide: five, .. } = &mut sums;
            for (sides, [motion, tangential, normal]) in [(one, raw), (three, narrow), (five, wide)] {
                if normal > PRESSED * mean {
                    sides.take([velocity - motion, tangential / normal], velocity, rises);
                }
            }
        }
        sums
    }

    pub(super) fn add(&mut self, other: &Within) {
        self.raw.add(&other.raw);
        self.narrow.add(&other.narrow);
        self.wide.add(&other.wide);
        self.steps += other.steps;
    }

    /// Half of the width over which a level is read at `velocity` (m/s), over that: a mean over [`SIDE`] on either side, of means over three
    /// samples, whose variance is half of the square of what the velocity changes by between two.
    pub(super) fn half_width(&self, velocity: f64) -> f64 {
        let count = self.narrow.all().count.max(1.0);
        // A mean over a half-width h has the variance h²/3.
        SIDE.hypot((1.5 * self.steps / count).sqrt() / velocity)
    }

    /// Friction coefficient at `velocity` (m/s), and slope `dμ/dv` (s/m); `None` with too few samples.
    pub(super) fn law(&self, velocity: f64) -> Option<[Measured; 2]> {
        /// Fewest samples of a line.
        const LEAST: f64 = 60.0;
        let lines = [&self.narrow, &self.raw, &self.wide].map(Sides::all);
        let [narrow, raw, wide] = lines.map(|line| line.read(velocity));
        let told = [0, 1].map(|k| {
            let Measured { value, error } = narrow[k];
            let off = [raw, wide].map(|other| (value - other[k].value).abs());
            Measured { value, error: error.hypot(off[0].min(off[1])) }
        });
        (lines.iter().all(|line| line.count >= LEAST) && told[1].value.is_finite()).then_some(told)
    }

    /// By how much the friction coefficients at `velocity` (m/s) differ that are read while the velocity rises and while it falls: what
    /// moves the masses has one at each velocity; less a standard error. `None` with too few samples of either.
    pub(super) fn differs(&self, velocity: f64) -> Option<f64> {
        /// Fewest samples of each.
        const LEAST: f64 = 20.0;
        let [falling, rising] = [0, 1].map(|way| {
            let line = self.narrow.way(way);
            (line.count >= LEAST).then(|| line.read(velocity)[0])
        });
        let (falling, rising) = (falling?, rising?);
        let by_chance = falling.error.hypot(rising.error);
        Some(((falling.value - rising.value).abs() - by_chance).max(0.0))
    }

    /// Whether the law bends: the slopes of both sides differ clearly, so that it has none at the mean velocity.
    pub(super) fn bends(&self, velocity: f64) -> bool {
        let [low, high] = [0, 1].map(|side| self.narrow.side(side).read(velocity));
        differ([low[1], high[1]], low[0].value, velocity)
    }

    /// Slope (s/m) above the mean velocity (m/s).
    pub(super) fn above(&self, velocity: f64) -> Measured {
        self.narrow.side(1).read(velocity)[1]
    }

    /// By how much the slopes (s/m) of both sides are off the one between them: a bend that is not clear may be one.
    pub(super) fn unclear_bend(&self, velocity: f64) -> f64 {
        let [low, high] = [0, 1].map(|side| self.narrow.side(side).read(velocity)[1].value);
        0.5 * (low - high).abs()
    }
}

/// Whether two slopes `dμ/dv` (s/m) of a law differ clearly, by more than matters to friction of this `level` at this velocity (m/s).
pub(super) fn differ(slopes: [Measured; 2], level: f64, velocity: f64) -> bool {
    /// The difference that matters, of `d ln μ/d ln v`.
    const MATTERS: f64 = 0.1;
    let [one, other] = slopes;
    differ_clearly(slopes) && (one.value - other.value).abs() * velocity.abs() > MATTERS * level.abs()
}

/// Whether two slopes differ by more than two standard errors.
pub(super) fn differ_clearly([one, other]: [Measured; 2]) -> bool {
    const CLEAR: f64 = 2.0;
    (one.value - other.value).abs() > CLEAR * one.error.hypot(other.error)
}
