//! The motion along a contact that opens: from impacts on, what was integrated over them is wrong, but the spring tells where
//! the mass is.
//!
//! Along the contact `m ẍ + c ẋ + k x = T` but for the inclination. While the contact stays closed, `ẋ = v + ∫ẍ` and
//! `x = x0 + v τ + ∬ẍ` with two numbers that no impact leaves as they were; `ẍ = T/m − (k/m) x − (c/m) ẋ` gives both: what a straight
//! line in time does not explain of `ẍ`, `T`, `∬ẍ` and `∫ẍ` gives `1/m`, `k/m` and `c/m`, and the line itself gives `v`. With the mass, a
//! bound of the damping ratio is one of the damping.

use std::ops::Range;

use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};

use crate::cross::Measured;
use crate::lanes::sum;

/// Normal force, over its mean, below which the contact is open.
pub(super) const OPEN: f64 = 0.1;

/// Fewest samples per period, and the shortest closed contact, in periods, that are read.
const PER_PERIOD: f64 = 15.0;
const SHORTEST: f64 = 0.25;

/// Relative standard error above which there is no mass.
const CLEAR: f64 = 0.2;

/// Sums of the products of `T`, `∬ẍ`, `∫ẍ` and `ẍ`, without their straight lines over each closed contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Inertia {
    count: f64,
    products: Matrix4<f64>,
}

/// A closed contact: the slopes over time of the lines that were taken off, and `∫ẍ` of every sample (m/s).
struct Closed {
    samples: Range<usize>,
    slopes: Vector4<f64>,
    gained: Vec<f64>,
}

impl Inertia {
    /// Reads acceleration `ẍ` (m/s²), forces `T` and `N` (N) with `rate` samples per second and `period` samples per period, and
    /// replaces the motion `ẋ` (m/s) by what the spring tells: NaN where it tells nothing.
    pub(super) fn read(
        motion: &mut [f64],
        [acceleration, tangential, normal]: [&[f64]; 3],
        rate: f64,
        period: f64,
    ) -> Inertia {
        let mut sums = Inertia::default();
        motion.fill(f64::NAN);
        if period < PER_PERIOD {
            return sums;
        }
        let open = OPEN * sum(normal) / normal.len() as f64;
        let mut found = Vec::new();
        let mut end = 0;
        for part in normal.chunk_by(|a, b| (*a < open) == (*b < open)) {
            let samples = end..end + part.len();
            end = samples.end;
            if part[0] >= open && part.len() as f64 >= SHORTEST * period {
                found.push(sums.closed(samples, acceleration, tangential, 1.0 / rate));
            }
        }
        let Some((of, _)) = sums.solved() else { return sums };
        for Closed { samples, slopes, gained } in found {
            let start = (slopes[3] - of.dot(&slopes.fixed_rows::<3>(0))) / of[1];
            motion[samples].iter_mut().zip(gained).for_each(|(motion, gained)| *motion = start + gained);
        }
        sums
    }

    /// Takes the samples of a closed contact, `step` (s) apart.
    fn closed(
        &mut self,
        samples: Range<usize>,
        acceleration: &[f64],
        tangential: &[f64],
        step: f64,
    ) -> Closed {
        let [mut velocity, mut place] = [0.0; 2];
        let mut rows = Vec::with_capacity(samples.len());
        for k in samples.clone() {
            let a = acceleration[k];
            if k > samples.start {
                let before = acceleration[k - 1];
                place += step * velocity + step * step * (2.0 * before + a) / 6.0;
                velocity += 0.5 * step * (before + a);
            }
            rows.push(Vector4::new(tangential[k], place, velocity, a));
        }
        let n = rows.len() as f64;
        let times = |k: usize| step * (k as f64 - 0.5 * (n - 1.0));
        let spread = step * step * n * (n * n - 1.0) / 12.0;
        let mean = rows.iter().sum::<Vector4<f64>>() / n;
        let slopes = rows.iter().enumerate().map(|(k, row)| row * times(k)).sum::<Vector4<f64>>() / spread;
        for (k, row) in rows.iter().enumerate() {
            let left = row - mean - slopes * times(k);
            self.products += left * left.transpose();
        }
        self.count += n - 2.0;
        Closed { samples, slopes, gained: rows.iter().map(|row| row[2]).collect() }
    }

    pub(super) fn add(&mut self, other: &Inertia) {
        self.count += other.count;
        self.products += other.products;
    }

    /// `1/m`, `−k/m` and `−c/m`, and the standard error of the first; `None` where they are not those of a mass on a spring.
    fn solved(&self) -> Option<(Vector3<f64>, f64)> {
        let given: Matrix3<f64> = self.products.fixed_view::<3, 3>(0, 0).into();
        let with: Vector3<f64> = self.products.fixed_view::<3, 1>(0, 3).into();
        let solver = given.cholesky()?;
        let of = solver.solve(&with);
        let residual = (self.products[(3, 3)] - of.dot(&with)).max(0.0) / (self.count - 3.0);
        let error = (residual * solver.inverse()[(0, 0)]).sqrt();
        (of[0] > 0.0 && of[1] < 0.0 && error < CLEAR * of[0]).then_some((of, error))
    }

    /// What the damping may be (N s/m) at an angular frequency (rad/s) up to this damping ratio `c/(2mω)`, all alike.
    pub(super) fn damping(&self, damping_ratio: f64, omega: f64) -> Option<Measured> {
        let (of, error) = self.solved()?;
        let middle = damping_ratio * omega / of[0];
        let spread = middle / 3_f64.sqrt();
        Some(Measured { value: middle, error: spread.hypot(middle * error / of[0]) })
    }
}
