//! The hunt for one cycle: Newton's method on the return map, engine by engine the same.
//!
//! The engine follows the points that a hunt asks for, each for so many returns, and hands in what they came to. Those of
//! one request do not depend on each other.

use nalgebra::{DMatrix, DVector};

use crate::engine::cycle::approach::Approach;
use crate::engine::cycle::candidate::{Candidate, Cycle};
use crate::engine::cycle::point::{Freedom, Point, Return};

/// Neighbours are this far off, as a part of the size of the motion. From 1e-7 the curvature of the map moves one of two nearly equal
/// multipliers by 2.4e-6; from 1e-8 rounding does.
const NEIGHBOUR: f64 = 3e-8;

/// A step of Newton's method this small, by the size of the motion, is the last: the next would be its square.
const LAST_STEP: f64 = 1e-6;

/// Where the returns of a transient lead to is no farther off than this part of the size of the motion.
const NEAR: f64 = 0.06;

/// The first step of Newton's method is no longer than this part of the size of the motion: from farther off it leads anywhere.
const LONGEST_STEP: f64 = 0.06;

/// Steps of Newton's method that a hunt may take.
const MOST_STEPS: usize = 6;

/// From step to step the distance to the fixed point falls at least by this factor, or the hunt is over.
const FALLS: f64 = 0.2;

/// A fixed point this much smaller than the transient is the equilibrium.
const VANISHES: f64 = 1e-3;

/// Multipliers up to here are those of a stable cycle: what is left of a disturbance after ten thousand returns is less than
/// a third.
const STABLE: f64 = 1.0 - 1e-4;

/// Most returns in which a cycle closes.
const MOST_RETURNS: usize = 8;

/// A transient repeats itself after several returns where the squares of its distances are below this part of those after one.
const CLOSER: f64 = 0.1;

/// What a hunt needs next.
#[derive(Debug)]
pub enum Next {
    /// These points followed for so many returns.
    Follow(Vec<Point>, usize),
    /// Nothing: this is a stable cycle.
    Found(Box<Candidate>),
    /// Nothing: this is a cycle, and unstable.
    Unstable(Box<Candidate>),
    /// Nothing: no cycle was found.
    Lost,
}

/// A hunt on its way.
#[derive(Debug)]
pub struct Hunt {
    freedom: Freedom,
    returns: usize,
    /// The size of the motion on the section.
    size: f64,
    point: Point,
    steps: usize,
    /// The length of the last step.
    last: f64,
}

impl Hunt {
    /// From the last returns of a transient; `far` looks for cycles of several returns, and what is smaller than `least` is
    /// none. `None` where the returns are not alike, or do not lead anywhere near.
    #[must_use]
    pub fn new(transient: &[Return], freedom: Freedom, far: bool, least: f64) -> Option<Hunt> {
        let last = transient.last()?.point;
        let returns = if far { repeats_after(transient) } else { 1 };
        let mut earlier = transient.iter().rev().step_by(returns).map(|at| &at.point);
        if !earlier.all(|at| (at.contact, at.piece) == (last.contact, last.piece)) {
            return None;
        }
        let size = last.coordinates(freedom).into_iter().fold(0.0, |size: f64, value| size.max(value.abs()));
        let points: Vec<DVector<f64>> = transient
            .iter()
            .rev()
            .step_by(returns)
            .map(|at| DVector::from_vec(at.point.coordinates(freedom)))
            .collect();
        let limit = extrapolated(&points)?;
        let is_near = (&limit - &points[0]).amax() <= NEAR * size;
        let point = last.with(limit.as_slice());
        (is_near && size > least && size.is_finite()).then_some(Hunt {
            freedom,
            returns,
            size,
            point,
            steps: 0,
            last: LONGEST_STEP * size / FALLS,
        })
    }

    /// The points to follow next.
    #[must_use]
    pub fn request(&self) -> Next {
        let here = self.point.coordinates(self.freedom);
        let neighbours = (0..here.len()).map(|i| {
            let mut moved = here.clone();
            moved[i] += NEIGHBOUR * self.size;
            self.point.with(&moved)
        });
        Next::Follow(std::iter::once(self.point).chain(neighbours).collect(), self.returns)
    }

    /// Takes in the returns of the points that were asked for, the fixed point's guess first; `None` where one of them does not
    /// come back.
    pub fn take(&mut self, flown: Option<&[Vec<Return>]>) -> Next {
        flown.and_then(|flown| self.step(flown)).unwrap_or(Next::Lost)
    }

