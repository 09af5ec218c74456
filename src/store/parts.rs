//! What is computed of a sweep piece by piece, where each piece follows from the ones before: the folder `parts/`.
//!
//! A part is a tile ([`super::tile`]) whose sweep is the hash of the sweep's id and of the very instances in it, so
//! that it is found again whatever else was computed, and never taken for other instances. Parts of other sweeps may
//! stand beside it.

use std::path::Path;

use super::claim::Claim;
use super::description::Description;
use super::folder::{Folder, Note, TILE};
use super::identity::Id;
use super::tile::{Label, instances_in};
use crate::disk::{self, door};
use crate::error::{Error, Result};
use crate::map::Record;
use crate::spec::Analysis;

/// The folder of the parts inside the output directory.
pub const PARTS: &str = "parts";

/// Digits of the sweep's id in the name of a part.
const DIGITS: usize = 8;

/// The parts of a sweep in an output directory.
#[derive(Debug)]
pub struct Parts {
    folder: Folder,
    id: Id,
    kind: String,
    analysis: Analysis,
}

/// The records of a part.
#[derive(Debug)]
pub struct Part {
    /// In the order of its instances.
    pub records: Vec<Record>,
    /// Whether they were there before.
    pub found: bool,
}

impl Parts {
    /// The parts of a sweep in a directory, which may hold some already.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn begin(directory: &Path, description: &Description) -> Result<Parts> {
        let folder = Folder::new(directory, PARTS);
        folder.make()?;
        folder.clean()?;
        let Description { id, kind, analysis, .. } = description;
        Ok(Parts { folder, id: *id, kind: kind.clone(), analysis: *analysis })
    }

    /// The records of some instances: those that are there, or those that `compute` gives, which are kept. A part that is
    /// not what it should be is set aside, named, and computed again.
    ///
    /// # Errors
    /// Those of `compute`, or when the part cannot be written.
    pub fn records(
        &self,
        instances: &[usize],
        note: Note,
        compute: &mut dyn FnMut() -> Result<Vec<Record>>,
    ) -> Result<Part> {
        let label = self.label(instances);
        let name = self.name(&label);
        match self.folder.read(&name, &label) {
            Ok(Some(tile)) => return Ok(Part { records: tile.records, found: true }),
            Ok(None) => {}
            Err(fault) => self.folder.expel(&name, &format!("{fault}; it is computed again"), note)?,
        }
        let records = compute()?;
        let path = self.folder.path(&name);
        let cannot = |why: std::io::Error| Error::WritePart { path: path.clone(), why: why.to_string() };
        // Another process that holds the claim writes the same.
        if let Some(claim) = Claim::take(&path).map_err(cannot)? {
            claim.write(&label.write(&records)).map_err(cannot)?;
        }
        Ok(Part { records, found: false })
    }

    /// How many good parts a directory has, of whatever sweep, how many instances they have, and how many are bad; `None`
    /// where there is no folder of parts.
    ///
    /// # Errors
    /// When the folder cannot be read.
    pub fn found(directory: &Path) -> Result<Option<[usize; 3]>> {
        let folder = Folder::new(directory, PARTS);
        if !folder.path("").is_dir() {
            return Ok(None);
        }
        let mut found = [0; 3];
        for name in folder.tiles()? {
            match instances_in(&disk::read(&folder.path(&name)).unwrap_or_default()) {
                Some(instances) => found = [found[0] + 1, found[1] + instances, found[2]],
                None => found[2] += 1,
            }
        }
        Ok(Some(found))
    }

    /// How many parts of other sweeps, programs and engines stand beside these.
    ///
    /// # Errors
    /// When the folder cannot be read.
    pub fn strangers(&self) -> Result<usize> {
        let own = &self.id.to_string()[..DIGITS];
        Ok(self.folder.tiles()?.iter().filter(|name| !name.starts_with(own)).count())
    }

    /// Removes the folder when nothing is in it, so that a run of which nothing came leaves nothing.
    pub fn remove_if_empty(&self) {
        // Fails, as it should, when there is something in it.
        let _ = door().remove_folder(&self.folder.path(""));
    }

    /// What the part of these instances says of itself.
    fn label(&self, instances: &[usize]) -> Label {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&self.id.0);
        for instance in instances {
            hasher.update(&(*instance as u64).to_le_bytes());
        }
        Label {
            sweep: Id(*hasher.finalize().as_bytes()),
            kind: self.kind.clone(),
            analysis: self.analysis,
            bounds: 0..instances.len(),
        }
    }

    fn name(&self, label: &Label) -> String {
        format!("{}-{}{TILE}", &self.id.to_string()[..DIGITS], label.key())
    }
}
