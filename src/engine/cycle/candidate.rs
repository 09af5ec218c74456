//! A stable cycle that a transient may come to.

use nalgebra::DVector;

use crate::engine::cycle::approach::Approach;
use crate::engine::cycle::point::{Freedom, Point, Return};

/// A cycle closes within this part of the size of its start.
const CLOSES: f64 = 1e-9;

/// A transient farther off than this part of the size of the motion goes elsewhere.
const ELSEWHERE: f64 = 0.3;

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
    /// Whether a motion that ends at this position and with this velocity has come back to the start.
    #[must_use]
    pub fn closes(&self, position: [f64; 3], velocity: [f64; 3]) -> bool {
        let here = self.start.position.iter().chain(&self.start.velocity);
        let size = here.clone().fold(0.0, |size: f64, value| size.max(value.abs()));
        here.zip(position.iter().chain(&velocity)).all(|(a, b)| (a - b).abs() <= CLOSES * size)
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
        let fixed = DVector::from_vec(self.cycle.start.coordinates(self.freedom));
        let distance = |at: &Return| DVector::from_vec(at.point.coordinates(self.freedom)) - &fixed;
        let distances: Vec<_> = transient.iter().rev().step_by(returns).map(distance).collect();
        if !alike || distances.iter().any(|distance| distance.amax() > ELSEWHERE * self.size) {
            return Course::Elsewhere;
        }
        let since = (now - self.seen) / self.cycle.period;
        self.seen = now;
        if self.approach.is_seen(&distances, since, self.size) { Course::Comes } else { Course::Near }
    }
}
