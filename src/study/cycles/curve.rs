//! A special point followed over two parameters: the curve on which cycles meet, double their period, or are born.
//!
//! From point to point one parameter takes a step, and the special point is looked for along the other: the parameter in which
//! the curve moves faster takes the steps, so that it may turn back in either.

use crate::engine::plan::Plan;
use crate::model::instance::Instance;
use crate::study::cycles::branch::{BranchPoint, Spot};
use crate::study::cycles::locate::{Found, Line, located};
use crate::study::cycles::special::Special;

/// The first step, as a part of the range of a parameter.
const FIRST: f64 = 0.004;

/// The longest.
const LONGEST: f64 = 0.02;

/// Shorter ones than this are not taken: the curve ends there.
const SHORTEST: f64 = 5e-5;

/// The special point is this near to where it is expected, in steps; at the first step nothing is expected yet.
const NEAR: [f64; 2] = [2.0, 25.0];

/// From step to step the curve turns by no more than this cosine, but for the shortest steps.
const TURNS: f64 = 0.9;

/// A curve comes back to its start where it passes it as near as this part of a step.
const CLOSES: f64 = 0.1;

/// Points of one direction.
const MOST_POINTS: usize = 2000;

/// The instances of a plane; `None` where there is none.
pub(crate) type Plane<'a> = &'a (dyn Fn([f64; 2]) -> Option<Instance> + Sync);

/// Why a curve goes no further.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The range of a parameter ends.
    Edge,
    /// It comes back to its start.
    Closed,
    /// No such point is beside the last: two curves meet there, or the contact states change.
    Lost,
    /// It has as many points as are followed.
    Limit,
}

/// A special point at two values.
#[derive(Clone, Debug)]
pub struct CurvePoint {
    /// The values of both parameters.
    pub values: [f64; 2],
    /// The cycle there, or the equilibrium of a Hopf point.
    pub cycle: BranchPoint,
}

/// Special points of one kind, in order along the curve that they make.
#[derive(Clone, Debug)]
pub struct Curve {
    /// What is special about them.
    pub special: Special,
    /// The points.
    pub points: Vec<CurvePoint>,
    /// Why it ends at its first and at its last point.
    pub ends: [End; 2],
}

/// Where curves are followed.
#[derive(Clone, Copy)]
pub(crate) struct Field<'a> {
    /// Its instances.
    pub(crate) plane: Plane<'a>,
    /// Their plan, a [`crate::study::cycles::map::fine`] one.
    pub(crate) plan: &'a Plan,
    /// The ranges of both parameters.
    pub(crate) ranges: [[f64; 2]; 2],
}

impl Field<'_> {
    /// The values at parts of both ranges.
    fn values(&self, at: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| self.ranges[k][0] + at[k] * (self.ranges[k][1] - self.ranges[k][0]))
    }

    /// The special point on a line of the plane near where it is expected.
    fn find(&self, special: Special, along: usize, at: [f64; 2], from: &Found, within: f64) -> Option<Here> {
        let across = 1 - along;
        let fixed = self.values(at)[across];
        let instances = |value: f64| {
            let mut values = [fixed; 2];
            values[along] = value;
            (self.plane)(values)
        };
        let line = Line { instances: &instances, plan: self.plan, range: self.ranges[along] };
        let found = located(&line, special, at[along], from, within)?;
        let mut there = at;
        there[along] = found.part;
        Some(Here { at: there, found })
    }
}

/// A special point on the way.
#[derive(Clone, Debug)]
struct Here {
    /// Parts of the ranges of both parameters.
    at: [f64; 2],
    found: Found,
}

impl Curve {
    /// The curve through a special point that was found `along` one of the parameters, at these parts of both ranges.
    pub(crate) fn through(field: Field<'_>, spot: &Spot, along: usize, at: [f64; 2]) -> Option<Curve> {
        let special = spot.special;
        let start = field.find(special, along, at, &Found::of(spot), LONGEST)?;
        let (mut back, mut first) = follow(field, special, along, &start, -1.0);
        back.reverse();
        let last = if first == End::Closed {
            first
        } else {
            let (forth, last) = follow(field, special, along, &start, 1.0);
            if last == End::Closed {
                // The way round has all points.
                (back, first) = (forth, last);
            } else {
                back.extend(forth.into_iter().skip(1));
            }
            last
        };
        let told = |here: Here| CurvePoint { values: field.values(here.at), cycle: here.found.cycle };
        Some(Curve { special, points: back.into_iter().map(told).collect(), ends: [first, last] })
    }

    /// How far it reaches, as a part of the `ranges`: the farther of both.
    pub(crate) fn reach(&self, ranges: [[f64; 2]; 2]) -> f64 {
        let along = |k: usize| {
            let values = self.points.iter().map(|point| point.values[k]);
            let ends =
                values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
            (ends[1] - ends[0]) / (ranges[k][1] - ranges[k][0])
        };
        along(0).max(along(1))
    }

