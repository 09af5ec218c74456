//! `squealmap modes`: eigenvalues against an axis.

use clap::Args;
use squealmap::Result;
use squealmap::export::{modes, png};
use squealmap::spec::Spec;

use crate::cli::output::{Output, list};
use crate::cli::{Files, print};

/// What is written.
const FILES: [&str; 3] = ["modes.csv", "modes.png", "modes.svg"];

/// Arguments of `modes`.
#[derive(Debug, Args)]
pub(crate) struct Modes {
    #[command(flatten)]
    files: Files,
}

impl Modes {
    pub(crate) fn execute(self) -> Result<()> {
        let spec = Spec::read(&self.files.sweep)?;
        let output = Output::prepare(self.files.directory(), &FILES)?;
        let svg = modes::modes_svg(&spec)?;
        let files = [
            (FILES[0], modes::modes_csv(&spec)?),
            (FILES[1], png::render(&svg)?),
            (FILES[2], svg.into_bytes()),
        ];
        print(&list(&output.write(&files)?));
        Ok(())
    }
}
