//! The knee of a friction law among the levels that are read within an oscillation, each of which is smeared.
//!
//! Levels are read over [`SIDE`] of the velocity on either side, and what happens between samples is smeared over more
//! ([`Within::half_width`](crate::within::Within::half_width)). Where friction falls below a velocity `k` by `c` per m/s more than above it, the mean
//! over a half-width `h` is `a + b v + c r(k − v)` with
//!
//! ```text
//! r(x) = 0 for x ≤ −h,   (x + h)²/4h between,   x for x ≥ h
//! ```
//!
//! Two straight lines follow that only with a third between them, and then say nothing of where the knee is.

use nalgebra::{Matrix3, Vector3};

use crate::within::SIDE;

/// By how much the squared residuals over their scale may exceed the least of a knee that is likely: two standard errors.
const LIKELY: f64 = 4.0;

/// A velocity below which friction falls more steeply.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Knee {
    /// Where, m/s.
    at: f64,
    /// Below which speed it lies behind, up to two standard errors of it, m/s.
    pub(super) below: f64,
    /// By how much more steeply friction falls, s/m.
    fall: f64,
    /// Half of the width over which levels are read, over the velocity.
    width: f64,
}

impl Knee {
    /// The knee that leaves the smallest sum of squared residuals of points (speed, m/s, and friction, in order of speed), each read over `width` of
    /// its velocity on either side, and that sum over the square of `scale`. `None` where there are not `least` points or more on either side, where friction does not fall more steeply below, or
    /// where the knee is known no better than a level.
    pub(super) fn fitted(points: &[[f64; 2]], width: f64, scale: f64, least: usize) -> Option<(Knee, f64)> {
        let last = points.len().checked_sub(least)?;
        let found =
            (least..last).filter_map(|k| solved(points, width, 0.5 * (points[k - 1][0] + points[k][0])));
        let found: Vec<(Knee, f64)> = found.collect();
        let (best, squares) = *found.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
        let likely = found.iter().filter(|(_, other)| *other <= squares + LIKELY * scale * scale);
        let [low, high] =
            likely.fold([best.at; 2], |[low, high], (knee, _)| [low.min(knee.at), high.max(knee.at)]);
        let knee = Knee { below: low, ..best };
        let clear = knee.fall > 0.0 && high - low < SIDE * best.at;
        clear.then_some((knee, squares / (scale * scale)))
    }

    /// By how much the level read at a velocity (m/s) lies above the law.
    pub(super) fn smear(self, velocity: f64) -> f64 {
        let speed = velocity.abs();
        self.fall * (ramp(self.at - speed, self.width * speed) - (self.at - speed).max(0.0))
    }
}

/// `r(x)` for a half-width `h`.
fn ramp(x: f64, h: f64) -> f64 {
    if x >= h {
        x
    } else if x <= -h {
        0.0
    } else {
        (x + h).powi(2) / (4.0 * h)
    }
}

/// Least squares with a knee at a speed (m/s), and the squared residuals.
fn solved(points: &[[f64; 2]], width: f64, at: f64) -> Option<(Knee, f64)> {
    // Speeds from the knee on: no digits are lost.
    let row = |point: &[f64; 2]| {
        let speed = point[0];
        Vector3::new(1.0, speed / at - 1.0, ramp(at - speed, width * speed) / at)
    };
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for point in points {
        let row = row(point);
        normal += row * row.transpose();
        right += row * point[1];
    }
    let solution = normal.cholesky()?.solve(&right);
    let squares = points.iter().map(|point| (point[1] - row(point).dot(&solution)).powi(2)).sum();
    Some((Knee { at, below: at, fall: solution[2] / at, width }, squares))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Levels of a bilinear law, as means over the window in which they are read, by sums: knee and smear are found again.
    #[test]
    fn a_smeared_knee_is_found_where_it_is() {
        // Midway between two points, where a knee is looked for.
        const KNEE: f64 = 0.0231;
        let law = |v: f64| 0.34 - 0.3 * v + 7.0 * (KNEE - v).max(0.0);
        let mean = |v: f64| {
            let parts = (0..2000).map(|k| law(v * (1.0 + SIDE * (f64::from(k) - 999.5) / 1000.0)));
            parts.sum::<f64>() / 2000.0
        };
        let points: Vec<[f64; 2]> =
            (0..200).map(|k| 0.0072 + 0.0002 * f64::from(k)).map(|v| [v, mean(v)]).collect();
        let (knee, squares) = Knee::fitted(&points, SIDE, 0.005, 5).expect("there is one");
        assert!((knee.at - KNEE).abs() < 1e-9 && squares < 1e-3, "{knee:?} {squares}");
        for [v, level] in &points {
            assert!((level - knee.smear(*v) - law(*v)).abs() < 1e-5, "{v}");
        }
    }
}
