//! The table of measured speed and error that choices come from: where it stands, and how rows get into it.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use crate::cli::error::{Error, Result};
use crate::cli::output::{cannot, claim};
use crate::cli::talk::note;
use squealmap::disk;
use squealmap::store::directory::Note;
use squealmap::sweep::accuracy::frontier::Frontier;
use squealmap::sweep::accuracy::row::{Row, from_csv, to_csv};
use squealmap::sweep::spec::Spec;

/// The name of the table.
const TABLE: &str = "accuracy.csv";

/// Where the table of this user stands; `None` where the system has no such place.
fn place() -> Option<PathBuf> {
    Some(dirs::cache_dir()?.join(env!("CARGO_PKG_NAME")).join(TABLE))
}

/// The measurements that a choice for this sweep is made from: those of this machine if they cover the sweep, or else those
/// that are shipped.
pub(crate) fn of(spec: &Spec, note: Note) -> Frontier {
    let measured = place().and_then(|path| match read(&path) {
        Ok(rows) => Some(Frontier::measured(rows, format!("`{}`", path.display()))),
        Err(why) => {
            note(&format!("{why}; the table that is shipped with the program takes its place"));
            None
        }
    });
    measured.filter(|frontier| frontier.covers(spec)).unwrap_or_else(|| Frontier::shipped().clone())
}

/// Whether a table can be written and the rows in it kept, told before hours are spent on measuring more.
pub(crate) fn writable(asked: Option<&Path>) -> Result<()> {
    let Some(path) = asked.map(Path::to_owned).or_else(place) else { return Ok(()) };
    if let Some(parent) = path.parent() {
        disk::make_all(parent).map_err(|why| cannot(&path, &why))?;
    }
    let _claim = claim(&path)?;
    read(&path).map(drop)
}

/// Puts the rows of a measurement in the place of older ones of the same scene. Returns the file, if there is one to write.
pub(crate) fn store(asked: Option<PathBuf>, rows: &[Row]) -> Result<Option<PathBuf>> {
    let Some(path) = asked.or_else(place) else {
        note("this system has no cache directory: give --store FILE to keep the table for `run --accuracy`");
        return Ok(None);
    };
    if let Some(parent) = path.parent() {
        disk::make_all(parent).map_err(|why| cannot(&path, &why))?;
    }
    // Held while it is read, lest the rows of another process are lost.
    let claim = claim(&path)?;
    let mut all = read(&path)?;
    all.retain(|row| rows.iter().all(|new| new.scene != row.scene));
    all.extend_from_slice(rows);
    claim.write(&to_csv(&all)?).map_err(|why| cannot(&path, &why))?;
    Ok(Some(path))
}

/// The rows of a table; none where there is none.
fn read(path: &Path) -> Result<Vec<Row>> {
    let bad = |why| Error::BadFrontier { path: path.to_owned(), why };
    match disk::read(path) {
        Ok(bytes) => from_csv(&bytes).map_err(bad),
        Err(why) if why.kind() == ErrorKind::NotFound => Ok(Vec::new()),
        Err(why) => Err(bad(why.to_string())),
    }
}
