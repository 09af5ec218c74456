//! A special point on a line through a plane of two parameters, near where it is expected.

use nalgebra::DVector;

use crate::engine::plan::Plan;
use crate::study::cycles::branch::{BranchPoint, Spot, State, birth_between, born, growing, point};
use crate::study::cycles::corner::beyond;
use crate::study::cycles::follow::next;
use crate::study::cycles::map::{Instances, ReturnMap};
use crate::study::cycles::newton::{Fixed, fixed};
use crate::study::cycles::special::{Special, crossing};

/// A multiplier of a special point that is nearer to the unit circle than this is on it.
const ON_CIRCLE: f64 = 1e-4;

/// So far before a corner its branch is taken up, the first of these that finds it: the other branch is beside it.
const BEFORE: [f64; 4] = [2e-3, 1e-2, 4e-4, 8e-5];

/// The last step to a corner.
const AT_CORNER: f64 = 1e-10;

/// Steps to a corner.
const MOST_TO_CORNER: usize = 80;

/// Halvings of the range about an expected Hopf point, from the narrowest.
const BRACKETS: i32 = 8;

/// A line of the plane.
pub(super) struct Line<'a> {
    /// Its instances.
    pub(super) instances: Instances<'a>,
    /// Their plan.
    pub(super) plan: &'a Plan,
    /// The range of its parameter.
    pub(super) range: [f64; 2],
}

/// A special point on a line.
#[derive(Clone, Debug)]
pub(super) struct Found {
    /// Where on the range of the line.
    pub(super) part: f64,
    /// What is there.
    pub(super) cycle: BranchPoint,
    state: State,
}

impl Found {
    /// A special point of a branch.
    pub(super) fn of(spot: &Spot) -> Found {
        Found { part: spot.part, cycle: spot.cycle.clone(), state: spot.state.clone() }
    }

    /// What is expected as far beyond this one as a `part` of the way from the one `before`.
    pub(super) fn beyond(&self, before: &Found, part: f64) -> Found {
        let mut there = self.clone();
        if let (State::Cycle(fixed, _), State::Cycle(before, _)) = (&mut there.state, &before.state) {
            let way = &fixed.place - &before.place;
            fixed.place += way * part;
        }
        there
    }
}

/// The special point of a kind on a line, `within` a distance of the part `expected`; `from` is one on a line beside it.
pub(super) fn located(
    line: &Line<'_>,
    special: Special,
    expected: f64,
    from: &Found,
    within: f64,
) -> Option<Found> {
    let (before, frame) = match &from.state {
        State::Cycle(before, frame) => (before, frame),
        State::Birth => return birth(line, expected, within),
    };
    let map = ReturnMap::along(line.instances, line.plan, line.range, *frame);
    let mut guess = before.place.clone();
    guess[map.count()] = expected;
    let at = match special {
        Special::Corner => corner(&map, &guess, before)?,
        _ => crossing(&map, &guess, before, special)?,
    };
    let part = at.place[map.count()];
    let mut cycle = point(&map, &at, Some(special)).filter(|_| (part - expected).abs() <= within)?;
    // Those that are on the unit circle are the special ones.
    let multipliers = at.multipliers();
    cycle.unstable = multipliers.iter().filter(|multiplier| multiplier.norm() > 1.0 + ON_CIRCLE).count();
    Some(Found { part, cycle, state: State::Cycle(Box::new(at), *frame) })
}

/// The last cycle before a corner: as far as its sequence of contact states goes.
fn corner(map: &ReturnMap<'_>, guess: &DVector<f64>, before: &Fixed) -> Option<Fixed> {
    let start = |by: f64| {
        let start = fixed(map, &(guess - &before.tangent * by), &before.tangent)?;
        (start.order == before.order).then_some((start, by))
    };
    let (mut here, mut step) = BEFORE.into_iter().find_map(start)?;
    for _ in 0..MOST_TO_CORNER {
        let order = here.order;
        match next(map, &here, step, order).filter(|(next, _)| next.order == order) {
            Some((next, _)) => here = next,
            None => step *= 0.5,
        }
        if step < AT_CORNER {
            let (along, _) = beyond(map, &here)?;
            return (along[map.count()] * here.along() < 0.0).then_some(here);
        }
    }
    None
}

/// Where the equilibrium loses its stability.
fn birth(line: &Line<'_>, expected: f64, within: f64) -> Option<Found> {
    let value = |part: f64| line.range[0] + part * (line.range[1] - line.range[0]);
    let instance = |part: f64| (line.instances)(value(part));
    let is_beyond = |part: f64| Some(growing(&instance(part)?)? > 0);
    // Where two curves are close the nearer one is meant.
    let about = |halvings: i32| {
        let by = within * 0.5_f64.powi(halvings);
        birth_between(&is_beyond, [expected - by, expected + by])
    };
    let part = (0..=BRACKETS).rev().find_map(about)?;
    let cycle = born(&instance(part)?, value(part), 0);
    Some(Found { part, cycle, state: State::Birth })
}
