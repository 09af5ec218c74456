//! `squealmap explore`: a map to look into, as one page for any browser.

use crate::cli::error::Result;
use crate::cli::files::Files;
use crate::cli::output::list;
use crate::cli::talk::print;
use clap::Args;
use squealmap::study;
use squealmap::study::explore::page;
use squealmap::sweep::spec::Spec;

include!(concat!(env!("OUT_DIR"), "/page.rs"));

/// The file that is written.
const FILE: &str = "explore.html";

/// Arguments of `explore`.
#[derive(Debug, Args)]
pub(crate) struct ExploreCommand {
    #[command(flatten)]
    files: Files,
}

impl ExploreCommand {
    pub(crate) fn execute(self) -> Result<()> {
        let spec = Spec::read(&self.files.sweep)?;
        let page =
            page(&spec, &self.files.sweep.display().to_string(), PAGE.ok_or(study::error::Error::NoPage)?)?;
        let paths = self.files.prepare_beside(&[FILE])?.write(&[(FILE, page)])?;
        print(&format!("open it in a browser; it asks nothing of anywhere\n{}", list(&paths)));
        Ok(())
    }
}
