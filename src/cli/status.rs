//! `squealmap status`: how far a directory has come.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use squealmap::store::directory::Store;
use squealmap::store::parts::Parts;
use squealmap::store::status::Status;
use squealmap::{Error, Result};

use crate::cli::print;
use crate::cli::progress::seconds;
use crate::cli::refined::DOCUMENT;

/// Arguments of `status`.
#[derive(Debug, Args)]
pub(crate) struct StatusCommand {
    /// Output directory of a run
    directory: PathBuf,
    /// Read every tile and compare its checksum, instead of its length alone
    #[arg(long)]
    verify: bool,
}

impl StatusCommand {
    pub(crate) fn execute(self) -> Result<()> {
        let text = match Store::open(&self.directory) {
            Ok(store) => describe(&store, &Status::new(&store, self.verify)?) + self.hint(),
            Err(no_tiles @ Error::NoTiles { .. }) => self.refinement().ok_or(no_tiles)?,
            Err(why) => return Err(why),
        };
        print(&text);
        Ok(())
    }

    /// What was not looked at.
    fn hint(&self) -> &'static str {
        if self.verify {
            ""
        } else {
            "checked    lengths of tiles alone; --verify reads them and compares their checksums\n"
        }
    }

    /// How far a refinement has come; `None` where there is none.
    fn refinement(&self) -> Option<String> {
        let found = Parts::found(&self.directory).ok().flatten()?;
        let (parts, instances) = (found.good.len(), found.instances);
        let bad = if found.bad.is_empty() { String::new() } else { format!(", {} bad", found.bad.len()) };
        let end = if self.directory.join(DOCUMENT).is_file() {
            "its results are written"
        } else {
            "how many are to come shows on the way"
        };
        Some(format!("refinement  {parts} part(s) of {instances} instances are done{bad}; {end}\n"))
    }
}

fn describe(store: &Store, status: &Status) -> String {
    let description = &store.description;
    let (tiles, total) = (description.tiling.count(), description.tiling.instances);
    let mut text = String::new();
    if !description.title.is_empty() {
        let _ = writeln!(text, "title      {}", description.title);
    }
    let _ = writeln!(text, "sweep      {}, {}", &description.id.to_string()[..16], description.kind);
    let percent = 100.0 * status.instances as f64 / total.max(1) as f64;
    let _ = writeln!(
        text,
        "tiles      {} of {tiles} done, {} in work, {} bad, {} set aside",
        status.done,
        status.in_work,
        status.bad.len(),
        status.set_aside
    );
    let _ = writeln!(text, "instances  {} of {total} done, {percent:.1} %", status.instances);
    if status.kept > 0 {
        let _ =
            writeln!(text, "kept       {} instances of tiles that were stopped on their way", status.kept);
    }
    if let Some(rate) = status.rate {
        let _ = writeln!(text, "rate       {rate:.0} instances/s over the last tiles");
    }
    if let Some(left) = status.left(total) {
        let _ = writeln!(text, "left       {} at this rate", seconds(left.as_secs_f64()));
    }
    for (path, fault) in &status.bad {
        let _ = writeln!(text, "bad        `{path}`: {fault}; the next run computes it again");
    }
    text
}
