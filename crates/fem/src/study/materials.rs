//! Materials from their descriptions.

use super::document::{Constants, Directional};
use crate::Error;
use crate::material::{self, Material, Orthotropic};

/// A material at a temperature, °C.
pub(super) fn material(name: &str, constants: &Constants, celsius: Option<f64>) -> Result<Material, Error> {
    let key = format!("materials.{name}");
    let Constants { young, poisson, shear, table, density, rayleigh, loss_factor } = constants;
    let found = match (young, poisson, table.as_slice()) {
        (Some(young), Some(poisson), []) => match elastic(&key, young, poisson, shear.as_ref())? {
            material::Constants::Isotropic(young, poisson) => {
                Material::isotropic(name, young, poisson, *density)
            }
            material::Constants::Orthotropic(constants) => Material::orthotropic(name, constants, *density),
        },
        (None, None, [_, ..]) if shear.is_none() => {
            let Some(celsius) = celsius else {
                let what = "it has a table over temperature, but the study has no temperature: add `temperature` (°C) above the parts";
                return Err(Error::at(format!("{key}.table"), what));
            };
            let rows = table.iter().enumerate().map(|(i, row)| {
                let key = format!("{key}.table[{i}]");
                if !row.temperature.is_finite() {
                    let what = format!("{} °C is no finite number", row.temperature);
                    return Err(Error::at(format!("{key}.temperature"), what));
                }
                Ok((row.temperature, elastic(&key, &row.young, &row.poisson, row.shear.as_ref())?))
            });
            Material::at(name, celsius, &rows.collect::<Result<Vec<_>, _>>()?, *density)
        }
        _ => {
            let what =
                "it needs either young and poisson, or a table of them over temperature: give one of both";
            return Err(Error::at(key, what));
        }
    };
    if let Some(c) = rayleigh.iter().find(|c| !(**c >= 0.0 && c.is_finite())) {
        return Err(Error::at(format!("{key}.rayleigh"), format!("{c} must be 0 or more")));
    }
    if !(0.0..2.0).contains(loss_factor) {
        let what = format!(
            "{loss_factor} is no loss factor, it must be 0 or more and below 2: steel has 0.001, a lining 0.05"
        );
        return Err(Error::at(format!("{key}.loss_factor"), what));
    }
    Ok(found?.damped(rayleigh[0], rayleigh[1]))
}

/// One number for all directions, or three of everything.
fn elastic(
    key: &str,
    young: &Directional,
    poisson: &Directional,
    shear: Option<&[f64; 3]>,
) -> Result<material::Constants, Error> {
    match (young, poisson, shear) {
        (Directional::Same(young), Directional::Same(poisson), None) => {
            Ok(material::Constants::Isotropic(*young, *poisson))
        }
        (Directional::Each(young), Directional::Each(poisson), Some(shear)) => {
            let constants = Orthotropic { young: *young, poisson: *poisson, shear: *shear };
            Ok(material::Constants::Orthotropic(constants))
        }
        _ => {
            let what = "young and poisson are one number each, or three each with three shear moduli in shear: give all or none of \
                        these as three";
            Err(Error::at(key, what))
        }
    }
}
