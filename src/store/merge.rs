//! Tiles of one sweep from several directories in one of them.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::store::direct::Room;
use crate::store::directory::{Note, Store};
use crate::store::error::{Error, Result};

/// Refuses directories of different sweeps.
///
/// # Errors
/// When they are.
pub fn of_one_sweep(one: &Store, other: &Store) -> Result<()> {
    if one.is_same(other) {
        return Ok(());
    }
    Err(Error::OtherMerge { target: one.directory.clone(), source_dir: other.directory.clone() })
}

/// Brings the tiles of `source` into `target` that are not there, until `cancel` is set; returns how many. Doing it again
/// changes nothing.
///
/// # Errors
/// When the directories are of different sweeps, or a tile cannot be written.
pub fn merge(target: &Store, source: &Store, cancel: &AtomicBool, note: Note) -> Result<usize> {
    of_one_sweep(target, source)?;
    let mut brought = 0;
    let mut room = Room::default();
    for number in source.numbers()? {
        if cancel.load(Ordering::Relaxed) {
            break;
        }
        if target.verify(number, note)? {
            continue;
        }
        match source.read(number) {
            Ok(None) => {}
            Ok(Some(records)) => {
                // Another process that has the claim writes the same.
                if let Some(claim) = target.claim(number)? {
                    target.write(claim, number, records, &mut room)?;
                    brought += 1;
                }
            }
            Err(fault) => {
                note(&format!("`{}` is left out: {fault}", source.path(number).display()));
            }
        }
    }
    Ok(brought)
}
