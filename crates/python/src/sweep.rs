//! A sweep as Python hands it over, and what is to compute it.

use std::path::PathBuf;

use pyo3::prelude::*;
use squealmap::engine::backend::Backend;
use squealmap::engine::options::Options;
use squealmap::engine::precision::Precision;
use squealmap::store::directory::Note;
use squealmap::sweep::accuracy::level::Level;
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
    /// Its instances, where they are given one by one: the columns by their names.
    #[pyo3(item)]
    points: Option<Vec<(String, Points)>>,
    /// The directory that the files it names are relative to.
    #[pyo3(item)]
    directory: PathBuf,
}

/// A column of points.
#[derive(Clone, Debug, FromPyObject)]
pub(crate) enum Points {
    Numbers(Vec<f64>),
    Names(Vec<String>),
}

impl Points {
    /// The field of a row; columns are as long as each other.
    fn field(&self, row: usize) -> String {
        match self {
            Points::Numbers(numbers) => numbers.get(row).map(f64::to_string).unwrap_or_default(),
            Points::Names(names) => names.get(row).map(|name| quoted(name)).unwrap_or_default(),
        }
    }

    fn len(&self) -> usize {
        match self {
            Points::Numbers(numbers) => numbers.len(),
            Points::Names(names) => names.len(),
        }
    }
}

/// Points as the text of the file that a sweep would name.
fn table(columns: &[(String, Points)]) -> String {
    let line = |fields: Vec<String>| fields.join(",") + "\n";
    let rows = columns.iter().map(|(_, column)| column.len()).max().unwrap_or_default();
    let header = line(columns.iter().map(|(name, _)| quoted(name)).collect());
    (0..rows)
        .fold(header, |text, row| text + &line(columns.iter().map(|(_, column)| column.field(row)).collect()))
}

/// A field in double quotes.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

impl Sweep {
    /// Reads and validates it.
    ///
    /// # Errors
    /// When anything in it is not valid.
    pub(crate) fn spec(&self) -> Result<Spec, Failure> {
        if let Some(file) = &self.file {
            return Ok(Spec::read(file)?);
        }
        let points = self.points.as_deref().map(table);
        Ok(Spec::of_lines(&self.lines, points.as_deref(), &self.directory)?)
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
    accuracy: Option<String>,
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

impl Engine {
    /// The accuracy that is asked for.
    ///
    /// # Errors
    /// For a word that is none.
    pub(crate) fn level(&self) -> Result<Option<Level>, Failure> {
        let parsed = |said: &String| {
            let quoted = squealmap_input::quote::quoted(said);
            Level::parse(said).map_err(|why| Failure::input(format!("accuracy is \"{quoted}\" but {why}")))
        };
        self.accuracy.as_ref().map(parsed).transpose()
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
