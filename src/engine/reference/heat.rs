//! The integration of an instance whose material has come to another temperature.

use std::borrow::Cow;

use crate::engine::course::Warmth;
use crate::engine::method::taylor::BeltMotion;
use crate::engine::reference::integrate::Integrator;
use crate::engine::reference::watched::Disarmed;
use crate::model::contact::Contact;
use crate::model::scaled::Scaled;
use crate::model::status::Status;

impl Integrator<'_> {
    /// This one, whose model is of `warmth`.
    #[must_use]
    pub fn of(mut self, warmth: Warmth) -> Self {
        self.warmth = warmth;
        self
    }

    /// The status it ended with, as it is told.
    #[must_use]
    pub fn told(&self, status: Status) -> Status {
        self.model.told(status)
    }

    /// What its model is of.
    #[must_use]
    pub fn warmth(&self) -> &Warmth {
        &self.warmth
    }

    /// Goes on with another model, on the belt `belt` as it is seen from there: what sticks may slip, what slides is on the piece of
    /// its speed.
    ///
    /// # Errors
    /// As [`Integrator::new`].
    pub fn go_over(&mut self, model: Scaled, warmth: Warmth, belt: BeltMotion) -> Result<(), Status> {
        self.state.position[0] += self.warmth.lag[0] - warmth.lag[0];
        self.state.position[2] += self.warmth.lag[1] - warmth.lag[1];
        self.state.velocity[0] += self.warmth.drift[0] - warmth.drift[0];
        self.state.velocity[2] += self.warmth.drift[1] - warmth.drift[1];
        (self.longest, self.warmth) = (self.resolution.longest(&model), warmth);
        self.model = Cow::Owned(model);
        match self.contact {
            Contact::Free => Ok(()),
            Contact::Stick => self.rest(belt),
            Contact::Slip { sigma, .. } => {
                let speed = sigma * (belt.velocity - self.state.velocity[0]);
                self.contact = Contact::Slip { sigma, piece: self.model.law.index(speed) };
                if self.disarmed != Disarmed::Rest {
                    self.disarmed = Disarmed::Nothing;
                }
                Ok(())
            }
        }
    }
}
