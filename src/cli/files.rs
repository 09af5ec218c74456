//! The sweep file and where its results go.

use crate::cli::error::Result;
use crate::cli::home::{directory, prepare, prepare_beside};
use crate::cli::output::Output;
use clap::Args;
use std::path::PathBuf;

/// The sweep file and where its results go.
#[derive(Debug, Args)]
pub(super) struct Files {
    /// Sweep file (TOML)
    pub(crate) sweep: PathBuf,
    /// Output directory [default: out/<name of the sweep file>, with a number where another file of this name has that]
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
}

impl Files {
    /// The output directory, see [`directory`].
    pub(crate) fn directory(&self) -> Result<PathBuf> {
        directory(&self.sweep, self.output.as_deref())
    }

    /// The output directory ready for `files`.
    pub(crate) fn prepare(&self, files: &[&str]) -> Result<Output> {
        prepare(&self.sweep, self.output.as_deref(), files)
    }

    /// The output directory ready for `files` that are made in seconds, see [`prepare_beside`].
    pub(crate) fn prepare_beside(&self, files: &[&str]) -> Result<Output> {
        prepare_beside(&self.sweep, self.output.as_deref(), files)
    }
}
