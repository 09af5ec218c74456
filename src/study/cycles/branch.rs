//! A branch of cycles, as it is told.

use nalgebra::DVector;

use crate::engine::cycle::candidate::Cycle;
use crate::engine::cycle::point::Freedom;
use crate::engine::judged::{examined, take_response};
use crate::engine::plan::Plan;
use crate::engine::record::Record;
use crate::model::linear;
use crate::study::cycles::follow::{Course, follow};
use crate::study::cycles::map::{Instances, ReturnMap};
use crate::study::cycles::newton::{Fixed, fixed};
use crate::study::cycles::special::Special;

/// How far about the end of a vanishing cycle the equilibrium is looked at, in the range of the parameter.
const ABOUT: [f64; 4] = [1e-4, 1e-3, 1e-2, 5e-2];

/// Halvings of such a range: to the rounding.
const HALVINGS: usize = 60;

/// A cycle of a branch.
#[derive(Clone, Debug)]
pub struct BranchPoint {
    /// The value of the parameter.
    pub value: f64,
    /// How many Floquet multipliers are outside the unit circle; 0 where the cycle is stable.
    pub unstable: usize,
    /// What is special about it.
    pub special: Option<Special>,
    /// What one period measures.
    pub record: Record,
}

impl BranchPoint {
    /// The standard deviation of `x2`, m.
    #[must_use]
    pub fn x2_std(&self) -> Option<f64> {
        self.record.outcome.as_ref().and_then(|outcome| outcome.x2_std)
    }
}

/// Cycles in order along the curve that they make.
#[derive(Clone, Debug, Default)]
pub struct Branch {
    /// The cycles.
    pub points: Vec<BranchPoint>,
}

impl Branch {
    /// Whether a cycle with this standard deviation of `x2` at a `value` of the parameter lies on the branch.
    #[must_use]
    pub fn holds(&self, value: f64, x2_std: f64) -> bool {
        /// As near to the branch as a chord of it may be.
        const NEAR: f64 = 0.02;
        self.points.windows(2).any(|pair| {
            let [a, b] = pair else { return false };
            let between = (a.value - value) * (b.value - value) <= 0.0;
            let (Some(from), Some(to)) = (a.x2_std(), b.x2_std()) else { return false };
            let part = (value - a.value) / (b.value - a.value);
            let part = if part.is_finite() { part } else { 0.5 };
            between && (from + part * (to - from) - x2_std).abs() <= NEAR * x2_std
        })
    }

    /// Follows a cycle at a `value` of the parameter both ways, to the ends of its `range` or of the branch.
    #[must_use]
    pub(crate) fn about(
        instances: Instances,
        plan: &Plan,
        range: [f64; 2],
        value: f64,
        cycle: (&Cycle, Freedom),
    ) -> Option<Branch> {
        let (map, place) = ReturnMap::about(instances, plan, range, value, cycle)?;
        let mut across = DVector::zeros(place.len());
        across[map.count()] = 1.0;
        let start = fixed(&map, &place, &across)?;
        let (backwards, closed) = follow(&map, &start, -1.0);
        let mut points = told(&map, &backwards);
        points.reverse();
        if !closed {
            points.extend(told(&map, &follow(&map, &start, 1.0).0).into_iter().skip(1));
        }
        Some(Branch { points })
    }
}

/// The records of a course.
fn told(map: &ReturnMap, course: &Course) -> Vec<BranchPoint> {
    let mut points: Vec<BranchPoint> =
        course.points.iter().filter_map(|(fixed, special)| point(map, fixed, *special)).collect();
    if course.vanishes
        && let Some(last) = course.points.last()
    {
        points.extend(birth(map, &last.0));
    }
    points
}

fn point(map: &ReturnMap, fixed: &Fixed, special: Option<Special>) -> Option<BranchPoint> {
    let (instance, _) = map.scene(&fixed.place)?;
    let (mut record, kind) = examined(&instance, true);
    let multipliers = fixed.multipliers();
    let largest = multipliers.iter().max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
    if let Some(outcome) = map.measure(&fixed.place, fixed.period, [largest.re, largest.im.abs()]) {
        take_response(&mut record, &instance, kind, &outcome);
    }
    Some(BranchPoint { value: map.value(&fixed.place), unstable: fixed.unstable(), special, record })
}

/// Where a pair of eigenvalues of the equilibrium that a cycle shrinks to crosses the imaginary axis.
fn birth(map: &ReturnMap, last: &Fixed) -> Option<BranchPoint> {
    let at = |part: f64| {
        let mut place = last.place.clone();
        place[map.count()] = part;
        Some((map.scene(&place)?.0, map.value(&place)))
    };
    // How many eigenvalues grow; the cycle may be that of a pair beside another that grows already.
    let growing = |part: f64| {
        let (instance, _) = at(part)?;
        Some(linear::eigenvalues(&instance)?.iter().filter(|eigenvalue| eigenvalue.re > 0.0).count())
    };
    let about = last.place[map.count()];
    let [mut low, mut high] = ABOUT
        .into_iter()
        .map(|by| [about - by, about + by])
        .find(|[low, high]| growing(*low).zip(growing(*high)).is_some_and(|(low, high)| low != high))?;
    let before = growing(low)?;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if growing(middle)? == before { low = middle } else { high = middle }
    }
    let (instance, value) = at(high)?;
    let (record, _) = examined(&instance, true);
    Some(BranchPoint { value, unstable: last.unstable(), special: Some(Special::Hopf), record })
}
