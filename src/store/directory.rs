//! The tiles of an output directory.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use crate::disk;
use crate::disk::door;
use crate::engine::record::Record;
use crate::model::status::Status;
use crate::store::claim::Claim;
use crate::store::description::{Description, Unread};
use crate::store::direct::Room;
use crate::store::error::{Error, Result};
pub use crate::store::folder::Note;
use crate::store::folder::{Folder, SOME, TILE, Tile};
use crate::store::identity::Id;
use crate::store::tile::{Checksum, Fault, instances_in, sweep_in};

/// The directory of the tiles inside the output directory.
pub const TILES: &str = "tiles";
/// The name of the file that describes the tiles.
pub const DESCRIPTION: &str = "sweep.json";

/// An output directory with tiles.
#[derive(Debug)]
pub struct Store {
    /// The output directory.
    pub directory: PathBuf,
    /// Describes its tiles.
    pub description: Description,
}

impl Store {
    /// The tiles that are in a directory.
    ///
    /// # Errors
    /// When there are none, or their description cannot be read.
    pub fn open(directory: &Path) -> Result<Store> {
        let path = directory.join(TILES).join(DESCRIPTION);
        let bytes = match disk::read(&path) {
            Err(why) if why.kind() == ErrorKind::NotFound => {
                return Err(Error::NoTiles { path: directory.to_owned() });
            }
            Err(why) if disk::is_of_reader(&why) => return Err(Error::Denied { path, why: why.to_string() }),
            other => {
                other.map_err(|why| Error::BadDescription { path: path.clone(), why: why.to_string() })?
            }
        };
        let description = Description::from_bytes(&bytes).map_err(|why| match why {
            Unread::Format(found) => Error::OtherFormat { path, found },
            Unread::Bad(why) => Error::BadDescription { path, why },
        })?;
        Ok(Store { directory: directory.to_owned(), description })
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

    /// The path of the file that keeps the records of tile `number` while the tile is not complete.
    #[must_use]
    pub fn path_of_some(&self, number: usize) -> PathBuf {
        self.folder().path(&self.name_of_some(number))
    }

    fn name_of_some(&self, number: usize) -> String {
        let name = self.name(number);
        format!("{}{SOME}", name.strip_suffix(TILE).unwrap_or(&name))
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
        claim.write_large(room).map_err(|why| self.cannot_write(number, &why))?;
        // It says no more than the tile; what a crash leaves of it the next run removes.
        let _ = disk::remove_if_there(&self.path_of_some(number));
        Ok(())
    }

    /// Keeps the records of a tile that was claimed and is stopped before it is complete. Those that were not computed are
    /// [`Record::NOT_COMPUTED`]; for them the records of an earlier stop stay.
    ///
    /// # Errors
    /// When the disk is full, read-only or gone.
    pub fn keep(&self, _claim: &Claim, number: usize, mut records: Vec<Record>) -> Result<()> {
        let before = self.read_some(number).ok().flatten().unwrap_or_default();
        for (record, before) in records.iter_mut().zip(before) {
            if record.status == Status::NotComputed {
                *record = before;
            }
        }
        let bytes = self.description.tile(number).write(&records);
        let cannot = |why: io::Error| self.cannot_write(number, &why);
        match Claim::take(&self.path_of_some(number)).map_err(cannot)? {
            Some(claim) => claim.write(&bytes).map_err(cannot),
            None => Err(cannot(io::Error::other("another process is writing it"))),
        }
    }

    /// The records that a stopped run has kept of tile `number`; `None` where there are none.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn read_some(&self, number: usize) -> std::result::Result<Option<Vec<Record>>, Fault> {
        let bytes = self.folder().bytes(&self.name_of_some(number))?;
        bytes.map(|bytes| self.description.tile(number).read_some(&bytes)).transpose()
    }

    /// The records that a stopped run has kept of tile `number`; `None` where there are none. A bad file is set aside and
    /// named.
    ///
    /// # Errors
    /// When it is bad and cannot be set aside.
    pub fn kept(&self, number: usize, note: Note) -> Result<Option<Vec<Record>>> {
        match self.read_some(number) {
            Ok(found) => Ok(found),
            Err(fault) => self.folder().expel_bad(&self.name_of_some(number), fault, note).map(|()| None),
        }
    }

    /// The bad ones among the files that stopped runs have kept: the path of each, and what is wrong with it.
    ///
    /// # Errors
    /// When the directory cannot be read.
    pub fn bad_kept(&self) -> Result<Vec<(String, Fault)>> {
        let folder = self.folder();
        let fault = |name: String| {
            let fault = self.read_some(self.number_of_some(&name)?).err()?;
            Some((folder.path(&name).display().to_string(), fault))
        };
        Ok(folder.ending(SOME)?.into_iter().filter_map(fault).collect())
    }

