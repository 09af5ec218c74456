//! Modes over another parameter than friction, at one coefficient of friction.

use super::Study;
use super::document::{Varied, Vary};
use super::values::rising;
use crate::Error;
use crate::sweep::Mode;
use crate::vary::{Parameter, Setup, vary};

/// Modes over a parameter.
#[derive(Debug, Clone)]
pub struct Variation {
    /// Values of the parameter, rising.
    pub values: Vec<f64>,
    /// The modes over them.
    pub modes: Vec<Mode>,
    /// Whether anything damps.
    pub damped: bool,
}

/// Computes the variation of `count` modes.
pub(super) fn variation(study: &Study, asked: &Vary, count: usize) -> Result<Variation, Error> {
    let parameter = match asked.parameter {
        Varied::ContactStiffness => Parameter::ContactStiffness,
        Varied::Load => Parameter::Load,
        Varied::Damping => Parameter::Damping,
        Varied::Slope => Parameter::Slope,
        Varied::Stiffness => {
            // Materials stand in the order of their names.
            let name = asked.material.as_ref();
            let index = study.document.materials.keys().position(|known| Some(known) == name);
            Parameter::Stiffness(index.unwrap_or(usize::MAX))
        }
    };
    let friction = &study.document.friction;
    let setup = Setup {
        model: study.model.clone(),
        faces: study.faces.clone(),
        loads: study.loads.clone(),
        mu: asked.mu,
        slope: friction.slope,
        static_mu: Some(friction.static_mu),
        stiffened: study.document.modes.stressed,
    };
    let values = rising("vary.values", &asked.values)?;
    // With the values of the description itself the contact has settled.
    let modes =
        vary(&setup, parameter, &values, count, study.document.modes.residual).map_err(|why| match why {
            Error::Contact { what } => Error::at("vary.values", what),
            other => other,
        })?;
    let rayleigh = study.model.materials.iter().any(|material| material.rayleigh.iter().any(|c| *c > 0.0));
    let damped = rayleigh || friction.slope != 0.0 || asked.parameter == Varied::Slope;
    Ok(Variation { values, modes, damped })
}
