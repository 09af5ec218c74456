//! A file that only one process at a time writes. It appears under its name complete or not at all.
//!
//! The temporary file is the claim: whoever holds the system's lock on it may write it. Such a lock ends with its
//! process, however that ends, and what is left of the file is written over by the next one.

use std::fs::TryLockError;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::disk;
use crate::disk::{Handle, How, door};
use crate::store::direct;
use crate::store::direct::Room;

/// The end of the name of a file that is being written.
pub const PART: &str = ".part";

/// A claim on a file to be written.
#[derive(Debug)]
pub struct Claim {
    path: PathBuf,
    part: PathBuf,
    file: Handle,
}

impl Claim {
    /// Claims the file `path`; `None` while another process has it.
    ///
    /// # Errors
    /// When the directory cannot be written, its file system knows no locks, or a link stands in place of the file.
    pub fn take(path: &Path) -> io::Result<Option<Claim>> {
        let mut part = path.as_os_str().to_owned();
        part.push(PART);
        let part = PathBuf::from(part);
        loop {
            let file = Handle::open(&part, How::Write)?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => return Ok(None),
                Err(TryLockError::Error(why)) => return Err(why),
            }
            // Another process may have renamed or removed the file between opening and locking it.
            if file.is_at(&part)? {
                return Ok(Some(Claim { path: path.to_owned(), part, file }));
            }
        }
    }

    /// The path of the file to be written.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The file, empty, for writing piece by piece before [`Claim::publish`].
    ///
    /// # Errors
    /// When it cannot be emptied.
    pub fn emptied(&mut self) -> io::Result<&mut Handle> {
        self.file.resize(0)?;
        io::Seek::rewind(&mut self.file)?;
        Ok(&mut self.file)
    }

    /// The file as it is, for writing on.
    pub fn file(&mut self) -> &mut Handle {
        &mut self.file
    }

    /// Gives the file its name, once its bytes are on the disk.
    ///
    /// # Errors
    /// When the disk is full, read-only or gone, or the file was moved away meanwhile.
    pub fn publish(self) -> io::Result<()> {
        self.file.sync()?;
        // Of a directory that was moved, another file may stand under the name by now.
        if !self.file.is_at(&self.part)? {
            self.part.metadata()?;
            return Err(io::Error::other("another file took its place while it was written"));
        }
        door().rename(&self.part, &self.path)?;
        disk::lasting(&self.path)
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
        if self.file.is_at(&self.part).unwrap_or(false) {
            let _ = door().remove(&self.part);
        }
    }
}
