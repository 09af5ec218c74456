//! `map.csv`, figures and manifest of a directory of tiles, read tile by tile.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use crate::cli::error::Result;
use crate::cli::output::{cannot, cannot_table, claim, fill, filled, publish_with};
use crate::cli::pictures::png_of;
use crate::cli::summed::{Summed, unlike};
use crate::cli::talk;
use crate::cli::talk::note;
use serde::Deserialize;
use squealmap::disk;
use squealmap::engine::record::Record;
use squealmap::results::csv::MapCsv;
use squealmap::results::figure::map::MapFigure;
use squealmap::results::manifest;
use squealmap::results::manifest::{Manifest, OfTiles, Run, Sum, Sums};
use squealmap::store::claim::Claim;
use squealmap::store::directory::{Fingerprint, Store};
use squealmap::store::seal::is_intact;
use squealmap::store::space::MOST_ROWS;
use squealmap::sweep::label::Tally;

/// The files that are written.
pub(crate) const FILES: [&str; 4] = ["map.csv", MANIFEST, "map.png", "map.svg"];

/// The file whose being there says that the others are complete.
pub(crate) const MANIFEST: &str = "manifest.json";

/// Between two looks at results that another process writes.
const WAIT: Duration = Duration::from_millis(50);

/// The result of writing results.
pub(crate) enum Results {
    /// They are written.
    Written { paths: Vec<PathBuf>, tally: Tally, complete: bool },
    /// They were there already, or another process has just written them.
    Current,
    /// A tile is bad or not there: nothing was written.
    Lacking,
    /// Another process was writing them when this one was to stop.
    Stopped,
    /// This process was to stop while it read the tiles of a complete sweep: nothing was written.
    GivenUp,
    /// A run that was stopped has fewer instances than the results that are there, which stay.
    Fuller { tally: Tally },
}

