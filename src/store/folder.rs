//! A folder of tiles inside an output directory: what is in it, what is set aside.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use super::claim::{Claim, PART};
use super::tile::{Fault, Label};
use crate::error::{Error, Result};
use crate::map::Record;

/// Where tiles go that are not what they should be.
pub(super) const BAD: &str = "bad";
/// The end of the name of a tile.
pub(super) const TILE: &str = ".tile";

/// What gets one sentence for the user.
pub type Note<'a> = &'a (dyn Fn(&str) + Sync);

/// A folder of tiles.
#[derive(Clone, Debug)]
pub(super) struct Folder {
    output: PathBuf,
    name: &'static str,
}

impl Folder {
    /// The folder `name` of an output directory; nothing is looked at.
    pub(super) fn new(output: &Path, name: &'static str) -> Folder {
        Folder { output: output.to_owned(), name }
    }

    /// Makes it where it is not there.
    pub(super) fn make(&self) -> Result<()> {
        std::fs::create_dir_all(self.output.join(self.name)).map_err(|why| self.refused(&why))
    }

    /// The path of something in it.
    pub(super) fn path(&self, name: &str) -> PathBuf {
        self.output.join(self.name).join(name)
    }

    /// The records of a tile that says `label` of itself; `None` when it is not there.
    ///
    /// # Errors
    /// What is wrong with it.
    pub(super) fn read(&self, name: &str, label: &Label) -> std::result::Result<Option<Vec<Record>>, Fault> {
        let path = self.path(name);
        // Reading from a pipe would not end.
        if path.metadata().is_ok_and(|found| !found.is_file()) {
            return Err(Fault::Unreadable { why: "it is no file".to_owned() });
        }
        match std::fs::read(path) {
            Ok(bytes) => label.read(&bytes).map(Some),
            Err(why) if why.kind() == ErrorKind::NotFound => Ok(None),
            Err(why) => Err(Fault::Unreadable { why: why.to_string() }),
        }
    }

    /// Sets something aside that is not what it should be, and says so; the end of the sentence is `what`.
    ///
    /// # Errors
    /// When it cannot be.
    pub(super) fn expel(&self, name: &str, what: &str, note: Note) -> Result<()> {
        self.set_aside(name).map_err(|why| self.refused(&why))?;
        note(&format!("`{}` is set aside in `{}/{BAD}`: {what}", self.path(name).display(), self.name));
        Ok(())
    }

    pub(super) fn set_aside(&self, name: &str) -> io::Result<()> {
        let bad = self.path(BAD);
        std::fs::create_dir_all(&bad)?;
        // What was set aside before stays.
        let mut place = bad.join(name);
        let mut number = 1;
        while place.symlink_metadata().is_ok() {
            number += 1;
            place = bad.join(format!("{name}.{number}"));
        }
        match std::fs::rename(self.path(name), place) {
            // Another process was faster.
            Err(why) if why.kind() == ErrorKind::NotFound => Ok(()),
            other => other,
        }
    }

    /// The names in it that end like a tile's.
    pub(super) fn tiles(&self) -> Result<Vec<String>> {
        Ok(self.entries()?.into_iter().filter(|name| name.ends_with(TILE)).collect())
    }

    /// Removes what a process that was killed has left of a file that is there by now.
    ///
    /// # Errors
    /// When the folder cannot be read or written.
    pub(super) fn clean(&self) -> Result<()> {
        for name in self.entries()? {
            let Some(path) = name.strip_suffix(PART).map(|name| self.path(name)) else { continue };
            // Dropping a claim removes its file; one that a living process holds stays.
            if path.exists() {
                drop(Claim::take(&path).map_err(|why| self.refused(&why))?);
            }
        }
        Ok(())
    }

    /// The names in it.
    fn entries(&self) -> Result<Vec<String>> {
        let entries = std::fs::read_dir(self.output.join(self.name))
            .and_then(Iterator::collect::<io::Result<Vec<_>>>)
            .map_err(|why| self.refused(&why))?;
        Ok(entries.into_iter().filter_map(|entry| entry.file_name().into_string().ok()).collect())
    }

    /// The error of an output directory that does not take what it should.
    pub(super) fn refused(&self, why: &io::Error) -> Error {
        Error::OutputDirectory { path: self.output.clone(), why: why.to_string() }
    }
}
