//! A refinement as it was asked for, so that it can be done again without its sweep file.
//!
//! It stands in two places, and either is enough: in `refine.json`, which says what the results are, and beside the parts as
//! soon as the first of them is computed.

use serde_json::{Value as Json, json};

use crate::store::description::Description;
use crate::store::seal::{is_intact, sealed};
use crate::sweep::spec::refine::Settings;

/// The key of the sweep.
const SWEEP: &str = "sweep";

/// A sweep, and how its lines are followed.
#[derive(Clone, Debug)]
pub struct Refinement {
    /// The sweep; what it calls a tile is a part.
    pub description: Description,
    /// How its lines are followed.
    pub settings: Settings,
}

impl Refinement {
    /// The entries of a document that say it.
    #[must_use]
    pub fn to_json(&self) -> Json {
        let Settings { coarse, sample, seed } = self.settings;
        json!({
            "coarse_cells_per_side": coarse,
            "sample": { "seed": seed, "asked_for": sample },
            SWEEP: self.description.to_json(),
        })
    }

    /// Reads these entries of a document, which may have others.
    ///
    /// # Errors
    /// What is wrong with them, as the end of a sentence.
    pub fn from_json(document: &Json) -> Result<Refinement, String> {
        Ok(Refinement {
            settings: settings(document)?,
            description: Description::from_json(&document[SWEEP])?,
        })
    }

    /// The file beside the parts.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        sealed(format!("{:#}\n", self.to_json()).into_bytes())
    }

    /// Reads the file.
    ///
    /// # Errors
    /// What is wrong with it, as the end of a sentence.
    pub fn from_bytes(bytes: &[u8]) -> Result<Refinement, String> {
        if !is_intact(bytes) {
            return Err("its content does not have its checksum".to_owned());
        }
        let document: Json = serde_json::from_slice(bytes).map_err(|why| why.to_string())?;
        Refinement::from_json(&document)
    }

    /// Whether both ask for the same refinement by the same program and engine.
    #[must_use]
    pub fn is_same(&self, other: &Refinement) -> bool {
        self.to_json() == other.to_json()
    }
}

/// How the lines of a document are followed.
///
/// # Errors
/// What is missing, as the end of a sentence.
pub fn settings(document: &Json) -> Result<Settings, String> {
    let count = |value: &Json, name: &str| value.as_u64().ok_or_else(|| format!("has no count `{name}`"));
    let sample = &document["sample"];
    #[expect(clippy::cast_possible_truncation, reason = "counts that the command took from a usize")]
    Ok(Settings {
        coarse: count(&document["coarse_cells_per_side"], "coarse_cells_per_side")? as usize,
        sample: count(&sample["asked_for"], "asked_for")? as usize,
        seed: count(&sample["seed"], "seed")?,
    })
}
