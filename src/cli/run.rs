//! `squealmap run`: a whole sweep.

use clap::Args;
use squealmap::export::{csv, figure, manifest, png};
use squealmap::spec::Spec;
use squealmap::{Error, Result, sweep};

use crate::cli::output::{Output, list};
use crate::cli::progress::{Progress, seconds};
use crate::cli::summary::summary;
use crate::cli::{Files, print};

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
}

impl Run {
    pub(crate) fn execute(self) -> Result<()> {
        let spec = Spec::read(&self.files.sweep)?;
        let output = Output::prepare(self.files.directory(), &FILES)?;
        let threads = self.threads.map_or(0, usize::from);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|why| Error::Threads { threads, why: why.to_string() })?;

        let progress = Progress::new(spec.grid.len());
        let map = pool.install(|| sweep::run(spec, &|count| progress.add(count)));
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
        let rate = map.records.len() as f64 / elapsed.max(f64::MIN_POSITIVE);
        print(&format!(
            "{} instances in {} on {} thread(s), {rate:.0} instances/s\n\n{}\n{}",
            map.records.len(),
            seconds(elapsed),
            map.provenance.threads,
            summary(&map),
            list(&paths)
        ));
        Ok(())
    }
}
