//! The folder `parts/`: records of a sweep that is computed piece by piece, each piece chosen from the results of those
//! before.
//!
//! A part is a tile ([`crate::store::tile`]). In the place of a sweep it names the hash of the sweep's id and of the very
//! instances in it. So it is found again whatever else was computed, and is never taken for other instances. Parts of other
//! sweeps may stand beside it. The refinement that last asked for the parts of a sweep ([`crate::store::refinement`]) stands
//! there, too, under the start of the sweep's id.

use std::collections::BTreeMap;
use std::path::Path;

use crate::disk;
use crate::disk::door;
use crate::engine::record::Record;
use crate::store::claim::Claim;
use crate::store::description::Description;
use crate::store::error::{Error, Result};
use crate::store::folder::{Folder, Note, TILE};
use crate::store::identity::Id;
use crate::store::refinement::Refinement;
use crate::store::tile::{Checksum, Fault, Label, checksum_in, fault_in, instances_in};
use crate::sweep::spec::Analysis;

/// The folder of the parts inside the output directory.
pub const PARTS: &str = "parts";

/// Digits of the sweep's id in the name of a part.
const DIGITS: usize = 8;

/// The end of the name of what asked for parts.
const ASKED: &str = ".json";

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
    /// The name of its file.
    pub name: String,
    /// Its checksum.
    pub checksum: String,
}

/// The content of the folder of parts, of all sweeps.
#[derive(Debug, Default)]
pub struct Found {
    /// The checksum of every good part by its name.
    pub good: BTreeMap<String, String>,
    /// How many instances they have.
    pub instances: usize,
    /// The names of the bad parts, and what is wrong with each.
    pub bad: Vec<(String, Fault)>,
    /// The refinements that asked for them, each with its name, or what is wrong with its file.
    pub asked: Vec<(String, std::result::Result<Refinement, String>)>,
}

impl Found {
    /// Sentences about everything that is in its place but damaged.
    #[must_use]
    pub fn damaged(&self) -> Vec<String> {
        let said = |name: &str, why: &dyn std::fmt::Display| format!("`{PARTS}/{name}`: {why}");
        let parts = self.bad.iter().map(|(name, fault)| said(name, fault));
        let asked = self.asked.iter().filter_map(|(name, one)| Some(said(name, one.as_ref().err()?)));
        parts.chain(asked).collect()
    }

    /// Sentences about everything that `document` names and that is missing or changed: parts by name and checksum, and the
    /// refinement that asked for them.
    #[must_use]
    pub fn lacking(&self, document: &str, named: &[(String, String)], asked: &Refinement) -> Vec<String> {
        let damaged = |name: &str| self.bad.iter().any(|(bad, _)| bad == name);
        let fault = |(name, checksum): &(String, String)| match self.good.get(name) {
            Some(found) if found == checksum => None,
            Some(_) => Some(format!("`{PARTS}/{name}` is another part than `{document}` names")),
            None if damaged(name) => None,
            None => Some(format!("`{PARTS}/{name}`, which `{document}` names, is not there")),
        };
        let asker = name_of(&asked.description);
        let without_asker = !self.asked.iter().any(|(name, _)| *name == asker);
        let asker = without_asker
            .then(|| format!("`{PARTS}/{asker}`, which says of what the parts are, is not there"));
        named.iter().filter_map(fault).chain(asker).collect()
    }
}