    fn step(&mut self, flown: &[Vec<Return>]) -> Option<Next> {
        let [base, neighbours @ ..] = flown else { return None };
        let ends = flown.iter().map(|returns| returns.get(self.returns - 1)).collect::<Option<Vec<_>>>()?;
        let orders = |returns: &[Return]| returns.iter().map(|at| at.order.to_bits()).collect::<Vec<_>>();
        let order = orders(base);
        let alike =
            |end: &Return| (end.point.contact, end.point.piece) == (self.point.contact, self.point.piece);
        if !ends.iter().all(|end| alike(end)) || neighbours.iter().any(|returns| orders(returns) != order) {
            return None;
        }
        let vector = |point: &Point| DVector::from_vec(point.coordinates(self.freedom));
        let (here, there) = (vector(&self.point), vector(&ends[0].point));
        let count = here.len();
        let spacing = NEIGHBOUR * self.size;
        let columns: Vec<DVector<f64>> =
            ends[1..].iter().map(|end| (vector(&end.point) - &there) / spacing).collect();
        let jacobian = DMatrix::from_columns(&columns);
        let change = (DMatrix::identity(count, count) - &jacobian).lu().solve(&(&there - &here))?;
        let length = change.amax();
        if !length.is_finite() || length > FALLS * self.last {
            return None;
        }
        (self.steps, self.last) = (self.steps + 1, length);
        if length > LAST_STEP * self.size {
            if self.steps >= MOST_STEPS {
                return None;
            }
            self.point = self.point.with((&here + &change).as_slice());
            return Some(self.request());
        }
        let fixed = here + &change;
        if fixed.amax() < VANISHES * self.size {
            return None;
        }
        let time = |returns: &[Return]| returns.iter().map(|at| at.time).sum::<f64>();
        let slopes = neighbours.iter().map(|returns| (time(returns) - time(base)) / spacing);
        let period = time(base) + slopes.zip(change.iter()).map(|(slope, by)| slope * by).sum::<f64>();
        let approach = Approach::new(jacobian)?;
        let multiplier = approach.slowest();
        let candidate = Box::new(Candidate {
            cycle: Cycle {
                start: self.point.with(fixed.as_slice()),
                returns: self.returns,
                period,
                multiplier: [multiplier.re, multiplier.im.abs()],
            },
            orders: base.iter().map(|at| at.order).collect(),
            size: self.size,
            freedom: self.freedom,
            approach,
            seen: 0.0,
        });
        Some(if multiplier.norm() < STABLE { Next::Found(candidate) } else { Next::Unstable(candidate) })
    }
}

/// After how many returns a transient comes closest to where it was: more than one only where that is much closer.
fn repeats_after(transient: &[Return]) -> usize {
    let apart = |a: &Point, b: &Point| {
        let [here, there] = [a, b].map(|point| point.position.into_iter().chain(point.velocity));
        here.zip(there).map(|(a, b)| (a - b).powi(2)).sum::<f64>()
    };
    let mean = |returns: usize| {
        let pairs = transient[returns..].iter().zip(transient);
        pairs.map(|(after, before)| apart(&after.point, &before.point)).sum::<f64>()
            / (transient.len() - returns) as f64
    };
    let most = MOST_RETURNS.min(transient.len().saturating_sub(1) / 2);
    let once = mean(1);
    let closest = (2..=most).map(|returns| (returns, mean(returns))).min_by(|a, b| a.1.total_cmp(&b.1));
    closest.filter(|(_, apart)| *apart < CLOSER * once).map_or(1, |(returns, _)| returns)
}

/// The limit of a sequence, the last point first, if it went on linearly: reduced rank extrapolation.
///
/// Reference: A. Sidi, "Vector Extrapolation Methods with Applications" (SIAM, 2017), section 1.4.
fn extrapolated(points: &[DVector<f64>]) -> Option<DVector<f64>> {
    // A square problem needs two points more than coordinates; where there are fewer, the last changes tell.
    let count = (points.first()?.len() + 2).min(points.len());
    let points = &points[..count];
    let changes: Vec<DVector<f64>> = points.windows(2).map(|pair| &pair[0] - &pair[1]).collect();
    let second: Vec<DVector<f64>> = changes.windows(2).map(|pair| &pair[0] - &pair[1]).collect();
    let solver = DMatrix::from_columns(&second).svd(true, true);
    let weights = solver.solve(&changes[0], 1e-12 * solver.singular_values.max()).ok()?;
    let limit =
        weights.iter().zip(&changes).fold(points[0].clone(), |sum, (weight, change)| sum - change * *weight);
    limit.iter().all(|value| value.is_finite()).then_some(limit)
}
