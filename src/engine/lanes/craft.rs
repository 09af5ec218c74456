//! Jobs that fly to the section of the return map, and back.

use crate::engine::cycle::point::Return;
use crate::engine::kernel::scalar::Real;
use crate::engine::lanes::contact::State;
use crate::engine::lanes::flight::Flight;
use crate::engine::lanes::job::Job;
use crate::model::status::Status;

impl<T: Real> Job<T> {
    /// A flight from a state for some returns.
    #[must_use]
    pub fn flying(&self, state: State<f64>, wanted: usize) -> Job<T> {
        let mut job = self.clone();
        job.place(&state);
        (job.time, job.until, job.steps) = (0.0, 0.0, 0);
        job.flight = Flight::new(wanted);
        job
    }

    /// Goes on where a flight from its state has come to.
    pub fn go_on_from(&mut self, flight: &Job<f64>) {
        self.place(&flight.exact_state());
        self.time += flight.time;
        self.steps += flight.steps;
    }

    fn place(&mut self, state: &State<f64>) {
        let number = |values: [f64; 3]| values.map(T::from_f64);
        self.state = State::blank();
        (self.state.body.p, self.state.body.v) = (number(state.body.p), number(state.body.v));
        (self.state.contact, self.state.piece, self.state.disarmed) =
            (state.contact, state.piece, state.disarmed);
    }

    /// Its state in double precision.
    #[must_use]
    pub fn exact_state(&self) -> State<f64> {
        let mut state = State::blank();
        state.body.p = self.state.body.p.map(T::to_f64);
        state.body.v = self.state.body.v.map(T::to_f64);
        (state.contact, state.piece, state.disarmed) =
            (self.state.contact, self.state.piece, self.state.disarmed);
        state
    }

    /// The returns of a flight, all that were asked for.
    #[must_use]
    pub fn returned(&self) -> Option<&[Return]> {
        let whole = self.state.status == Status::Unwritten && !self.flight.is_open();
        whole.then_some(&self.flight.returns)
    }
}
