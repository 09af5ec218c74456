//! `squealmap verify`: is all of a directory as it was written?

use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use squealmap::backend::choice::{Backend, Options};
use squealmap::backend::solver::Solver;
use squealmap::kernel::source::Precision;
use squealmap::store::description::Description;
use squealmap::store::directory::Store;
use squealmap::store::parts::Parts;
use squealmap::store::status::Status;
use squealmap::{Error, Result};

use crate::cli::note;
use crate::cli::print;
use crate::cli::results::faults;
use crate::cli::run::run;
use crate::cli::signal::stop_at_signal;

/// Missing tiles that are named.
const NAMED: usize = 10;

/// Arguments of `verify`.
#[derive(Debug, Args)]
pub(crate) struct Verify {
    /// Output directory of a run
    directory: PathBuf,
    /// Set bad tiles aside, compute what is missing and write the results again, by the engine that computed the others
    #[arg(long)]
    repair: bool,
    /// Worker threads of a repair, 1 to 1024 [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
}

impl Verify {
    pub(crate) fn execute(self) -> Result<ExitCode> {
        let store = match Store::open(&self.directory) {
            Err(no_tiles @ Error::NoTiles { .. }) => return self.parts().ok_or(no_tiles),
            other => other?,
        };
        if self.repair {
            return self.repair(&store);
        }
        let status = Status::new(&store, true)?;
        let bad_kept = store.bad_kept()?;
        let total = store.description.tiling.count();
        let mut text = String::new();
        let _ = writeln!(text, "description  good");
        let _ = writeln!(
            text,
            "tiles        {} of {total} are there and good, {} bad",
            status.done,
            status.bad.len()
        );
        let there = store.numbers()?;
        let lacking = (0..total).filter(|number| there.binary_search(number).is_err());
        for number in lacking.clone().take(NAMED) {
            let _ = writeln!(text, "missing      `{}`", store.path(number).display());
        }
        if let more @ 1.. = lacking.count().saturating_sub(NAMED) {
            let _ = writeln!(text, "missing      {more} more");
        }
        for (path, fault) in status.bad.iter().chain(&bad_kept) {
            let _ = writeln!(text, "bad          `{path}`: {fault}");
        }
        let faults = if self.has_results() { faults(&store) } else { Vec::new() };
        for fault in &faults {
            let _ = writeln!(text, "bad          {fault}");
        }
        let is_good = status.bad.is_empty() && bad_kept.is_empty();
        // A run that was stopped says so itself: its results are no fault.
        let results = match (self.has_results(), faults.as_slice()) {
            (false, _) => "none are written",
            (true, []) => "good, and those of all tiles",
            (true, _) => "not those of all tiles as they are",
        };
        let _ = writeln!(text, "results      {results}");
        print(&text);
        if is_good && faults.is_empty() {
            return Ok(ExitCode::SUCCESS);
        }
        note(&format!("run the same command with --repair to put {} right", self.directory.display()));
        Ok(ExitCode::FAILURE)
    }

    /// Whether a run has written results.
    fn has_results(&self) -> bool {
        ["manifest.json", "map.csv"].iter().any(|name| self.directory.join(name).exists())
    }

    /// The parts of a refinement; `None` where there are none.
    fn parts(&self) -> Option<ExitCode> {
        let [parts, instances, bad] = Parts::found(&self.directory).ok().flatten()?;
        print(&format!("parts        {parts} of {instances} instances are there and good, {bad} bad\n"));
        if bad == 0 {
            return Some(ExitCode::SUCCESS);
        }
        note("run the command that refined it again: bad parts are set aside and computed anew");
        Some(ExitCode::FAILURE)
    }

    /// What `run` does with a directory whose sweep file is at hand.
    fn repair(&self, store: &Store) -> Result<ExitCode> {
        let cancel = stop_at_signal()?;
        let other = || Error::OtherVersion { path: self.directory.clone() };
        let spec = store.description.spec().ok_or_else(other)?;
        let [linear, response] = &store.description.computations;
        let made = response.as_ref().or(linear.as_ref()).ok_or_else(other)?;
        let options = Options {
            backend: Backend::of_name(&made.backend).ok_or_else(other)?,
            precision: [Precision::F32, Precision::F64]
                .into_iter()
                .find(|one| one.to_string() == made.precision),
            strict: made.strict == Some(true),
            cancel: Some(&cancel),
            note: Some(&note),
            ..Options::default()
        };
        let mut solver = Solver::new(&spec, &options)?;
        let description = Description::new(&spec, solver.computations(), store.description.tiling.tile);
        if description.id != store.description.id {
            return Err(other());
        }
        run(store, &mut solver, &cancel, None, None)
    }
}
