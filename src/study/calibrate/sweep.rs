//! A calibrated model as a sweep file.

use std::fmt::Write as _;

use crate::model::Param;
use crate::study::calibrate::solve::{Calibrated, Measured};

/// The plane of its map.
#[derive(Clone, Debug, PartialEq)]
pub enum Plane {
    /// Static against dynamic friction of the bilinear law with this knee (m/s), at each of these velocities (m/s).
    Friction {
        /// The knee, m/s.
        knee: f64,
        /// Velocities, m/s.
        velocities: Vec<f64>,
    },
    /// Temperature (°C) against velocity (m/s) of a material.
    Material {
        /// The file of the material, as the sweep file names it.
        file: String,
        /// Its law.
        law: String,
        /// Lowest and highest temperature, °C.
        temperatures: [f64; 2],
        /// Lowest and highest velocity, m/s.
        velocities: [f64; 2],
    },
}

/// The parameters of a model in the order of a sweep file.
const MODEL: [Param; 8] =
    [Param::M1, Param::M2, Param::K1, Param::K2, Param::C1, Param::C2, Param::FExt, Param::Theta];

/// The sweep file of a calibrated model, which `squealmap run` takes.
#[must_use]
pub fn sweep_toml(found: &Calibrated, measured: &Measured, plane: &Plane) -> String {
    let [first, second] = measured.frequencies;
    let [lower, upper] = measured.damping_ratios;
    let mut text = format!(
        "# Two masses with modes at {first} and {second} Hz, damping ratios of {lower} and {upper}, and mode coupling from a\n\
         # friction coefficient of {} on.\n\n\
         title = \"Calibrated: {first} and {second} Hz, critical friction {}\"\n\n[model]\n",
        measured.critical_friction, measured.critical_friction,
    );
    for param in MODEL {
        let info = param.info();
        let _ = writeln!(
            text,
            "{} = {}   # {}, {}",
            info.name,
            number(found.params.require(param)),
            info.unit,
            info.meaning
        );
    }
    match plane {
        Plane::Friction { knee, velocities } => {
            let most = (2.0 * measured.critical_friction).max(0.6);
            let velocities: Vec<String> = velocities.iter().map(|velocity| number(*velocity)).collect();
            let _ = write!(
                text,
                "\n[friction]\nlaw = \"bilinear\"\nknee_velocity = {}   # above the velocities; `squealmap fit` finds yours\n\n[axes]\nmu_s = {{ from = 0.0, to = {most}, points = 61 }}\n\
                 mu_d = {{ from = 0.0, to = {most}, points = 61 }}\nbelt_velocity = {{ values = [{}] }}\n",
                number(*knee),
                velocities.join(", ")
            );
        }
        Plane::Material { file, law, temperatures: [cold, hot], velocities: [slow, fast] } => {
            let _ = write!(
                text,
                "\n[friction]\nlaw = \"{law}\"\nmaterial = \"{file}\"\n\n[axes]\ntemperature = {{ from = {}, to = {}, points = 61 \
                 }}\nbelt_velocity = {{ from = {}, to = {}, points = 61 }}\n",
                number(*cold),
                number(*hot),
                number(*slow),
                number(*fast)
            );
        }
    }
    text + "\n[response]\nsettle = \"auto\"\n"
}

/// A number as TOML has it: with a point or an exponent.
fn number(value: f64) -> String {
    let text = format!("{value:?}");
    if text.contains(['.', 'e']) { text } else { text + ".0" }
}
