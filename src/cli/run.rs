//! `squealmap run`: a whole sweep.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use clap::{Args, ValueEnum};
use squealmap::accuracy::configuration::{self, Configuration};
use squealmap::accuracy::frontier::{Choice, Chosen};
use squealmap::accuracy::level::Level;
use squealmap::accuracy::trial::first_that_keeps;
use squealmap::backend::choice::{Backend, Options};
use squealmap::backend::gpu::adapter::Adapter;
use squealmap::backend::solver::Solver;
use squealmap::export::manifest;
use squealmap::kernel::source::Precision;
use squealmap::label::Tally;
use squealmap::map::Stopped;
use squealmap::spec::Spec;
use squealmap::store::description::Description;
use squealmap::store::directory::Store;
use squealmap::store::fill::{Filled, Watch, fill};
use squealmap::store::reuse::Reuse;
use squealmap::store::shard::Shard;
use squealmap::store::space;
use squealmap::store::tiling::TILE;
use squealmap::{Error, Result};

use crate::cli::output::{Output, list};
use crate::cli::progress::{Progress, seconds};
use crate::cli::results::{self, FILES, Results};
use crate::cli::summary::summary;
use crate::cli::{Files, INTERRUPTED, frontier, note, print};

/// Arguments of `run`.
#[derive(Debug, Args)]
pub(crate) struct Run {
    #[command(flatten)]
    files: Files,
    /// Worker threads, 1 to 1024 [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// What computes: `auto` takes a hardware GPU where there is one, else the CPU; `reference` is the
    /// slow, accurate judge of the others
    #[arg(long, value_enum, default_value_t)]
    backend: BackendName,
    /// Arithmetic [default: f64 on the CPU, f32 on a GPU]
    #[arg(long, value_enum)]
    precision: Option<PrecisionName>,
    /// The fastest engine, arithmetic and steps per period with this relative error of deviation, accelerations and
    /// frequency in 95 % of the settled oscillations: draft (1e-2), standard (1e-3), paper (1e-4), reference,
    /// or a number up to 0.1; see `squealmap tradeoff`
    #[arg(long, value_name = "LEVEL", value_parser = Level::parse)]
    accuracy: Option<Level>,
    /// Compute no instance again: the manifest then says nothing of the error
    #[arg(long)]
    no_check: bool,
    /// A GPU rounds every operation by itself, like the twin of its kernel on the CPU; needs Vulkan
    #[arg(long)]
    strict: bool,
    /// Only a GPU with this in its name; see `squealmap adapters`
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Fail unless a hardware GPU computes
    #[arg(long)]
    require_gpu: bool,
    /// Only the tiles k, k + n, k + 2n, … with k from 0 to n - 1, and no results, which `merge` writes; `auto` takes
    /// k and n, `auto/n` takes k from the task of Slurm, mpirun, Kubernetes, PBS or HyperQueue
    #[arg(long, value_name = "K/N", value_parser = shard)]
    shard: Option<Shard>,
    /// Output directory of a run of this sweep with other values of the axes: instances of both are taken over
    #[arg(long, value_name = "DIR")]
    reuse: Option<PathBuf>,
    /// Instances of a tile: for tests, which have no time for large ones
    #[arg(long, hide = true, default_value_t = TILE, value_parser = at_least_one)]
    tile: usize,
}

/// The values of `--backend`.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub(crate) enum BackendName {
    #[default]
    Auto,
    Gpu,
    Cpu,
    Reference,
}

/// The values of `--precision`.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum PrecisionName {
    F32,
    F64,
}

impl From<BackendName> for Backend {
    fn from(name: BackendName) -> Backend {
        match name {
            BackendName::Auto => Backend::Auto,
            BackendName::Gpu => Backend::Gpu,
            BackendName::Cpu => Backend::Cpu,
            BackendName::Reference => Backend::Reference,
        }
    }
}

impl From<PrecisionName> for Precision {
    fn from(name: PrecisionName) -> Precision {
        match name {
            PrecisionName::F32 => Precision::F32,
            PrecisionName::F64 => Precision::F64,
        }
    }
}

impl Run {
    /// Instances of a tile.
    pub(crate) fn tile(&self) -> usize {
        self.tile
    }

    /// Worker threads that were asked for.
    pub(crate) fn threads(&self) -> Option<u16> {
        self.threads
    }

    /// The engine that was asked for.
    pub(crate) fn backend(&self) -> BackendName {
        self.backend
    }

    /// Whether it takes over the instances of another directory.
    pub(crate) fn reuses(&self) -> bool {
        self.reuse.is_some()
    }

