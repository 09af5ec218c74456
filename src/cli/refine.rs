//! `squealmap refine`: the lines of a large map from few of its instances.

use std::io::{BufWriter, Write};
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;

use crate::cli::engine::EngineArgs;
use crate::cli::error::{Error, Result};
use crate::cli::failed::judged;
use crate::cli::files::Files;
use crate::cli::home::Replace;
use crate::cli::numbers::at_least_one;
use crate::cli::onset::onset_of;
use crate::cli::output::{Output, cannot, cannot_table, claim, list};
use crate::cli::progress::Progress;
use crate::cli::refined::{Checked, DOCUMENT, Ended, FILES};
use crate::cli::signal::{INTERRUPTED, stop_at_signal};
use crate::cli::summary::{classes, summary};
use crate::cli::summed::Summed;
use crate::cli::talk;
use crate::cli::talk::{note, print};
use clap::Args;
use serde_json::json;
use squealmap::disk::Handle;
use squealmap::engine::backend::Backend;
use squealmap::results::csv::MapCsv;
use squealmap::results::manifest::Sum;
use squealmap::store::cut::tile_of;
use squealmap::store::description::Description;
use squealmap::store::parts::{PARTS, Parts};
use squealmap::store::refinement::Refinement;
use squealmap::store::space;
use squealmap::sweep::accuracy::sample::subset;
use squealmap::sweep::label::{Label, Tally};
use squealmap::sweep::refine::{Refined, planes_of, refine};
use squealmap::sweep::solver::Solver;
use squealmap::sweep::spec::refine::{COARSE, Settings};
use squealmap::sweep::spec::{Analysis, Spec, Starts};

/// Arguments of `refine`.
#[derive(Debug, Args)]
pub(crate) struct RefineCommand {
    #[command(flatten)]
    files: Files,
    /// Cells along each side of a map to begin with, 2 to 4096: a region smaller than one of them may be missed
    /// [default: of the sweep's [refine], or 32]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(COARSE.0 as i64..=COARSE.1 as i64))]
    coarse: Option<u16>,
    /// Instances drawn among those that no line asks for, to see what is missed [default: of [refine], or 1000]
    #[arg(long, value_name = "N")]
    sample: Option<u32>,
    /// Seed of the drawing [default: of [refine], or 1]
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    #[command(flatten)]
    pub(crate) engine: EngineArgs,
    #[command(flatten)]
    replace: Replace,
    /// Instances of a part: for tests, which have no time for large ones
    #[arg(long, hide = true, value_parser = at_least_one)]
    tile: Option<usize>,
}

impl RefineCommand {
    pub(crate) fn execute(self) -> Result<ExitCode> {
        let cancel = stop_at_signal()?;
        let spec = Spec::read(&self.files.sweep)?;
        let given = spec.refine.unwrap_or_default();
        let settings = Settings {
            coarse: self.coarse.map_or(given.coarse, usize::from),
            sample: self.sample.map_or(given.sample, |sample| sample as usize),
            seed: self.seed.unwrap_or(given.seed),
        };
        let refining =
            Refining { files: &self.files, engine: &self.engine, replace: self.replace, part: self.tile };
        refining.execute(spec, settings, &cancel)
    }
}

/// A refinement as asked for by `refine`, or by `run` of a sweep with `[refine]`.
#[derive(Debug)]
pub(crate) struct Refining<'a> {
    /// The sweep file and where its results go.
    pub(crate) files: &'a Files,
    /// The options that choose an engine.
    pub(crate) engine: &'a EngineArgs,
    /// The options that say what may be replaced.
    pub(crate) replace: Replace,
    /// Most instances of a part.
    pub(crate) part: Option<usize>,
}

