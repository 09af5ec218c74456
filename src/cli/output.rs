//! The output directory: proven writable before the run, filled at once after it.

use squealmap::{results, store};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

use crate::cli::error::{Error, Result};
use crate::cli::talk;
use squealmap::disk;
use squealmap::disk::{Handle, door};
use squealmap::store::claim::Claim;
use squealmap::store::origin;

/// The file that is claimed where no other is to be written.
const PROBE: &str = ".squealmap";

/// An output directory that exists and can be written.
#[derive(Debug)]
pub(crate) struct Output {
    directory: PathBuf,
    /// Directories made for it, deepest first; removed again when nothing comes of the run.
    made: Vec<PathBuf>,
    /// How many entries it had when its source was noted for the first time. The note goes, too, when nothing comes of the
    /// run.
    beside: Option<usize>,
}

impl Output {
    /// Makes the directory, with the folders that the names of `files` contain, and claims a file in each to see that it can
    /// be written. The claims are given up again; what a run that is killed in this moment leaves of them, the next one
    /// uses. Refuses a directory that stands in the place of one of `files`.
    pub(crate) fn prepare(directory: PathBuf, files: &[&str]) -> Result<Output> {
        let mut output = Output { directory, made: Vec::new(), beside: None };
        let probes = if files.is_empty() { &[PROBE][..] } else { files };
        let mut proven: Vec<PathBuf> = Vec::new();
        for name in probes {
            let path = output.directory.join(name);
            let folder = path.parent().unwrap_or(&output.directory).to_owned();
            if proven.contains(&folder) {
                continue;
            }
            let made =
                disk::make_all(&folder).and_then(|made| Claim::take(&path).map(|_| made)).map_err(|why| {
                    store::error::Error::OutputDirectory { path: folder.clone(), why: why.to_string() }
                })?;
            output.made.splice(0..0, made);
            proven.push(folder);
        }
        match files.iter().find(|name| output.directory.join(name).is_dir()) {
            None => Ok(output),
            Some(name) => {
                let why = format!("`{name}`, a file to be written there, is a directory");
                Err(store::error::Error::OutputDirectory { path: output.directory.clone(), why }.into())
            }
        }
    }

    /// The directory.
    pub(crate) fn directory(&self) -> &Path {
        &self.directory
    }

    /// Notes in the directory from which input file its results are made.
    pub(crate) fn made_from(&mut self, input: &Path) -> Result<()> {
        if origin::is_of(&self.directory, input) {
            return Ok(());
        }
        let is_first = origin::written(&self.directory).is_none();
        let beside = self.entries();
        origin::record(&self.directory, input)
            .map_err(|why| cannot(&self.directory.join(origin::SOURCE), &why))?;
        self.beside = beside.filter(|_| is_first);
        Ok(())
    }

    /// How many entries the directory has; `None` where it cannot be read.
    fn entries(&self) -> Option<usize> {
        door().names(&self.directory).ok().map(|names| names.len())
    }

    /// The directory, which stays even if nothing is written into it here.
    pub(crate) fn keep(mut self) -> PathBuf {
        self.made.clear();
        self.beside = None;
        std::mem::take(&mut self.directory)
    }

    /// Opens a file of the directory that is written piece by piece and then handed to [`Output::write_beside`].
    pub(crate) fn draft(&self, name: &str) -> Result<Draft> {
        let mut claim = claim(&self.directory.join(name))?;
        claim.emptied().map_err(|why| cannot(&self.directory.join(name), &why))?;
        Ok(Draft(claim))
    }

    /// Writes all files or none: first under temporary names, then renamed. Older files of these names are removed first, so
    /// that after a crash no figure of one call stands beside the table of another. Returns their paths.
    pub(crate) fn write(self, files: &[(&str, Vec<u8>)]) -> Result<Vec<PathBuf>> {
        self.write_beside(files, Vec::new())
    }

    /// Writes `files` as [`Output::write`] does, and removes what an earlier call has left of the other `names`.
    pub(crate) fn write_alone(self, files: &[(&str, Vec<u8>)], names: &[&str]) -> Result<Vec<PathBuf>> {
        let others = names.iter().filter(|name| files.iter().all(|(written, _)| written != *name));
        let stale: Vec<PathBuf> = others.map(|name| self.directory.join(name)).collect();
        self.put(files, Vec::new(), &stale)
    }

    /// Writes `files`, and puts the `drafts`, which have been written already, in their places with them: all or none, as
    /// [`Output::write`] does.
    pub(crate) fn write_beside(self, files: &[(&str, Vec<u8>)], drafts: Vec<Draft>) -> Result<Vec<PathBuf>> {
        self.put(files, drafts, &[])
    }

