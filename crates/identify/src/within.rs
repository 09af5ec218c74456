//! The friction law read within the oscillation: where force sensors follow it, every sample has a friction coefficient and
//! a sliding velocity `v = V − ẋ` of its own.
//!
//! The mean of `T/N` over a vibration that reverses the sliding, sticks or lifts off is not the friction at the mean velocity.
//! The samples at which `v` passes the mean velocity have exactly that, whatever the rest of the cycle does.

use crate::cross::Measured;

/// Sliding velocities around the mean one, over it, at which the law is read: the lower and the upper side.
const SIDES: [[f64; 2]; 2] = [[0.7, 1.0], [1.0, 1.3]];
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

/// The law on both sides of the mean velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Within([Line; 2]);

impl Within {
    /// Reads samples: motion `ẋ` (m/s), forces `T` and `N` (N), with the mean velocity (m/s) and the mean normal force (N).
    pub(super) fn read(
        motion: &[f64],
        tangential: &[f64],
        normal: &[f64],
        velocity: f64,
        mean: f64,
    ) -> Within {
        let mut sums = Within::default();
        for ((motion, tangential), normal) in motion.iter().zip(tangential).zip(normal) {
            let v = velocity - motion;
            if *normal > PRESSED * mean {
                for (line, [low, high]) in sums.0.iter_mut().zip(SIDES) {
                    if (low * velocity..high * velocity).contains(&v) {
                        line.take(v, tangential / normal);
                    }
                }
            }
        }
        sums
    }

    pub(super) fn add(&mut self, other: &Within) {
        self.0.iter_mut().zip(&other.0).for_each(|(sum, line)| sum.add(line));
    }

    /// Friction coefficient at `velocity` (m/s), and slope `dμ/dv` (s/m); `None` with too few samples.
    pub(super) fn law(&self, velocity: f64) -> Option<[Measured; 2]> {
        /// Fewest samples of a line.
        const LEAST: f64 = 60.0;
        let mut both = self.0[0];
        both.add(&self.0[1]);
        let found = both.read(velocity);
        (both.count >= LEAST && found[1].value.is_finite()).then_some(found)
    }

    /// Whether the law bends: the slopes of both sides differ clearly, so that it has none at the mean velocity.
    pub(super) fn bends(&self, velocity: f64) -> bool {
        let [low, high] = self.0.map(|line| line.read(velocity));
        differ([low[1], high[1]], low[0].value, velocity)
    }

    /// Slope (s/m) above the mean velocity (m/s).
    pub(super) fn above(&self, velocity: f64) -> Measured {
        self.0[1].read(velocity)[1]
    }

    /// By how much the slopes (s/m) of both sides are off the one between them: a bend that is not clear may be one.
    pub(super) fn unclear_bend(&self, velocity: f64) -> f64 {
        let [low, high] = self.0.map(|line| line.read(velocity)[1].value);
        0.5 * (low - high).abs()
    }
}

/// Whether two slopes `dμ/dv` (s/m) of a law differ clearly, by more than matters to friction of this `level` at this velocity (m/s).
pub(super) fn differ([one, other]: [Measured; 2], level: f64, velocity: f64) -> bool {
    /// Standard errors that are clear, and the difference that matters, of `d ln μ/d ln v`.
    const CLEAR: f64 = 2.0;
    const MATTERS: f64 = 0.1;
    let off = (one.value - other.value).abs();
    off > CLEAR * one.error.hypot(other.error) && off * velocity.abs() > MATTERS * level.abs()
}