impl Refining<'_> {
    pub(crate) fn execute(
        &self,
        mut spec: Spec,
        settings: Settings,
        cancel: &AtomicBool,
    ) -> Result<ExitCode> {
        // Checks are drawn by the place in a sweep, and what is computed here has another: no columns of theirs either.
        spec.analysis.checked = false;
        // So are the starts of a box; two starts are the same at any place, and their verdicts have lines too.
        if let Starts::Box(_) = spec.analysis.starts {
            note("a refined map has no starts from a box: every instance starts from its kick alone");
            spec.analysis.starts = Starts::One;
        }
        planes_of(&spec.grid)?;
        let mut output = self.files.prepare(&FILES)?;
        let options = self.engine.options(cancel, &note);
        let mut solver = Solver::new(&spec, &options)?;
        let part = self.part.unwrap_or_else(|| tile_of(&spec, self.engine.backend == Backend::Reference));
        let description = Description::new(&spec, solver.computations(), part);
        self.replace.refinement(output.directory(), &self.files.sweep, &description)?;
        output.made_from(&self.files.sweep)?;
        let code = follow(&output, &spec, &mut solver, &Refinement { description, settings })?;
        Ok(judged(code, output.directory(), DOCUMENT))
    }
}

/// Follows the lines of a sweep and writes the results, unless they are there.
pub(crate) fn follow(
    output: &Output,
    spec: &Spec,
    solver: &mut Solver,
    asked: &Refinement,
) -> Result<ExitCode> {
    let directory = output.directory();
    if Checked::read(directory)?.is_some_and(|checked| checked.is_current(asked)) {
        talk::tell("directory", directory.display().to_string());
        talk::tell("complete", true);
        let directory = directory.display();
        print(&format!(
            "all that the lines need was computed before; nothing is left to do in {directory}\n"
        ));
        return Ok(ExitCode::SUCCESS);
    }
    let table_path = directory.join(FILES[0]);
    let mut table = claim(&table_path)?;
    let file = BufWriter::new(table.emptied().map_err(|why| cannot(&table_path, &why))?);
    let rows = MapCsv::new(asked.description.sheet(), Summed::new(file))
        .map_err(|why| cannot_table(&table_path, why))?;
    let parts = Parts::begin(directory, asked)?;
    let used = Vec::new();
    let tally = Tally::default();
    let mut work =
        Work { spec, solver, parts: &parts, directory, table: &table_path, rows, fresh: 0, tally, used };
    let part = asked.description.tiling.tile;
    let refined = refine(&spec.grid, asked.settings, &mut |instances| work.compute(instances, part));
    if refined.is_err() {
        parts.remove_if_empty();
    }
    if refined.as_ref().is_err_and(Error::is_cancelled) {
        note(&stopped(work.fresh));
        return Ok(ExitCode::from(INTERRUPTED));
    }
    let refined = refined?;
    let (fresh, computed) = (work.fresh, work.tally.clone());
    let (used, table_sum) = work.end()?;
    // Results are of the parts that they name: what is gone is computed again before they are written.
    if let Some((gone, _)) = used.iter().find(|(name, checksum)| !parts.has(name, checksum)) {
        note(&format!("`{PARTS}/{gone}` was removed or changed meanwhile; it is computed again"));
        drop(table);
        return follow(output, spec, solver, asked);
    }
    let ended = Ended { spec, asked, refined: &refined, parts: used, table, table_sum };
    let (paths, tally) = ended.write(directory)?;
    tell(directory, &refined, fresh);
    print(&report(&refined, fresh, spec.analysis, [&computed, &tally]));
    print(&onset_of(spec, &computed));
    print(&list(&paths));
    if parts.strangers()? > 0 {
        note("parts of other sweeps, programs or engines stand in `parts` too; they may be removed");
    }
    Ok(ExitCode::SUCCESS)
}

/// A refinement on its way.
struct Work<'a, 's> {
    spec: &'a Spec,
    solver: &'a mut Solver<'s>,
    parts: &'a Parts,
    directory: &'a Path,
    /// The path of the table of points.
    table: &'a Path,
    rows: MapCsv<'a, Summed<BufWriter<&'a mut Handle>>>,
    /// Instances that were computed now.
    fresh: usize,
    /// The labels of all computed instances, now or before, counted.
    tally: Tally,
    /// The parts by name and checksum, in the order of use.
    used: Vec<(String, String)>,
}

