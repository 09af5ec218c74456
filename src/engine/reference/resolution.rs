//! How fine an integration is.

use crate::engine::method::pace::Turns;
use crate::engine::method::{Method, rk4};
use crate::model::contact::ContactState;
use crate::model::scaled::Scaled;

/// How finely to integrate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// How a step is taken.
    pub method: Method,
    /// Order of the position series, 4 to [`crate::engine::method::taylor::MAX_ORDER`]; of a Taylor series only.
    pub order: usize,
    /// Largest step, in units of `1/ω0`.
    pub nominal_step: f64,
    /// Bound on the last two terms of the series; infinite for steps of fixed length. Of a Taylor series only.
    pub tolerance: f64,
}

impl Resolution {
    /// How far a step may turn.
    pub(super) fn turns(&self) -> Turns {
        let tolerance = if self.method == Method::Taylor { self.tolerance } else { f64::INFINITY };
        Turns::new(self.order, tolerance)
    }

    /// The longest step of slip, reversed slip, stick and flight.
    pub(super) fn longest(&self, model: &Scaled) -> [f64; 4] {
        let mut longest = match self.method {
            Method::Taylor => self.turns().longest_steps(&model.fastest),
            Method::LocatedRk4 | Method::FixedStep => [self.nominal_step; 4],
        };
        if self.method == Method::LocatedRk4 {
            longest[ContactState::Free as usize] *= rk4::IN_FLIGHT;
        }
        longest
    }
}
