//! The tables beside a picture. A picture says which tables belong to it, and those of an older picture are removed with it.

use std::path::Path;

use crate::cli::plot_map::{TABLES, Tables};
use crate::cli::talk::note;
use squealmap::disk;
use squealmap::disk::door;

/// The words before the list of tables in the metadata of a picture.
const BESIDE: &str = "; beside it: ";
/// The end of the metadata.
const END: &str = "</metadata>";
/// The characters of a checksum that are enough to tell two tables apart.
const CHECKSUM: usize = 16;

/// A picture whose metadata name the tables beside it, each with the beginning of its BLAKE3 checksum.
pub(crate) fn with_tables(svg: String, tables: &Tables) -> String {
    let each = tables.iter().map(|(name, bytes)| format!("{name} {}", checksum(bytes)));
    let list = each.collect::<Vec<_>>().join(", ");
    if list.is_empty() { svg } else { svg.replacen(END, &format!("{BESIDE}{list}{END}"), 1) }
}

fn checksum(bytes: &[u8]) -> String {
    blake3::hash(bytes).to_hex()[..CHECKSUM].to_owned()
}

/// A table in the directory of a picture that does not have it.
#[derive(Debug)]
pub(crate) struct Stale {
    name: &'static str,
    /// Whether it is as it was written with the picture before.
    unchanged: bool,
}

/// The tables in a directory that are not among `written`, the files that are going to be written. `picture`, the older
/// picture, says how they were when it was made: each is unchanged since or not.
pub(crate) fn stale(directory: &Path, picture: &str, written: &[&str]) -> Vec<Stale> {
    let before = disk::read(&directory.join(picture)).unwrap_or_default();
    let before = String::from_utf8_lossy(&before);
    let beside = before.split_once(END).and_then(|(metadata, _)| metadata.rsplit_once(BESIDE));
    let beside = beside.map_or("", |(_, list)| list);
    let of = |name: &'static str| {
        let bytes = disk::read(&directory.join(name)).ok()?;
        let as_written = format!("{name} {}", checksum(&bytes));
        Some(Stale { name, unchanged: beside.split(", ").any(|one| one == as_written) })
    };
    TABLES.into_iter().filter(|name| !written.contains(name)).filter_map(of).collect()
}

/// Removes what the program wrote itself, and names what it did not, or not so.
pub(crate) fn remove(directory: &Path, stale: &[Stale]) {
    for Stale { name, unchanged } in stale {
        let path = directory.join(name);
        if *unchanged && door().remove(&path).is_ok() {
            note(&format!("removed `{}`, which belonged to the picture before", path.display()));
        } else {
            note(&format!("`{}` does not belong to this picture; it stays as it is", path.display()));
        }
    }
}
