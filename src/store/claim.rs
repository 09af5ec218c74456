//! A file that one process at a time writes, and that appears under its name complete or not at all.
//!
//! The temporary file is the claim: whoever holds the system's lock on it may write it. Such a lock ends with its
//! process, however that ends, and what is left of the file is written over by the next one.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use same_file::Handle;

use super::direct::{self, Room};

/// The end of the name of a file that is being written.
pub const PART: &str = ".part";

/// A claim on a file to be written.
#[derive(Debug)]
pub struct Claim {
    path: PathBuf,
    part: PathBuf,
    file: File,
}

impl Claim {
    /// Claims the file `path`; `None` while another process has it.
    ///
    /// # Errors
    /// When the directory cannot be written, or its file system knows no locks.
    pub fn take(path: &Path) -> io::Result<Option<Claim>> {
        let mut part = path.as_os_str().to_owned();
        part.push(PART);
        let part = PathBuf::from(part);
        loop {
            let file = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&part)?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => return Ok(None),
                Err(TryLockError::Error(why)) => return Err(why),
            }
            // Another process may have renamed or removed the file between opening and locking it.
            if is_at(&file, &part)? {
                return Ok(Some(Claim { path: path.to_owned(), part, file }));
            }
        }
    }

    /// The file, empty, for writing piece by piece before [`Claim::publish`].
    ///
    /// # Errors
    /// When it cannot be emptied.
    pub fn emptied(&mut self) -> io::Result<&mut File> {
        self.file.set_len(0)?;
        io::Seek::rewind(&mut self.file)?;
        Ok(&mut self.file)
    }

    /// Gives the file its name, once its bytes are on the disk.
    ///
    /// # Errors
    /// When the disk is full, read-only or gone.
    pub fn publish(self) -> io::Result<()> {
        self.file.sync_all()?;
        std::fs::rename(&self.part, &self.path)?;
        match self.path.parent() {
            Some(directory) => sync(directory),
            None => Ok(()),
        }
    }

    /// Writes the whole file and gives it its name.
    ///
    /// # Errors
    /// Those of [`Claim::publish`].
    pub fn write(mut self, bytes: &[u8]) -> io::Result<()> {
        self.emptied()?.write_all(bytes)?;
        self.publish()
    }

    /// Writes the whole file, past the system's cache where that can be done and pays, and gives it its name.
    ///
    /// # Errors
    /// Those of [`Claim::publish`].
    pub fn write_large(mut self, room: &Room) -> io::Result<()> {
        self.emptied()?;
        // Of an error past the cache the one through it, if there is one, counts.
        if room.bytes().len() >= direct::LEAST && direct::write(&self.part, room).is_ok() {
            return self.publish();
        }
        self.write(room.bytes())
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        // Still locked: what stands there is this claim's own, unless it has its name by now.
        if is_at(&self.file, &self.part).unwrap_or(false) {
            let _ = std::fs::remove_file(&self.part);
        }
    }
}

/// Whether an open file is the one at a path.
fn is_at(file: &File, path: &Path) -> io::Result<bool> {
    match Handle::from_path(path) {
        Ok(found) => Ok(found == Handle::from_file(file.try_clone()?)?),
        Err(why) if why.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(why) => Err(why),
    }
}

/// A new name is on the disk only with its directory.
#[cfg(unix)]
fn sync(directory: &Path) -> io::Result<()> {
    let directory = if directory.as_os_str().is_empty() { Path::new(".") } else { directory };
    File::open(directory)?.sync_all()
}

#[cfg(not(unix))]
fn sync(_directory: &Path) -> io::Result<()> {
    Ok(())
}
