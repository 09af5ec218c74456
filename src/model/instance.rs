//! One instance of the model.

use std::sync::Arc;

use crate::model::friction::FrictionLaw;
use crate::model::heating::Heating;
use crate::model::modal::Modal;
use crate::model::motion::Motion;
use crate::model::{Param, Params};

/// Everything that defines one instance.
#[derive(Clone, Debug)]
pub struct Instance {
    /// Its numeric parameters.
    pub params: Params,
    /// Its friction law, materials resolved.
    pub law: FrictionLaw,
    /// Whether impacts carry a Coulomb impulse.
    pub impact_friction: bool,
    /// How the velocity of its belt goes.
    pub motion: Motion,
    /// How the temperature of its material goes; `None` where it stays.
    pub heating: Option<Arc<Heating>>,
    /// The structure that slides; `None` for two masses.
    pub modal: Option<Arc<Modal>>,
}

impl Instance {
    /// The temperature of its material at a time (s), °C, where it has one.
    #[must_use]
    pub fn temperature(&self, time: f64) -> Option<f64> {
        let own = || self.params.get(Param::Temperature);
        self.heating.as_ref().map_or_else(own, |heating| Some(heating.temperature(time)))
    }

    /// The instance with its material at another temperature (°C); as it is where that does not change within a run.
    #[must_use]
    pub fn heated(&self, temperature: f64) -> Instance {
        let mut heated = self.clone();
        if let Some(heating) = &self.heating {
            heated.law = heating.law_at(temperature, &mut heated.params);
        }
        heated
    }
}
