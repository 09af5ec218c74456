//! Large files written past the system's cache hold what was given, whatever their length and the file system.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::Path;

use squealmap::store::claim::Claim;
use squealmap::store::direct;
use squealmap::store::direct::{LEAST, Room};

/// Bytes that differ from block to block.
fn pattern(len: usize) -> Vec<u8> {
    (0..len).map(|at| u8::try_from((at ^ (at >> 8) ^ (at >> 16)) & 255).unwrap()).collect()
}

/// Writes files of several lengths into a directory, each in the room of the one before, and reads them back.
fn written(directory: &Path) {
    let mut room = Room::default();
    for len in [LEAST + 1, 3 * LEAST + 4095, 2 * LEAST, LEAST - 1, 0] {
        let path = directory.join(len.to_string());
        room.take(len).copy_from_slice(&pattern(len));
        Claim::take(&path).unwrap().unwrap().write_large(&room).unwrap();
        assert!(std::fs::read(&path).unwrap() == pattern(len), "{len} bytes in `{}`", directory.display());
        assert!(!path.with_extension("part").exists());
    }
}

#[test]
fn files_have_their_bytes_and_no_more() {
    written(tempfile::tempdir().unwrap().path());
}

/// File systems in memory know no such way, or do since lately.
#[test]
#[cfg(target_os = "linux")]
fn files_in_memory_have_them_too() {
    written(tempfile::tempdir_in("/dev/shm").unwrap().path());
}

#[test]
#[cfg(target_os = "linux")]
fn room_begins_at_a_block() {
    let mut room = Room::default();
    for len in [1, 5000, 1 << 20] {
        assert_eq!(room.take(len).as_ptr().addr() % 4096, 0);
        assert_eq!(room.bytes().len(), len);
    }
}

/// What a claim had in its file before is written over as a whole.
#[test]
fn nothing_stays_of_a_longer_file() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("tile");
    std::fs::write(directory.path().join("tile.part"), pattern(4 * LEAST)).unwrap();
    let mut room = Room::default();
    room.take(LEAST + 7).copy_from_slice(&pattern(LEAST + 7));
    Claim::take(&path).unwrap().unwrap().write_large(&room).unwrap();
    assert!(std::fs::read(&path).unwrap() == pattern(LEAST + 7));
}

/// A file that is not there is not made: it is the claim's to make.
#[test]
fn only_a_claimed_file_is_written() {
    let directory = tempfile::tempdir().unwrap();
    let mut room = Room::default();
    room.take(LEAST).fill(1);
    assert!(direct::write(&directory.path().join("none"), &room).is_err());
}
