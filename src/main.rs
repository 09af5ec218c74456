//! The command-line program.

use std::process::ExitCode;

fn main() -> ExitCode {
    squealmap::cli::main(None, std::env::args_os())
}
