//! The program itself.

use std::ffi::OsString;
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use pyo3::prelude::*;

/// Runs the program with its arguments, the name first, and gives the exit code. `program` is the file that starts it, where
/// there is one.
#[pyfunction]
pub(crate) fn main(py: Python<'_>, program: Option<PathBuf>, arguments: Vec<OsString>) -> u8 {
    py.detach(move || {
        let code = squealmap::cli::main(program, arguments);
        let _ = std::io::stdout().flush();
        (0..=u8::MAX).find(|number| ExitCode::from(*number) == code).unwrap_or(1)
    })
}
