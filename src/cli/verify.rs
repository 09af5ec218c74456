//! `squealmap verify`: is all of a directory as it was written?

use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;

use crate::cli::error::{Error, Result};
use crate::cli::output::Output;
use crate::cli::refine::follow;
use crate::cli::refined::{Checked, FILES};
use crate::cli::results::faults;
use crate::cli::run::run;
use crate::cli::signal::stop_at_signal;
use crate::cli::talk;
use crate::cli::talk::{note, print};
use clap::Args;
use serde_json::json;
use squealmap::engine::backend::Backend;
use squealmap::engine::options::Options;
use squealmap::engine::precision::Precision;
use squealmap::store::description::Description;
use squealmap::store::directory::Store;
use squealmap::store::parts::Parts;
use squealmap::store::status::Status;
use squealmap::sweep::solver::Solver;
use squealmap::sweep::spec::Spec;

/// Missing tiles that are named.
const NAMED: usize = 10;

/// Arguments of `verify`.
#[derive(Debug, Args)]
pub(crate) struct Verify {
    /// Output directory of a run or a refinement
    directory: PathBuf,
    /// Set bad tiles and parts aside, compute what is missing and write the results again, by the engine that computed the
    /// others
    #[arg(long)]
    repair: bool,
    /// Worker threads of a repair, 1 to 1024 [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
}

impl Verify {
    pub(crate) fn execute(self) -> Result<ExitCode> {
        let refined = Checked::read(&self.directory)?;
        let store = match Store::open(&self.directory) {
            Err(squealmap::store::error::Error::NoTiles { .. }) if refined.is_some() => None,
            other => Some(other?),
        };
        if self.repair {
            return self.repair(store, refined);
        }
        let mut text = String::new();
        let of_tiles = store.map_or(Ok(true), |store| self.of_tiles(&store, &mut text))?;
        let of_parts = refined.as_ref().is_none_or(|checked| of_parts(checked, &mut text));
        print(&text);
        talk::tell("good", of_tiles && of_parts);
        if of_tiles && of_parts {
            return Ok(ExitCode::SUCCESS);
        }
        match refined.filter(|_| !of_parts).map(|checked| checked.asked(&self.directory).map(drop)) {
            Some(Err(why)) => note(&why.to_string()),
            _ => {
                note(&format!(
                    "run the same command with --repair to put {} right",
                    self.directory.display()
                ));
            }
        }
        Ok(ExitCode::FAILURE)
    }

    /// Says how the tiles are and what was made of them; whether all is good.
    fn of_tiles(&self, store: &Store, text: &mut String) -> Result<bool> {
        let status = Status::new(store, true)?;
        let bad_kept = store.bad_kept()?;
        let total = store.description.tiling.count();
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
        let bad: Vec<String> =
            status.bad.iter().chain(&bad_kept).map(|(path, fault)| format!("`{path}`: {fault}")).collect();
        talk::tell("tiles", json!({ "total": total, "good": status.done, "bad": bad }));
        for (path, fault) in status.bad.iter().chain(&bad_kept) {
            let _ = writeln!(text, "bad          `{path}`: {fault}");
        }
        let faults = if self.has_results() { faults(store) } else { Vec::new() };
        talk::tell("results", json!({ "written": self.has_results(), "faults": faults }));
        for fault in &faults {
            let _ = writeln!(text, "bad          {fault}");
        }
        // A run that was stopped says so itself: its results are no fault.
        let results = match (self.has_results(), faults.as_slice()) {
            (false, _) => "none are written",
            (true, []) => "good, and those of all tiles",
            (true, _) => "not those of all tiles as they are",
        };
        let _ = writeln!(text, "results      {results}");
        Ok(status.bad.is_empty() && bad_kept.is_empty() && faults.is_empty())
    }

    /// Whether a run has written results.
    fn has_results(&self) -> bool {
        ["manifest.json", "map.csv"].iter().any(|name| self.directory.join(name).exists())
    }

    /// Repairs a directory as `run` and `refine` would, which have the sweep file at hand.
    fn repair(&self, store: Option<Store>, refined: Option<Checked>) -> Result<ExitCode> {
        let cancel = stop_at_signal()?;
        if let Some(store) = store {
            let ended = self
                .again(&store.description, &cancel, |_, solver| run(&store, solver, &cancel, None, None))?;
            if ended != ExitCode::SUCCESS {
                return Ok(ended);
            }
        }
        let Some(checked) = refined else { return Ok(ExitCode::SUCCESS) };
        let asked = checked.asked(&self.directory)?;
        let ended = self.again(&asked.description, &cancel, |spec, solver| {
            follow(&Output::prepare(self.directory.clone(), &FILES)?, spec, solver, asked)
        })?;
        if ended == ExitCode::SUCCESS {
            Parts::expel_damaged(&self.directory, &note)?;
        }
        Ok(ended)
    }

    /// Does something with the sweep of a description and what computed it.
    fn again(
        &self,
        description: &Description,
        cancel: &AtomicBool,
        work: impl FnOnce(&Spec, &mut Solver) -> Result<ExitCode>,
    ) -> Result<ExitCode> {
        let other = || Error::OtherVersion { path: self.directory.clone() };
        let spec = description.spec().ok_or_else(other)?;
        let [linear, response] = &description.computations;
        let made = response.as_ref().or(linear.as_ref()).ok_or_else(other)?;
        let options = Options {
            backend: Backend::of_name(&made.backend).ok_or_else(other)?,
            precision: [Precision::F32, Precision::F64]
                .into_iter()
                .find(|one| one.to_string() == made.precision),
            strict: made.strict == Some(true),
            cancel: Some(cancel),
            note: Some(&note),
            ..Options::default()
        };
        let mut solver = Solver::new(&spec, &options)?;
        let now = Description::new(&spec, solver.computations(), description.tiling.tile);
        if now.id != description.id {
            return Err(other());
        }
        work(&spec, &mut solver)
    }
}

/// Says how the parts of a refinement are and what was made of them; whether all is good.
fn of_parts(checked: &Checked, text: &mut String) -> bool {
    let Checked { found, has_results, faults, .. } = checked;
    talk::tell(
        "parts",
        json!({ "good": found.good.len(), "bad": found.bad.len(), "instances": found.instances }),
    );
    talk::tell("faults", faults.clone());
    let (parts, instances, bad) = (found.good.len(), found.instances, found.bad.len());
    let _ = writeln!(text, "parts        {parts} of {instances} instances are there and good, {bad} bad");
    for fault in faults {
        let _ = writeln!(text, "bad          {fault}");
    }
    let results = match (has_results, faults.as_slice()) {
        (false, _) => "none are written",
        (true, []) => "good, and those of the parts that `refine.json` names",
        (true, _) => "not known to be those of the parts as they are",
    };
    let _ = writeln!(text, "results      {results}");
    faults.is_empty()
}
