//! Points as a linear problem.

use crate::model::Param;
use crate::study::fit::fault::FitFault;
use crate::study::fit::shape::Part;
use nalgebra::{DMatrix, DVector};
use smallvec::SmallVec;
use squealmap_identify::Point;

/// Condition of the normal equations above which a row of the material is not determined by the data.
pub(super) const DETERMINED: f64 = 1e-9;

/// Values of the law's velocity that are tried before the best one is refined, even in the logarithm.
const TRIALS: usize = 40;

/// Refinements by the golden section: to 1e-7 of the interval.
const REFINEMENTS: usize = 34;

/// The values that the friction of a point depends on: two of each of two rows, and perhaps a velocity.
pub(super) type Weights = SmallVec<[(usize, f64); 5]>;

/// A fit with its law's velocity open.
pub(super) struct Problem<'a> {
    pub(super) points: &'a [Point],
    /// The part of `μ_d`; `None` where it is all.
    pub(super) part: Option<Part>,
    pub(super) temperatures: &'a [f64],
    pub(super) params: &'a [Param],
}

impl Problem<'_> {
    /// The parts of `μ_s` and `μ_d` (or of `μ_d` alone) over the velocities of a point.
    fn parts(&self, point: &Point, velocity: f64) -> [f64; 2] {
        let Some(part) = self.part else { return [1.0, 0.0] };
        let w = part.over(speeds(point), velocity);
        [1.0 - w, w]
    }

    /// The rows on either side of a temperature with their shares.
    pub(super) fn rows(&self, temperature: f64) -> [(usize, f64); 2] {
        let upper =
            self.temperatures.partition_point(|&row| row < temperature).min(self.temperatures.len() - 1);
        let lower = upper.saturating_sub(1);
        let (t0, t1) = (self.temperatures[lower], self.temperatures[upper]);
        let part = if t1 > t0 { ((temperature - t0) / (t1 - t0)).clamp(0.0, 1.0) } else { 1.0 };
        [(lower, 1.0 - part), (upper, part)]
    }

    /// The weight of each value of the rows in the friction of a point, without those of weight 0.
    pub(super) fn weights(&self, point: &Point, velocity: f64) -> Weights {
        let kinds = self.params.len();
        let parts = self.parts(point, velocity);
        let rows = self.rows(point.temperature);
        rows.into_iter()
            .flat_map(|(row, share)| (0..kinds).map(move |k| (row * kinds + k, share * parts[k])))
            .filter(|(_, weight)| *weight != 0.0)
            .collect()
    }

    /// Measured less fitted friction of every point.
    pub(super) fn residuals(&self, solution: &DVector<f64>, velocity: f64) -> Vec<f64> {
        let fitted = |point: &Point| -> f64 {
            self.weights(point, velocity).iter().map(|(i, weight)| weight * solution[*i]).sum()
        };
        self.points.iter().map(|point| point.friction - fitted(point)).collect()
    }

    /// Whether the points bound the law's velocity: whether the one of the fastest point fits them worse than the best one
    /// (with a sum of `squares`) by more than errors of this variance make likely.
    pub(super) fn bounds(&self, fastest: f64, squares: f64, variance: f64) -> bool {
        /// Two standard deviations: the sum of squares rises by their square times the variance.
        const LIKELY: f64 = 4.0;
        self.squares(fastest) - squares > LIKELY * variance
    }

    /// The sum of squares that a velocity leaves; infinite where the points do not determine the values.
    fn squares(&self, velocity: f64) -> f64 {
        self.solve(velocity)
            .map_or(f64::INFINITY, |solution| sum_of_squares(&self.residuals(&solution, velocity)))
    }

    /// Values of all rows.
    pub(super) fn solve(&self, velocity: f64) -> Result<DVector<f64>, FitFault> {
        let unknowns = self.params.len() * self.temperatures.len();
        let mut normal = DMatrix::<f64>::zeros(unknowns, unknowns);
        let mut right = DVector::<f64>::zeros(unknowns);
        for point in self.points {
            let weights = self.weights(point, velocity);
            for &(i, a) in &weights {
                right[i] += a * point.friction;
                for &(j, b) in &weights {
                    normal[(i, j)] += a * b;
                }
            }
        }
        let eigen = normal.clone().symmetric_eigen();
        let largest = eigen.eigenvalues.max();
        let least = eigen.eigenvalues.imin();
        if eigen.eigenvalues[least].partial_cmp(&(DETERMINED * largest)) != Some(std::cmp::Ordering::Greater)
        {
            return Err(self.undetermined(eigen.eigenvectors.column(least).icamax()));
        }
        let solution = normal.cholesky().map(|factors| factors.solve(&right));
        solution.ok_or_else(|| self.undetermined(0))
    }

    /// The value that the points leave most open.
    fn undetermined(&self, index: usize) -> FitFault {
        let (row, param) = (index / self.params.len(), self.params[index % self.params.len()]);
        let near = self.points.iter().filter(|point| {
            self.rows(point.temperature).into_iter().any(|(near, share)| near == row && share > 0.0)
        });
        let speeds = near.map(|point| point.velocity.abs());
        let (low, high) =
            speeds.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), v| (low.min(v), high.max(v)));
        FitFault::Undetermined {
            temperature: self.temperatures[row],
            param: param.info().name,
            low: if low.is_finite() { low } else { 0.0 },
            high,
        }
    }

    /// The velocity of the law with the least residual, up to the fastest point (m/s).
    pub(super) fn best_velocity(&self, fastest: f64) -> f64 {
        /// The slowest velocity tried, relative to the fastest point.
        const SLOWEST: f64 = 1e-3;
        /// 1/golden ratio.
        const GOLDEN: f64 = 0.618_033_988_749_894_8;
        let residual = |log: f64| self.squares(log.exp());
        let top = fastest.max(f64::MIN_POSITIVE).ln();
        let step = -SLOWEST.ln() / TRIALS as f64;
        let trials = (0..=TRIALS).map(|k| top - k as f64 * step).map(|log| (log, residual(log)));
        let best = trials.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(top, |(log, _)| log);
        let (mut low, mut high) = (best - step, (best + step).min(top));
        let within = |low: f64, high: f64, part: f64| {
            let log = low + part * (high - low);
            (log, residual(log))
        };
        // One of the two places inside is one of the next interval, too.
        let (mut a, mut b) = (within(low, high, 1.0 - GOLDEN), within(low, high, GOLDEN));
        for _ in 0..REFINEMENTS {
            if a.1 <= b.1 {
                (high, b) = (b.0, a);
                a = within(low, high, 1.0 - GOLDEN);
            } else {
                (low, a) = (a.0, b);
                b = within(low, high, GOLDEN);
            }
        }
        (0.5 * (low + high)).exp()
    }
}

/// The speeds over which the friction of a point is averaged, m/s.
pub(super) fn speeds(point: &Point) -> [f64; 2] {
    let speed = point.velocity.abs();
    [(speed - point.half_range).max(0.0), speed + point.half_range]
}

pub(super) fn sum_of_squares(residuals: &[f64]) -> f64 {
    residuals.iter().map(|residual| residual * residual).sum()
}
