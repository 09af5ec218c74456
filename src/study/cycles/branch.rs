//! A branch of cycles, as it is told.

use nalgebra::DVector;

use crate::engine::cycle::candidate::Cycle;
use crate::engine::cycle::point::Freedom;
use crate::engine::judged::{examined, take_response};
use crate::engine::plan::Plan;
use crate::engine::record::Record;
use crate::model::instance::Instance;
use crate::model::linear;
use crate::study::cycles::follow::{Course, HALVED, follow};
use crate::study::cycles::map::{Frame, Instances, ReturnMap};
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

/// A special point that can be followed over a second parameter.
#[derive(Clone, Debug)]
pub(crate) struct Spot {
    /// What is special about it.
    pub(crate) special: Special,
    /// Where on the range of the parameter, from 0 to 1.
    pub(crate) part: f64,
    /// The cycle there.
    pub(crate) cycle: BranchPoint,
    pub(super) state: State,
}

/// What a special point is of.
#[derive(Clone, Debug)]
pub(super) enum State {
    /// A cycle: its fixed point, and the coordinates that it is in.
    Cycle(Box<Fixed>, Frame),
    /// An equilibrium that loses its stability.
    Birth,
}

/// Cycles in order along the curve that they make.
#[derive(Clone, Debug, Default)]
pub struct Branch {
    /// The cycles.
    pub points: Vec<BranchPoint>,
    /// Those that can be followed; empty where a branch is read back.
    pub(crate) spots: Vec<Spot>,
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
        let (mut map, place) = ReturnMap::about(instances, plan, range, value, cycle)?;
        // A cycle may have been found after more returns than it has.
        while let Some(half) = map.halved().filter(|half| half.gap(&place).is_some_and(|gap| gap < HALVED)) {
            map = half;
        }
        let mut across = DVector::zeros(place.len());
        across[map.count()] = 1.0;
        let start = fixed(&map, &place, &across)?;
        let (backwards, closed) = follow(&map, &start, -1.0);
        let forwards = (!closed).then(|| follow(&map, &start, 1.0));
        let mut branch = Branch::default();
        // The way round has all points.
        if let Some((round, true)) = &forwards {
            branch.tell(&map, round);
            return Some(branch);
        }
        branch.tell(&map, &backwards);
        branch.points.reverse();
        if let Some((mut forwards, _)) = forwards {
            // The start is told once.
            forwards.points.remove(0);
            branch.tell(&map, &forwards);
        }
        Some(branch)
    }

    /// Takes over a course.
    fn tell(&mut self, map: &ReturnMap, course: &Course) {
        for (fixed, special) in &course.points {
            let Some(cycle) = point(map, fixed, *special) else { continue };
            if let Some(special) = special.filter(|special| Special::FOLLOWED.contains(special)) {
                let (part, cycle) = (fixed.place[map.count()], cycle.clone());
                // A doubling is followed as that of the cycle whose period doubles.
                let half = course.halved.as_ref().filter(|_| special == Special::Doubling);
                let half = half.filter(|(half, _)| half.place == fixed.place);
                let (fixed, frame) = half.map_or((fixed, map.frame), |(half, frame)| (half, *frame));
                let state = State::Cycle(Box::new(fixed.clone()), frame);
                self.spots.push(Spot { special, part, cycle, state });
            }
            self.points.push(cycle);
        }
        if course.vanishes
            && let Some(last) = course.points.last()
        {
            self.points.extend(birth(map, &last.0));
        }
    }
}

/// What is told of a cycle.
pub(super) fn point(map: &ReturnMap, fixed: &Fixed, special: Option<Special>) -> Option<BranchPoint> {
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
    let growing = |part: f64| growing(&at(part)?.0);
    let about = last.place[map.count()];
    let between = |[low, high]: [f64; 2]| {
        // The cycle may be that of a pair beside another that grows already.
        let least = growing(low)?.max(growing(high)?);
        birth_between(&|part| Some(growing(part)? >= least), [low, high])
    };
    let part = ABOUT.into_iter().find_map(|by| between([about - by, about + by]))?;
    let (instance, value) = at(part)?;
    Some(born(&instance, value, last.unstable()))
}

/// What is told of an equilibrium that a cycle is born from.
pub(super) fn born(instance: &Instance, value: f64, unstable: usize) -> BranchPoint {
    let (record, _) = examined(instance, true);
    BranchPoint { value, unstable, special: Some(Special::Hopf), record }
}

/// How many eigenvalues of an equilibrium grow.
pub(crate) fn growing(instance: &Instance) -> Option<usize> {
    Some(linear::eigenvalues(instance)?.iter().filter(|eigenvalue| eigenvalue.re > 0.0).count())
}

/// Between two values that only one of which `is_beyond`, where that changes.
pub(crate) fn birth_between(is_beyond: &dyn Fn(f64) -> Option<bool>, [low, high]: [f64; 2]) -> Option<f64> {
    let (mut low, mut high) = (low, high);
    let before = is_beyond(low)?;
    if is_beyond(high)? == before {
        return None;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if is_beyond(middle)? == before { low = middle } else { high = middle }
    }
    Some(high)
}

impl Spot {
    /// Where the equilibrium loses its stability between neighbouring `values` of a parameter.
    pub(crate) fn births(instances: Instances, values: &[f64]) -> Vec<Spot> {
        let is_beyond = |value: f64| Some(growing(&instances(value)?)? > 0);
        let range = [values[0], values[values.len() - 1]];
        let birth = |pair: &[f64]| {
            let value = birth_between(&is_beyond, [pair[0], pair[1]])?;
            let part = (value - range[0]) / (range[1] - range[0]);
            let cycle = born(&instances(value)?, value, 0);
            Some(Spot { special: Special::Hopf, part, cycle, state: State::Birth })
        };
        values.windows(2).filter_map(birth).collect()
    }
}
