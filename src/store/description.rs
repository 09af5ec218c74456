//! `tiles/sweep.json`: what the tiles of a directory are, so that they can be read without the sweep file.

use std::io::{self, Write};

use serde::{Deserialize, Serialize};
use serde_json::{Value as Json, json};

use crate::engine::computation::Computation;
use crate::store::grid_json::{GRID, PHYSICS, Parted, Whole, from_json, rows};
use crate::store::identity::{Id, identity, kind};
use crate::store::seal::{Sealing, is_intact};
use crate::store::tile::Label;
use crate::store::tiling::Tiling;
use crate::sweep::accuracy::frontier::Chosen;
use crate::sweep::grid::Grid;
use crate::sweep::sheet::Sheet;
use crate::sweep::spec::duration::{AUTO, CYCLE};
use crate::sweep::spec::{Analysis, Spec, Starts, start};

/// The version of the format.
const FORMAT: u32 = 2;

/// The versions that are read: the first has no checksum.
const READ: [u32; 2] = [1, FORMAT];

/// What the tiles of a directory are.
#[derive(Clone, Debug)]
pub struct Description {
    /// The id of the sweep.
    pub id: Id,
    /// The engine in words.
    pub kind: String,
    /// Title of figures and manifest.
    pub title: String,
    /// What is computed.
    pub analysis: Analysis,
    /// The instances.
    pub grid: Grid,
    /// How they are cut.
    pub tiling: Tiling,
    /// Where and how the eigenvalue analysis and the response are computed.
    pub computations: [Option<Computation>; 2],
    /// The sweep as the manifest shows it.
    pub resolved: Json,
    /// The accuracy that was asked for and what was chosen for it; what it does to the numbers stands elsewhere.
    pub accuracy: Option<Chosen>,
    identity: Json,
    /// The version of the format that it was read in, or is written in.
    format: u32,
}

/// Why bytes are no description.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unread {
    /// The file has a format that this version does not know.
    Format(u32),
    /// Something else is wrong with the file; the text is the end of a sentence.
    Bad(String),
}

/// The part of the file that every format has.
#[derive(Deserialize)]
struct Versioned {
    format: u32,
}

/// The file; the id is that of `identity`.
#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Document<I> {
    format: u32,
    sweep_id: String,
    title: String,
    tile: usize,
    linear: Option<Computation>,
    response: Option<Computation>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    accuracy: Option<Chosen>,
    identity: I,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    checksum: Option<String>,
}

impl Description {
    /// The description of a sweep whose tiles have `tile` instances.
    #[must_use]
    pub fn new(spec: &Spec, computations: [Option<Computation>; 2], tile: usize) -> Description {
        let identity = identity(spec, &computations);
        Description {
            id: Id::with_rows(&identity, rows(&spec.grid)),
            kind: kind(&computations),
            title: spec.title.clone(),
            analysis: spec.analysis,
            grid: spec.grid.clone(),
            tiling: Tiling { instances: spec.grid.len(), tile: tile.max(1) },
            computations,
            resolved: resolved(&spec.title, identity[PHYSICS].clone(), &spec.grid),
            accuracy: None,
            identity,
            format: FORMAT,
        }
    }

    /// Whether its file reads like that of another description of the same tiles.
    #[must_use]
    pub fn is_written_as(&self, other: &Description) -> bool {
        (self.format, &self.title, &self.accuracy) == (other.format, &other.title, &other.accuracy)
    }

