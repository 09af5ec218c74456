//! A folder of tiles inside an output directory: which tiles are in it, and which are set aside.

use std::io::{self, ErrorKind, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use crate::disk;
use crate::disk::{Handle, How, door};
use crate::engine::record::Record;
use crate::store::claim::{Claim, PART};
use crate::store::error::{Error, Result};
use crate::store::tile::{Checksum, FOOTER, Fault, Label, checksum_in};

/// Where tiles go that are not what they should be.
pub(super) const BAD: &str = "bad";
/// The end of the name of a tile.
pub(super) const TILE: &str = ".tile";
/// The end of the name of a file with the records of a tile that was stopped before it was complete.
pub(super) const SOME: &str = ".some";

/// Gets one sentence at a time for the user.
pub type Note<'a> = &'a (dyn Fn(&str) + Sync);

/// A tile that was read and is good.
#[derive(Clone, Debug)]
pub struct Tile {
    /// Its records.
    pub records: Vec<Record>,
    /// Its checksum.
    pub checksum: Checksum,
}

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
        disk::make_all(&self.output.join(self.name)).map(drop).map_err(|why| self.refused(&why))
    }

    /// The path of something in it.
    pub(super) fn path(&self, name: &str) -> PathBuf {
        self.output.join(self.name).join(name)
    }

    /// The records of a tile that says `label` of itself, and its checksum; `None` when it is not there.
    ///
    /// # Errors
    /// What is wrong with it.
    pub(super) fn read(&self, name: &str, label: &Label) -> std::result::Result<Option<Tile>, Fault> {
        let Some(bytes) = self.bytes(name)? else { return Ok(None) };
        let checksum = checksum_in(&bytes).unwrap_or_default();
        label.read(&bytes).map(|records| Some(Tile { records, checksum }))
    }

    /// The checksum of a tile, read from the end of its file alone; `None` when there is no such tile.
    pub(super) fn checksum(&self, name: &str) -> Option<Checksum> {
        let mut end = [0; FOOTER];
        let mut file = Handle::open(&self.path(name), How::Read).ok()?;
        file.seek(SeekFrom::End(-i64::try_from(FOOTER).ok()?)).ok()?;
        file.read_exact(&mut end).ok()?;
        checksum_in(&end)
    }

    /// The bytes of a file; `None` when it is not there.
    pub(super) fn bytes(&self, name: &str) -> std::result::Result<Option<Vec<u8>>, Fault> {
        match disk::read(&self.path(name)) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(why) if why.kind() == ErrorKind::NotFound => Ok(None),
            Err(why) if disk::is_of_reader(&why) => Err(Fault::Denied { why: why.to_string() }),
            Err(why) => Err(Fault::Unreadable { why: why.to_string() }),
        }
    }

    /// The bytes of a file, or what is wrong with it. That this process may not read the file is an error: nothing is known
    /// of the file then.
    ///
    /// # Errors
    /// When this process may not read the file.
    pub(super) fn seen(&self, name: &str) -> Result<std::result::Result<Option<Vec<u8>>, Fault>> {
        match self.bytes(name) {
            Err(Fault::Denied { why }) => Err(Error::Denied { path: self.path(name), why }),
            other => Ok(other),
        }
    }

    /// Sets a tile aside that is bad and will be computed again.
    ///
    /// # Errors
    /// When it cannot be; when it may be good, as this process cannot read it.
    pub(super) fn expel_bad(&self, name: &str, fault: Fault, note: Note) -> Result<()> {
        match fault {
            Fault::Denied { why } => Err(Error::Denied { path: self.path(name), why }),
            fault => self.expel(name, &format!("{fault}; it is computed again"), note),
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
        disk::make_all(&bad)?;
        // What was set aside before stays.
        let mut place = bad.join(name);
        let mut number = 1;
        while place.symlink_metadata().is_ok() {
            number += 1;
            place = bad.join(format!("{name}.{number}"));
        }
        match door().rename(&self.path(name), &place) {
            // Another process was faster.
            Err(why) if why.kind() == ErrorKind::NotFound => Ok(()),
            other => other,
        }
    }

    /// The names in it that end like a tile's.
    pub(super) fn tiles(&self) -> Result<Vec<String>> {
        self.ending(TILE)
    }

    /// The names in it with this end.
    pub(super) fn ending(&self, end: &str) -> Result<Vec<String>> {
        Ok(self.entries()?.into_iter().filter(|name| name.ends_with(end)).collect())
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
        let names = door().names(&self.output.join(self.name)).map_err(|why| self.refused(&why))?;
        Ok(names.into_iter().filter_map(|name| name.into_string().ok()).collect())
    }

    /// The error of an output directory that does not take what it should.
    pub(super) fn refused(&self, why: &io::Error) -> Error {
        Error::OutputDirectory { path: self.output.clone(), why: why.to_string() }
    }
}
