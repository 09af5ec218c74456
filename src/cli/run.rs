//! `squealmap run`: a whole sweep.

use crate::cli::accuracy::{AccuracyArgs, ranked, said};
use crate::cli::engine::EngineArgs;
use crate::cli::error::{Error, Result};
use crate::cli::failed::judged;
use crate::cli::files::Files;
use crate::cli::home::Replace;
use crate::cli::numbers::at_least_one;
use crate::cli::onset::onset_of;
use crate::cli::output::list;
use crate::cli::progress::{Progress, seconds};
use crate::cli::refine::Refining;
use crate::cli::results::{FILES, MANIFEST, Results};
use crate::cli::signal::{INTERRUPTED, stop_at_signal};
use crate::cli::summary::summary;
use crate::cli::talk::{note, print};
use crate::cli::{results, talk};
use squealmap::engine::backend::Backend;
use squealmap::engine::computation::Stopped;
use squealmap::engine::options::Options;
use squealmap::results::manifest;
use squealmap::store::cut::tile_of;
use squealmap::store::description::Description;
use squealmap::store::directory::Store;
use squealmap::store::fill::{Watch, fill};
use squealmap::store::finish::Filled;
use squealmap::store::reuse::Reuse;
use squealmap::store::shard::Shard;
use squealmap::store::space;
use squealmap::sweep::accuracy::level::Level;
use squealmap::sweep::accuracy::trial::first_that_keeps;
use squealmap::sweep::label::Tally;
use squealmap::sweep::solver::Solver;
use squealmap::sweep::spec::Spec;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use clap::Args;
use serde_json::json;

/// Arguments of `run`.
#[derive(Debug, Args)]
pub(crate) struct Run {
    #[command(flatten)]
    files: Files,
    #[command(flatten)]
    engine: EngineArgs,
    #[command(flatten)]
    accuracy: AccuracyArgs,
    /// Compute no instance again: the manifest then says nothing of the error
    #[arg(long)]
    no_check: bool,
    /// Only a share of the tiles, k of n with k from 0 to n - 1, and no results, which `merge` writes; `auto` takes
    /// k and n, `auto/n` takes k from the task of Slurm, mpirun, Kubernetes, PBS or HyperQueue
    #[arg(long, value_name = "K/N", value_parser = shard)]
    shard: Option<Shard>,
    /// Output directory of a run of this sweep with other values of the axes: instances of both are taken over
    #[arg(long, value_name = "DIR")]
    reuse: Option<PathBuf>,
    #[command(flatten)]
    replace: Replace,
    /// Instances of a tile: for tests, which have no time for large ones
    #[arg(long, hide = true, value_parser = at_least_one)]
    tile: Option<usize>,
}

impl Run {
    /// Instances of a tile of a sweep.
    pub(crate) fn tile(&self, spec: &Spec) -> usize {
        self.tile.unwrap_or_else(|| {
            let by_reference =
                self.engine.backend == Backend::Reference || self.accuracy.accuracy == Some(Level::Reference);
            tile_of(spec, by_reference)
        })
    }

    /// Worker threads that were asked for.
    pub(crate) fn threads(&self) -> Option<u16> {
        self.engine.threads
    }

    /// The engine that was asked for.
    pub(crate) fn backend(&self) -> Backend {
        self.engine.backend
    }

    /// Whether it takes over the instances of another directory.
    pub(crate) fn reuses(&self) -> bool {
        self.reuse.is_some()
    }

    /// The options that say what may be replaced.
    pub(crate) fn replace(&self) -> Replace {
        self.replace
    }

    /// The accuracy that was asked for.
    pub(crate) fn accuracy(&self) -> Option<Level> {
        self.accuracy.accuracy
    }

    pub(crate) fn execute(self) -> Result<ExitCode> {
        let cancel = stop_at_signal()?;
        let mut spec = Spec::read(&self.files.sweep)?;
        spec.analysis.checked &= !self.no_check;
        spec.beyond_its_modes().iter().for_each(|why| note(&format!("warning: {why}")));
        if let Some(settings) = spec.refine {
            self.can_refine()?;
            let refining =
                Refining { files: &self.files, engine: &self.engine, replace: self.replace, part: self.tile };
            return refining.execute(spec, settings, &cancel);
        }
        let options = self.engine.options(&cancel, &note);
        let level = self.accuracy.accuracy;
        let ranked = level.map(|level| ranked(level, &spec, &options)).transpose()?.flatten();
        let mut output = self.files.prepare(&FILES)?;
        let choice = ranked.map(|ranked| first_that_keeps(ranked, &spec, &options)).transpose()?;
        let options = match &choice {
            None => options,
            Some(choice) => {
                for sentence in said(&choice.chosen) {
                    note(&sentence);
                }
                spec = choice.configuration.sweep(&spec);
                Options { adapters: options.adapters, ..choice.configuration.options(&options) }
            }
        };
        let mut solver = Solver::new(&spec, &options)?;
        let mut description = Description::new(&spec, solver.computations(), self.tile(&spec));
        description.accuracy = choice.as_ref().map(|choice| choice.chosen.clone());
        let reuse = self.reuse.as_ref();
        let reuse =
            reuse.map(|directory| Reuse::new(directory, &description, output.directory())).transpose()?;
        self.replace.tiles(output.directory(), Some(&self.files.sweep), &description)?;
        output.made_from(&self.files.sweep)?;
        let store = Store::begin(output.directory(), description, &note)?;
        let ended = run(&store, &mut solver, &cancel, self.shard, reuse.as_ref());
        if ended.is_err() {
            store.remove_if_empty();
        }
        let code = ended?;
        // A part of a sweep may lie where nothing has a result.
        Ok(if self.shard.is_none() { judged(code, &store.directory, MANIFEST) } else { code })
    }