    /// The accuracy that was asked for.
    pub(crate) fn accuracy(&self) -> Option<Level> {
        self.accuracy
    }

    pub(crate) fn execute(self) -> Result<ExitCode> {
        let cancel = stop_at_signal()?;
        let mut spec = Spec::read(&self.files.sweep)?;
        spec.analysis.checked &= !self.no_check;
        let ranked = self.ranked(&spec)?;
        let output = Output::prepare_claimed(self.files.directory(), &FILES)?;
        let threads = self.threads.map_or(0, usize::from);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|why| Error::Threads { threads, why: why.to_string() })?;

        let note = |text: &str| note(text);
        let options = Options {
            backend: self.backend.into(),
            precision: self.precision.map(Precision::from),
            strict: self.strict,
            require_gpu: self.require_gpu,
            adapter: self.adapter.as_deref(),
            chunk: None,
            cancel: Some(&cancel),
            note: Some(&note),
        };
        let choice =
            ranked.map(|ranked| pool.install(|| first_that_keeps(ranked, &spec, &options))).transpose()?;
        let options = match &choice {
            None => options,
            Some(choice) => {
                say(&choice.chosen);
                spec = choice.configuration.sweep(&spec);
                Options { adapter: options.adapter, ..choice.configuration.options(&options) }
            }
        };
        let mut solver = Solver::new(&spec, &options)?;
        let mut description = Description::new(&spec, solver.computations(), self.tile);
        description.accuracy = choice.as_ref().map(|choice| choice.chosen.clone());
        let reuse = self.reuse.as_ref();
        let reuse =
            reuse.map(|directory| Reuse::new(directory, &description, output.directory())).transpose()?;
        let store = Store::begin(output.directory(), description, &note)?;
        let ended = pool.install(|| run(&store, &mut solver, &cancel, self.shard, reuse.as_ref()));
        if ended.is_err() {
            store.remove_if_empty();
        }
        ended
    }

    /// What may compute the sweep with the accuracy that is asked for, the fastest first; `None` where none is.
    ///
    /// # Errors
    /// When something that it chooses is given too, or nothing is accurate enough.
    fn ranked(&self, spec: &Spec) -> Result<Option<Vec<Choice>>> {
        let Some(level) = self.accuracy else { return Ok(None) };
        let beside = |option: String| Error::AccuracyBeside { option, accuracy: level.to_string() };
        if let Some(at) = &spec.steps_given {
            let key = "`steps_per_period` in [response]".to_owned();
            let other = format!("--accuracy {level}, which chooses it");
            return Err(Error::Conflict { at: at.clone(), key, other });
        }
        if let Some(precision) = self.precision {
            return Err(beside(format!("--precision {}", Precision::from(precision))));
        }
        let only_gpu = self.strict || self.require_gpu || self.adapter.is_some();
        let backend = match self.backend {
            BackendName::Auto => only_gpu.then_some(Backend::Gpu),
            asked => Some(Backend::from(asked)),
        };
        if let (Level::Reference, Some(other @ (Backend::Gpu | Backend::Cpu))) = (level, backend) {
            return Err(beside(format!("--backend {}", configuration::name(other))));
        }
        if !spec.analysis.response {
            note("--accuracy has nothing to choose: this sweep asks for no response");
            return Ok(None);
        }
        let allowed =
            |one: &Configuration| backend.is_none_or(|backend| backend == one.backend) && is_here(one);
        frontier::of(spec).ranked(level, spec, &allowed).map(Some)
    }
}

/// Says what was chosen, and why.
fn say(chosen: &Chosen) {
    note(&format!("--accuracy {}: {}", chosen.asked, chosen.configuration));
    note(&chosen.why);
    if let (Some(bound), Some(trial)) = (chosen.bound, chosen.trial) {
        note(&trial.sentence(bound));
    }
}

/// Whether this machine has what a configuration needs: a GPU may have gone since it was measured.
fn is_here(configuration: &Configuration) -> bool {
    let adapter = configuration.adapter.as_deref();
    configuration.backend != Backend::Gpu
        || Adapter::best(configuration.precision, adapter).is_ok_and(|adapter| !adapter.is_software())
}

