//! A cycle that a transient may come to, or leave.

use nalgebra::DVector;

use crate::engine::cycle::approach::Approach;
use crate::engine::cycle::point::{Freedom, Point, Return};

/// A cycle that a run comes to closes within this part of the size of its start.
pub const CLOSES: f64 = 1e-9;

/// A transient farther off than this part of the size of the motion goes elsewhere.
const ELSEWHERE: f64 = 0.3;

/// What is closer than this part of the size of the motion has no way to go.
const CLOSE: f64 = 1e-4;

/// The way is looked at where the distance is largest, and where it has fallen to these parts of that.
const PARTS: [f64; 4] = [1.0, 0.5, 0.2, 0.05];

/// Returns to the farthest of them, at most.
const LONGEST_WAY: usize = 100_000;

/// A cycle: a fixed point of the return map.
#[derive(Clone, Debug)]
pub struct Cycle {
    /// A point of it on the section.
    pub start: Point,
    /// Returns that it takes to close.
    pub returns: usize,
    /// Its period, scaled.
    pub period: f64,
    /// The multiplier of largest modulus, real and imaginary part; of a pair the one above the real axis.
    pub multiplier: [f64; 2],
}

impl Cycle {
    /// Whether a motion that ends at this position and with this velocity has come back to the start, `within` this part of its size.
    #[must_use]
    pub fn closes(&self, position: [f64; 3], velocity: [f64; 3], within: f64) -> bool {
        let here = self.start.position.iter().chain(&self.start.velocity);
        let size = here.clone().fold(0.0, |size: f64, value| size.max(value.abs()));
        here.zip(position.iter().chain(&velocity)).all(|(a, b)| (a - b).abs() <= within * size)
    }
}

/// What a transient does near a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Course {
    /// It comes to it.
    Comes,
    /// It may still.
    Near,
    /// It is far from it, or passes through other contact states.
    Elsewhere,
}

/// A cycle, and what is seen of the transient's way to it.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The cycle.
    pub cycle: Cycle,
    /// The sequences of events between its returns.
    pub orders: Vec<f64>,
    /// The size of the motion on the section.
    pub size: f64,
    pub(super) freedom: Freedom,
    pub(super) approach: Approach,
    /// The time at which the last returns were looked at.
    pub(super) seen: f64,
}

impl Candidate {
    /// What the returns of a transient up to the scaled time `now` show.
    #[must_use]
    pub fn course(&mut self, transient: &[Return], now: f64) -> Course {
        let returns = self.cycle.returns;
        let alike = transient.iter().rev().zip(self.orders.iter().rev().cycle());
        // The first return began somewhere else.
        let alike = alike.take(transient.len() - 1).all(|(at, order)| at.order.to_bits() == order.to_bits());
        let fixed = self.vector(&self.cycle.start);
        let distance = |at: &Return| self.vector(&at.point) - &fixed;
        let distances: Vec<_> = transient.iter().rev().step_by(returns).map(distance).collect();
        if !alike || distances.iter().any(|distance| distance.amax() > ELSEWHERE * self.size) {
            return Course::Elsewhere;
        }
        let since = (now - self.seen) / self.cycle.period;
        self.seen = now;
        if self.approach.is_seen(&distances, since, self.size) { Course::Comes } else { Course::Near }
    }

    /// Whether a transient leaves this cycle, which is unstable, as its multiplier predicts: about it a motion may turn for
    /// hundreds of returns that look settled.
    #[must_use]
    pub fn is_left_by(&self, transient: &[Return]) -> bool {
        let fixed = self.vector(&self.cycle.start);
        let returns = transient.iter().rev().step_by(self.cycle.returns);
        let distances: Vec<_> = returns.map(|at| self.vector(&at.point) - &fixed).collect();
        self.approach.drives_away(&distances, self.size)
    }

    /// Points on the way of a transient from here to the cycle, as its linear map has it. On the way the distance may grow before
    /// it falls, and the motion may meet what it has not met yet: a border between contact states, or a bend of the map. Behind
    /// them points all around the farthest, where the way is a spiral of many turns. None where it is there.
    #[must_use]
    pub fn way(&self, transient: &[Return]) -> Vec<Point> {
        let Some(last) = transient.last() else { return Vec::new() };
        let fixed = self.vector(&self.cycle.start);
        let begun = self.vector(&last.point) - &fixed;
        if begun.amax() <= CLOSE * self.size {
            return Vec::new();
        }
        let mut farthest = begun.clone();
        let mut distance = begun;
        for _ in 0..LONGEST_WAY {
            distance = self.approach.next(&distance);
            if distance.norm() > farthest.norm() {
                farthest.copy_from(&distance);
            } else if distance.norm() < PARTS[PARTS.len() - 1] * farthest.norm() {
                break;
            }
        }
        let whole = farthest.norm();
        let around = self.approach.around(&farthest);
        let mut points = Vec::with_capacity(PARTS.len());
        let mut distance = farthest;
        for part in PARTS {
            let mut steps = 0;
            while distance.norm() > part * whole && steps < LONGEST_WAY {
                distance = self.approach.next(&distance);
                steps += 1;
            }
            points.push(self.cycle.start.with((&fixed + &distance).as_slice()));
        }
        points.extend(around.iter().map(|distance| self.cycle.start.with((&fixed + distance).as_slice())));
        points
    }

    /// Whether the returns of those points show that nothing stands in the way.
    #[must_use]
    pub fn is_open(&self, points: &[Point], flown: &[Option<&[Return]>]) -> bool {
        let fixed = self.vector(&self.cycle.start);
        let pair = |(point, returns): (&Point, Option<&[Return]>)| {
            let returns = returns?;
            let same = returns
                .iter()
                .map(|at| at.order.to_bits())
                .eq(self.orders.iter().map(|order| order.to_bits()));
            let end = returns.last().filter(|_| same && point.position[1] >= 0.0)?;
            Some([self.vector(point) - &fixed, self.vector(&end.point) - &fixed])
        };
        let Some(pairs) = points.iter().zip(flown.iter().copied()).map(pair).collect::<Option<Vec<_>>>()
        else {
            return false;
        };
        let (way, around) = pairs.split_at(PARTS.len().min(pairs.len()));
        way.iter().all(|[before, after]| self.approach.predicts(before, after))
            && self.approach.draws_in(around)
    }

    fn vector(&self, point: &Point) -> DVector<f64> {
        DVector::from_vec(point.coordinates(self.freedom))
    }
}
