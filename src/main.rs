//! The command-line program: parse, call, print the error chain, exit code.

use std::process::ExitCode;

use clap::Parser;

mod cli;

fn main() -> ExitCode {
    match cli::Cli::parse().execute() {
        Ok(code) => code,
        Err(error) => {
            cli::report::report(&error);
            ExitCode::from(match error {
                squealmap::Error::Cancelled { .. } => cli::INTERRUPTED,
                error if error.is_bad_input() => 2,
                _ => 1,
            })
        }
    }
}
