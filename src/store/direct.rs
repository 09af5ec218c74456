//! Bytes that go to the disk past the system's cache.
//!
//! A sweep writes its tiles once and reads them again when all is done: copying them into the page cache costs
//! half of what tiles cost beside computing, and pushes out what other programs keep there. A file opened with
//! `O_DIRECT` takes whole blocks from memory that begins at a block.

use std::io::{self, Write};
use std::path::Path;

use crate::disk::{Handle, How};

/// A multiple of the blocks of all usual disks.
const BLOCK: usize = 4096;

/// Below this the cache costs next to nothing.
pub const LEAST: usize = 1 << 18;

/// Room for bytes that begin at a block; what was used is used again, so that the system need not give its pages anew.
#[derive(Debug, Default)]
pub struct Room {
    bytes: Vec<u8>,
    first: usize,
    len: usize,
}

impl Room {
    /// Room for `len` bytes, of whatever value.
    pub fn take(&mut self, len: usize) -> &mut [u8] {
        let whole = len.next_multiple_of(BLOCK);
        if self.bytes.len() < whole + BLOCK {
            self.bytes.resize(whole + BLOCK, 0);
        }
        // `usize::MAX` where the offset is not known: without alignment the disk refuses, and the cache takes it.
        self.first =
            Some(self.bytes.as_ptr().align_offset(BLOCK)).filter(|first| *first < BLOCK).unwrap_or(0);
        self.len = len;
        &mut self.bytes[self.first..self.first + len]
    }

    /// The bytes that it was last taken for.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes[self.first..self.first + self.len]
    }

    /// The bytes that it was last taken for, filled up to whole blocks.
    fn blocks(&self) -> &[u8] {
        &self.bytes[self.first..self.first + self.len.next_multiple_of(BLOCK)]
    }
}

/// Writes the bytes of `room` as the whole of the file `path`, which is there and empty, past the cache.
///
/// # Errors
/// Those of the disk; where the system or the file system knows no such way.
pub fn write(path: &Path, room: &Room) -> io::Result<()> {
    let mut file = Handle::open(path, How::Direct)?;
    file.write_all(room.blocks())?;
    file.resize(room.len as u64)
}
