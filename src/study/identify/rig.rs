//! The rig of a sweep file: what `identify` takes forces, coalescence and damping from.

use crate::model::Param;
use crate::model::instance::Instance;
use crate::study::calibrate::{MOST, coalescence};
use crate::study::error::{Error, Result};
use crate::sweep::grid::AxisKey;
use crate::sweep::spec::Spec;
use squealmap_identify::{Measured, Rig};

/// What a rig is made of; only its friction and its belt may vary in a sweep.
const STRUCTURE: [Param; 8] =
    [Param::M1, Param::M2, Param::K1, Param::K2, Param::C1, Param::C2, Param::Theta, Param::FExt];

/// How well a rig is known: its stiffnesses, from measured frequencies, and its inclination, each as a part of it.
const KNOWN: [(Param, f64); 3] = [(Param::K1, 0.01), (Param::K2, 0.01), (Param::Theta, 0.1)];

/// The structure of a sweep. The error of the coalescence is what a per cent of either stiffness and a tenth of the inclination move it by,
/// and a thirtieth of it at least.
///
/// # Errors
/// For a sweep of another model than two masses, or one that varies the structure.
pub fn rig_of(spec: &Spec) -> Result<Rig> {
    spec.of_two_masses("--model")?;
    let varied = spec.grid.keys().into_iter().find_map(|key| match key {
        AxisKey::Param(param) if STRUCTURE.contains(&param) => Some(param.info().name),
        _ => None,
    });
    if let Some(name) = varied {
        return Err(Error::NoOneRig { name });
    }
    let instance = spec.instance(0);
    let value = |param: Param| instance.params.require(param);
    let theta = value(Param::Theta);
    let critical = [theta, -theta].map(|theta| {
        let mut directed = instance.clone();
        directed.params.set(Param::Theta, theta);
        let found = |instance: &Instance| coalescence(instance).min(MOST);
        let value = found(&directed);
        let moved = KNOWN.map(|(param, part)| {
            let mut other = directed.clone();
            other.params.set(param, (1.0 + part) * directed.params.require(param));
            found(&other) - value
        });
        let error = moved.into_iter().fold(value / 30.0, f64::hypot);
        Measured { value, error }
    });
    let [m1, m2, k1, k2, c1, c2] =
        [Param::M1, Param::M2, Param::K1, Param::K2, Param::C1, Param::C2].map(value);
    Ok(Rig { m1, m2, k1, k2, c1, c2, theta, load: value(Param::FExt), critical })
}
