//! The description of a study as it stands in a file.

use std::collections::BTreeMap;

use serde::Deserialize;

pub use super::part::{Part, PartKind};
use super::place::key_of;
use crate::Error;

/// A description of a study. The keys are those of `docs/fem_files.md`; units are SI.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Document {
    /// What stands above figures; may be empty.
    #[serde(default)]
    pub title: String,
    /// °C at which the tables of materials are read.
    pub temperature: Option<f64>,
    /// Meshes by name. The sets of a part have its name and a dot before theirs: `pin.z0`.
    pub parts: BTreeMap<String, Part>,
    /// Materials by name.
    #[serde(default)]
    pub materials: BTreeMap<String, Constants>,
    /// What holds the parts.
    #[serde(default)]
    pub supports: Vec<Support>,
    /// What presses them.
    #[serde(default)]
    pub loads: Vec<Load>,
    /// Surfaces that move as one.
    #[serde(default)]
    pub bonds: Vec<Bond>,
    /// Surfaces that slide on each other.
    #[serde(default)]
    pub sliding: Vec<Sliding>,
    /// Friction of all sliding surfaces.
    pub friction: Friction,
    /// The modes that are asked for.
    #[serde(default)]
    pub modes: Modes,
    /// Another parameter that is varied, at one coefficient of friction.
    pub vary: Option<Vary>,
    /// What is written.
    #[serde(default)]
    pub output: Output,
}

/// One number for all directions, or one along each axis.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(try_from = "toml::Value")]
pub enum Directional {
    /// The same in every direction.
    Same(f64),
    /// Along x, y, z; or of xy, yz, xz.
    Each([f64; 3]),
}

impl TryFrom<toml::Value> for Directional {
    type Error = String;

    fn try_from(value: toml::Value) -> Result<Self, String> {
        let wanted = format!("{value} is neither a number nor three of them in brackets");
        match value {
            toml::Value::Array(all) => {
                let all: Option<Vec<f64>> = all.iter().map(number).collect();
                all.and_then(|all| all.try_into().ok()).map(Self::Each).ok_or(wanted)
            }
            other => number(&other).map(Self::Same).ok_or(wanted),
        }
    }
}

/// Integers are numbers, too.
#[expect(clippy::cast_precision_loss, reason = "no constant of a material has more than sixteen digits")]
fn number(value: &toml::Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|i| i as f64))
}

/// A material: its elastic constants, or a table of them over temperature.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Constants {
    /// Young's modulus, Pa; three along x, y, z of an orthotropic one.
    pub young: Option<Directional>,
    /// Poisson's ratio; three, ν_xy, ν_yz, ν_xz, of an orthotropic one.
    pub poisson: Option<Directional>,
    /// Shear moduli of the planes xy, yz, zx of an orthotropic material, Pa.
    pub shear: Option<[f64; 3]>,
    /// Instead of these constants: some at each of some temperatures.
    #[serde(default)]
    pub table: Vec<Row>,
    /// kg/m³.
    pub density: f64,
    /// Rayleigh damping C = α M + β K: α in 1/s, β in s.
    #[serde(default)]
    pub rayleigh: [f64; 2],
    /// The part of its strain energy that it loses in a radian of a vibration.
    #[serde(default)]
    pub loss_factor: f64,
}

/// Elastic constants at a temperature.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// °C.
    pub temperature: f64,
    /// As of a material.
    pub young: Directional,
    /// As of a material.
    pub poisson: Directional,
    /// As of a material.
    pub shear: Option<[f64; 3]>,
}

/// A support.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Support {
    /// Which nodes.
    pub set: String,
    /// Along which axes they are held, such as `xy`.
    #[serde(default = "all_axes")]
    pub axes: String,
    /// How far they are moved along these axes, m.
    #[serde(default)]
    pub displacement: f64,
}

fn all_axes() -> String {
    "xyz".to_owned()
}

/// A load on a surface: one of `pressure` and `force`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// Which faces.
    pub set: String,
    /// Pa, inwards.
    pub pressure: Option<f64>,
    /// Total force of a uniform pressure, N, inwards; for a flat surface.
    pub force: Option<f64>,
}

/// Two flat surfaces that move as one.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bond {
    /// The surface whose nodes follow.
    pub slaves: String,
    /// The surface that leads; the larger one.
    pub masters: String,
    /// How nodes that do not match are tied.
    #[serde(default)]
    pub by: By,
}

/// How surfaces are tied that do not match.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum By {
    /// In the mean, weighted by shape functions; every slave node is coupled to all masters.
    #[default]
    Mortar,
    /// Node by node: each slave to the face in which it lies.
    Points,
}

