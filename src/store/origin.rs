//! `source.txt`: from which input file the results of a directory were made.
//!
//! The path is written as seen from the directory, so that it still holds when both are moved together.

use std::ffi::OsString;
use std::io;
use std::path::{Component, Path, PathBuf};

use crate::disk;
use crate::store::claim::Claim;

/// The name of the file.
pub const SOURCE: &str = "source.txt";

/// The input file that `directory` says it was made from, as written there; `None` where it says nothing.
#[must_use]
pub fn written(directory: &Path) -> Option<PathBuf> {
    let text = String::from_utf8(disk::read(&directory.join(SOURCE)).ok()?).ok()?;
    let path = text.lines().next().filter(|line| !line.trim().is_empty())?;
    Some(directory.join(path))
}

/// The real path of the input file that `directory` was made from; `None` where it names none, or that file is no longer
/// there.
#[must_use]
pub fn of(directory: &Path) -> Option<PathBuf> {
    written(directory)?.canonicalize().ok()
}

/// Whether a directory says that it was made from this file.
#[must_use]
pub fn is_of(directory: &Path, input: &Path) -> bool {
    of(directory).zip(input.canonicalize().ok()).is_some_and(|(there, here)| there == here)
}

/// Writes into a directory that it is made from `input`. What is no file (a pipe), or has a name that is no text, is left out.
///
/// # Errors
/// When the directory cannot be written.
pub fn record(directory: &Path, input: &Path) -> io::Result<()> {
    let (Ok(here), Ok(input)) = (directory.canonicalize(), input.canonicalize()) else { return Ok(()) };
    let path = seen_from(&here, &input);
    let Some(text) = path.to_str().filter(|text| input.is_file() && !text.contains(char::is_control)) else {
        return Ok(());
    };
    // Another process that has the claim writes the same.
    Claim::take(&directory.join(SOURCE))?.map_or(Ok(()), |claim| claim.write(format!("{text}\n").as_bytes()))
}

/// A path as seen from a directory, both without links; as it is where they have nothing in common.
fn seen_from(directory: &Path, path: &Path) -> PathBuf {
    let common =
        directory.components().zip(path.components()).take_while(|(one, other)| one == other).count();
    if common == 0 {
        return path.to_owned();
    }
    let up = directory.components().skip(common).map(|_| OsString::from(".."));
    let down = path.components().skip(common).map(Component::as_os_str).map(OsString::from);
    up.chain(down).collect()
}
