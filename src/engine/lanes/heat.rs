//! An instance whose material has come to another temperature.

use crate::engine::kernel::scalar::Real;
use crate::engine::lanes::ORDER;
use crate::engine::lanes::constants::constants;
use crate::engine::lanes::job::{Job, belt_at, is_left_to_f64};
use crate::engine::lanes::words::Words;
use crate::engine::method::pace::Turns;
use crate::model::status::Status;

impl<T: Real> Job<T> {
    /// Goes over to the model of its present time, where that is another, for steps of this tolerance. Whether it is.
    pub fn heat(&mut self, tolerance: f64) -> bool {
        let before = self.warmth;
        if !self.take_model(tolerance) {
            return false;
        }
        let shift = self.shift_from(before.base);
        let faster = [0, 1].map(|k| T::from_f64(before.drift[k] - self.warmth.drift[k]));
        let belt = belt_at(self.warmth.seen(self.scene.belt(self.time)));
        let ahead = [0, 1].map(|k| T::from_f64(before.lag[k] - self.warmth.lag[k]));
        self.state.body.shift(ahead);
        self.state.go_over(&self.words, belt, faster);
        self.origin = [self.origin[0] + shift[0], self.origin[1] + shift[1]];
        true
    }

    /// Takes the model of its present time; positions count from its equilibrium then. Whether it is another.
    pub(super) fn take_model(&mut self, tolerance: f64) -> bool {
        if self.state.status != Status::Unwritten {
            return false;
        }
        match self.scene.warmed(self.time, &self.warmth) {
            Ok(None) => return false,
            Ok(Some((model, warmth))) => (self.scene.model, self.warmth) = (model, warmth),
            Err(status) => {
                self.state.status = status;
                return false;
            }
        }
        let turns = &Turns::new(ORDER, tolerance);
        self.words = Words::new(self.words.law, &self.scene, turns);
        self.constants = constants(&self.scene.model, turns);
        if is_left_to_f64(&self.words, &self.scene.model, turns) {
            self.state.status = Status::StepTooLarge;
        }
        true
    }

    /// By how much positions are larger that count from the present equilibrium instead of one that lay at `before`.
    pub(super) fn shift_from(&self, before: [f64; 2]) -> [T; 2] {
        [0, 1].map(|k| T::from_f64(before[k] - self.warmth.base[k]))
    }
}
