//! The operations of a disk, and the system's own disk.

use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Write};
use std::path::Path;

/// The purpose that a file is opened for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum How {
    /// To be read; a file of the system's that is not read to an end (a pipe, a device) is refused.
    Read,
    /// To be written: made where it is not there, otherwise as it is. A link in its place is not followed.
    Write,
    /// To be written in whole blocks past the system's cache.
    Direct,
}

/// The operations that change a disk or read from it, one call of the system each.
pub trait Disk: Send + Sync {
    /// Opens a file.
    ///
    /// # Errors
    /// Those of the system, as of all functions here.
    fn open(&self, path: &Path, how: How) -> io::Result<File> {
        match how {
            How::Read => open_file(path),
            How::Write => not_followed(path),
            How::Direct => direct(path),
        }
    }

    /// Reads some bytes; 0 at the end.
    ///
    /// # Errors
    /// See [`Disk::open`].
    fn read(&self, mut file: &File, _path: &Path, bytes: &mut [u8]) -> io::Result<usize> {
        file.read(bytes)
    }

    /// Writes the first of some bytes; gives how many.
    ///
    /// # Errors
    /// See [`Disk::open`].
    fn write(&self, mut file: &File, _path: &Path, bytes: &[u8]) -> io::Result<usize> {
        file.write(bytes)
    }

    /// Cuts or lengthens a file.
    ///
    /// # Errors
    /// See [`Disk::open`].
    fn resize(&self, file: &File, _path: &Path, length: u64) -> io::Result<()> {
        file.set_len(length)
    }

    /// Waits until the bytes of a file are on the disk.
    ///
    /// # Errors
    /// See [`Disk::open`].
    fn sync(&self, file: &File, _path: &Path) -> io::Result<()> {
        file.sync_all()
    }

    /// Waits until the names in a folder are on the disk.
    ///
    /// # Errors
    /// See [`Disk::open`].
    fn sync_folder(&self, path: &Path) -> io::Result<()> {
        sync_folder(path)
    }

    /// Gives a file or a folder another name, in place of what has that name.
    ///
    /// # Errors
    /// See [`Disk::open`].
    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        fs::rename(from, to)
    }

    /// Removes a file.
    ///
    /// # Errors
    /// See [`Disk::open`].
    fn remove(&self, path: &Path) -> io::Result<()> {
        fs::remove_file(path)
    }

    /// Makes a folder in one that is there.
    ///
    /// # Errors
    /// See [`Disk::open`].
    fn make_folder(&self, path: &Path) -> io::Result<()> {
        fs::create_dir(path)
    }

    /// Removes an empty folder.
    ///
    /// # Errors
    /// See [`Disk::open`].
    fn remove_folder(&self, path: &Path) -> io::Result<()> {
        fs::remove_dir(path)
    }

    /// The names in a folder, in no order.
    ///
    /// # Errors
    /// See [`Disk::open`].
    fn names(&self, path: &Path) -> io::Result<Vec<OsString>> {
        fs::read_dir(path)?.map(|entry| Ok(entry?.file_name())).collect()
    }
}

/// The system's own disk.
#[derive(Clone, Copy, Debug)]
pub struct System;

impl Disk for System {}

/// Opens a file that has an end.
fn open_file(path: &Path) -> io::Result<File> {
    // Opening a pipe that nobody writes to would not end; looked at before, as opening is what hangs.
    if path.metadata().is_ok_and(|found| !found.is_file()) {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is no file"));
    }
    File::open(path)
}

fn not_followed(path: &Path) -> io::Result<File> {
    // Where somebody else may write, a link there would let this program overwrite any file of its user.
    if path.symlink_metadata().is_ok_and(|found| !found.is_file()) {
        let why = format!("`{}` is a link or no file; remove it", path.display());
        return Err(io::Error::new(io::ErrorKind::InvalidInput, why));
    }
    let mut options = OpenOptions::new();
    options.read(true).write(true).create(true).truncate(false);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::custom_flags(&mut options, libc::O_NOFOLLOW);
    options.open(path)
}

#[cfg(target_os = "linux")]
fn direct(path: &Path) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.write(true);
    std::os::unix::fs::OpenOptionsExt::custom_flags(&mut options, libc::O_DIRECT | libc::O_NOFOLLOW);
    options.open(path)
}

#[cfg(not(target_os = "linux"))]
fn direct(_path: &Path) -> io::Result<File> {
    Err(io::ErrorKind::Unsupported.into())
}

#[cfg(unix)]
fn sync_folder(path: &Path) -> io::Result<()> {
    File::open(path)?.sync_all()
}

#[cfg(not(unix))]
fn sync_folder(_path: &Path) -> io::Result<()> {
    Ok(())
}
