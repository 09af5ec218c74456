//! The command-line program: parse, call, print the error chain, exit code.

use std::process::ExitCode;

use clap::Parser;

mod cli;

fn main() -> ExitCode {
    match cli::Cli::parse().execute() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            cli::report::report(&error);
            ExitCode::from(if error.is_bad_input() { 2 } else { 1 })
        }
    }
}
