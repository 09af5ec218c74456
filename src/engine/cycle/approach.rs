//! Whether a transient comes to a cycle: its returns approach it as the multipliers predict.

use std::f64::consts::{PI, TAU};

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

/// A return this close, by the size of the motion, has come.
const THERE: f64 = 1e-6;

/// From one return to the next the distance may differ from the linear prediction by this part of it.
const OFF: f64 = 0.25;

/// Where it differs by less than this part of what is forgotten from one return to the next, nothing else holds the motion.
const CLOSELY: f64 = 0.5;

/// The slowest part of the distance decays between these multiples of the predicted rate.
const RATES: [f64; 2] = [0.5, 2.0];

/// A distance beyond this part of the size of the motion is far.
const AFAR: f64 = 0.05;

/// A spiral from afar is followed for this angle before it is believed: by half a turn its distance has been in all
/// directions, one way or the other.
const TURNED: f64 = PI;

/// The slowest part shows in a distance where it is no smaller than this part of it.
const SHOWS: f64 = 0.05;

/// The part of an unstable multiplier this small, by the size of the motion, is rounding: the motion lies on the fixed point.
const ON_IT: f64 = 1e-9;

/// A spiral of a multiplier above this one takes many turns, on which what bends the map adds up.
const WINDS: f64 = 0.98;

/// Points all around a spiral.
const AROUND: u32 = 6;

/// Multipliers below this one are forgotten so soon that no rate is measured.
const SLOW: f64 = 0.5;

/// What the linear map about a fixed point says of distances from it.
#[derive(Clone, Debug)]
pub struct Approach {
    jacobian: DMatrix<f64>,
    /// The eigenvalue of largest modulus, and its left eigenvector.
    slowest: Complex64,
    left: DVector<Complex64>,
    /// Its right eigenvector, by which `left` is 1.
    right: DVector<Complex64>,
    /// The part of the slowest multiplier in the first distance that was seen, and the returns since then.
    first: Option<(f64, f64)>,
}

impl Approach {
    /// The approach to a fixed point with this `jacobian`; `None` where its eigenvectors are not to be had.
    #[must_use]
    pub fn new(jacobian: DMatrix<f64>) -> Option<Approach> {
        let multipliers = jacobian.complex_eigenvalues();
        let slowest = *multipliers.iter().max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        let left = left_vector(&jacobian, slowest)?;
        let right = left_vector(&jacobian.transpose(), slowest)?;
        let right = &right / left.dot(&right);
        Some(Approach { jacobian, slowest, left, right, first: None })
    }

    /// The multiplier of largest modulus; of a pair one of the two.
    #[must_use]
    pub fn slowest(&self) -> Complex64 {
        self.slowest
    }

    /// The distance after one more return.
    #[must_use]
    pub fn next(&self, distance: &DVector<f64>) -> DVector<f64> {
        &self.jacobian * distance
    }

    /// Whether a distance becomes another about as the linear map has it, and what is left of it longest decays.
    #[must_use]
    pub fn predicts(&self, before: &DVector<f64>, after: &DVector<f64>) -> bool {
        let off = (after - self.next(before)).norm();
        let [first, last] = [before, after].map(|distance| self.part(distance));
        let slow = first >= SHOWS * before.norm() && self.slowest.norm() > SLOW;
        let rate = (first / last).ln();
        off <= OFF * before.norm() && (!slow || rate >= -RATES[0] * self.slowest.norm().ln())
    }

    /// Distances all around the spiral that a distance is on, as large as its slowest part; none where nothing winds.
    #[must_use]
    pub fn around(&self, distance: &DVector<f64>) -> Vec<DVector<f64>> {
        if self.slowest.im == 0.0 || self.slowest.norm() < WINDS {
            return Vec::new();
        }
        let here = self.left.dot(&distance.map(Complex64::from));
        let turned = |k| Complex64::cis(TAU * f64::from(k) / f64::from(AROUND)) * here * 2.0;
        (0..AROUND).map(|k| self.right.map(|part| (turned(k) * part).re)).collect()
    }

