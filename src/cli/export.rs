//! `squealmap export`: the tiles of a directory in a format that other programs read.

use std::io::{self, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::cli::error::{Error, Result};
use crate::cli::output::{cannot, cannot_table, claim, list};
use crate::cli::run::missing;
use crate::cli::talk::{note, print};
use clap::{Args, ValueEnum};
use squealmap::disk;
use squealmap::disk::{Handle, How, door};
use squealmap::engine::record::Record;
use squealmap::model::status::Status;
use squealmap::results::csv::MapCsv;
use squealmap::results::netcdf::NetCdf;
use squealmap::results::parquet::MapParquet;
use squealmap::results::zarr::{METADATA, Zarr};
use squealmap::store::directory::Store;

/// Arguments of `export`.
#[derive(Debug, Args)]
pub(crate) struct Export {
    /// Output directory of a run
    directory: PathBuf,
    /// What to write: map.csv, map.zarr (Zarr v3), map.nc (NetCDF classic) or map.parquet
    #[arg(long, value_enum)]
    format: Format,
    /// File, for zarr directory, to write [default: the name above, in the output directory; partial.… where tiles are missing]
    #[arg(short, long, value_name = "PATH")]
    output: Option<PathBuf>,
    /// Also where tiles are missing: their instances are `not_computed`
    #[arg(long)]
    partial: bool,
    /// Replace the file that is there under the name of --output
    #[arg(long)]
    force: bool,
}

/// The values of `--format`.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Format {
    Csv,
    Zarr,
    Netcdf,
    Parquet,
}

impl Format {
    /// The end of the name of its file.
    fn ending(self) -> &'static str {
        match self {
            Format::Csv => "csv",
            Format::Zarr => "zarr",
            Format::Netcdf => "nc",
            Format::Parquet => "parquet",
        }
    }

    /// Its file where none is named. One with holes never stands where the whole map would.
    fn file(self, is_whole: bool) -> String {
        let stem = if is_whole { "map" } else { "partial" };
        format!("{stem}.{}", self.ending())
    }
}

impl Export {
    pub(crate) fn execute(self) -> Result<()> {
        let store = Store::open(&self.directory)?;
        let total = store.description.tiling.count();
        let lacking = missing(&store, 0..total)?.len();
        if lacking > 0 && !self.partial {
            let (path, done) = (self.directory, total - lacking);
            return Err(Error::TilesMissing { path, done, total });
        }
        if let Some(path) = self.output.as_ref().filter(|_| !matches!(self.format, Format::Zarr)) {
            replaceable(path, self.force)?;
        }
        let whole = store.directory.join(self.format.file(true));
        let path = self.output.unwrap_or_else(|| store.directory.join(self.format.file(lacking == 0)));
        if lacking > 0 && is_same(&path, &whole) {
            return Err(Error::PartialAsWhole { path });
        }
        if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
            disk::make_all(folder).map_err(|why| cannot(&path, &why))?;
        }
        let mut tiles = Tiles { store: &store, partial: lacking > 0, last: None };
        match self.format {
            Format::Csv => csv(&mut tiles, &path)?,
            Format::Zarr => zarr(&mut tiles, &path)?,
            Format::Netcdf => netcdf(&mut tiles, &path)?,
            Format::Parquet => parquet(&mut tiles, &path)?,
        }
        if lacking > 0 {
            note(&format!("{} of {total} tiles are there; the rest is `not_computed`", total - lacking));
        }
        print(&list(&[path]));
        Ok(())
    }
}

/// Refuses a file that is there, unless it may be replaced, and whatever is no file.
fn replaceable(path: &Path, force: bool) -> Result<()> {
    let why = match path.symlink_metadata() {
        Err(_) => return Ok(()),
        Ok(found) if found.is_file() && force => return Ok(()),
        Ok(found) if found.is_file() => {
            "is there already; name another file with -o, or replace it with --force"
        }
        Ok(_) => "is a directory, a link, a pipe or a device; name a file with -o",
    };
    Err(Error::ExportThere { path: path.to_owned(), why })
}

/// Whether two paths name one file, which need not be there.
fn is_same(one: &Path, two: &Path) -> bool {
    let folder = |path: &Path| {
        let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
        parent.unwrap_or(Path::new(".")).canonicalize().ok()
    };
    one.file_name() == two.file_name() && folder(one) == folder(two)
}

/// The records of a directory in order, one tile in memory.
struct Tiles<'a> {
    store: &'a Store,
    /// Whether some may be missing.
    partial: bool,
    last: Option<(usize, Vec<Record>)>,
}

