//! `squealmap modes`: eigenvalues against an axis.

use clap::Args;
use squealmap::Result;
use squealmap::export::{modes, png};
use squealmap::spec::Spec;

use crate::cli::output::{Output, list};
use crate::cli::{Files, print};

/// Arguments of `modes`.
#[derive(Debug, Args)]
pub(crate) struct Modes {
    #[command(flatten)]
    files: Files,
}

impl Modes {
    pub(crate) fn execute(self) -> Result<()> {
        let spec = Spec::read(&self.files.sweep)?;
        let output = Output::prepare(self.files.directory())?;
        let svg = modes::modes_svg(&spec)?;
        let files = [
            ("modes.csv", modes::modes_csv(&spec)?),
            ("modes.png", png::render(&svg)?),
            ("modes.svg", svg.into_bytes()),
        ];
        print(&list(&output.write(&files)?));
        Ok(())
    }
}
