//! A file whose length and checksum are known as soon as it is written.

use std::io::{self, Write};

use squealmap::export::manifest::Sum;

/// Writes to another writer, and sums.
pub(crate) struct Summed<W> {
    out: W,
    bytes: u64,
    hasher: blake3::Hasher,
}

impl<W: Write> Summed<W> {
    pub(crate) fn new(out: W) -> Summed<W> {
        Summed { out, bytes: 0, hasher: blake3::Hasher::new() }
    }

    /// Of all that was written.
    pub(crate) fn sum(&self) -> Sum {
        Sum { bytes: self.bytes, blake3: self.hasher.finalize().to_hex().to_string() }
    }
}

impl<W: Write> Write for Summed<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes)?;
        self.bytes += written as u64;
        self.hasher.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}
