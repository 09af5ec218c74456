//! The directory of the results of an input file: which one it is by default, and whose results it may already hold.

use crate::cli::error::{Error, Result};
use crate::cli::output::Output;
use crate::cli::talk::note;
use clap::Args;
use squealmap::store::description::Description;
use squealmap::store::directory::{Store, TILES};
use squealmap::store::occupant::Occupant;
use squealmap::store::origin;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// Where the directories of results are by default.
const OUT: &str = "out";

/// The output directory of an input file: the one asked for, or else `out/NAME` for `NAME.toml`. Where that holds results of
/// another file of this name, it is `out/NAME-2`, and so on. An input file finds its own directory again.
pub(crate) fn directory(input: &Path, asked: Option<&Path>) -> Result<PathBuf> {
    if let Some(asked) = asked {
        return Ok(asked.to_owned());
    }
    let first = Path::new(OUT).join(stem(input)?);
    let Ok(input) = input.canonicalize() else { return Ok(first) };
    let mut directory = first.clone();
    let mut number = 1;
    while origin::of(&directory).is_some_and(|other| other != input) {
        number += 1;
        let mut name = first.as_os_str().to_owned();
        name.push(format!("-{number}"));
        directory = name.into();
    }
    Ok(directory)
}

/// Makes that directory ready for `files`, and says where another file of the same name has the first.
pub(crate) fn prepare(input: &Path, asked: Option<&Path>, files: &[&str]) -> Result<Output> {
    let directory = directory(input, asked)?;
    if asked.is_none() {
        let first = Path::new(OUT).join(stem(input)?);
        if let Some(other) = origin::of(&first).filter(|_| directory != first) {
            let (first, other) = (first.display(), short(&other));
            note(&format!(
                "`{first}` is of `{}`; the results go to `{}`",
                other.display(),
                directory.display()
            ));
        }
    }
    Output::prepare(directory, files)
}

/// Makes the directory ready for `files` that are made in seconds. They replace others of their names, and the directory
/// goes on belonging to the input file that it was made from.
pub(crate) fn prepare_beside(input: &Path, asked: Option<&Path>, files: &[&str]) -> Result<Output> {
    let mut output = prepare(input, asked, files)?;
    if origin::written(output.directory()).is_none() {
        output.made_from(input)?;
    }
    Ok(output)
}

/// A path as seen from here, where it is below.
fn short(path: &Path) -> PathBuf {
    let here = std::env::current_dir().and_then(|here| here.canonicalize()).unwrap_or_default();
    path.strip_prefix(here).unwrap_or(path).to_owned()
}

/// Says what may be replaced.
#[derive(Clone, Copy, Debug, Default, Args)]
pub(crate) struct Replace {
    /// Replace the results of another sweep that are in the output directory
    #[arg(long)]
    pub(crate) force: bool,
}

impl Replace {
    /// Makes room for the tiles and results of a sweep. What the same sweep file gave before it was changed gives way if it is
    /// a single tile, which is made again in seconds; other results only if that was asked for.
    pub(crate) fn tiles(
        self,
        directory: &Path,
        input: Option<&Path>,
        description: &Description,
    ) -> Result<()> {
        let Some(there) = Occupant::of_run(directory)? else { return Ok(()) };
        let is_cut_alike = there.tiles.is_none_or(|(_, total)| total == description.tiling.count());
        if there.sweep == description.id.to_string() && is_cut_alike {
            return Ok(());
        }
        let is_own = input.is_some_and(|input| origin::is_of(directory, input));
        self.decide(directory, &there, is_own && there.is_cheap())?;
        if self.force && directory.join(TILES).is_dir() {
            Store { directory: directory.to_owned(), description: description.clone() }.remove_strangers()?;
        }
        Ok(())
    }

    /// Makes room for the results of a refinement. The parts that are there stay in any case.
    pub(crate) fn refinement(self, directory: &Path, input: &Path, description: &Description) -> Result<()> {
        match Occupant::of_refinement(directory) {
            Some(there) if there.sweep != description.id.to_string() => {
                self.decide(directory, &there, origin::is_of(directory, input))
            }
            _ => Ok(()),
        }
    }

    /// Makes room for the file `name`, which takes minutes to make: one of another input file is replaced only if that was
    /// asked for.
    pub(crate) fn file(self, directory: &Path, input: &Path, name: &'static str) -> Result<()> {
        match origin::of(directory) {
            Some(from)
                if !self.force && directory.join(name).exists() && !origin::is_of(directory, input) =>
            {
                Err(Error::OtherInput { path: directory.to_owned(), name, from: short(&from) })
            }
            _ => Ok(()),
        }
    }

    /// Makes room for the files of a command that takes minutes: where any of them stands there and is not known to be of this
    /// input file, it is replaced only if that was asked for.
    pub(crate) fn files(self, directory: &Path, input: &Path, names: &[&'static str]) -> Result<()> {
        let there = names.iter().copied().find(|name| directory.join(name).exists());
        let Some(name) = there.filter(|_| !origin::is_of(directory, input)) else { return Ok(()) };
        if self.force {
            return Ok(());
        }
        let from = origin::of(directory).map_or_else(|| "an unknown file".into(), |from| short(&from));
        Err(Error::OtherInput { path: directory.to_owned(), name, from })
    }

    fn decide(self, directory: &Path, there: &Occupant, gives_way: bool) -> Result<()> {
        if !self.force && !gives_way {
            return Err(squealmap::store::error::Error::OtherSweep {
                path: directory.to_owned(),
                there: there.to_string(),
            }
            .into());
        }
        note(&format!("replaces what is in `{}`: {there}", directory.display()));
        Ok(())
    }
}

/// The name of a file without its ending, for a directory of its own.
pub(super) fn stem(path: &Path) -> Result<&OsStr> {
    let stem = path.file_stem().unwrap_or_default();
    // `..toml` and `...toml` are files, but what remains of their names is no directory of their own.
    if stem.is_empty() || stem == "." || stem == ".." {
        return Err(Error::NoStem { path: path.to_owned() });
    }
    Ok(stem)
}