/// Writes all files or none: first under temporary names, then renamed. The manifest, which is the claim on all of them,
/// comes last. Where `run` was stopped, tiles may be missing. Records that were kept of such a tile stand in its place, and
/// the rest is `not_computed`.
pub(crate) fn write(store: &Store, run: &Run, cancel: &AtomicBool) -> Result<Results> {
    let path = |name: &str| store.directory.join(name);
    let mut manifest_file = match claim_or_current(store, run, cancel)? {
        Claimed::Claim(claim) => claim,
        Claimed::Current => return Ok(Results::Current),
        Claimed::Stopped => return Ok(Results::Stopped),
    };
    let description = &store.description;
    let sheet = description.sheet();
    let tiling = description.tiling;
    let mut figure = MapFigure::new(sheet);
    let csv_path = path(FILES[0]);
    let table_full = |why: squealmap::results::error::Error| cannot_table(&csv_path, why);
    let mut table = if tiling.instances <= MOST_ROWS { Some(claim(&csv_path)?) } else { None };
    let mut rows = match &mut table {
        Some(table) => {
            let file = Summed::new(table.emptied().map_err(|why| cannot(&csv_path, &why))?);
            Some(MapCsv::new(sheet, file).map_err(table_full)?)
        }
        None => None,
    };
    let mut fingerprint = Some(Fingerprint::default());
    for number in 0..tiling.count() {
        // Of a run that was stopped what is done is written.
        if run.stopped.is_none() && cancel.load(Ordering::Relaxed) {
            return Ok(Results::GivenUp);
        }
        let bounds = tiling.bounds(number);
        let Ok(tile) = store.read_tile(number) else { return Ok(Results::Lacking) };
        if tile.is_none() && run.stopped.is_none() {
            return Ok(Results::Lacking);
        }
        match (&tile, &mut fingerprint) {
            (Some(tile), Some(fingerprint)) => fingerprint.add(&tile.checksum),
            _ => fingerprint = None,
        }
        let found = match tile {
            Some(tile) => Some(tile.records),
            None => store.kept(number, &note)?,
        };
        match &found {
            Some(records) => figure.add(bounds.start, records),
            None => figure.add_missing(bounds.len()),
        }
        if let Some(rows) = &mut rows {
            let missing = || vec![Record::NOT_COMPUTED; bounds.len()];
            rows.add(bounds.start, &found.unwrap_or_else(missing)).map_err(table_full)?;
        }
    }
    let table_sum = rows.map(|rows| rows.finish().sum());
    let tally = figure.tally().clone();
    let of_tiles = OfTiles {
        sweep_id: description.id.to_string(),
        checksum: fingerprint.map(|fingerprint| (tiling.count(), fingerprint.finish().to_string())),
        files: Sums::default(),
    };
    let mut run = Run { tiles: Some(of_tiles), ..run.clone() };
    let complete = run.is_complete(&tally);
    if run.stopped.is_some() && there(store) > Some((complete, tally.computed())) {
        return Ok(Results::Fuller { tally });
    }
    let svg = figure.svg();
    let mut files: Vec<Claim> = Vec::new();
    let mut sums: Vec<(&'static str, Sum)> = Vec::new();
    for (name, bytes) in [(FILES[2], png_of(&svg)?), (FILES[3], svg.into_bytes())] {
        files.push(filled(&path(name), &bytes)?);
        sums.push((name, Sum::of(&bytes)));
    }
    sums.splice(0..0, table_sum.map(|sum| (FILES[0], sum)));
    if let Some(tiles) = &mut run.tiles {
        tiles.files = sums.into_iter().collect();
    }
    let text = manifest::manifest(sheet, &description.resolved, &tally, &run)?;
    fill(&mut manifest_file, &text)?;
    if table.is_none() {
        note(&format!(
            "no {} of more than {MOST_ROWS} rows is written; `squealmap export {} --format csv` does",
            FILES[0],
            store.directory.display()
        ));
    }
    // One of before must not stand beside these results.
    let stale = table.is_none().then_some(csv_path.as_path());
    files.extend(table);
    let paths = publish_with(manifest_file, files, stale)?;
    Ok(Results::Written { paths, tally, complete })
}

/// The result of asking for the right to write results.
enum Claimed {
    Claim(Claim),
    Current,
    Stopped,
}

/// The claim on the results, unless they are complete and current; waits for another process that writes them, until it is
/// to stop.
fn claim_or_current(store: &Store, run: &Run, cancel: &AtomicBool) -> Result<Claimed> {
    let path = store.directory.join(MANIFEST);
    let mut told = false;
    loop {
        let claim = Claim::take(&path).map_err(|why| cannot(&path, &why))?;
        match claim {
            Some(_) if run.stopped.is_none() && faults(store).is_empty() => return Ok(Claimed::Current),
            Some(claim) => return Ok(Claimed::Claim(claim)),
            None if cancel.load(Ordering::Relaxed) => return Ok(Claimed::Stopped),
            None => {}
        }
        if !std::mem::replace(&mut told, true) {
            note(&format!(
                "waiting for another process that writes the results in {}",
                store.directory.display()
            ));
        }
        thread::sleep(WAIT);
    }
}

/// Whether the results of this sweep which are there are complete, and the instances they have; `None` where there are none
/// that are whole.
fn there(store: &Store) -> Option<(bool, usize)> {
    let bytes = disk::read(&store.directory.join(MANIFEST)).ok().filter(|bytes| is_intact(bytes))?;
    let document: serde_json::Value = serde_json::from_slice(&bytes).ok()?;
    let manifest = Manifest::deserialize(&document).ok()?;
    let is_of_this = manifest.sweep_id.as_deref() == Some(store.description.id.to_string().as_str());
    let is_there = |name: &&str| {
        Sum::in_manifest(&document, name).is_none()
            || unlike(&store.directory, name, MANIFEST, &document).is_none()
    };
    (is_of_this && FILES.iter().all(is_there)).then_some((manifest.complete, manifest.computation.computed))
}

/// Tells scripts what the manifest of a directory says.
pub(crate) fn tell(directory: &Path) {
    let bytes = disk::read(&directory.join(MANIFEST)).unwrap_or_default();
    let manifest: serde_json::Value = serde_json::from_slice(&bytes).unwrap_or_default();
    talk::tell("directory", directory.display().to_string());
    for key in ["title", "sweep_id", "complete", "computation", "counts", "checks"] {
        talk::tell(key, manifest[key].clone());
    }
}

/// Why the results are not those of all tiles of this sweep as they are now, a sentence each; none where they are.
pub(crate) fn faults(store: &Store) -> Vec<String> {
    let bytes = disk::read(&store.directory.join(MANIFEST)).unwrap_or_default();
    let document: serde_json::Value = serde_json::from_slice(&bytes).unwrap_or_default();
    let Ok(manifest) = Manifest::deserialize(&document) else {
        return vec![format!("`{MANIFEST}` is not there or no document")];
    };
    if manifest.checksum.is_none() && manifest.files.is_none() {
        return vec![format!(
            "`{MANIFEST}`: it is of a version that wrote no checksums, so that the results cannot be judged; \
             `squealmap merge {}` writes them again from the tiles",
            store.directory.display()
        )];
    }
    let mut faults = Vec::new();
    let mut expect = |holds: bool, why: &str| {
        if !holds {
            faults.push(format!("`{MANIFEST}`: {why}"));
        }
    };
    let description = &store.description;
    expect(is_intact(&bytes), "its content does not have its checksum");
    expect(
        manifest.sweep_id == Some(description.id.to_string()),
        "it is of another sweep, version or engine",
    );
    expect(manifest.title == description.title, "its title is another one");
    expect(manifest.complete, "it says that the results are not complete");
    let fingerprint = store.fingerprint().map(|id| id.to_string());
    let of_all = manifest.tiles.flatten().is_some_and(|tiles| Some(tiles.blake3) == fingerprint);
    expect(of_all, "it is not of the tiles that are there");
    let tables = if description.tiling.instances <= MOST_ROWS { &FILES[..] } else { &FILES[1..] };
    for name in tables.iter().filter(|name| **name != MANIFEST) {
        faults.extend(unlike(&store.directory, name, MANIFEST, &document));
    }
    faults
}
