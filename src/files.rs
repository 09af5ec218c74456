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

/// The text of a file of at most `most` bytes.
///
/// # Errors
/// What is wrong with it, as the end of a sentence.
pub fn text(path: &Path, most: u64) -> Result<String, String> {
    let file = open(path)?;
    let size = file.metadata().map_err(|why| why.to_string())?.len();
    if size > most {
        return Err(too_long(&format!("{size} bytes"), most));
    }
    let mut text = String::with_capacity(usize::try_from(size).unwrap_or(0));
    // A file may grow, and those of /proc say nothing of their length.
    let read = file.take(most + 1).read_to_string(&mut text).map_err(|why| why.to_string())?;
    if read as u64 > most {
        return Err(too_long("more", most));
    }
    Ok(text)
}

fn too_long(size: &str, most: u64) -> String {
    format!(
        "it has {size} but at most {} MiB are read; name the file that is meant, or take less",
        most / MIB
    )
}