    fn put(
        mut self,
        files: &[(&str, Vec<u8>)],
        drafts: Vec<Draft>,
        stale: &[PathBuf],
    ) -> Result<Vec<PathBuf>> {
        let mut written = Vec::with_capacity(files.len() + drafts.len());
        for (name, bytes) in files {
            written.push(filled(&self.directory.join(name), bytes)?);
        }
        written.extend(drafts.into_iter().map(|Draft(claim)| claim));
        // The first takes the place of its own.
        let mut others: Vec<&Path> = written.iter().skip(1).map(Claim::path).collect();
        let stale = stale.iter().map(PathBuf::as_path);
        others.iter().copied().chain(stale).try_for_each(gone)?;
        others.dedup_by_key(|path| path.parent());
        others.into_iter().try_for_each(lasting)?;
        let paths = publish(written)?;
        self.made.clear();
        self.beside = None;
        Ok(paths)
    }
}

/// Puts files in their places, one after the other; returns these.
fn publish(files: Vec<Claim>) -> Result<Vec<PathBuf>> {
    let publish = |claim: Claim| {
        let path = claim.path().to_owned();
        claim.publish().map_err(|why| cannot(&path, &why)).map(|()| path)
    };
    files.into_iter().map(publish).collect()
}

/// Puts files in their places and then `last`, whose being there says that the others are complete. The older file of its
/// name is removed before the first of them comes, and so is `stale`, which must not stand beside them. Returns the paths.
pub(crate) fn publish_with(last: Claim, mut files: Vec<Claim>, stale: Option<&Path>) -> Result<Vec<PathBuf>> {
    let before = last.path();
    gone(before)?;
    lasting(before)?;
    stale.map_or(Ok(()), gone)?;
    files.push(last);
    let mut paths = publish(files)?;
    paths.sort();
    Ok(paths)
}

/// Removes a file that must not stand beside others that come.
fn gone(path: &Path) -> Result<()> {
    disk::remove_if_there(path).map_err(|why| cannot(path, &why))
}

/// Waits until it is so after a crash, too.
fn lasting(path: &Path) -> Result<()> {
    disk::lasting(path).map_err(|why| cannot(path, &why))
}

impl Drop for Output {
    fn drop(&mut self) {
        let counts = self.beside.zip(self.entries());
        if counts.is_some_and(|(before, now)| now <= before + 1) {
            let _ = disk::remove_if_there(&self.directory.join(origin::SOURCE));
        }
        for directory in &self.made {
            // Fails, as it should, when there is something in it.
            let _ = door().remove_folder(directory);
        }
    }
}

/// A file that is written as its content comes; dropped, it leaves nothing.
#[derive(Debug)]
pub(crate) struct Draft(Claim);

impl Draft {
    /// Takes what was written to it.
    pub(crate) fn file(&mut self) -> &mut Handle {
        self.0.file()
    }
}

/// The list of written files for the end of a command, in words and for `--json`.
pub(crate) fn list(paths: &[PathBuf]) -> String {
    talk::tell_files(paths.iter().map(|path| path.display().to_string()));
    paths.iter().fold(String::new(), |text, path| text + "wrote " + &path.display().to_string() + "\n")
}

/// Another process that only looks whether it may write a file has it no longer than this; one that writes it is an error.
const PATIENCE: Duration = Duration::from_secs(1);

/// A claim on a file that is written piece by piece.
pub(crate) fn claim(path: &Path) -> Result<Claim> {
    let began = Instant::now();
    loop {
        match Claim::take(path).map_err(|why| cannot(path, &why))? {
            Some(claim) => return Ok(claim),
            None if began.elapsed() > PATIENCE => {
                return Err(cannot(path, &io::Error::other("another process is writing it")));
            }
            None => thread::sleep(PATIENCE / 100),
        }
    }
}

/// A claim on a file, with its bytes in it.
pub(crate) fn filled(path: &Path, bytes: &[u8]) -> Result<Claim> {
    let mut claim = claim(path)?;
    fill(&mut claim, bytes)?;
    Ok(claim)
}

/// Writes the bytes of a file that was claimed.
pub(crate) fn fill(claim: &mut Claim, bytes: &[u8]) -> Result<()> {
    let written = claim.emptied().and_then(|file| file.write_all(bytes));
    written.map_err(|why| cannot(claim.path(), &why))
}

/// The error of a table that cannot be written: with its path, and what the system says.
pub(crate) fn cannot_table(path: &Path, why: results::error::Error) -> Error {
    match why {
        results::error::Error::WriteTable(why) => cannot(path, &io::Error::other(why)),
        results::error::Error::WriteParquet(why) => cannot(path, &io::Error::other(why)),
        other => other.into(),
    }
}

/// The error of a file that cannot be written.
pub(crate) fn cannot(path: &Path, why: &io::Error) -> Error {
    Error::Write { path: path.to_owned(), why: why.to_string() }
}
