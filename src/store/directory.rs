//! The tiles of an output directory.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use super::claim::Claim;
use super::description::Description;
use super::direct::Room;
pub use super::folder::Note;
use super::folder::{BAD, Folder, TILE};
use super::tile::Fault;
use crate::error::{Error, Result};
use crate::map::Record;

/// The directory of the tiles inside the output directory.
pub const TILES: &str = "tiles";
/// What they are.
pub const DESCRIPTION: &str = "sweep.json";

/// An output directory with tiles.
#[derive(Debug)]
pub struct Store {
    /// The output directory.
    pub directory: PathBuf,
    /// What its tiles are.
    pub description: Description,
}

impl Store {
    /// The tiles that are in a directory.
    ///
    /// # Errors
    /// When there are none, or their description cannot be read.
    pub fn open(directory: &Path) -> Result<Store> {
        let path = directory.join(TILES).join(DESCRIPTION);
        let bytes = match std::fs::read(&path) {
            Err(why) if why.kind() == ErrorKind::NotFound => {
                return Err(Error::NoTiles { path: directory.to_owned() });
            }
            other => {
                other.map_err(|why| Error::BadDescription { path: path.clone(), why: why.to_string() })?
            }
        };
        let description =
            Description::from_bytes(&bytes).map_err(|why| Error::BadDescription { path, why })?;
        Ok(Store { directory: directory.to_owned(), description })
    }

    /// Opens a directory for the tiles of a sweep; it may hold some of them already. A sweep of a single tile
    /// that stands there gives way: it is cheap to compute again.
    ///
    /// # Errors
    /// When it holds tiles of another sweep, or cannot be written.
    pub fn begin(directory: &Path, description: Description, note: Note) -> Result<Store> {
        let folder = Folder::new(directory, TILES);
        folder.make()?;
        let cannot = |why: io::Error| folder.refused(&why);
        let store = Store { directory: directory.to_owned(), description };
        match Store::open(directory) {
            Ok(other) if store.is_same(&other) => {
                return Ok(Store { description: other.description, ..store });
            }
            Ok(other) => {
                let (done, total) = (other.done()?, other.description.tiling.count());
                if total > 1 && done > 0 {
                    return Err(Error::OtherSweep { path: directory.to_owned(), done, total });
                }
                for number in 0..total.min(1) {
                    remove(&other.path(number)).map_err(cannot)?;
                }
            }
            Err(Error::NoTiles { .. }) => {}
            Err(why) => {
                folder.set_aside(DESCRIPTION).map_err(cannot)?;
                note(&format!("{why}; it was set aside in `{TILES}/{BAD}` and written again"));
            }
        }
        let path = directory.join(TILES).join(DESCRIPTION);
        // Another process that holds the claim writes the same.
        if let Some(mut claim) = Claim::take(&path).map_err(cannot)? {
            let mut file = io::BufWriter::new(claim.emptied().map_err(cannot)?);
            store.description.write(&mut file).and_then(|()| io::Write::flush(&mut file)).map_err(cannot)?;
            drop(file);
            claim.publish().map_err(cannot)?;
        }
        Ok(store)
    }

    /// Whether two stores have the same tiles.
    #[must_use]
    pub fn is_same(&self, other: &Store) -> bool {
        let (one, two) = (&self.description, &other.description);
        one.id == two.id && one.tiling == two.tiling
    }

    /// The name of tile `number`: its number and the start of its key.
    #[must_use]
    pub fn name(&self, number: usize) -> String {
        format!("{number:08}-{}{TILE}", self.description.tile(number).key())
    }

    /// The path of tile `number`.
    #[must_use]
    pub fn path(&self, number: usize) -> PathBuf {
        self.folder().path(&self.name(number))
    }

    /// Claims tile `number`; `None` while another process computes it.
    ///
    /// # Errors
    /// When the directory cannot be written or locked.
    pub fn claim(&self, number: usize) -> Result<Option<Claim>> {
        Claim::take(&self.path(number)).map_err(|why| self.cannot_write(number, &why))
    }

