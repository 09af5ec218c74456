//! A straight line through points that follow each other and scatter alike for a while.

use crate::cross::Measured;

/// A line and how well it is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Trended {
    pub(super) slope: Measured,
    /// Standard error of the mean ordinate.
    pub(super) error: f64,
}

impl Trended {
    /// Least squares. Residuals that resemble their neighbours count as fewer: `n (1 − ρ)/(1 + ρ)` with their correlation ρ.
    pub(super) fn new(points: impl Iterator<Item = [f64; 2]>) -> Trended {
        let points: Vec<[f64; 2]> = points.collect();
        let n = points.len() as f64;
        let mean = |k: usize| points.iter().map(|point| point[k]).sum::<f64>() / n;
        let [x0, y0] = [mean(0), mean(1)];
        let spread: f64 = points.iter().map(|[x, _]| (x - x0).powi(2)).sum();
        let value = points.iter().map(|[x, y]| (x - x0) * (y - y0)).sum::<f64>() / spread;
        let residuals: Vec<f64> = points.iter().map(|[x, y]| y - y0 - value * (x - x0)).collect();
        let square: f64 = residuals.iter().map(|r| r * r).sum();
        let beside: f64 = residuals.windows(2).map(|pair| pair[0] * pair[1]).sum();
        let alike = if square > 0.0 { (beside / square).clamp(0.0, 0.95) } else { 0.0 };
        let independent = (n * (1.0 - alike) / (1.0 + alike) - 2.0).max(0.5);
        let variance = square / independent;
        if n < 3.0 || !value.is_finite() {
            let slope = Measured { value: 0.0, error: f64::INFINITY };
            return Trended { slope, error: (square / n.max(1.0)).sqrt() };
        }
        Trended { slope: Measured { value, error: (variance / spread).sqrt() }, error: (variance / n).sqrt() }
    }
}