    /// The bytes of its file.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        // Memory takes any text.
        let _ = self.write(&mut bytes);
        bytes
    }

    /// Writes the file, value by value.
    ///
    /// # Errors
    /// What `out` gives.
    pub fn write(&self, out: impl io::Write) -> io::Result<()> {
        let mut out = Sealing::new(out);
        serde_json::to_writer_pretty(&mut out, &self.document())?;
        out.write_all(b"\n")?;
        out.finish()
    }

    /// The description as an entry of another document, without a checksum of its own.
    #[must_use]
    pub fn to_json(&self) -> Json {
        // None of its keys is anything but text.
        serde_json::to_value(self.document()).unwrap_or_default()
    }

    fn document(&self) -> Document<Whole<'_>> {
        let [linear, response] = self.computations.clone();
        Document {
            format: FORMAT,
            sweep_id: self.id.to_string(),
            title: self.title.clone(),
            tile: self.tiling.tile,
            linear,
            response,
            accuracy: self.accuracy.clone(),
            identity: Whole { json: &self.identity, rows: rows(&self.grid), sorted: false },
            checksum: None,
        }
    }

    /// Reads the file.
    ///
    /// # Errors
    /// Why it cannot be read.
    pub fn from_bytes(bytes: &[u8]) -> Result<Description, Unread> {
        // First of all, as another format may have other entries.
        match serde_json::from_slice(bytes) {
            Ok(Versioned { format }) if !READ.contains(&format) => Err(Unread::Format(format)),
            _ => Description::parse(bytes).map_err(Unread::Bad),
        }
    }

    fn parse(bytes: &[u8]) -> Result<Description, String> {
        let document: Document<Parted> = serde_json::from_slice(bytes).map_err(|why| why.to_string())?;
        if document.format == FORMAT && !is_intact(bytes) {
            return Err("it was changed: its content does not have its checksum".to_owned());
        }
        Description::described(document)
    }

    /// Reads the entry of another document.
    ///
    /// # Errors
    /// What is wrong with it, as the end of a sentence.
    pub fn from_json(json: &Json) -> Result<Description, String> {
        Description::described(Document::deserialize(json).map_err(|why| why.to_string())?)
    }

    fn described(document: Document<Parted>) -> Result<Description, String> {
        if !READ.contains(&document.format) {
            return Err(format!("its format is {}, which this version does not know", document.format));
        }
        let Parted { json: identity, rows } = document.identity;
        let id = Id::with_rows(&identity, rows.as_ref());
        if id.to_string() != document.sweep_id || document.tile == 0 {
            return Err("it was changed: its content does not have its id".to_owned());
        }
        let physics = identity.get(PHYSICS).cloned().unwrap_or_default();
        let grid = physics.get(GRID).and_then(|grid| from_json(grid, rows)).ok_or("its grid is none")?;
        let computations = [document.linear, document.response];
        let [linear, response] = computations.each_ref().map(Option::is_some);
        let settles = |word: &str| response && physics["response"]["settle"] == word;
        let (until_settled, finds_cycles) = (settles(AUTO) || settles(CYCLE), settles(CYCLE));
        let checked = response && physics["response"]["check"] == true;
        let starts = if response { start::from_json(&physics["start"]) } else { Starts::One };
        let analysis = Analysis { linear, response, until_settled, finds_cycles, checked, starts };
        let tiling = Tiling { instances: grid.len(), tile: document.tile };
        let resolved = resolved(&document.title, physics, &grid);
        Ok(Description {
            id,
            kind: kind(&computations),
            title: document.title,
            analysis,
            grid,
            tiling,
            computations,
            resolved,
            accuracy: document.accuracy,
            identity,
            format: document.format,
        })
    }

    /// The sweep, to be computed again by this program; `None` where another version described it.
    #[must_use]
    pub fn spec(&self) -> Option<Spec> {
        // What was read back is the sweep if it has its identity, and only then.
        self.spec_as_read().filter(|spec| Id::of(&identity(spec, &self.computations)) == self.id)
    }

    /// The sweep as this program reads it, whichever version has described it; `None` where an entry is none that it knows.
    #[must_use]
    pub fn spec_as_read(&self) -> Option<Spec> {
        Spec::from_resolved(&self.identity[PHYSICS], &self.title, self.analysis, self.grid.clone())
    }

    /// Whether another sweep has everything but its grid in common with this one.
    #[must_use]
    pub fn differs_only_in_grid(&self, other: &Description) -> bool {
        let without_grid = |one: &Description| {
            let mut identity = one.identity.clone();
            if let Some(Json::Object(physics)) = identity.get_mut(PHYSICS) {
                physics.remove(GRID);
            }
            Id::of(&identity)
        };
        without_grid(self) == without_grid(other)
    }

    /// The tile `number`.
    #[must_use]
    pub fn tile(&self, number: usize) -> Label {
        Label {
            sweep: self.id,
            kind: self.kind.clone(),
            analysis: self.analysis,
            bounds: self.tiling.bounds(number),
        }
    }

    /// The sweep as exports see it.
    #[must_use]
    pub fn sheet(&self) -> Sheet<'_> {
        let [linear, response] = self.computations.each_ref().map(Option::as_ref);
        Sheet { title: &self.title, analysis: self.analysis, grid: &self.grid, linear, response }
    }
}

/// The manifest's form of a sweep, see [`Spec::resolved`], from what its identity holds.
fn resolved(title: &str, physics: Json, grid: &Grid) -> Json {
    let mut resolved = serde_json::Map::from_iter([("title".to_owned(), json!(title))]);
    if let Json::Object(entries) = physics {
        for (key, value) in entries {
            if key == GRID {
                let (key, value) = crate::sweep::spec::resolved_grid(grid);
                resolved.insert(key.to_owned(), value);
            } else {
                resolved.insert(key, value);
            }
        }
    }
    Json::Object(resolved)
}