    /// Whether nearly all points of another curve lie on this one.
    pub(crate) fn covers(&self, ranges: [[f64; 2]; 2], other: &Curve) -> bool {
        /// What of it: where both end they may part.
        const NEARLY_ALL: f64 = 0.9;
        let on = |point: &&CurvePoint| self.holds(ranges, other.special, point.values, point.cycle.x2_std());
        other.points.iter().filter(on).count() as f64 >= NEARLY_ALL * other.points.len() as f64
    }

    /// Whether a special point of this kind and size lies on the curve; distances are parts of the `ranges`.
    pub(crate) fn holds(
        &self,
        ranges: [[f64; 2]; 2],
        special: Special,
        values: [f64; 2],
        size: Option<f64>,
    ) -> bool {
        /// As near to the curve as a chord of it may be.
        const NEAR: f64 = 2e-3;
        /// And as alike.
        const ALIKE: f64 = 0.05;
        let scaled = |values: [f64; 2]| [0, 1].map(|k| values[k] / (ranges[k][1] - ranges[k][0]));
        let passes = |pair: &[CurvePoint]| {
            let chord = [scaled(pair[0].values), scaled(pair[1].values)];
            let is_near = distance(scaled(values), chord) <= NEAR;
            let sizes = pair[0].cycle.x2_std().zip(pair[1].cycle.x2_std());
            let of_curve = sizes.map(|(a, b)| a + part(scaled(values), chord) * (b - a));
            let alike = of_curve.zip(size).is_none_or(|(a, b)| (a - b).abs() <= ALIKE * a.max(b));
            is_near && alike
        };
        special == self.special && self.points.windows(2).any(passes)
    }
}

/// Where on a chord a point is nearest, as a part of it.
fn part([x, y]: [f64; 2], [[x0, y0], [x1, y1]]: [[f64; 2]; 2]) -> f64 {
    let (dx, dy) = (x1 - x0, y1 - y0);
    let part = (((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
    if part.is_finite() { part } else { 0.0 }
}

/// How far a point is from a chord.
fn distance(point: [f64; 2], chord: [[f64; 2]; 2]) -> f64 {
    let ([x, y], [[x0, y0], [x1, y1]], part) = (point, chord, part(point, chord));
    (x0 + part * (x1 - x0) - x).hypot(y0 + part * (y1 - y0) - y)
}

/// Follows the curve from `start`, which was found `along` a parameter, towards higher (`sign` 1) or lower values of the other.
fn follow(field: Field<'_>, special: Special, along: usize, start: &Here, sign: f64) -> (Vec<Here>, End) {
    let mut points = vec![start.clone()];
    let mut step = FIRST;
    while points.len() < MOST_POINTS {
        let here = &points[points.len() - 1];
        let before = points.len().checked_sub(2).map(|at| &points[at]);
        // Along which the next point is looked for, and in which direction the other goes.
        let way = before.map(|before| [0, 1].map(|k| here.at[k] - before.at[k]));
        let (along, sign) = way.map_or((along, sign), |[x, y]| {
            let along = usize::from(x.abs() >= y.abs());
            (along, [x, y][1 - along].signum())
        });
        let across = 1 - along;
        let whole = here.at[across] + sign * step;
        let (to, is_last) = (whole.clamp(0.0, 1.0), whole <= 0.0 || whole >= 1.0);
        if sign * (to - here.at[across]) <= 0.0 {
            return (points, End::Edge);
        }
        let expected = |to: f64| {
            let mut at = here.at;
            at[across] = to;
            if let Some(way) = way {
                at[along] += way[along] / way[across] * (to - here.at[across]);
            }
            at
        };
        let from = before.map_or_else(
            || here.found.clone(),
            |before| {
                let part = (to - here.at[across]) / (here.at[across] - before.at[across]);
                here.found.beyond(&before.found, part)
            },
        );
        let near = NEAR[usize::from(way.is_none())] * step;
        let next = field.find(special, along, expected(to), &from, near).filter(|next| {
            let taken = [0, 1].map(|k| next.at[k] - here.at[k]);
            let straight = way.is_none_or(|way| {
                let dot = taken[0] * way[0] + taken[1] * way[1];
                dot >= TURNS * taken[0].hypot(taken[1]) * way[0].hypot(way[1])
            });
            straight || step < 10.0 * SHORTEST
        });
        let Some(next) = next else {
            step *= 0.5;
            if step >= SHORTEST {
                continue;
            }
            return (points, End::Lost);
        };
        if !(0.0..=1.0).contains(&next.at[along]) {
            // It leaves through the other side: its last point is there.
            let edge = next.at[along].clamp(0.0, 1.0);
            let part = (edge - here.at[along]) / (next.at[along] - here.at[along]);
            let mut at = here.at;
            at[across] += part * (to - here.at[across]);
            at[along] = edge;
            let last = field.find(special, across, at, &here.found, LONGEST);
            points.extend(last.filter(|_| part > 0.0));
            return (points, End::Edge);
        }
        let closed = points.len() > 10 && distance(start.at, [here.at, next.at]) < CLOSES * step;
        points.push(next);
        if closed {
            points.push(start.clone());
            return (points, End::Closed);
        }
        if is_last {
            return (points, End::Edge);
        }
        step = (1.5 * step).min(LONGEST);
    }
    (points, End::Limit)
}
