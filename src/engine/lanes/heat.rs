//! An instance whose material has come to another temperature.

use crate::engine::kernel::scalar::Real;
use crate::engine::lanes::ORDER;
use crate::engine::lanes::constants::constants;
use crate::engine::lanes::job::{Job, belt_at};
use crate::engine::lanes::words::Words;
use crate::engine::method::pace::Turns;
use crate::model::status::Status;

impl<T: Real> Job<T> {
    /// Takes the model of its present time, where that is another, for steps of this tolerance: positions count from its
    /// equilibrium then. Whether it is another.
    pub fn heat(&mut self, tolerance: f64) -> bool {
        if self.state.status != Status::Unwritten {
            return false;
        }
        let (model, warmth) = match self.scene.warmed(self.time, &self.warmth) {
            Ok(None) => return false,
            Ok(Some(found)) => found,
            Err(status) => {
                self.state.status = status;
                return false;
            }
        };
        let before = self.warmth.base;
        let shift = [0, 1].map(|k| T::from_f64(before[k] - warmth.base[k]));
        let turns = &Turns::new(ORDER, tolerance);
        self.scene.model = model;
        self.warmth = warmth;
        self.words = Words::new(self.words.law, &self.scene, turns);
        self.constants = constants(&self.scene.model, turns);
        let belt = belt_at(&self.scene, self.time);
        self.state.go_over(&self.words, belt, shift);
        if let Some(start) = &mut self.snapshot {
            start.body.shift(shift);
        }
        self.origin = [self.origin[0] + shift[0], self.origin[1] + shift[1]];
        true
    }
}
