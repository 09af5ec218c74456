//! Whose results stand in a directory, before others are written there.

use std::fmt;
use std::path::{Path, PathBuf};

use serde_json::Value as Json;

use crate::disk;
use crate::store::directory::Store;
use crate::store::error::{Error, Result};
use crate::store::origin;

/// The results, or the tiles, of a sweep in a directory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Occupant {
    /// The id of the sweep; empty where nothing says it.
    pub sweep: String,
    /// Its title.
    pub title: String,
    /// Its instances, where something says it.
    pub instances: Option<u64>,
    /// Its tiles that are there, and all of them.
    pub tiles: Option<(usize, usize)>,
    /// Its instances that a stopped run has kept of other tiles.
    kept: usize,
    /// The engine in words.
    engine: String,
    /// The input file that the directory names.
    from: Option<PathBuf>,
}

impl Occupant {
    /// The tiles of a sweep; `None` where there are none.
    fn of_tiles(store: &Store) -> Result<Option<Occupant>> {
        let (done, kept, description) = (store.done()?, store.kept_instances()?, &store.description);
        Ok((done + kept > 0).then(|| Occupant {
            sweep: description.id.to_string(),
            title: description.title.clone(),
            instances: Some(description.tiling.instances as u64),
            tiles: Some((done, description.tiling.count())),
            kept,
            engine: description.kind.clone(),
            from: origin::written(&store.directory),
        }))
    }

    /// The results that `run` and `merge` have left in a directory: tiles or, where these are gone, the files made from
    /// them.
    ///
    /// # Errors
    /// When the directory cannot be read.
    pub fn of_run(directory: &Path) -> Result<Option<Occupant>> {
        match Store::open(directory) {
            Ok(store) => {
                if let Some(there) = Occupant::of_tiles(&store)? {
                    return Ok(Some(there));
                }
            }
            Err(Error::NoTiles { .. }) => {}
            // What is to become of tiles without a description is decided where they are opened.
            Err(_) => return Ok(None),
        }
        let manifest = document(&directory.join("manifest.json"));
        if manifest.is_none() && !directory.join("map.csv").exists() {
            return Ok(None);
        }
        let manifest = manifest.unwrap_or_default();
        Ok(Some(Occupant::of_results(directory, &manifest, &manifest["computation"]["instances"])))
    }

    /// The results that `refine` has left in a directory. Its parts stay whatever becomes of its results.
    #[must_use]
    pub fn of_refinement(directory: &Path) -> Option<Occupant> {
        let refined = document(&directory.join("refine.json"))?;
        let results = Occupant::of_results(directory, &refined, &refined["instances"]);
        Some(Occupant { sweep: text(&refined["sweep"]["sweep_id"]), ..results })
    }

    fn of_results(directory: &Path, document: &Json, instances: &Json) -> Occupant {
        Occupant {
            sweep: text(&document["sweep_id"]),
            title: text(&document["title"]),
            instances: instances.as_u64(),
            tiles: None,
            kept: 0,
            engine: String::new(),
            from: origin::written(directory),
        }
    }

    /// Whether a run of some seconds makes all of it again.
    #[must_use]
    pub fn is_cheap(&self) -> bool {
        matches!(self.tiles, Some((_, 0 | 1)))
    }
}

impl fmt::Display for Occupant {
    /// `"Stability map", 8405 instances, 1 of 1 tiles, cpu f64, from map.toml`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut words = Vec::new();
        if !self.title.is_empty() {
            words.push(format!("\"{}\"", self.title));
        }
        words.extend(self.instances.map(|count| format!("{count} instances")));
        words.extend(self.tiles.map(|(done, total)| format!("{done} of {total} tiles")));
        if self.kept > 0 {
            words.push(format!("{} instances kept of others", self.kept));
        }
        if !self.engine.is_empty() {
            words.push(self.engine.clone());
        }
        words.push(self.from.as_ref().map_or_else(
            || "of an unknown sweep file".to_owned(),
            |from| format!("from `{}`", seen(from).display()),
        ));
        f.write_str(&words.join(", "))
    }
}

/// A path without its detours, as seen from here where it is below.
fn seen(path: &Path) -> PathBuf {
    let whole = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let here = std::env::current_dir().and_then(|here| here.canonicalize()).unwrap_or_default();
    whole.strip_prefix(here).map(Path::to_owned).unwrap_or(whole)
}

fn document(path: &Path) -> Option<Json> {
    serde_json::from_slice(&disk::read(path).ok()?).ok().filter(Json::is_object)
}

fn text(json: &Json) -> String {
    json.as_str().unwrap_or_default().to_owned()
}
