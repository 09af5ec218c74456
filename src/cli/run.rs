//! `squealmap run`: a whole sweep.

use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::{Args, ValueEnum};
use squealmap::backend::choice::{Backend, Options};
use squealmap::export::{csv, figure, manifest, png};
use squealmap::kernel::source::Precision;
use squealmap::map::Stopped;
use squealmap::spec::Spec;
use squealmap::{Error, Result, sweep};

use crate::cli::output::{Output, list};
use crate::cli::progress::{Progress, seconds};
use crate::cli::summary::summary;
use crate::cli::{Files, INTERRUPTED, note, print};

/// What is written.
const FILES: [&str; 4] = ["map.csv", "manifest.json", "map.png", "map.svg"];

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
    /// A GPU rounds every operation by itself, like the twin of its kernel on the CPU; needs Vulkan
    #[arg(long)]
    strict: bool,
    /// Only a GPU with this in its name; see `squealmap adapters`
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Fail unless a hardware GPU computes
    #[arg(long)]
    require_gpu: bool,
}

/// The values of `--backend`.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum BackendName {
    #[default]
    Auto,
    Gpu,
    Cpu,
    Reference,
}

/// The values of `--precision`.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum PrecisionName {
    F32,
    F64,
}

impl Run {
    pub(crate) fn execute(self) -> Result<ExitCode> {
        let cancel = stop_at_ctrl_c()?;
        let spec = Spec::read(&self.files.sweep)?;
        let output = Output::prepare(self.files.directory(), &FILES)?;
        let threads = self.threads.map_or(0, usize::from);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|why| Error::Threads { threads, why: why.to_string() })?;

        let progress = Progress::new(spec.grid.len());
        let note = |text: &str| note(text);
        let options = Options {
            backend: match self.backend {
                BackendName::Auto => Backend::Auto,
                BackendName::Gpu => Backend::Gpu,
                BackendName::Cpu => Backend::Cpu,
                BackendName::Reference => Backend::Reference,
            },
            precision: self.precision.map(|name| match name {
                PrecisionName::F32 => Precision::F32,
                PrecisionName::F64 => Precision::F64,
            }),
            strict: self.strict,
            require_gpu: self.require_gpu,
            adapter: self.adapter.as_deref(),
            chunk: None,
            cancel: Some(&cancel),
            note: Some(&note),
        };
        let map = pool.install(|| sweep::run(spec, &options, &|count| progress.add(count)));
        progress.finish();
        let map = map?;

        let svg = figure::map_svg(&map)?;
        let files = [
            (FILES[0], csv::map_csv(&map)?),
            (FILES[1], manifest::manifest_json(&map)?),
            (FILES[2], png::render(&svg)?),
            (FILES[3], svg.into_bytes()),
        ];
        let paths = output.write(&files)?;

        let elapsed = map.provenance.elapsed.as_secs_f64();
        let computed = map.computed();
        let rate = computed as f64 / elapsed.max(f64::MIN_POSITIVE);
        let of = if map.stopped.is_some() { format!(" of {}", map.records.len()) } else { String::new() };
        print(&format!(
            "{computed}{of} instances in {} on {} thread(s), {rate:.0} instances/s\n\n{}\n{}",
            seconds(elapsed),
            map.provenance.threads,
            summary(&map),
            list(&paths)
        ));
        Ok(map.stopped.as_ref().map_or(ExitCode::SUCCESS, |why| ended(why, computed, map.records.len())))
    }
}

/// Says that a sweep is not complete, and gives the exit code.
fn ended(stopped: &Stopped, done: usize, total: usize) -> ExitCode {
    let code = match stopped {
        Stopped::Cancelled => INTERRUPTED,
        Stopped::Failed(why) => {
            note(&format!("error: {why}"));
            1
        }
    };
    note(&format!(
        "stopped after {done} of {total} instances; wrote what is done, the others are `not_computed`; \
         run the same command again to compute all"
    ));
    ExitCode::from(code)
}

/// A flag that Ctrl-C sets; the run then ends between two instances or dispatches. Set before anything is
/// made on the disk; a second Ctrl-C changes nothing, so that no file is left half written.
fn stop_at_ctrl_c() -> Result<Arc<AtomicBool>> {
    let cancel = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&cancel);
    ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed))
        .map_err(|why| Error::Signal { why: why.to_string() })?;
    Ok(cancel)
}
