//! `squealmap status`: how far a directory has come.

use std::fmt::Write;
use std::path::PathBuf;
use std::thread;
use std::time::Duration;

use crate::cli::error::Result;
use crate::cli::progress::seconds;
use crate::cli::refined::DOCUMENT;
use crate::cli::talk;
use crate::cli::talk::print;
use clap::Args;
use console::Term;
use serde_json::json;
use squealmap::store::directory::Store;
use squealmap::store::parts::Parts;
use squealmap::store::status::Status;

/// Arguments of `status`.
#[derive(Debug, Args)]
pub(crate) struct StatusCommand {
    /// Output directory of a run
    directory: PathBuf,
    /// Read every tile and compare its checksum, instead of its length alone
    #[arg(long)]
    verify: bool,
    /// Say it again every so many seconds until all is done [default: 2]; with --json once, at the end
    #[arg(long, value_name = "S", num_args = 0..=1, require_equals = true, default_missing_value = "2",
          value_parser = clap::value_parser!(u64).range(1..=86_400))]
    watch: Option<u64>,
}

impl StatusCommand {
    pub(crate) fn execute(self) -> Result<()> {
        loop {
            let (text, is_done) = match Store::open(&self.directory) {
                Ok(store) => {
                    let status = Status::new(&store, self.verify)?;
                    tell(&store, &status);
                    let is_done = status.done == store.description.tiling.count();
                    (describe(&store, &status) + self.hint(), is_done)
                }
                // Parts say what is done, and nothing how much is to come, until the results are there.
                Err(no_tiles @ squealmap::store::error::Error::NoTiles { .. }) => {
                    (self.refinement().ok_or(no_tiles)?, self.directory.join(DOCUMENT).is_file())
                }
                Err(why) => return Err(why.into()),
            };
            let Some(seconds) = self.watch else {
                print(&text);
                return Ok(());
            };
            let terminal = Term::stdout();
            let _ = if terminal.is_term() { terminal.clear_screen() } else { Ok(()) };
            print(&text);
            // Nobody reads on.
            if is_done || talk::has_failed() {
                return Ok(());
            }
            thread::sleep(Duration::from_secs(seconds));
            if !terminal.is_term() {
                print("\n");
            }
        }
    }

    /// A line about the checks that were left out.
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
        talk::tell("parts", parts);
        talk::tell("instances", json!({ "done": instances }));
        talk::tell("complete", self.directory.join(DOCUMENT).is_file());
        let bad = if found.bad.is_empty() { String::new() } else { format!(", {} bad", found.bad.len()) };
        let end = if self.directory.join(DOCUMENT).is_file() {
            "its results are written"
        } else {
            "how many are to come shows on the way"
        };
        Some(format!("refinement  {parts} part(s) of {instances} instances are done{bad}; {end}\n"))
    }
}

/// Tells scripts how far a run has come.
fn tell(store: &Store, status: &Status) {
    let description = &store.description;
    let (tiles, total) = (description.tiling.count(), description.tiling.instances);
    let bad: Vec<&String> = status.bad.iter().map(|(path, _)| path).collect();
    talk::tell("title", description.title.clone());
    talk::tell("sweep_id", description.id.to_string());
    talk::tell(
        "tiles",
        json!({ "total": tiles, "done": status.done, "in_work": status.in_work, "bad": bad, "set_aside": status.set_aside }),
    );
    talk::tell("instances", json!({ "total": total, "done": status.instances, "kept": status.kept }));
    talk::tell("instances_per_second", status.rate);
    talk::tell("seconds_left", status.left(total).map(|left| left.as_secs_f64()));
    talk::tell("complete", status.done == tiles);
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
