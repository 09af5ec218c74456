//! A job on its way to the section of the return map.

use crate::engine::cycle::point::{Point, Return};
use crate::engine::cycle::pursuit::LONGEST_RETURN;
use crate::engine::kernel::scalar::Real;
use crate::engine::lanes::contact::{NOTHING, State};

/// Returns asked for, and those that were made.
#[derive(Clone, Debug, Default)]
pub struct Flight {
    /// How many are asked for.
    wanted: usize,
    /// Those made.
    pub returns: Vec<Return>,
    /// When it ends without the next.
    pub until: f64,
    /// When the last was made.
    since: f64,
    /// The events since then, see [`crate::engine::lanes::section`].
    pub order: f64,
}

impl Flight {
    /// So many returns.
    #[must_use]
    pub fn new(wanted: usize) -> Flight {
        Flight { wanted, until: LONGEST_RETURN, ..Flight::default() }
    }

    /// Whether some are still to come.
    #[must_use]
    pub fn is_open(&self) -> bool {
        self.returns.len() < self.wanted
    }

    /// Notes a return at a time.
    pub fn arrive<T: Real>(&mut self, state: &State<T>, time: f64, order: f64) {
        let body = &state.body;
        let point = Point {
            position: body.p.map(T::to_f64),
            velocity: body.v.map(T::to_f64),
            contact: state.contact,
            piece: state.piece,
        };
        self.returns.push(Return { point, time: time - self.since, order });
        self.since = time;
        self.until = time + LONGEST_RETURN;
        self.order = 0.0;
    }
}

/// The state of a body at a point of the section.
#[must_use]
pub fn state_at(point: &Point) -> State<f64> {
    let mut state = State::blank();
    (state.body.p, state.body.v) = (point.position, point.velocity);
    (state.contact, state.piece, state.disarmed) = (point.contact, point.piece, NOTHING);
    state
}