impl Tiles<'_> {
    /// The records of tile `number`; not computed where it is missing and may be.
    fn tile(&mut self, number: usize) -> Result<&[Record]> {
        if self.last.as_ref().is_none_or(|(last, _)| *last != number) {
            let found = self.store.read(number).map_err(|fault| {
                let path = self.store.path(number);
                Error::BadTile { path, fault: fault.into() }
            })?;
            let found = match found {
                None if self.partial => self.store.kept(number, &note)?,
                // It was there a moment ago.
                None => {
                    let (path, total) = (self.store.directory.clone(), self.store.description.tiling.count());
                    return Err(Error::TilesMissing { path, done: self.store.done()?, total });
                }
                found => found,
            };
            let length = self.store.description.tiling.bounds(number).len();
            self.last = Some((number, found.unwrap_or_else(|| vec![Record::NOT_COMPUTED; length])));
        }
        Ok(self.last.as_ref().map_or(&[], |(_, records)| records))
    }

    /// Gives the records of every tile to `write`, with the first instance, in order.
    fn each(&mut self, mut write: impl FnMut(usize, &[Record]) -> Result<()>) -> Result<()> {
        let tiling = self.store.description.tiling;
        (0..tiling.count()).try_for_each(|number| write(tiling.bounds(number).start, self.tile(number)?))
    }

    /// The records of some instances.
    fn range(&mut self, range: Range<usize>) -> Result<Vec<Record>> {
        let size = self.store.description.tiling.tile;
        let mut records = Vec::with_capacity(range.len());
        while range.start + records.len() < range.end {
            let next = range.start + records.len();
            let tile = self.tile(next / size)?;
            let from = next % size;
            let to = tile.len().min(from + range.end - next);
            records.extend_from_slice(&tile[from..to]);
        }
        Ok(records)
    }
}

fn csv(tiles: &mut Tiles, path: &Path) -> Result<()> {
    let mut claim = claim(path)?;
    let file = claim.emptied().map_err(|why| cannot(path, &why))?;
    let full = |why| cannot_table(path, why);
    let mut table = MapCsv::new(tiles.store.description.sheet(), file).map_err(full)?;
    tiles.each(|first, records| table.add(first, records).map_err(full))?;
    claim.publish().map_err(|why| cannot(path, &why))
}

fn parquet(tiles: &mut Tiles, path: &Path) -> Result<()> {
    let mut claim = claim(path)?;
    let file = claim.emptied().map_err(|why| cannot(path, &why))?;
    let full = |why| cannot_table(path, why);
    let mut table = MapParquet::new(tiles.store.description.sheet(), file).map_err(full)?;
    tiles.each(|first, records| table.add(first, records).map_err(full))?;
    table.finish().map_err(full)?;
    claim.publish().map_err(|why| cannot(path, &why))
}

fn netcdf(tiles: &mut Tiles, path: &Path) -> Result<()> {
    let mut claim = claim(path)?;
    let netcdf = NetCdf::new(tiles.store.description.sheet());
    let failed = |why: io::Error| cannot(path, &why);
    let file = claim.emptied().map_err(failed)?;
    file.resize(netcdf.size()).and_then(|()| file.write_all(&netcdf.start())).map_err(failed)?;
    tiles.each(|first, records| {
        netcdf.pieces(first, records).iter().try_for_each(|(at, bytes)| {
            file.seek(SeekFrom::Start(*at)).and_then(|_| file.write_all(bytes)).map_err(failed)
        })
    })?;
    claim.publish().map_err(failed)
}

/// A directory of many files: made under another name, then renamed.
fn zarr(tiles: &mut Tiles, path: &Path) -> Result<()> {
    // Nobody else writes it as long as this is held; the file itself is never published.
    let _claim = claim(&beside(path, ".lock"))?;
    let part = beside(path, ".part");
    let failed = |why: io::Error| cannot(path, &why);
    if path.exists() && !path.join(METADATA).is_file() {
        return Err(failed(io::Error::other("it is there and is no Zarr group")));
    }
    let written = disk::remove_all(&part).map_err(failed).and_then(|()| zarr_files(tiles, &part));
    if written.is_err() {
        let _ = disk::remove_all(&part);
    }
    written?;
    // A folder takes the place of none: the one before steps aside until the new one is there.
    let old = beside(path, ".old");
    disk::remove_all(&old)
        .and_then(|()| if path.exists() { door().rename(path, &old) } else { Ok(()) })
        .and_then(|()| door().rename(&part, path))
        .and_then(|()| disk::lasting(path))
        .and_then(|()| disk::remove_all(&old))
        .map_err(failed)
}

/// The path with more at its end.
fn beside(path: &Path, end: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(end);
    PathBuf::from(name)
}

/// Writes the group, its own metadata last; every file and name lasts then.
fn zarr_files(tiles: &mut Tiles, part: &Path) -> Result<()> {
    let tile = tiles.store.description.tiling.tile;
    let zarr = Zarr::new(tiles.store.description.sheet(), tile);
    let mut folders = std::collections::BTreeSet::new();
    let mut write = |(name, bytes): (String, Vec<u8>)| {
        let path = part.join(name);
        let folder = path.parent().unwrap_or(part).to_owned();
        let new = if folders.contains(&folder) { Ok(Vec::new()) } else { disk::make_all(&folder) };
        let written = new
            .and_then(|_| Handle::open(&path, How::Write))
            .and_then(|mut file| file.write_all(&bytes).and_then(|()| file.sync()));
        folders.insert(folder);
        written.map_err(|why| cannot(&path, &why))
    };
    let (of_group, others): (Vec<_>, Vec<_>) =
        zarr.files().into_iter().partition(|(name, _)| name == METADATA);
    others.into_iter().try_for_each(&mut write)?;
    for number in 0..zarr.chunks() {
        let records = tiles.range(zarr.bounds(number))?;
        if records.iter().any(|record| record.status != Status::NotComputed) {
            zarr.chunk(number, &records).into_iter().try_for_each(&mut write)?;
        }
    }
    of_group.into_iter().try_for_each(&mut write)?;
    let lasting = |folder: &PathBuf| door().sync_folder(folder).map_err(|why| cannot(folder, &why));
    folders.iter().try_for_each(lasting)
}
