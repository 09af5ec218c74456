//! The straight line through points that come one by one.

use crate::cross::Measured;
use crate::window::SHARED;

/// Running sums of a least squares line.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Line {
    count: f64,
    mean: [f64; 2],
    /// `Σ (x − x0)²`, `Σ (x − x0)(y − y0)`, `Σ (y − y0)²`.
    spread: [f64; 3],
}

impl Line {
    pub(super) fn take(&mut self, [x, y]: [f64; 2]) {
        self.count += 1.0;
        let before = [x - self.mean[0], y - self.mean[1]];
        self.mean[0] += before[0] / self.count;
        self.mean[1] += before[1] / self.count;
        let after = [x - self.mean[0], y - self.mean[1]];
        self.spread[0] += before[0] * after[0];
        self.spread[1] += before[0] * after[1];
        self.spread[2] += before[1] * after[1];
    }

    /// The slope; points are windows that overlap, which its error accounts for. An infinite error: too few of them.
    pub(super) fn slope(&self) -> Measured {
        let [xx, xy, yy] = self.spread;
        let independent = self.count / SHARED - 2.0;
        if xx.is_nan() || xx <= 0.0 || independent < 1.0 {
            return Measured { value: 0.0, error: f64::INFINITY };
        }
        let value = xy / xx;
        let residual = (yy - value * xy).max(0.0);
        Measured { value, error: (residual / independent / xx).sqrt() }
    }
}
