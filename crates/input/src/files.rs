//! Files of the user: only regular ones are read, and only so much of them.

use std::fs::File;
use std::io::Read;
use std::path::Path;

/// A mebibyte.
pub const MIB: u64 = 1 << 20;

/// Opens a file, unless it is a directory, a pipe or a device, which may have no end.
///
/// # Errors
/// What is wrong with it, as the end of a sentence.
pub fn open(path: &Path) -> Result<File, String> {
    // Asked before it is opened: opening a pipe waits for who writes it.
    let kind = std::fs::metadata(path).map_err(|why| why.to_string())?.file_type();
    if kind.is_dir() {
        return Err("it is a directory; name a file in it".to_owned());
    }
    if !kind.is_file() {
        return Err(
            "it is a pipe or a device, not a file; write its content into a file and name that".to_owned()
        );
    }
    File::open(path).map_err(|why| why.to_string())
}

/// What [`open`] gives, to be read.
///
/// # Errors
/// The same.
pub fn reader(path: &Path) -> std::io::Result<Box<dyn Read>> {
    open(path).map(|file| Box::new(file) as Box<dyn Read>).map_err(std::io::Error::other)
}

/// The text of a file of at most `most` bytes.
///
/// # Errors
/// What is wrong with it, as the end of a sentence.
pub fn text(path: &Path, most: u64) -> Result<String, String> {
    String::from_utf8(bytes(path, most)?).map_err(|_| "it is no text in UTF-8; save it as UTF-8".to_owned())
}

/// The text of a table of at most `most` bytes. Many programs still write tables in Latin-1, so that is read as well.
///
/// # Errors
/// What is wrong with it, as the end of a sentence.
pub fn table(path: &Path, most: u64) -> Result<String, String> {
    let bytes = bytes(path, most)?;
    // Of text in UTF-16, or none at all, every other byte may be 0.
    if bytes.contains(&0) {
        return Err("it is no text in UTF-8; save it as CSV in UTF-8".to_owned());
    }
    Ok(decoded(bytes))
}

/// The text of bytes in UTF-8, or else in Latin-1, where every byte is a character.
#[must_use]
pub fn decoded(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes)
        .unwrap_or_else(|bytes| bytes.as_bytes().iter().map(|byte| char::from(*byte)).collect())
}

/// The bytes of a file of at most `most` bytes.
fn bytes(path: &Path, most: u64) -> Result<Vec<u8>, String> {
    let file = open(path)?;
    let size = file.metadata().map_err(|why| why.to_string())?.len();
    if size > most {
        return Err(too_long(&format!("{size} bytes"), most));
    }
    let mut bytes = Vec::with_capacity(usize::try_from(size).unwrap_or(0));
    // A file may grow, and those of /proc say nothing of their length.
    let read = file.take(most + 1).read_to_end(&mut bytes).map_err(|why| why.to_string())?;
    if read as u64 > most {
        return Err(too_long("more", most));
    }
    Ok(bytes)
}

fn too_long(size: &str, most: u64) -> String {
    format!(
        "it has {size} but at most {} MiB are read; name the file that is meant, or take less",
        most / MIB
    )
}