    /// The instances that stopped runs have kept of tiles that are not there.
    ///
    /// # Errors
    /// When the directory cannot be read.
    pub fn kept_instances(&self) -> Result<usize> {
        let there = self.numbers()?;
        let done = |records: &Vec<Record>| {
            records.iter().filter(|record| record.status != Status::NotComputed).count()
        };
        let of =
            |name: &String| self.number_of_some(name).filter(|number| there.binary_search(number).is_err());
        let numbers = self.folder().ending(SOME)?;
        let kept = numbers.iter().filter_map(of).filter_map(|number| self.read_some(number).ok().flatten());
        Ok(kept.map(|records| done(&records)).sum())
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

    /// The records of tile `number`, checked; `None` when it is not there.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn read(&self, number: usize) -> std::result::Result<Option<Vec<Record>>, Fault> {
        Ok(self.read_tile(number)?.map(|tile| tile.records))
    }

    /// Tile `number`, checked: its records and its checksum; `None` when it is not there.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn read_tile(&self, number: usize) -> std::result::Result<Option<Tile>, Fault> {
        self.folder().read(&self.name(number), &self.description.tile(number))
    }

    /// The checksum of all its tiles as they are now, from the ends of their files alone; `None` when one is not there.
    #[must_use]
    pub fn fingerprint(&self) -> Option<Id> {
        let mut all = Fingerprint::default();
        for number in 0..self.description.tiling.count() {
            all.add(&self.folder().checksum(&self.name(number))?);
        }
        Some(all.finish())
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
            Err(fault) => self.folder().expel_bad(&self.name(number), fault, note).map(|()| false),
        }
    }

    /// Sets files aside that have the form of a tile's name and are no tile of this sweep.
    ///
    /// # Errors
    /// When the directory cannot be read or written; when one is a whole tile of this sweep, cut otherwise.
    pub fn expel_strangers(&self, note: Note) -> Result<()> {
        self.strangers()?.into_iter().try_for_each(|name| {
            if self.whole(&name)? == Some(self.description.id) {
                return Err(Error::OtherCut { path: self.folder().path(&name) });
            }
            self.folder().expel(&name, "it is no tile of this sweep", note)
        })
    }

    /// Removes whole tiles of other sweeps, and what was kept of them.
    ///
    /// # Errors
    /// When the directory cannot be read or written.
    pub fn remove_strangers(&self) -> Result<()> {
        let folder = self.folder();
        self.strangers()?.into_iter().try_for_each(|name| {
            disk::remove_if_there(&folder.path(&name)).map_err(|why| folder.refused(&why))
        })
    }

    /// The names of files that have the form of a tile's name and are no tile of this sweep.
    pub(super) fn strangers(&self) -> Result<Vec<String>> {
        let folder = self.folder();
        let tiles = folder.tiles()?.into_iter().filter(|name| self.number(name).is_none());
        let kept = folder.ending(SOME)?.into_iter().filter(|name| self.number_of_some(name).is_none());
        Ok(tiles.chain(kept).collect())
    }

    /// The sweep that a whole tile belongs to; `None` when there is no whole tile of this name.
    pub(super) fn whole(&self, name: &str) -> Result<Option<Id>> {
        let bytes = self.folder().seen(name)?.ok().flatten();
        Ok(bytes.and_then(|bytes| instances_in(&bytes).and(sweep_in(&bytes))))
    }

    /// Removes what a process that was killed has left of a file that is there by now.
    ///
    /// # Errors
    /// When the directory cannot be read or written.
    pub fn clean(&self) -> Result<()> {
        let folder = self.folder();
        folder.clean()?;
        let of_tiles = folder.ending(SOME)?.into_iter();
        let stale =
            of_tiles.filter(|name| self.number_of_some(name).is_some_and(|of| self.path(of).exists()));
        stale.into_iter().try_for_each(|name| {
            disk::remove_if_there(&folder.path(&name)).map_err(|why| folder.refused(&why))
        })
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

    /// Removes an empty store, so that a run without a result leaves nothing behind.
    pub fn remove_if_empty(&self) {
        let tiles = self.directory.join(TILES);
        let Ok(names) = door().names(&tiles) else { return };
        if names.iter().all(|name| name == DESCRIPTION) {
            // Fails, as it should, when another process has begun a tile in between.
            let _ = door().remove(&tiles.join(DESCRIPTION));
            let _ = door().remove_folder(&tiles);
        }
    }

    /// The number of the tile of this name; `None` when it is none of this sweep.
    fn number(&self, name: &str) -> Option<usize> {
        let number = name.split_once('-')?.0.parse().ok()?;
        (number < self.description.tiling.count() && self.name(number) == name).then_some(number)
    }

    /// The number of the tile that a file of this name keeps some records of; `None` when it is none of this sweep.
    fn number_of_some(&self, name: &str) -> Option<usize> {
        self.number(&format!("{}{TILE}", name.strip_suffix(SOME)?))
    }

    /// Where its tiles are.
    pub(super) fn folder(&self) -> Folder {
        Folder::new(&self.directory, TILES)
    }
}

/// The checksum of the checksums of tiles, in their order.
#[derive(Debug, Default)]
pub struct Fingerprint(blake3::Hasher);

impl Fingerprint {
    /// Takes the next tile.
    pub fn add(&mut self, checksum: &Checksum) {
        self.0.update(checksum);
    }

    /// The checksum of all.
    #[must_use]
    pub fn finish(&self) -> Id {
        Id(*self.0.finalize().as_bytes())
    }
}
