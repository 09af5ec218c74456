//! JSON files that show when they were changed: the last entry is the checksum of all bytes before it.
//!
//! Bytes and not values are summed, so that a file of any length is sealed as it is written.

use std::io::{self, Write};

/// A sealed file ends with this, the 64 hexadecimal digits of its BLAKE3 checksum, and [`AFTER`].
const BEFORE: &[u8] = b",\n  \"checksum\": \"";
const AFTER: &[u8] = b"\"\n}\n";
const DIGITS: usize = 64;

/// The end of an indented JSON object, in whose place the checksum comes.
const END: &[u8] = b"\n}\n";

/// Writes an indented JSON object that ends with a new line to another writer, and its checksum as its last entry.
pub struct Sealing<W> {
    out: W,
    hasher: blake3::Hasher,
    /// The last bytes, which may be the end.
    held: Vec<u8>,
}

impl<W: Write> Sealing<W> {
    /// Writes to `out`.
    pub fn new(out: W) -> Sealing<W> {
        Sealing { out, hasher: blake3::Hasher::new(), held: Vec::new() }
    }

    /// Writes the checksum and the end.
    ///
    /// # Errors
    /// Those of `out`; when what was written is no indented object.
    pub fn finish(mut self) -> io::Result<()> {
        if self.held != END {
            return Err(io::Error::other("only an indented JSON object is sealed"));
        }
        let digits = self.hasher.finalize().to_hex();
        [BEFORE, digits.as_bytes(), AFTER].into_iter().try_for_each(|part| self.out.write_all(part))
    }
}

impl<W: Write> Write for Sealing<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.held.extend_from_slice(bytes);
        let passed = self.held.len().saturating_sub(END.len());
        self.out.write_all(&self.held[..passed])?;
        self.hasher.update(&self.held[..passed]);
        self.held.drain(..passed);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// An indented JSON object, which ends with a new line, with its checksum; as it is where it is none.
#[must_use]
pub fn sealed(document: Vec<u8>) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(document.len() + BEFORE.len() + DIGITS + AFTER.len());
    let mut sealing = Sealing::new(&mut bytes);
    match sealing.write_all(&document).and_then(|()| sealing.finish()) {
        Ok(()) => bytes,
        Err(_) => document,
    }
}

/// Whether a file has the checksum that it says; false of one that has none.
#[must_use]
pub fn is_intact(bytes: &[u8]) -> bool {
    let said = || {
        let (before, digits) = bytes.strip_suffix(AFTER)?.split_last_chunk::<DIGITS>()?;
        Some((before.strip_suffix(BEFORE)?, digits))
    };
    said().is_some_and(|(content, digits)| blake3::hash(content).to_hex().as_bytes() == digits)
}