    /// Refuses what a refined sweep does not have.
    fn can_refine(&self) -> Result<()> {
        let options = [
            ("--accuracy", self.accuracy.accuracy.is_some()),
            ("--shard", self.shard.is_some()),
            ("--reuse", self.reuse.is_some()),
        ];
        options
            .into_iter()
            .find(|(_, given)| *given)
            .map_or(Ok(()), |(option, _)| Err(Error::RefineBeside { option }))
    }
}

/// Computes the tiles that are missing, and writes the results of all.
pub(crate) fn run(
    store: &Store,
    solver: &mut Solver,
    cancel: &AtomicBool,
    shard: Option<Shard>,
    reuse: Option<&Reuse>,
) -> Result<ExitCode> {
    let tiling = store.description.tiling;
    let total = tiling.instances;
    let (mut computed, mut reused) = (0, 0);
    let mut elapsed = Duration::ZERO;
    store.expel_strangers(&note)?;
    store.clean()?;
    tell_begin(store);
    loop {
        let missing = missing(store, shard.unwrap_or(Shard { number: 0, of: 1 }).tiles(tiling.count()))?;
        let lacking: usize = missing.iter().map(|number| tiling.bounds(*number).len()).sum();
        if lacking > 0 {
            space::verify(&store.directory, &store.description, lacking)?;
        }
        let progress = Progress::new(lacking, "instances");
        let watch = Watch { cancel, progress: &|count| progress.add(count), note: &note };
        let filled = fill(store, solver, &missing, reuse, watch);
        progress.finish();
        let filled = filled?;
        if let Some(shard) = shard {
            return Ok(shard_done(store, shard, &filled));
        }
        talk::detail(&format!(
            "{} tile(s) to do, {} instances computed and {} taken over in {}",
            missing.len(),
            filled.computed,
            filled.reused,
            seconds(filled.elapsed.as_secs_f64())
        ));
        computed += filled.computed;
        reused += filled.reused;
        elapsed += filled.elapsed;
        if let Some(why) = &filled.stopped
            && store.done()? == 0
            && store.kept_instances()? == 0
        {
            return Err(why.clone().error(0, total).into());
        }
        let run = manifest::Run {
            threads: rayon::current_num_threads(),
            elapsed,
            computed,
            reused: reuse.map(|reuse| (reused, reuse.sweep_id())),
            stopped: filled.stopped.as_ref().map(ToString::to_string),
            tiles: None,
            accuracy: store.description.accuracy.clone(),
        };
        let directory = store.directory.display();
        let began = Instant::now();
        let written = results::write(store, &run, cancel)?;
        talk::detail(&format!("results looked at and written in {}", seconds(began.elapsed().as_secs_f64())));
        results::tell(&store.directory);
        match written {
            // What is bad is set aside, and what is not there is computed.
            Results::Lacking => {}
            Results::Current => {
                print(&if computed + reused == 0 {
                    format!(
                        "all {total} instances were computed before; nothing is left to do in {directory}\n"
                    )
                } else {
                    format!("{computed} of {total} instances in {}; ", seconds(elapsed.as_secs_f64()))
                        + &format!("the results of all are in {directory}\n")
                });
                return Ok(ExitCode::SUCCESS);
            }
            Results::Stopped => {
                note(&format!(
                    "stopped; the results in {directory} are left to the process that is writing them; run the same \
                     command again to see that they are complete"
                ));
                return Ok(ExitCode::from(INTERRUPTED));
            }
            Results::GivenUp => {
                note(&format!(
                    "stopped while the results were written; all tiles are in {directory}; run the same command again to \
                     write the results"
                ));
                return Ok(ExitCode::from(INTERRUPTED));
            }
            Results::Fuller { tally } => {
                note(&format!(
                    "the results in {directory} have more instances than the tiles there; they stay"
                ));
                let stopped = filled.stopped.as_ref().unwrap_or(&Stopped::Cancelled);
                return Ok(ended(stopped, &tally, "kept"));
            }
            Results::Written { paths, tally, complete } => {
                store.remove_if_empty();
                let onset = onset_of(solver.spec(), &tally);
                print(&report(&run, store, &tally, &onset, &paths));
                // Complete is what was written, whatever stopped the run in its last moment.
                return Ok(match &filled.stopped {
                    Some(why) if !complete => ended(why, &tally, "wrote"),
                    _ => ExitCode::SUCCESS,
                });
            }
        }
    }
}

