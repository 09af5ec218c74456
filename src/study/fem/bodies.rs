//! What pictures of a study show: its mesh and its modes, just computed or read back.

use serde::Deserialize;
use squealmap_fem::c64;
use squealmap_fem::mesh::Mesh;
use squealmap_fem::output::Field;
use squealmap_fem::read::vtu;
use squealmap_fem::study::{Outcome, Shape, Study};

use crate::results::read::folder::{Folder, Why};
use crate::study::error::Result;

/// The bodies of a study, and their modes.
#[derive(Clone, Debug)]
pub struct Bodies {
    /// What stands above pictures.
    pub title: String,
    /// Nodes and elements.
    pub mesh: Mesh,
    /// Each part with its numbers of nodes and elements; nodes stand part by part.
    pub parts: Vec<(String, usize, usize)>,
    /// The sliding contact.
    pub sliding: Option<Sliding>,
    /// Whether anything damps.
    pub damped: bool,
    /// Modes that become unstable or stable, from 0.
    pub concerned: Vec<usize>,
    /// Shapes of modes.
    pub shapes: Vec<Shape>,
}

/// Where bodies slide.
#[derive(Clone, Copy, Debug, Deserialize)]
pub struct Sliding {
    /// Points of contact.
    pub points: usize,
    /// Along which the first of them slides.
    pub direction: [f64; 3],
    /// The normal of its contact.
    pub normal: [f64; 3],
    /// Whether they turn about an axis.
    pub turns: bool,
}

/// What the manifest says.
#[derive(Deserialize)]
struct Document {
    title: String,
    parts: Vec<Part>,
    sliding: Option<Sliding>,
    damped: bool,
    transitions: Vec<Met>,
    shapes: Vec<Found>,
}

#[derive(Deserialize)]
struct Part {
    name: String,
    nodes: usize,
    elements: usize,
}

#[derive(Deserialize)]
struct Met {
    modes: Vec<usize>,
}

#[derive(Deserialize)]
struct Found {
    name: String,
    mode: usize,
    mu: f64,
    angular_frequency: f64,
    growth_rate: f64,
}

impl Bodies {
    /// Those of a study that has just been computed.
    #[must_use]
    pub fn of(study: &Study, outcome: &Outcome) -> Bodies {
        let sliding = study.model.contact.first().map(|point| Sliding {
            points: study.model.contact.len(),
            direction: point.direction,
            normal: point.normal,
            turns: study.document.sliding.iter().any(|one| one.axis.is_some()),
        });
        Bodies {
            title: study.document.title.clone(),
            mesh: study.model.mesh.clone(),
            parts: study.parts.clone(),
            sliding,
            damped: outcome.damped,
            concerned: outcome.transitions.iter().flat_map(|t| t.modes.iter().copied()).collect(),
            shapes: outcome.shapes.clone(),
        }
    }

    /// What stands above pictures.
    pub(crate) fn title(&self) -> &str {
        &self.title
    }

    /// Those in the files of a study, the mesh with its shapes and the manifest.
    pub(crate) fn read(folder: Folder<'_>, files: [&str; 2]) -> Result<Bodies> {
        let json = folder.json(files[1])?;
        let document = Document::deserialize(&json).map_err(|why| {
            folder.bad(files[1], format!("{why}; `squealmap fem` of this version writes it anew"))
        })?;
        let (mesh, fields) =
            vtu(&folder.text(files[0])?).map_err(|why| folder.bad(files[0], why.to_string()))?;
        let shapes = document.shapes.iter().map(|found| shape(found, &fields)).collect::<Why<_>>();
        Ok(Bodies {
            title: document.title,
            mesh,
            parts: document.parts.into_iter().map(|part| (part.name, part.nodes, part.elements)).collect(),
            sliding: document.sliding,
            damped: document.damped,
            concerned: document
                .transitions
                .into_iter()
                .flat_map(|met| met.modes)
                .map(|mode| mode - 1)
                .collect(),
            shapes: shapes.map_err(|why| folder.bad(files[0], why))?,
        })
    }
}

/// A shape by the field of its name.
fn shape(found: &Found, fields: &[(String, Field)]) -> Why<Shape> {
    let field = fields.iter().find(|(name, _)| *name == found.name);
    let Some((_, Field::Complex(displacement))) = field else {
        return Err(format!("has no shape \"{}\", which the manifest names", found.name));
    };
    let lambda = c64::new(found.growth_rate, found.angular_frequency);
    Ok(Shape { mu: found.mu, mode: found.mode.max(1) - 1, lambda, displacement: displacement.clone() })
}
