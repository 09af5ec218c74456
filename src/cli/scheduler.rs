//! Calls the programs of a scheduler.

use std::io::{ErrorKind, Write};
use std::path::Path;
use std::process::{Command, Stdio};

use crate::cli::error::{Error, Result};

/// Calls `program` in `directory` with a text as its input; returns what it prints.
///
/// # Errors
/// When it is not there, or refuses; then with its own words.
pub(crate) fn call(
    program: &'static str,
    arguments: &[String],
    directory: &Path,
    input: &str,
) -> Result<String> {
    let failed = |why: std::io::Error| match why.kind() {
        ErrorKind::NotFound => Error::NoScheduler { program },
        _ => Error::Scheduler { program, why: why.to_string() },
    };
    let mut command = Command::new(program);
    command.args(arguments).current_dir(directory);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().map_err(failed)?;
    // One that refuses its arguments may end before it reads; it says why below.
    if let Some(mut pipe) = child.stdin.take() {
        let _ = pipe.write_all(input.as_bytes());
    }
    let output = child.wait_with_output().map_err(failed)?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    let said: Vec<&str> = said.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    let why = if said.is_empty() { output.status.to_string() } else { said.join("; ") };
    Err(Error::Scheduler { program, why })
}