/// With `--verbose`: what is to be computed, and where.
fn tell_begin(store: &Store) {
    let tiling = store.description.tiling;
    talk::detail(&format!(
        "sweep {}: {} tile(s) of up to {} instances on {} thread(s), into {}",
        store.description.id,
        tiling.count(),
        tiling.tile,
        rayon::current_num_threads(),
        store.directory.display()
    ));
}

/// Says how far a shard and the sweep have come, and gives the exit code.
fn shard_done(store: &Store, shard: Shard, filled: &Filled) -> ExitCode {
    let (done, total) = (store.done().unwrap_or_default(), store.description.tiling.count());
    let directory = store.directory.display();
    talk::tell("directory", directory.to_string());
    talk::tell("tiles", json!({ "total": total, "done": done }));
    talk::tell("computed", filled.computed);
    print(&format!(
        "{} instances of shard {shard} in {}; {done} of {total} tiles are in {directory}{}\n",
        filled.computed,
        seconds(filled.elapsed.as_secs_f64()),
        if done == total {
            format!("; `squealmap merge {directory}` writes the results")
        } else {
            String::new()
        }
    ));
    match &filled.stopped {
        None => ExitCode::SUCCESS,
        Some(Stopped::Cancelled) => {
            note("stopped; run the same command again to compute the rest");
            ExitCode::from(INTERRUPTED)
        }
        Some(Stopped::Failed(why)) => {
            talk::error(why);
            ExitCode::FAILURE
        }
    }
}

/// Which of some tiles are not there. Bad ones are set aside and named, and count as missing.
pub(crate) fn missing(store: &Store, tiles: impl Iterator<Item = usize>) -> Result<Vec<usize>> {
    let there = store.numbers()?;
    let mut missing = Vec::new();
    for number in tiles {
        if there.binary_search(&number).is_err() || !store.verify(number, &note)? {
            missing.push(number);
        }
    }
    Ok(missing)
}

/// The report: how much was computed, the results, and the files.
fn report(run: &manifest::Run, store: &Store, tally: &Tally, onset: &str, paths: &[PathBuf]) -> String {
    let total = store.description.tiling.instances;
    let reused = run.reused.as_ref().map_or(0, |(instances, _)| *instances);
    let before = tally.computed().saturating_sub(run.computed + reused);
    let elapsed = run.elapsed.as_secs_f64();
    let rate = run.computed as f64 / elapsed.max(f64::MIN_POSITIVE);
    let of = if run.computed < total { format!(" of {total}") } else { String::new() };
    let before = if before > 0 { format!("; {before} were there before") } else { String::new() };
    let reused = if run.reused.is_some() { format!("; {reused} were taken over") } else { String::new() };
    format!(
        "{}{of} instances in {} on {} thread(s), {rate:.0} instances/s{before}{reused}\n\n{}{onset}{}\n{}",
        run.computed,
        seconds(elapsed),
        run.threads,
        summary(store.description.analysis, tally),
        missed(run, tally),
        list(paths)
    )
}

/// A sentence where the checks found less accuracy than was asked for.
fn missed(run: &manifest::Run, tally: &Tally) -> String {
    let bound = run.accuracy.as_ref().and_then(|chosen| chosen.bound);
    match (bound, tally.checks().fine.known_quantile(0.95)) {
        (Some(bound), Some(found)) if found > bound => format!(
            "warning: that is more than the {bound:e} that was asked for; a part of it is the scatter of motions that do \
             not repeat\n"
        ),
        _ => String::new(),
    }
}

/// Says that a sweep is not complete, and what was done with the part that is; gives the exit code.
fn ended(stopped: &Stopped, tally: &Tally, did: &str) -> ExitCode {
    let code = match stopped {
        Stopped::Cancelled => INTERRUPTED,
        Stopped::Failed(why) => {
            talk::error(why);
            1
        }
    };
    let (computed, total) = (tally.computed(), tally.total());
    note(&if computed < total {
        format!(
            "stopped after {computed} of {total} instances; {did} what is done, the others are `not_computed`; \
             run the same command again to compute the rest"
        )
    } else {
        format!(
            "stopped before the checks of {total} instances were done; {did} what was computed; run the same command again \
             to check it"
        )
    });
    ExitCode::from(code)
}

/// A share of the tiles.
fn shard(text: &str) -> std::result::Result<Shard, String> {
    Shard::parse(text, &|name| std::env::var(name).ok())
}
