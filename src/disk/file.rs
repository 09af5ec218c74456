//! An open file of the disk that is in place.

use std::fs::{File, TryLockError};
use std::io::{self, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use same_file::Handle as Same;

use crate::disk::{How, door};

/// An open file, read and written through the door.
#[derive(Debug)]
pub struct Handle {
    file: File,
    path: PathBuf,
}

impl Handle {
    /// Opens a file.
    ///
    /// # Errors
    /// When it cannot be opened like that.
    pub fn open(path: &Path, how: How) -> io::Result<Handle> {
        let file = retried(|| door().open(path, how))?;
        Ok(Handle { file, path: path.to_owned() })
    }

    /// Locks it for this process, as long as it is open.
    ///
    /// # Errors
    /// When another process has it, or the file system knows no locks.
    pub fn try_lock(&self) -> Result<(), TryLockError> {
        self.file.try_lock()
    }

    /// Whether a process has it locked.
    #[must_use]
    pub fn is_locked(&self) -> bool {
        self.file.try_lock_shared().is_err()
    }

    /// Whether it is the file that has this path now.
    ///
    /// # Errors
    /// When that cannot be seen.
    pub fn is_at(&self, path: &Path) -> io::Result<bool> {
        is_at(&self.file, path)
    }

    /// Cuts or lengthens it.
    ///
    /// # Errors
    /// Those of the disk.
    pub fn resize(&mut self, length: u64) -> io::Result<()> {
        retried(|| door().resize(&self.file, &self.path, length))
    }

    /// Waits until its bytes are on the disk.
    ///
    /// # Errors
    /// Those of the disk: some of its bytes may be lost then, whatever a second call says.
    pub fn sync(&self) -> io::Result<()> {
        retried(|| door().sync(&self.file, &self.path))
    }
}

impl Read for Handle {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        door().read(&self.file, &self.path, bytes)
    }
}

impl Write for Handle {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        door().write(&self.file, &self.path, bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Seek for Handle {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

/// The bytes of a file. What fails in passing, as on a network, is read a second time: a file that could not be read is
/// not one that is bad.
///
/// # Errors
/// When it is not there, is no file, or cannot be read.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    read_once(path).or_else(|why| match why.kind() {
        ErrorKind::NotFound | ErrorKind::InvalidInput | ErrorKind::PermissionDenied => Err(why),
        _ => read_once(path),
    })
}

fn read_once(path: &Path) -> io::Result<Vec<u8>> {
    let mut file = Handle::open(path, How::Read)?;
    let mut bytes = Vec::new();
    let length = file.file.metadata().map_or(0, |found| found.len());
    // One byte more, so that the end is seen without room being made again.
    bytes.try_reserve_exact(usize::try_from(length).unwrap_or(usize::MAX).saturating_add(1))?;
    file.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Whether a file could not be read for a reason of this process, which may not or has too little room, and not of the file.
#[must_use]
pub fn is_of_reader(why: &io::Error) -> bool {
    #[cfg(unix)]
    let out_of_files = matches!(why.raw_os_error(), Some(libc::EMFILE | libc::ENFILE));
    #[cfg(not(unix))]
    let out_of_files = false;
    out_of_files || matches!(why.kind(), ErrorKind::PermissionDenied | ErrorKind::OutOfMemory)
}

/// Whether an open file is the one at a path.
///
/// # Errors
/// When that cannot be seen.
pub fn is_at(file: &File, path: &Path) -> io::Result<bool> {
    match Same::from_path(path) {
        Ok(found) => Ok(found == Same::from_file(file.try_clone()?)?),
        Err(why) if why.kind() == ErrorKind::NotFound => Ok(false),
        Err(why) => Err(why),
    }
}

/// Does again what a signal interrupted.
pub(super) fn retried<T>(mut once: impl FnMut() -> io::Result<T>) -> io::Result<T> {
    loop {
        match once() {
            Err(why) if why.kind() == ErrorKind::Interrupted => {}
            other => return other,
        }
    }
}
