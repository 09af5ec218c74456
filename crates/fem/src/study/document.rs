//! The description of a study as it stands in a file.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::Error;

/// A description of a study. The keys are those of `docs/fem_files.md`; units are SI.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Document {
    /// What stands above figures; may be empty.
    #[serde(default)]
    pub title: String,
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
    /// What is written.
    #[serde(default)]
    pub output: Output,
}

/// A mesh: a block or a file.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub enum Part {
    /// A rectangular block along the axes; its sides are the sets x0, x1, y0, y1, z0, z1.
    Block {
        /// `hex8`, `hex20`, `hex20r`, `tet4`, `tet10` or `wedge15`.
        element: String,
        /// The corner with the smallest coordinates, m.
        origin: [f64; 3],
        /// Lengths of the edges, m.
        size: [f64; 3],
        /// Elements along each edge.
        cells: [usize; 3],
        /// Name of its material.
        material: String,
    },
    /// A file of Gmsh (`.msh`) or of Abaqus and CalculiX (`.inp`).
    Mesh {
        /// Path, relative to the description.
        file: String,
        /// Metres per unit of its coordinates.
        #[serde(default = "one")]
        scale: f64,
        /// How far it is moved, m, after scaling.
        #[serde(default)]
        shift: [f64; 3],
        /// Names of the materials of its physical volumes, in the order of their tags; one name is for all. None: those of an `.inp` file.
        #[serde(default)]
        materials: Vec<String>,
    },
}

fn one() -> f64 {
    1.0
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

/// Constants of a material.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Constants {
    /// Young's modulus, Pa; three along x, y, z of an orthotropic one.
    pub young: Directional,
    /// Poisson's ratio; three, ν_xy, ν_yz, ν_xz, of an orthotropic one.
    pub poisson: Directional,
    /// Shear moduli of the planes xy, yz, zx of an orthotropic material, Pa.
    pub shear: Option<[f64; 3]>,
    /// kg/m³.
    pub density: f64,
    /// Rayleigh damping C = α M + β K: α in 1/s, β in s.
    #[serde(default)]
    pub rayleigh: [f64; 2],
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
#[serde(deny_unknown_fields)]
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
}

impl Default for Modes {
    fn default() -> Self {
        Self { count: 20, band: [0.0, f64::INFINITY], residual: 1e-6 }
    }
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
}

impl Document {
    /// Reads the text of a file. Whether the values make sense is seen when the model is built.
    ///
    /// # Errors
    /// What is no TOML; keys that there are not or that are missing; values of a wrong kind.
    pub fn read(text: &str) -> Result<Self, Error> {
        parsed(text)
    }
}

/// A file of TOML; what is wrong with it as one line.
pub(super) fn parsed<T: serde::de::DeserializeOwned>(text: &str) -> Result<T, Error> {
    toml::from_str(text).map_err(|error| {
        let at = error.span().map_or(0, |span| span.start.min(text.len()));
        let line = text[..at].matches('\n').count() + 1;
        Error::File { line, what: error.message().trim().replace('\n', "; ") }
    })
}
