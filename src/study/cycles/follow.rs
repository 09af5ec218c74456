//! From one fixed point of the return map to the next, along the arc length of their curve.

use nalgebra::DVector;

use crate::study::cycles::corner::beyond;
use crate::study::cycles::map::{Frame, ReturnMap};
use crate::study::cycles::newton::{Fixed, fixed};
use crate::study::cycles::special::{Special, between, crossing};

/// The first step along the curve, in sizes of the first cycle and ranges of the parameter.
const FIRST: f64 = 0.005;

/// The longest.
const LONGEST: f64 = 0.03;

/// Shorter ones than this are not taken: something ends there.
const SHORTEST: f64 = 1e-10;

/// The first step beyond a corner.
const AFTER_CORNER: f64 = 1e-4;

/// A step beyond a corner that is shorter than this finds no branch there.
const NO_BRANCH: f64 = 1e-7;

/// Two steps in a row that are taken make the next this much longer.
const GROWS: f64 = 1.5;

/// From point to point the curve turns by no more than this cosine.
const TURNS: f64 = 0.95;

/// And where the contact states change on the way, by this.
const STRAIGHT: f64 = 0.998;

/// A step is no longer than this part of the cycle.
const OF_SIZE: f64 = 0.2;

/// A cycle so small, in the size of the first, vanishes.
const VANISHES: f64 = 0.01;

/// What comes back after half its returns within this part of its size is the cycle of half its period.
pub(super) const HALVED: f64 = 1e-3;

/// A doubling that a branch meets is no farther than this many steps.
const NEAR: f64 = 2.0;

/// So close to an end of the range it is reached.
const EDGE: f64 = 1e-6;

/// Points of one direction.
const MOST_POINTS: usize = 3000;

/// The way of a branch in one direction.
pub(super) struct Course {
    /// The points, the start first.
    pub(super) points: Vec<(Fixed, Option<Special>)>,
    /// Whether the cycle shrinks to the equilibrium at the end.
    pub(super) vanishes: bool,
    /// The cycle of half the returns that it comes to at the end, and the coordinates that this one is in.
    pub(super) halved: Option<(Fixed, Frame)>,
}

/// Follows the curve from `start`, along its tangent or against it. Also whether it comes back to its start.
pub(super) fn follow(map: &ReturnMap, start: &Fixed, sign: f64) -> (Course, bool) {
    let count = map.count();
    let begun = start.along().signum() * sign;
    let mut here = Fixed { tangent: &start.tangent * begun, ..start.clone() };
    let mut course = Course { points: vec![(here.clone(), None)], vanishes: false, halved: None };
    let half = map.halved();
    let (mut step, mut taken) = (FIRST, 0);
    // After a corner: the events that are to be met, and how short a step may become.
    let mut beyond_corner: Option<u64> = None;
    while course.points.len() < MOST_POINTS {
        if leaves(&here, count, 0.0) {
            break;
        }
        let size = map.size(&here.place).unwrap_or(0.0);
        if size < VANISHES {
            course.vanishes = true;
            break;
        }
        step = step.min(OF_SIZE * size);
        let order = beyond_corner.unwrap_or(here.order);
        let Some((next, at_edge)) = next(map, &here, step, order) else {
            step *= 0.5;
            taken = 0;
            if step >= if beyond_corner.is_some() { NO_BRANCH } else { SHORTEST } {
                continue;
            }
            // The last value of a range may have no neighbours, as a law without a slope has no knee.
            if leaves(&here, count, EDGE) {
                break;
            }
            let last = course.points.len() - 1;
            let turned = if beyond_corner.is_some() { None } else { beyond(map, &here) };
            let Some((along, order)) = turned else {
                course.points[last].1 = Some(Special::End);
                break;
            };
            let turns = along[count] * here.tangent[count] < 0.0;
            course.points[last].1 = Some(if turns { Special::Corner } else { Special::Border });
            (here.tangent, beyond_corner, step) = (along, Some(order), AFTER_CORNER);
            continue;
        };
        let changed = if beyond_corner.take().is_none() { between(map, &here, &next) } else { None };
        if let Some(half) = &half
            && let Some(met) = meets(half, &here, &next, size)
        {
            match met {
                Ok(at) => {
                    course.points.push((twice(&at, &here), Some(Special::Doubling)));
                    course.halved = Some((at, half.frame));
                }
                Err(end) => {
                    let last = course.points.len() - 1;
                    course.points[last].1 = Some(end);
                }
            }
            break;
        }
        if course.points.len() > 3
            && let Some(part) = passed(map, start, [&here, &next], begun)
        {
            // What lies behind the start is there already.
            let before = changed.filter(|(at, _)| ahead(&here.place, &next.place, &at.place) < part);
            course.points.extend(before.map(|(at, special)| (at, Some(special))));
            course.points.push(course.points[0].clone());
            return (course, true);
        }
        course.points.extend(changed.map(|(at, special)| (at, Some(special))));
        if at_edge {
            course.points.push((next, None));
            break;
        }
        course.points.push((next.clone(), None));
        (here, taken) = (next, taken + 1);
        if taken >= 2 {
            step = (step * GROWS).min(LONGEST);
        }
    }
    (course, false)
}

