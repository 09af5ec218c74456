//! The output directory: proven writable before the run, filled at once after it.

use std::io::Write;
use std::path::{Path, PathBuf};

use squealmap::store::claim::Claim;
use squealmap::{Error, Result};
use tempfile::NamedTempFile;

/// An output directory that exists and can be written.
#[derive(Debug)]
pub(crate) struct Output {
    directory: PathBuf,
    /// Directories made for it, deepest first; removed again when nothing comes of the run.
    made: Vec<PathBuf>,
}

impl Output {
    /// Makes the directory where it does not exist, and those that the names of `files` have in them, and
    /// writes a file in each, which it removes; refuses one where a directory stands in place of one of the
    /// `files` to come.
    pub(crate) fn prepare(directory: PathBuf, files: &[&str]) -> Result<Output> {
        Output::prepare_with(directory, files, |directory| temporary(directory)?.close())
    }

    /// The same for files that are claimed: what a run that is killed in this moment leaves, the next one uses.
    pub(crate) fn prepare_claimed(directory: PathBuf, files: &[&str]) -> Result<Output> {
        let first = files.first().copied().unwrap_or_default();
        Output::prepare_with(directory, files, |directory| Claim::take(&directory.join(first)).map(drop))
    }

    fn prepare_with(
        directory: PathBuf,
        files: &[&str],
        probe: impl Fn(&Path) -> std::io::Result<()>,
    ) -> Result<Output> {
        let mut output = Output { directory, made: Vec::new() };
        let mut inside: Vec<PathBuf> =
            files.iter().filter_map(|name| Some(output.directory.join(name).parent()?.to_owned())).collect();
        inside.insert(0, output.directory.clone());
        inside.dedup();
        for directory in inside {
            let missing = directory.ancestors().filter(|path| !path.as_os_str().is_empty());
            let missing: Vec<PathBuf> =
                missing.take_while(|path| !path.exists()).map(Path::to_owned).collect();
            output.made.splice(0..0, missing);
            std::fs::create_dir_all(&directory)
                .and_then(|()| probe(&directory))
                .map_err(|why| Error::OutputDirectory { path: directory.clone(), why: why.to_string() })?;
        }
        match files.iter().find(|name| output.directory.join(name).is_dir()) {
            None => Ok(output),
            Some(name) => {
                let why = format!("`{name}`, a file to be written there, is a directory");
                Err(Error::OutputDirectory { path: output.directory.clone(), why })
            }
        }
    }

    /// The directory.
    pub(crate) fn directory(&self) -> &Path {
        &self.directory
    }

    /// The directory, which stays even if nothing is written into it here.
    pub(crate) fn keep(mut self) -> PathBuf {
        self.made.clear();
        std::mem::take(&mut self.directory)
    }

    /// A file of the directory that is written as its content comes, for [`Output::write_beside`].
    pub(crate) fn draft<'a>(&self, name: &'a str) -> Result<Draft<'a>> {
        let file = temporary(&self.directory).map_err(|why| cannot(&self.directory.join(name), &why))?;
        Ok(Draft { name, file })
    }

    /// Writes all files or none: first under temporary names, then renamed. Returns their paths.
    pub(crate) fn write(self, files: &[(&str, Vec<u8>)]) -> Result<Vec<PathBuf>> {
        self.write_beside(files, Vec::new())
    }

    /// The same with files that have been written already.
    pub(crate) fn write_beside(
        mut self,
        files: &[(&str, Vec<u8>)],
        drafts: Vec<Draft>,
    ) -> Result<Vec<PathBuf>> {
        let mut written = Vec::with_capacity(files.len() + drafts.len());
        for (name, bytes) in files {
            let path = self.directory.join(name);
            let file = temporary(&self.directory)
                .and_then(|mut file| file.write_all(bytes).map(|()| file))
                .map_err(|why| cannot(&path, &why))?;
            written.push((path, file));
        }
        written.extend(drafts.into_iter().map(|draft| (self.directory.join(draft.name), draft.file)));
        let mut paths = Vec::with_capacity(files.len());
        for (path, file) in written {
            file.persist(&path).map_err(|why| cannot(&path, &why.error))?;
            paths.push(path);
        }
        self.made.clear();
        Ok(paths)
    }
}

impl Drop for Output {
    fn drop(&mut self) {
        for directory in &self.made {
            // Fails, as it should, when there is something in it.
            let _ = std::fs::remove_dir(directory);
        }
    }
}

/// A file that is written as its content comes; dropped, it leaves nothing.
#[derive(Debug)]
pub(crate) struct Draft<'a> {
    name: &'a str,
    pub(crate) file: NamedTempFile,
}

/// A file under a temporary name that has the permissions of any other new file once it is renamed.
fn temporary(directory: &Path) -> std::io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".squealmap-").suffix(".tmp");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(directory)
}

/// The list of written files for the end of a command.
pub(crate) fn list(paths: &[PathBuf]) -> String {
    paths.iter().fold(String::new(), |text, path| text + "wrote " + &path.display().to_string() + "\n")
}

/// A claim on a file that is written piece by piece.
pub(crate) fn claim(path: &Path) -> Result<Claim> {
    Claim::take(path)
        .and_then(|claim| claim.ok_or_else(|| std::io::Error::other("another process is writing it")))
        .map_err(|why| cannot(path, &why))
}

/// The error of a file that cannot be written.
pub(crate) fn cannot(path: &Path, why: &std::io::Error) -> Error {
    Error::Write { path: path.to_owned(), why: why.to_string() }
}
