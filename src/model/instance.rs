//! One instance of the model.

use std::sync::Arc;

use crate::model::Params;
use crate::model::friction::FrictionLaw;
use crate::model::modal::Modal;
use crate::model::motion::Motion;

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
    /// The structure that slides; `None` for two masses.
    pub modal: Option<Arc<Modal>>,
}
