//! `map.csv`, figures and manifest of a directory of tiles, read tile by tile.

use std::io::{self, Write};
use std::path::PathBuf;
use std::thread;
use std::time::Duration;

use squealmap::Result;
use squealmap::export::csv::MapCsv;
use squealmap::export::figure::MapFigure;
use squealmap::export::manifest::{self, Run};
use squealmap::label::Tally;
use squealmap::map::Record;
use squealmap::store::claim::Claim;
use squealmap::store::directory::Store;
use squealmap::store::space::MOST_ROWS;

use crate::cli::output::{cannot, claim};
use crate::cli::{note, png_of};

/// What is written.
pub(crate) const FILES: [&str; 4] = ["map.csv", "manifest.json", "map.png", "map.svg"];

/// Between two looks at results that another process writes.
const WAIT: Duration = Duration::from_millis(50);

/// Records beside the tiles: those of a tile that was stopped on its way.
pub(crate) type Partial<'a> = Option<(usize, &'a [Record])>;

/// What came of writing results.
pub(crate) enum Results {
    /// They are written.
    Written { paths: Vec<PathBuf>, tally: Tally },
    /// They were there already, or another process has just written them.
    Current,
    /// A tile is bad: nothing was written.
    BadTile,
}

/// Writes all files or none: first under temporary names, then renamed; the manifest, which is the claim on all
/// of them, last. Tiles that are not there are `not_computed`.
pub(crate) fn write(store: &Store, partial: Partial, run: &Run) -> Result<Results> {
    let path = |name: &str| store.directory.join(name);
    let Some(mut manifest_file) = claim_or_current(store, run)? else { return Ok(Results::Current) };
    let description = &store.description;
    let sheet = description.sheet();
    let tiling = description.tiling;
    let mut figure = MapFigure::new(sheet);
    let csv_path = path(FILES[0]);
    let mut table = if tiling.instances <= MOST_ROWS { Some(claim(&csv_path)?) } else { None };
    let mut rows = match &mut table {
        Some(table) => Some(MapCsv::new(sheet, table.emptied().map_err(|why| cannot(&csv_path, &why))?)?),
        None => None,
    };
    for number in 0..tiling.count() {
        let bounds = tiling.bounds(number);
        let Ok(found) = records(store, number, partial) else { return Ok(Results::BadTile) };
        match &found {
            Some(records) => figure.add(bounds.start, records),
            None => figure.add_missing(bounds.len()),
        }
        if let Some(rows) = &mut rows {
            let missing = || vec![Record::NOT_COMPUTED; bounds.len()];
            rows.add(bounds.start, &found.unwrap_or_else(missing))?;
        }
    }
    if table.is_none() {
        note(&format!(
            "no {} of more than {MOST_ROWS} rows is written; `squealmap export {} --format csv` does",
            FILES[0],
            store.directory.display()
        ));
        // One of another sweep must not stand beside these results.
        if csv_path.exists() && manifest_of(store)["sweep_id"] != description.id.to_string() {
            std::fs::remove_file(&csv_path).map_err(|why| cannot(&csv_path, &why))?;
        }
    }
    let tally = figure.tally().clone();
    let svg = figure.svg();
    let text = manifest::manifest(sheet, &description.resolved, &tally, run)?;
    let mut files: Vec<(PathBuf, Claim)> = Vec::new();
    for (name, bytes) in [(FILES[2], png_of(&svg)?), (FILES[3], svg.into_bytes())] {
        let mut file = claim(&path(name))?;
        fill(&mut file, &bytes).map_err(|why| cannot(&path(name), &why))?;
        files.push((path(name), file));
    }
    let manifest_path = path(FILES[1]);
    fill(&mut manifest_file, &text).map_err(|why| cannot(&manifest_path, &why))?;
    files.insert(0, (manifest_path, manifest_file));
    files.extend(table.map(|table| (csv_path, table)));
    let mut paths = Vec::new();
    // From the last to the first: the manifest says that the others are there.
    for (path, file) in files.into_iter().rev() {
        file.publish().map_err(|why| cannot(&path, &why))?;
        paths.push(path);
    }
    paths.sort();
    Ok(Results::Written { paths, tally })
}

/// The claim on the results; nothing when they are complete and current.
fn claim_or_current(store: &Store, run: &Run) -> Result<Option<Claim>> {
    let path = store.directory.join(FILES[1]);
    loop {
        let claim = Claim::take(&path).map_err(|why| cannot(&path, &why))?;
        if run.stopped.is_none() && are_current(store) {
            return Ok(None);
        }
        match claim {
            Some(claim) => return Ok(Some(claim)),
            None => thread::sleep(WAIT),
        }
    }
}

/// The manifest that is there; null where there is none.
fn manifest_of(store: &Store) -> serde_json::Value {
    let bytes = std::fs::read(store.directory.join(FILES[1])).unwrap_or_default();
    serde_json::from_slice(&bytes).unwrap_or_default()
}

/// Whether the files are there and those of all tiles of this sweep.
fn are_current(store: &Store) -> bool {
    let manifest = manifest_of(store);
    let wanted = if store.description.tiling.instances <= MOST_ROWS { &FILES[..] } else { &FILES[1..] };
    manifest["complete"] == true
        && manifest["sweep_id"] == store.description.id.to_string()
        && manifest["title"] == store.description.title
        && wanted.iter().all(|name| store.directory.join(name).is_file())
}

/// The records of a tile, or of the one that was stopped; `None` of one that was not begun.
fn records(
    store: &Store,
    number: usize,
    partial: Partial,
) -> std::result::Result<Option<Vec<Record>>, squealmap::store::tile::Fault> {
    let of_partial = |(of, records): (usize, &[Record])| (of == number).then(|| records.to_vec());
    Ok(store.read(number)?.or_else(|| partial.and_then(of_partial)))
}

fn fill(claim: &mut Claim, bytes: &[u8]) -> io::Result<()> {
    claim.emptied()?.write_all(bytes)
}