/// Two flat surfaces that slide on each other. One of `direction` and `axis` with `origin`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sliding {
    /// The surface whose nodes are in contact; the finer or smaller one.
    pub slaves: String,
    /// The surface on which they slide; `rigid` for a rigid plane.
    pub masters: String,
    /// Along which the slaves move relative to the masters.
    pub direction: Option<[f64; 3]>,
    /// The axis about which the slaves turn relative to the masters.
    pub axis: Option<[f64; 3]>,
    /// A point on that axis, m.
    pub origin: Option<[f64; 3]>,
}

/// Friction.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Friction {
    /// Coefficients of friction.
    pub mu: Values,
    /// Slope dμ/dV of friction over the sliding velocity, s/m.
    #[serde(default)]
    pub slope: f64,
    /// Pressure per overlap kn, Pa/m; none: the surfaces do not overlap (multipliers).
    pub contact_stiffness: Option<f64>,
    /// Coefficient of friction at which the static step decides what stays in contact.
    #[serde(default)]
    pub static_mu: f64,
}

/// Rising values: `{ from = 0.0, to = 0.6, points = 61 }`, or `{ values = [0.0, 0.2] }`.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "{ from, to, points } or { values = [...] }")]
pub struct Values {
    /// The first of a range.
    pub from: Option<f64>,
    /// Its last.
    pub to: Option<f64>,
    /// How many it has, 2 or more.
    pub points: Option<usize>,
    /// Values one by one.
    pub values: Option<Vec<f64>>,
}

/// The modes that are asked for.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Modes {
    /// How many, from the lowest frequency on; fewer where the band ends before.
    pub count: usize,
    /// Lowest and highest frequency of what is written, Hz.
    pub band: [f64; 2],
    /// The largest residual that is good enough.
    pub residual: f64,
    /// Damping ratios of the lowest real modes, one by one.
    pub damping_ratios: Vec<f64>,
    /// Whether the stress of the static step stiffens the bodies.
    pub stressed: bool,
}

impl Default for Modes {
    fn default() -> Self {
        Self {
            count: 20,
            band: [0.0, f64::INFINITY],
            residual: 1e-6,
            damping_ratios: Vec::new(),
            stressed: false,
        }
    }
}

/// A parameter that is varied at one coefficient of friction.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Vary {
    /// Which.
    pub parameter: Varied,
    /// The material whose stiffness is varied.
    pub material: Option<String>,
    /// The coefficient of friction.
    pub mu: f64,
    /// Its values.
    pub values: Values,
}

/// What may be varied.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Varied {
    /// Pressure per overlap, Pa/m.
    ContactStiffness,
    /// A factor of all moduli of a material.
    Stiffness,
    /// A factor of loads and prescribed displacements.
    Load,
    /// A factor of the Rayleigh damping of all materials.
    Damping,
    /// dμ/dV, s/m.
    Slope,
}

/// What is written.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Output {
    /// Coefficients of friction at which the shapes of all modes in the band are written; they are values of `friction.mu`.
    pub shapes_at: Vec<f64>,
    /// Whether the projected problem is written, as `modes.toml`.
    pub modal: bool,
    /// How many vectors it has at most; none: as many as it may.
    pub vectors: Option<usize>,
    /// The least and the largest contact stiffness for which it holds, Pa/m; none: that of friction alone.
    pub kn: Option<[f64; 2]>,
}

impl Document {
    /// Reads the text of a file. Whether the values make sense is seen when the model is built.
    ///
    /// # Errors
    /// What is no TOML; keys that there are not or that are missing; values of a wrong kind.
    pub fn read(text: &str) -> Result<Self, Error> {
        parsed(text).map_err(|error| match error {
            Error::Description { line, span, what }
                if OF_SWEEPS.iter().any(|key| what.starts_with(&format!("unknown field `{key}`"))) =>
            {
                let what = format!("{what}; a sweep file is for `squealmap run`");
                Error::Description { line, span, what }
            }
            other => other,
        })
    }
}

/// Without the names of Rust's types, on one line.
fn in_words(message: &str) -> String {
    let plain = message.trim().replace('\n', "; ");
    let plain = plain.replace("expected usize", "expected a whole number from 0 on");
    let plain = plain.replace("expected i64", "expected a whole number");
    plain.replace("expected f64", "expected a number")
}

/// Keys of sweep files.
const OF_SWEEPS: [&str; 7] = ["axes", "points", "model", "belt", "analysis", "response", "start"];

/// A file of TOML; what is wrong with it as one line.
pub(super) fn parsed<T: serde::de::DeserializeOwned>(text: &str) -> Result<T, Error> {
    toml::from_str(text).map_err(|error| {
        let span = error.span().unwrap_or(0..0);
        let line = text.get(..span.start).map_or(1, |before| before.matches('\n').count() + 1);
        let key = key_of(text, &span).map(|key| key + ": ").unwrap_or_default();
        Error::Description { line, span, what: key + &in_words(error.message()) }
    })
}