/// How far along the step from `here` to `next` a place lies, as a part of it.
fn ahead(here: &DVector<f64>, next: &DVector<f64>, place: &DVector<f64>) -> f64 {
    let chord = next - here;
    (place - here).dot(&chord) / chord.norm_squared()
}

/// The part of the step from `here` to `next` at which it passes the cycle that it began with, in the direction that it began with; `None` where
/// it does not. It may be at another of its returns.
fn passed(map: &ReturnMap, start: &Fixed, [here, next]: [&Fixed; 2], begun: f64) -> Option<f64> {
    /// Periods and multipliers of one cycle agree to so much.
    const SAME: [f64; 2] = [1e-7, 1e-4];
    /// Periods that are farther apart are not looked at more closely.
    const LIKELY: f64 = 0.05;
    let count = map.count();
    let part = (start.place[count] - here.place[count]) / (next.place[count] - here.place[count]);
    let likely = (here.period / start.period - 1.0).abs() < LIKELY;
    if !(0.0..=1.0).contains(&part) || !likely || here.along() * start.along() * begun <= 0.0 {
        return None;
    }
    let mut guess = &here.place + (&next.place - &here.place) * part;
    guess[count] = start.place[count];
    let mut across = DVector::zeros(guess.len());
    across[count] = 1.0;
    let there = fixed(map, &guess, &across)?;
    let radius = |fixed: &Fixed| fixed.multipliers().iter().map(|z| z.norm()).fold(0.0, f64::max);
    let same = (there.period / start.period - 1.0).abs() < SAME[0]
        && (radius(&there) - radius(start)).abs() < SAME[1] * radius(start).max(1.0);
    same.then_some(part)
}

/// Whether between two neighbours a cycle meets that of half its returns, whose period doubles there: beyond, it is its own mirror
/// image or the other cycle twice. The fixed point of half the returns, or what the branch does where that is not found.
fn meets(half: &ReturnMap, here: &Fixed, next: &Fixed, size: f64) -> Option<Result<Fixed, Special>> {
    let chord = &next.place - &here.place;
    let turns = here.along() * next.along() < 0.0;
    let is_other = half.gap(&next.place).is_some_and(|gap| gap < HALVED * size);
    if !turns && !is_other {
        return None;
    }
    let part = if turns { here.along() / (here.along() - next.along()) } else { 0.5 };
    let at = crossing(half, &(&here.place + &chord * part), next, Special::Doubling);
    let at = at.filter(|at| (&at.place - &here.place).norm() <= NEAR * chord.norm());
    (is_other || at.is_some()).then(|| at.ok_or(Special::End))
}

/// A fixed point of half the returns as one of all, on the branch that ends there.
fn twice(half: &Fixed, here: &Fixed) -> Fixed {
    let count = half.jacobian.nrows();
    let (state, parameter) = (half.jacobian.columns(0, count), half.jacobian.column(count));
    let mut jacobian = half.jacobian.clone();
    jacobian.columns_mut(0, count).copy_from(&(state * state));
    jacobian.set_column(count, &(state * parameter + parameter));
    Fixed { place: half.place.clone(), jacobian, period: 2.0 * half.period, ..here.clone() }
}

/// Whether the curve leaves the range of the parameter from here on, or is closer than `near` to where it does.
fn leaves(here: &Fixed, count: usize, near: f64) -> bool {
    let (at, along) = (here.place[count], here.tangent[count]);
    at <= near && along < 0.0 || at >= 1.0 - near && along > 0.0
}

/// The next point, where the curve goes on smoothly for a step, and whether the range of the parameter ends there.
pub(super) fn next(map: &ReturnMap, here: &Fixed, step: f64, order: u64) -> Option<(Fixed, bool)> {
    let count = map.count();
    let guess = &here.place + &here.tangent * step;
    let inside = guess[count].clamp(0.0, 1.0);
    let at_edge = !(0.0..=1.0).contains(&guess[count]);
    let next = if at_edge {
        let part = (inside - here.place[count]) / here.tangent[count];
        let mut across = DVector::zeros(guess.len());
        across[count] = here.tangent[count].signum();
        let mut guess = &here.place + &here.tangent * part;
        guess[count] = inside;
        fixed(map, &guess, &across)?
    } else {
        fixed(map, &guess, &here.tangent)?
    };
    let cosine = next.tangent.dot(&here.tangent);
    let is_near = at_edge || (&next.place - &guess).norm() <= step;
    let wanted = if next.order == order { TURNS } else { STRAIGHT };
    (is_near && cosine >= wanted).then_some((next, at_edge))
}
