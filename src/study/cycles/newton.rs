//! A fixed point of the return map near a guess.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use crate::study::cycles::map::ReturnMap;

/// Neighbours on both sides are this far off: what two of them differ by is known to eight digits.
const BOTH_SIDES: f64 = 1e-5;

/// A neighbour on one side alone.
const ONE_SIDE: f64 = 1e-7;

/// The last step of Newton's method: the next would be its square.
const LAST_STEP: f64 = 1e-7;

/// The first step is no longer than this.
const FIRST_STEP: f64 = 0.1;

/// From step to step they become shorter by this factor.
const FALLS: f64 = 0.5;

/// Steps.
const MOST_STEPS: usize = 8;

/// A multiplier this close to the unit circle is on it: a straight law has cycles of all sizes beside each other.
const NEUTRAL: f64 = 1e-6;

/// A fixed point closes within this.
const CLOSES: f64 = 1e-9;

/// A fixed point of the return map.
#[derive(Clone, Debug)]
pub(super) struct Fixed {
    /// Where: coordinates and parameter.
    pub(super) place: DVector<f64>,
    /// Along the curve of fixed points, of length 1.
    pub(super) tangent: DVector<f64>,
    /// The derivatives of the returned coordinates.
    pub(super) jacobian: DMatrix<f64>,
    /// Stands for the sequence of events.
    pub(super) order: u64,
    /// The period, s.
    pub(super) period: f64,
}

impl Fixed {
    /// The Floquet multipliers.
    pub(super) fn multipliers(&self) -> Vec<Complex64> {
        let count = self.jacobian.nrows();
        self.jacobian.columns(0, count).into_owned().complex_eigenvalues().iter().copied().collect()
    }

    /// How many of them are outside the unit circle: none, where the cycle is stable.
    pub(super) fn unstable(&self) -> usize {
        self.multipliers().iter().filter(|multiplier| multiplier.norm() > 1.0 + NEUTRAL).count()
    }

    /// Whether one of them is on the unit circle, as far as they are known.
    pub(super) fn is_neutral(&self) -> bool {
        self.multipliers().iter().any(|multiplier| (multiplier.norm() - 1.0).abs() <= NEUTRAL)
    }

    /// The component of the tangent along the parameter.
    pub(super) fn along(&self) -> f64 {
        self.tangent[self.jacobian.nrows()]
    }
}

/// The map at a place, and its derivatives after coordinates and parameter.
struct Linear {
    end: DVector<f64>,
    jacobian: DMatrix<f64>,
    order: u64,
}

/// The derivatives at a place, from neighbours whose events are those of the place itself.
fn linear(map: &ReturnMap, place: &DVector<f64>) -> Option<Linear> {
    let base = map.fly(place)?;
    let neighbour = |i: usize, by: f64| {
        let mut moved = place.clone();
        moved[i] += by;
        map.fly(&moved).filter(|flown| flown.order == base.order)
    };
    let columns: Option<Vec<DVector<f64>>> = (0..place.len())
        .map(|i| {
            if let [Some(after), Some(before)] = [BOTH_SIDES, -BOTH_SIDES].map(|by| neighbour(i, by)) {
                return Some((after.end - before.end) / (2.0 * BOTH_SIDES));
            }
            [ONE_SIDE, -ONE_SIDE].into_iter().find_map(|by| Some((neighbour(i, by)?.end - &base.end) / by))
        })
        .collect();
    Some(Linear { jacobian: DMatrix::from_columns(&columns?), end: base.end, order: base.order })
}

/// The matrix of the map less the identity, with one more row.
fn bordered(jacobian: &DMatrix<f64>, row: &DVector<f64>) -> DMatrix<f64> {
    let count = jacobian.nrows();
    let mut matrix = jacobian.clone().insert_row(count, 0.0);
    for i in 0..count {
        matrix[(i, i)] -= 1.0;
    }
    matrix.set_row(count, &row.transpose());
    matrix
}

/// The tangent of the curve whose map has this Jacobian, on the side of `towards`.
pub(super) fn tangent(jacobian: &DMatrix<f64>, towards: &DVector<f64>) -> Option<DVector<f64>> {
    let count = jacobian.nrows();
    let mut right = DVector::zeros(count + 1);
    right[count] = 1.0;
    let along = bordered(jacobian, towards).lu().solve(&right)?;
    let length = along.norm();
    (length > 0.0 && length.is_finite()).then(|| along / length)
}

/// The fixed point in the plane through `guess` across `along`.
pub(super) fn fixed(map: &ReturnMap, guess: &DVector<f64>, along: &DVector<f64>) -> Option<Fixed> {
    let count = map.count();
    let mut place = guess.clone();
    let mut longest = FIRST_STEP;
    for _ in 0..MOST_STEPS {
        let here = linear(map, &place)?;
        let mut right = DVector::zeros(count + 1);
        right.rows_mut(0, count).copy_from(&(place.rows(0, count) - here.end));
        right[count] = along.dot(&(guess - &place));
        let change = bordered(&here.jacobian, along).lu().solve(&right)?;
        let length = change.amax();
        if length > longest || length.is_nan() {
            return None;
        }
        place += change;
        if length <= LAST_STEP {
            let flown = map.fly(&place)?;
            let off = (&flown.end - place.rows(0, count)).amax();
            let tangent = tangent(&here.jacobian, along)?;
            let (order, period) = (flown.order, flown.time);
            // On a border itself the derivatives are those of one side, and the events those of the other.
            let closes = order == here.order && off <= CLOSES * here.jacobian.amax().max(1.0);
            return closes.then_some(Fixed { place, tangent, jacobian: here.jacobian, order, period });
        }
        longest = (FALLS * length).max(LAST_STEP);
    }
    None
}
