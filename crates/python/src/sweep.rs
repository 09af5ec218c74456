//! A sweep as Python hands it over, and what is to compute it.

use std::path::PathBuf;

use pyo3::prelude::*;
use squealmap::engine::backend::Backend;
use squealmap::engine::options::Options;
use squealmap::engine::precision::Precision;
use squealmap::store::directory::Note;
use squealmap::sweep::spec::Spec;

use crate::failure::Failure;
use crate::watch::Watch;

/// A sweep: a file, or its keys written one a line.
#[derive(Clone, Debug, FromPyObject)]
pub(crate) struct Sweep {
    #[pyo3(item)]
    file: Option<PathBuf>,
    #[pyo3(item)]
    lines: String,
    /// The directory that the files it names are relative to.
    #[pyo3(item)]
    directory: PathBuf,
}

impl Sweep {
    /// Reads and validates it.
    ///
    /// # Errors
    /// When anything in it is not valid.
    pub(crate) fn spec(&self) -> Result<Spec, Failure> {
        Ok(match &self.file {
            Some(file) => Spec::read(file)?,
            None => Spec::of_lines(&self.lines, &self.directory)?,
        })
    }
}

/// What is to compute a sweep, in the words of the command line.
#[derive(Clone, Debug, FromPyObject)]
pub(crate) struct Engine {
    #[pyo3(item)]
    backend: String,
    #[pyo3(item)]
    precision: Option<String>,
    #[pyo3(item)]
    strict: bool,
    #[pyo3(item)]
    adapter: Option<String>,
    #[pyo3(item)]
    require_gpu: bool,
    #[pyo3(item)]
    pub(crate) threads: Option<usize>,
}

/// Threads that the command line takes.
const THREADS: std::ops::RangeInclusive<usize> = 1..=1024;

impl Engine {
    /// The options of a computation that `watch` can stop.
    ///
    /// # Errors
    /// For a name that is none.
    pub(crate) fn options<'a>(&'a self, watch: &'a Watch, note: Note<'a>) -> Result<Options<'a>, Failure> {
        if let Some(threads) = self.threads.filter(|threads| !THREADS.contains(threads)) {
            return Err(Failure::input(format!(
                "threads is {threads} but must be from {} to {}",
                THREADS.start(),
                THREADS.end()
            )));
        }
        let precision = self.precision.as_deref();
        let precision =
            precision.map(|said| named("precision", said, &Precision::ALL, Precision::name)).transpose()?;
        Ok(Options {
            backend: named("backend", &self.backend, &Backend::OFFERED, Backend::name)?,
            precision,
            strict: self.strict,
            require_gpu: self.require_gpu,
            adapters: self.adapter.as_slice(),
            chunk: None,
            cancel: Some(watch.cancel()),
            note: Some(note),
        })
    }
}

/// One of some values by its name.
pub(crate) fn named<T: Copy>(
    what: &str,
    said: &str,
    all: &[T],
    name: fn(T) -> &'static str,
) -> Result<T, Failure> {
    all.iter().copied().find(|one| name(*one) == said).ok_or_else(|| {
        let names: Vec<&str> = all.iter().map(|one| name(*one)).collect();
        let said = squealmap_input::quote::quoted(said);
        Failure::input(format!("{what} is \"{said}\" but must be one of {}", names.join(", ")))
    })
}
