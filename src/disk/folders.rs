//! Folders, and names that last.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use crate::disk::door;
use crate::disk::file::retried;

/// Makes a folder and those above it where they are not there, so that they last; gives those that were made, the
/// deepest first.
///
/// # Errors
/// When one cannot be made.
pub fn make_all(path: &Path) -> io::Result<Vec<PathBuf>> {
    let missing = path.ancestors().filter(|path| !path.as_os_str().is_empty());
    let missing: Vec<PathBuf> = missing.take_while(|path| !path.is_dir()).map(Path::to_owned).collect();
    for folder in missing.iter().rev() {
        match retried(|| door().make_folder(folder)) {
            // Another process was faster.
            Err(why) if why.kind() == ErrorKind::AlreadyExists && folder.is_dir() => {}
            other => other?,
        }
        lasting(folder)?;
    }
    Ok(missing)
}

/// Waits until the name of a file or folder, or that it is gone, is on the disk.
///
/// # Errors
/// Those of the disk.
pub fn lasting(path: &Path) -> io::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    retried(|| door().sync_folder(folder.unwrap_or(Path::new("."))))
}

/// Removes a file that may be there.
///
/// # Errors
/// When it is there and cannot be removed.
pub fn remove_if_there(path: &Path) -> io::Result<()> {
    match retried(|| door().remove(path)) {
        Err(why) if why.kind() == ErrorKind::NotFound => Ok(()),
        other => other,
    }
}

/// Removes a folder, if it is there, with everything in it. Links are removed and not followed, also where the folder itself
/// is one.
///
/// # Errors
/// When something cannot be removed.
pub fn remove_all(path: &Path) -> io::Result<()> {
    if !path.symlink_metadata().is_ok_and(|found| found.is_dir()) {
        return remove_if_there(path);
    }
    for name in retried(|| door().names(path))? {
        remove_all(&path.join(name))?;
    }
    retried(|| door().remove_folder(path))
}