impl Parts {
    /// The parts of a sweep in a directory, which may hold some already; what asks for them is kept beside them.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn begin(directory: &Path, asked: &Refinement) -> Result<Parts> {
        let folder = Folder::new(directory, PARTS);
        folder.make()?;
        folder.clean()?;
        let (path, bytes) = (folder.path(&name_of(&asked.description)), asked.to_bytes());
        if disk::read(&path).ok().as_ref() != Some(&bytes) {
            let claim = Claim::take(&path).map_err(|why| folder.refused(&why))?;
            // Another process that holds the claim asks for the same sweep.
            claim.map_or(Ok(()), |claim| claim.write(&bytes)).map_err(|why| folder.refused(&why))?;
        }
        let Description { id, kind, analysis, .. } = &asked.description;
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
            Ok(Some(tile)) => {
                return Ok(Part {
                    records: tile.records,
                    found: true,
                    name,
                    checksum: digits(&tile.checksum),
                });
            }
            Ok(None) => {}
            Err(fault) => self.folder.expel_bad(&name, fault, note)?,
        }
        let records = compute()?;
        let path = self.folder.path(&name);
        let cannot = |why: std::io::Error| Error::WritePart { path: path.clone(), why: why.to_string() };
        let bytes = label.write(&records);
        // Another process that holds the claim writes the same.
        if let Some(claim) = Claim::take(&path).map_err(cannot)? {
            claim.write(&bytes).map_err(cannot)?;
        }
        let checksum = digits(&checksum_in(&bytes).unwrap_or_default());
        Ok(Part { records, found: false, name, checksum })
    }

    /// Whether a part is still there with this checksum; only the end of its file is read.
    #[must_use]
    pub fn has(&self, name: &str, checksum: &str) -> bool {
        self.folder.checksum(name).is_some_and(|found| digits(&found) == checksum)
    }

    /// What the folder of parts of a directory holds, every part read; `None` where there is none.
    ///
    /// # Errors
    /// When the folder cannot be read, or this process cannot read a file in it.
    pub fn found(directory: &Path) -> Result<Option<Found>> {
        let folder = Folder::new(directory, PARTS);
        if !folder.path("").is_dir() {
            return Ok(None);
        }
        // What is gone by now was not there.
        let read = |name: &str| folder.seen(name).map(std::result::Result::transpose);
        let mut found = Found::default();
        for name in folder.tiles()? {
            let Some(bytes) = read(&name)? else { continue };
            match bytes.and_then(|bytes| fault_in(&bytes).map_or(Ok(bytes), Err)) {
                Ok(bytes) => {
                    found.instances += instances_in(&bytes).unwrap_or_default();
                    found.good.insert(name, digits(&checksum_in(&bytes).unwrap_or_default()));
                }
                Err(fault) => found.bad.push((name, fault)),
            }
        }
        for name in folder.ending(ASKED)? {
            let Some(bytes) = read(&name)? else { continue };
            let bytes = bytes.map_err(|fault| fault.to_string());
            found.asked.push((name, bytes.and_then(|bytes| Refinement::from_bytes(&bytes))));
        }
        Ok(Some(found))
    }

    /// Sets everything aside that is damaged, of whatever sweep, and names it.
    ///
    /// # Errors
    /// When it cannot be.
    pub fn expel_damaged(directory: &Path, note: Note) -> Result<()> {
        let folder = Folder::new(directory, PARTS);
        let Some(found) = Parts::found(directory)? else { return Ok(()) };
        for (name, fault) in &found.bad {
            folder.expel(name, &fault.to_string(), note)?;
        }
        for (name, asked) in found.asked {
            asked.map_or_else(|why| folder.expel(&name, &why, note), |_| Ok(()))?;
        }
        Ok(())
    }

    /// How many parts of other sweeps, programs and engines stand beside these.
    ///
    /// # Errors
    /// When the folder cannot be read.
    pub fn strangers(&self) -> Result<usize> {
        let own = start_of(self.id);
        Ok(self.folder.tiles()?.iter().filter(|name| !name.starts_with(&own)).count())
    }

    /// Removes the folder when no part is in it, so that a run without a result leaves nothing behind.
    pub fn remove_if_empty(&self) {
        let own = format!("{}{ASKED}", start_of(self.id));
        let Ok(names) = door().names(&self.folder.path("")) else { return };
        if names.iter().all(|name| *name == *own) {
            // Fails, as it should, when another process has begun a part in between.
            let _ = door().remove(&self.folder.path(&own));
            let _ = door().remove_folder(&self.folder.path(""));
        }
    }

    /// The label of the part with these instances.
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
        format!("{}-{}{TILE}", start_of(self.id), label.key())
    }
}

/// The start of the names of all files that belong to a sweep.
fn start_of(id: Id) -> String {
    id.to_string()[..DIGITS].to_owned()
}

/// The name of what asked for the parts of a sweep.
fn name_of(description: &Description) -> String {
    format!("{}{ASKED}", start_of(description.id))
}

/// A checksum as documents have it.
fn digits(checksum: &Checksum) -> String {
    Id(*checksum).to_string()
}
