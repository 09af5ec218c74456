//! How much of the disk a sweep takes, and how much is free.

use std::path::Path;

use crate::store::description::Description;
use crate::store::error::{Error, Result};
use crate::store::tiling::{TILE, Tiling};
use crate::sweep::spec::{Analysis, Starts};

/// Sweeps of more instances get no `map.csv` by themselves: nothing that reads tables reads these.
pub const MOST_ROWS: usize = 20_000_000;

/// Bytes of a row of `map.csv`, generously: for eigenvalues, for the response, and for the columns that every row has.
const ROW: [u64; 3] = [130, 430, 40];

/// Bytes of a row for the counts of starts from a box.
const BASIN: u64 = 64;

/// Bytes of figures, manifest and description, on the large side.
const AROUND: u64 = 32 << 20;

/// Bytes that are left free for others.
const RESERVE: u64 = 64 << 20;

/// Room on the disk that a sweep needs, bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Need {
    /// All tiles.
    pub tiles: u64,
    /// `map.csv`; `None` when the sweep is too large for one.
    pub table: Option<u64>,
}

impl Need {
    /// The need of a sweep, cut like this.
    #[must_use]
    pub fn new(tiling: Tiling, analysis: Analysis) -> Need {
        let width = crate::store::starts::width(analysis) as u64;
        let instances = tiling.instances as u64;
        let around = 120 * tiling.count() as u64;
        let others = match analysis.starts {
            Starts::One => 0,
            Starts::Both => ROW[1] + 1,
            Starts::Box(_) => BASIN,
        };
        let row = ROW[2]
            + others
            + if analysis.linear { ROW[0] } else { 0 }
            + if analysis.response { ROW[1] } else { 0 };
        let table = (tiling.instances <= MOST_ROWS).then_some(instances * row);
        Need { tiles: instances * width + around, table }
    }
}

/// Whether the disk of a directory has room for what a sweep still lacks: `missing` of its instances.
///
/// # Errors
/// When it has not.
pub fn verify(directory: &Path, description: &Description, missing: usize) -> Result<()> {
    // Where the system does not say, the run finds out.
    let Some(free) = free(directory) else { return Ok(()) };
    let tiling = Tiling { instances: missing, ..description.tiling };
    let tiles = Need::new(tiling, description.analysis).tiles;
    let table = Need::new(description.tiling, description.analysis).table.unwrap_or(0);
    fits(directory, tiles + table + AROUND, free)
}

/// Whether the disk of a directory has room for the parts of `missing` instances and their rows.
///
/// # Errors
/// When it has not.
pub fn verify_parts(directory: &Path, analysis: Analysis, missing: usize) -> Result<()> {
    let Some(free) = free(directory) else { return Ok(()) };
    let need = Need::new(Tiling { instances: missing, tile: TILE }, analysis);
    fits(directory, need.tiles + need.table.unwrap_or(0) + AROUND, free)
}

fn fits(directory: &Path, needed: u64, free: u64) -> Result<()> {
    let needed = needed + RESERVE;
    if needed > free {
        return Err(Error::NoSpace { path: directory.to_owned(), needed: bytes(needed), free: bytes(free) });
    }
    Ok(())
}

/// Bytes for people: `512 bytes`, `14 MB`, `2.9 GB`.
#[must_use]
pub fn bytes(count: u64) -> String {
    const UNITS: [&str; 5] = ["bytes", "kB", "MB", "GB", "TB"];
    let mut value = count as f64;
    let mut unit = 0;
    while value >= 1000.0 && unit + 1 < UNITS.len() {
        value /= 1000.0;
        unit += 1;
    }
    if unit == 0 || value >= 9.95 {
        format!("{value:.0} {}", UNITS[unit])
    } else {
        format!("{value:.1} {}", UNITS[unit])
    }
}

/// The bytes that are free on the disk of a directory; `None` where the system does not say.
#[cfg(not(target_family = "wasm"))]
fn free(directory: &Path) -> Option<u64> {
    fs4::available_space(directory).ok()
}

#[cfg(target_family = "wasm")]
fn free(_directory: &Path) -> Option<u64> {
    None
}
