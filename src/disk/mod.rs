//! The one door to the disk: all that the program keeps is written, and read back, through one small trait.
//!
//! A test can put a disk in its place that fails, tears or forgets at the n-th operation ([`put_in_place`]). What every
//! writer owes the disk (retries, no links followed, names that last) stands here once. A test of the sources sees to it
//! that nobody else writes. Files that a user names as input are read elsewhere.
//!
//! - `system.rs`: the operations of a disk, and the system's own disk.
//! - `file.rs`, `folders.rs`: one open file; folders made and removed.

mod file;
mod folders;
mod system;

pub use file::{Handle, is_at, is_of_reader, read};
pub use folders::{lasting, make_all, remove_all, remove_if_there};
pub use system::{Disk, How, System};

use std::sync::OnceLock;

static DOOR: OnceLock<Box<dyn Disk>> = OnceLock::new();

/// The disk that is in place: the system's own, unless a test has put another there.
#[must_use]
pub fn door() -> &'static dyn Disk {
    DOOR.get().map_or(&System, |disk| &**disk)
}

/// Puts another disk in place for the rest of the process; for tests, before anything is opened.
///
/// # Panics
/// When one was put in place before.
pub fn put_in_place(disk: Box<dyn Disk>) {
    assert!(DOOR.set(disk).is_ok(), "one disk is put in place, once");
}