/// Computes what is missing and writes the results of all.
fn run(
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
    loop {
        let missing = missing(store, shard.unwrap_or(Shard { number: 0, of: 1 }).tiles(tiling.count()))?;
        let lacking: usize = missing.iter().map(|number| tiling.bounds(*number).len()).sum();
        if lacking > 0 {
            space::verify(&store.directory, &store.description, lacking)?;
        }
        let progress = Progress::new(lacking);
        let watch = Watch { cancel, progress: &|count| progress.add(count), note: &note };
        let filled = fill(store, solver, &missing, reuse, watch);
        progress.finish();
        let filled = filled?;
        if let Some(shard) = shard {
            return Ok(shard_done(store, shard, &filled));
        }
        computed += filled.computed;
        reused += filled.reused;
        elapsed += filled.elapsed;
        let partial = filled.partial.as_ref().map(|(number, records)| (*number, records.as_slice()));
        let of_partial = partial.map_or(0, |(_, records)| Tally::of(records).computed());
        let fresh = computed + of_partial - filled.partial_reused;
        if let Some(why) = &filled.stopped
            && fresh + reused == 0
            && missing.len() == tiling.count()
        {
            return Err(why.clone().error(0, total));
        }
        let run = manifest::Run {
            threads: rayon::current_num_threads(),
            elapsed,
            computed: fresh,
            reused: reuse.map(|reuse| (reused, reuse.sweep_id())),
            stopped: filled.stopped.as_ref().map(ToString::to_string),
            sweep_id: Some(store.description.id.to_string()),
            accuracy: store.description.accuracy.clone(),
        };
        match results::write(store, partial, &run)? {
            // It is set aside and computed again.
            Results::BadTile => {}
            Results::Current => {
                let directory = store.directory.display();
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
            Results::Written { paths, tally } => {
                store.remove_if_empty();
                print(&report(&run, store, &tally, &paths));
                return Ok(filled
                    .stopped
                    .as_ref()
                    .map_or(ExitCode::SUCCESS, |why| ended(why, store, &tally)));
            }
        }
    }
}

/// Says how far a shard and the sweep have come, and gives the exit code.
fn shard_done(store: &Store, shard: Shard, filled: &Filled) -> ExitCode {
    let (done, total) = (store.done().unwrap_or_default(), store.description.tiling.count());
    let directory = store.directory.display();
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
            note(&format!("error: {why}"));
            ExitCode::FAILURE
        }
    }
}

/// Those of some tiles that are not there; bad ones are set aside and named.
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

/// What was computed, what came out, and the files.
fn report(run: &manifest::Run, store: &Store, tally: &Tally, paths: &[PathBuf]) -> String {
    let total = store.description.tiling.instances;
    let reused = run.reused.as_ref().map_or(0, |(instances, _)| *instances);
    let before = tally.computed().saturating_sub(run.computed + reused);
    let elapsed = run.elapsed.as_secs_f64();
    let rate = run.computed as f64 / elapsed.max(f64::MIN_POSITIVE);
    let of = if run.computed < total { format!(" of {total}") } else { String::new() };
    let before = if before > 0 { format!("; {before} were there before") } else { String::new() };
    let reused = if run.reused.is_some() { format!("; {reused} were taken over") } else { String::new() };
    format!(
        "{}{of} instances in {} on {} thread(s), {rate:.0} instances/s{before}{reused}\n\n{}{}\n{}",
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

/// Says that a sweep is not complete, and gives the exit code.
fn ended(stopped: &Stopped, store: &Store, tally: &Tally) -> ExitCode {
    let code = match stopped {
        Stopped::Cancelled => INTERRUPTED,
        Stopped::Failed(why) => {
            note(&format!("error: {why}"));
            1
        }
    };
    let rest = if store.description.tiling.count() > 1 { "the rest" } else { "all" };
    note(&format!(
        "stopped after {} of {} instances; wrote what is done, the others are `not_computed`; \
         run the same command again to compute {rest}",
        tally.computed(),
        tally.total()
    ));
    ExitCode::from(code)
}

/// A flag that Ctrl-C sets, and SIGTERM, by which schedulers end a process; the run then ends between two instances or dispatches. Set before anything is
/// made on the disk; a second Ctrl-C changes nothing, so that no file is left half written.
pub(crate) fn stop_at_signal() -> Result<Arc<AtomicBool>> {
    let cancel = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&cancel);
    ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed))
        .map_err(|why| Error::Signal { why: why.to_string() })?;
    #[cfg(unix)]
    signal_hook::flag::register(signal_hook::consts::SIGTERM, Arc::clone(&cancel))
        .map_err(|why| Error::Signal { why: why.to_string() })?;
    Ok(cancel)
}

/// A share of the tiles.
fn shard(text: &str) -> std::result::Result<Shard, String> {
    Shard::parse(text, &|name| std::env::var(name).ok())
}

/// A number of instances.
fn at_least_one(text: &str) -> std::result::Result<usize, String> {
    match text.parse() {
        Ok(number) if number > 0 => Ok(number),
        _ => Err("must be a whole number from 1 on".to_owned()),
    }
}
