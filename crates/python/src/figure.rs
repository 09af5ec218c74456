//! Figures, and the tables from which the program draws them.

use std::ffi::OsString;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::PathBuf;

use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use squealmap::sweep::columns::Cell;
use squealmap::version::program;
use squealmap_figure::{pdf, png};

use crate::failure::Failure;
use crate::watch::whole;

/// The figure of a directory as SVG, with the options of `squealmap plot`.
#[pyfunction]
pub(crate) fn figure(py: Python<'_>, arguments: Vec<OsString>) -> PyResult<String> {
    whole(py, move |_| squealmap::cli::figure(arguments).map_err(Failure::input))
}

/// A figure in another format, `png` or `pdf`.
#[pyfunction]
pub(crate) fn rendered(
    py: Python<'_>,
    svg: String,
    format: String,
    title: String,
) -> PyResult<Bound<'_, PyBytes>> {
    let bytes = whole(py, move |_| match format.as_str() {
        "png" => Ok(png::render(&svg).map_err(squealmap::results::error::Error::from)?),
        "pdf" => {
            Ok(pdf::render(&svg, &title, "", &program()).map_err(squealmap::results::error::Error::from)?)
        }
        other => Err(Failure::input(format!("a figure is svg, png or pdf, not {other}"))),
    })?;
    Ok(PyBytes::new(py, &bytes))
}

/// A column of a table to be written.
#[derive(Debug, FromPyObject)]
pub(crate) enum Cells<'py> {
    /// Numbers; NaN is an empty cell.
    Numbers(PyReadonlyArray1<'py, f64>),
    /// Codes, and the word of each code from the first on.
    Coded(PyReadonlyArray1<'py, i8>, i8, Vec<String>),
    /// Words.
    Words(Vec<String>),
}

impl Cells<'_> {
    fn cell(&self, row: usize) -> Option<String> {
        Some(match self {
            Cells::Numbers(numbers) => Cell::from(*numbers.as_array().get(row)?).to_string(),
            Cells::Coded(codes, first, words) => {
                let code = codes.as_array().get(row)?.checked_sub(*first);
                let word = code.and_then(|code| words.get(usize::try_from(code).ok()?));
                word.cloned().unwrap_or_default()
            }
            Cells::Words(words) => words.get(row)?.clone(),
        })
    }
}

/// Writes columns as a table; ends at the shortest of them.
#[pyfunction]
pub(crate) fn write_table(path: PathBuf, columns: Vec<(String, Cells<'_>)>) -> PyResult<()> {
    let cannot = |why: csv::Error| PyOSError::new_err(format!("cannot write `{}`: {why}", path.display()));
    let file = File::create(&path).map_err(|why| cannot(why.into()))?;
    let mut out = csv::Writer::from_writer(BufWriter::new(file));
    out.write_record(columns.iter().map(|(name, _)| name)).map_err(cannot)?;
    for row in 0.. {
        let cells: Option<Vec<String>> = columns.iter().map(|(_, cells)| cells.cell(row)).collect();
        match cells.filter(|cells| !cells.is_empty()) {
            Some(cells) => out.write_record(cells).map_err(cannot)?,
            None => break,
        }
    }
    let mut file = out.into_inner().map_err(|why| cannot(why.into_error().into()))?;
    file.flush().map_err(|why| cannot(why.into()))
}