    /// Writes a tile that was claimed; `room` may be used again.
    ///
    /// # Errors
    /// When the disk is full, read-only or gone; the other tiles stay as they are.
    pub fn write(&self, claim: Claim, number: usize, records: Vec<Record>, room: &mut Room) -> Result<()> {
        let tile = self.description.tile(number);
        tile.write_into(records.into(), room.take(tile.size()));
        claim.write_large(room).map_err(|why| self.cannot_write(number, &why))
    }

    fn cannot_write(&self, number: usize, why: &io::Error) -> Error {
        let total = self.description.tiling.count();
        Error::WriteTile {
            path: self.path(number),
            why: why.to_string(),
            done: self.done().unwrap_or_default(),
            total,
        }
    }

    /// The bytes of tile `number`, checked, as records; `None` when it is not there.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn read(&self, number: usize) -> std::result::Result<Option<Vec<Record>>, Fault> {
        self.folder().read(&self.name(number), &self.description.tile(number))
    }

    /// Whether tile `number` is there and good; one that is bad is set aside and named.
    ///
    /// # Errors
    /// When it is bad and cannot be set aside.
    pub fn verify(&self, number: usize, note: Note) -> Result<bool> {
        if let Ok(found) = self.read(number) {
            return Ok(found.is_some());
        }
        // Under the claim, lest one is set aside that another process has just written in its place.
        let Some(_claim) = self.claim(number)? else { return Ok(false) };
        match self.read(number) {
            Ok(found) => Ok(found.is_some()),
            Err(fault) => {
                let what = format!("{fault}; it is computed again");
                self.folder().expel(&self.name(number), &what, note)?;
                Ok(false)
            }
        }
    }

    /// Sets files aside that have the form of a tile's name and are no tile of this sweep.
    ///
    /// # Errors
    /// When the directory cannot be read or written.
    pub fn expel_strangers(&self, note: Note) -> Result<()> {
        let folder = self.folder();
        let strangers = folder.tiles()?.into_iter().filter(|name| self.number(name).is_none());
        strangers.into_iter().try_for_each(|name| folder.expel(&name, "it is no tile of this sweep", note))
    }

    /// Removes what a process that was killed has left of a file that is there by now.
    ///
    /// # Errors
    /// When the directory cannot be read or written.
    pub fn clean(&self) -> Result<()> {
        self.folder().clean()
    }

    /// How many of its tiles are there, bad ones included.
    ///
    /// # Errors
    /// When the directory cannot be read.
    pub fn done(&self) -> Result<usize> {
        Ok(self.numbers()?.len())
    }

    /// The numbers of its tiles that are there, bad ones included, in order.
    ///
    /// # Errors
    /// When the directory cannot be read.
    pub fn numbers(&self) -> Result<Vec<usize>> {
        let mut numbers: Vec<usize> =
            self.folder().tiles()?.iter().filter_map(|name| self.number(name)).collect();
        numbers.sort_unstable();
        Ok(numbers)
    }

    /// Removes an empty store, so that a run of which nothing came leaves nothing.
    pub fn remove_if_empty(&self) {
        let tiles = self.directory.join(TILES);
        let Ok(entries) = std::fs::read_dir(&tiles) else { return };
        let only = entries.flatten().all(|entry| entry.file_name() == DESCRIPTION);
        if only {
            // Fails, as it should, when another process has begun a tile in between.
            let _ = std::fs::remove_file(tiles.join(DESCRIPTION));
            let _ = std::fs::remove_dir(tiles);
        }
    }

    /// The number of the tile of this name; `None` when it is none of this sweep.
    fn number(&self, name: &str) -> Option<usize> {
        let number = name.split_once('-')?.0.parse().ok()?;
        (number < self.description.tiling.count() && self.name(number) == name).then_some(number)
    }

    /// Where its tiles are.
    fn folder(&self) -> Folder {
        Folder::new(&self.directory, TILES)
    }
}

fn remove(path: &Path) -> io::Result<()> {
    match std::fs::remove_file(path) {
        Err(why) if why.kind() == ErrorKind::NotFound => Ok(()),
        other => other,
    }
}
