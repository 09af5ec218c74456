//! A file whose length and checksum are known as soon as it is written, and files held against those that a document names.

use std::io::{self, Read, Write};
use std::path::Path;

use squealmap::disk::{Handle, How};
use squealmap::results::manifest::Sum;

/// Bytes of a file that are read at a time to be summed.
const BLOCK: usize = 1 << 16;

/// Why a file of a directory is not the one that the document `of` names, as a sentence; `None` where it is.
pub(crate) fn unlike(directory: &Path, file: &str, of: &str, document: &serde_json::Value) -> Option<String> {
    match sum(&directory.join(file)) {
        Ok(found) if Some(&found) == Sum::in_manifest(document, file).as_ref() => None,
        Ok(_) => Some(format!("`{file}` is not the file that `{of}` names: its checksum is another one")),
        Err(why) => Some(format!("`{file}` cannot be read: {why}")),
    }
}

/// Length and checksum of a file, which is not held in memory.
fn sum(path: &Path) -> io::Result<Sum> {
    let mut file = Handle::open(path, How::Read)?;
    let mut summed = Summed::new(io::sink());
    let mut block = vec![0; BLOCK];
    loop {
        match file.read(&mut block) {
            Ok(0) => return Ok(summed.sum()),
            Ok(count) => summed.write_all(&block[..count])?,
            Err(why) if why.kind() == io::ErrorKind::Interrupted => {}
            Err(why) => return Err(why),
        }
    }
}

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

    /// The length and the checksum of everything that was written.
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