    /// Whether distances all around a spiral become others that are nearer, in the mean, as the multiplier has it: a torus around
    /// the cycle, beyond which motions go elsewhere, slows them down or turns them back.
    #[must_use]
    pub fn draws_in(&self, pairs: &[[DVector<f64>; 2]]) -> bool {
        let rates = pairs.iter().map(|[before, after]| (self.part(before) / self.part(after)).ln());
        let mean = rates.sum::<f64>() / pairs.len().max(1) as f64;
        pairs.is_empty() || mean >= -RATES[0] * self.slowest.norm().ln()
    }

    /// Whether distances from an unstable fixed point, the last one first, grow as its multiplier has it. `size` is that of the motion.
    #[must_use]
    pub fn drives_away(&self, distances: &[DVector<f64>], size: f64) -> bool {
        let (Some(last), Some(first)) = (distances.first(), distances.last()) else { return false };
        let [first, last] = [first, last].map(|distance| self.part(distance));
        let returns = (distances.len() - 1) as f64;
        let predicted = self.slowest.norm().ln();
        predicted > 0.0 && (last <= ON_IT * size || (last / first).ln() >= RATES[0] * predicted * returns)
    }

    /// The part of the slowest multiplier in a distance.
    fn part(&self, distance: &DVector<f64>) -> f64 {
        self.left.dot(&distance.map(Complex64::from)).norm()
    }

    /// Whether the distances from the fixed point, the last one first, fall as they should. `since` are the returns that were
    /// made since the distances of the last call began; `size` is the size of the motion.
    #[must_use]
    pub fn is_seen(&mut self, distances: &[DVector<f64>], since: f64, size: f64) -> bool {
        let (Some(last), Some(first)) = (distances.first(), distances.last()) else { return false };
        if last.amax() <= THERE * size {
            return true;
        }
        let within = |part: f64| {
            distances.windows(2).all(|pair| {
                let [after, before] = pair else { return false };
                let off = (after - &self.jacobian * before).norm();
                off <= part * before.norm() || before.amax() <= THERE * size
            })
        };
        let multiplier = self.slowest.norm();
        let seen = (within(OFF.min(CLOSELY * (1.0 - multiplier))), within(OFF));
        let part = |distance: &DVector<f64>| self.part(distance);
        let (begun, so_far) = match self.first {
            Some((part, before)) if seen.1 => (part, before + since),
            _ => (part(first), 0.0),
        };
        let returns = so_far + (distances.len() - 1) as f64;
        let rate = (begun / part(last)).ln() / returns;
        self.first = seen.1.then_some((begun, so_far));
        // What spirals in from afar is seen from all sides.
        let turned = self.slowest.arg() == 0.0 || returns * self.slowest.arg().abs() >= TURNED;
        let near = distances.iter().all(|distance| distance.amax() <= AFAR * size);
        let predicted = -multiplier.ln();
        let decays = (RATES[0] * predicted..=RATES[1] * predicted).contains(&rate);
        seen.0 || seen.1 && (multiplier < SLOW || decays && (turned || near))
    }
}

/// The left eigenvector of an eigenvalue, by inverse iteration.
fn left_vector(matrix: &DMatrix<f64>, eigenvalue: Complex64) -> Option<DVector<Complex64>> {
    let count = matrix.nrows();
    let near = eigenvalue + Complex64::from(1e-9 * eigenvalue.norm().max(1e-3));
    let shifted = matrix.transpose().map(Complex64::from) - DMatrix::identity(count, count) * near;
    let factors = shifted.lu();
    let mut vector = DVector::from_fn(count, |i, _| Complex64::new(1.0, 0.3 * i as f64));
    for _ in 0..3 {
        vector = factors.solve(&vector)?;
        let norm = vector.norm();
        if !(norm > 0.0 && norm.is_finite()) {
            return None;
        }
        vector.unscale_mut(norm);
    }
    Some(vector)
}
