//! `squealmap modes`: eigenvalues against an axis.

use crate::cli::error::Result;
use crate::cli::files::Files;
use crate::cli::output::list;
use crate::cli::pictures::png_of;
use crate::cli::talk::print;
use clap::Args;
use squealmap::results::figure::look::Look;
use squealmap::study::modes::follow::{document, draw, modes_of, table};
use squealmap::sweep::spec::Spec;

/// The files that are written.
const FILES: [&str; 4] = ["modes.csv", "modes.json", "modes.png", "modes.svg"];

/// Arguments of `modes`.
#[derive(Debug, Args)]
pub(crate) struct Modes {
    #[command(flatten)]
    files: Files,
}

impl Modes {
    pub(crate) fn execute(self) -> Result<()> {
        let spec = Spec::read(&self.files.sweep)?;
        let output = self.files.prepare_beside(&FILES)?;
        let found = modes_of(&spec)?;
        let svg = draw(&spec, &found, &Look::default());
        let files = [
            (FILES[0], table(&spec, &found)?),
            (FILES[1], document(&spec, &found)?),
            (FILES[2], png_of(&svg)?),
            (FILES[3], svg.into_bytes()),
        ];
        print(&list(&output.write(&files)?));
        Ok(())
    }
}