impl Work<'_, '_> {
    /// The labels of some instances, in parts of so many.
    fn compute(&mut self, instances: &[usize], size: usize) -> Result<Vec<Label>> {
        talk::detail(&format!("{} more instances", instances.len()));
        let progress = Progress::new(instances.len(), "instances");
        let mut labels = Vec::with_capacity(instances.len());
        for block in instances.chunks(size) {
            self.part(block, &progress, &mut labels)?;
        }
        progress.finish();
        Ok(labels)
    }

    fn part(&mut self, block: &[usize], progress: &Progress, labels: &mut Vec<Label>) -> Result<()> {
        let Work { spec, solver, .. } = self;
        let part = self.parts.records(block, &note, &mut || {
            space::verify_parts(self.directory, spec.analysis, block.len())?;
            let mut sweep = subset(spec, block);
            sweep.analysis.starts = spec.analysis.starts;
            let made = solver.records_of(&sweep, 0..block.len(), &|count| progress.add(count))?;
            made.stopped.map_or(Ok(made.records), |why| Err(why.error(0, block.len()).into()))
        })?;
        if part.found {
            progress.add(block.len());
        } else {
            self.fresh += block.len();
        }
        self.rows.add_some(block, &part.records).map_err(|why| cannot_table(self.table, why))?;
        labels.extend(part.records.iter().map(Label::from));
        self.tally.add(&part.records);
        self.used.push((part.name, part.checksum));
        Ok(())
    }

    /// The parts, and length and checksum of the table.
    fn end(self) -> Result<(Vec<(String, String)>, Sum)> {
        let mut rows = self.rows.finish();
        rows.flush().map_err(|why| cannot(self.table, &why))?;
        Ok((self.used, rows.sum()))
    }
}

/// Tells scripts what [`report`] tells people.
fn tell(directory: &Path, refined: &Refined, fresh: usize) {
    talk::tell("directory", directory.display().to_string());
    talk::tell("instances", refined.labels.len());
    talk::tell("computed", refined.computed);
    talk::tell("computed_now", fresh);
    let (sampled, missed) = (refined.sampled, refined.missed);
    talk::tell(
        "sample",
        json!({ "drawn": sampled, "missed": missed, "missed_at_most": refined.missed_at_most() }),
    );
    talk::tell("complete", true);
}

/// A sentence about a refinement that was stopped, and how it goes on.
fn stopped(fresh: usize) -> String {
    if fresh == 0 {
        return "stopped before another part was done; run the same command again to go on".to_owned();
    }
    format!(
        "stopped after {fresh} more instances, which stay in `parts`; no lines are written yet; run the same command again \
         to go on"
    )
}

/// The report for people: how many instances were computed (`fresh` of them now) and with which results, what the lines say
/// of all instances, and how much may be missed.
fn report(refined: &Refined, fresh: usize, analysis: Analysis, [computed, all]: [&Tally; 2]) -> String {
    let summary = summary(analysis, computed);
    let instances = refined.labels.len();
    let share = 100.0 * refined.computed as f64 / instances as f64;
    let before = match refined.computed - fresh {
        0 => String::new(),
        before => format!(", {before} of them before"),
    };
    if refined.computed == instances {
        return format!("computed all of {instances} instances{before}\n\n{summary}\n");
    }
    let missed = refined.missed_at_most().map_or_else(
        || "nothing was drawn to see what is missed".to_owned(),
        |most| {
            format!(
                "of {} drawn at random among the others {} had another label than the lines said, and what they showed \
                 was followed; at most {:.2} % of the others do (95 % confidence)",
                refined.sampled,
                refined.missed,
                100.0 * most
            )
        },
    );
    format!(
        "computed {} of {instances} instances ({share:.2} %){before}; {missed}\n\nwhat was computed, most of it near \
         lines:\n{summary}\nthe whole map by its lines, {instances} instances, of which those that were not computed have the \
         label of the cell around them:\n{}\n",
        refined.computed,
        classes(analysis, all)
    )
}
