//! `squealmap tradeoff`: speed against error of every engine on a sweep.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use crate::cli::error::{Error, Result};
use crate::cli::frontier;
use crate::cli::home::{Replace, prepare, stem};
use crate::cli::output::{Output, list};
use crate::cli::pictures::png_of;
use crate::cli::talk::{note, print};
use clap::Args;
use squealmap::engine::options::Options;
use squealmap::results::figure::look::Look;
use squealmap::study::tradeoff::report::{self, Section};
use squealmap::sweep::accuracy::measure::{Measurement, Settings, measure};
use squealmap::sweep::accuracy::row::{Row, to_csv};
use squealmap::sweep::spec::Spec;

/// The files that are written.
const FILES: [&str; 4] = ["tradeoff.csv", "tradeoff.json", "tradeoff.png", "tradeoff.svg"];

/// Settled oscillations below which a sweep is measured for the eye alone.
const FEWEST_JUDGED: usize = 20;

/// Instances that are judged, and the seed of their draw, unless the options say otherwise.
const SAMPLE: u32 = 512;
const SEED: u64 = 1;

/// Arguments of `tradeoff`.
#[derive(Debug, Args)]
pub(crate) struct Tradeoff {
    /// Sweep files (TOML)
    #[arg(required = true, value_name = "SWEEP")]
    sweeps: Vec<PathBuf>,
    /// Output directory; of several sweeps each has a directory of its name in it [default: out/<name of the sweep>]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Instances that are judged, 16 to 100000, of all types and regimes, more near the borders between them
    #[arg(long, value_name = "N", default_value_t = SAMPLE, value_parser = clap::value_parser!(u32).range(16..=100_000))]
    sample: u32,
    /// Another seed draws another sample
    #[arg(long, value_name = "S", default_value_t = SEED)]
    seed: u64,
    /// Worker threads, 1 to 1024 [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Also a report on all the sweeps in Markdown, its figures in a directory of the same name
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// The table that `run --accuracy` chooses from gets these rows [default: a file in the user's cache directory]
    #[arg(long, value_name = "FILE", conflicts_with = "no_store")]
    store: Option<PathBuf>,
    /// Leave that table as it is
    #[arg(long)]
    no_store: bool,
    /// Measure a software GPU too, which `run` never chooses
    #[arg(long, requires = "no_store")]
    software: bool,
    #[command(flatten)]
    replace: Replace,
}

/// The result of a sweep.
struct Done {
    stem: String,
    title: String,
    measured: Measurement,
    png: Vec<u8>,
}

impl Tradeoff {
    pub(crate) fn execute(self) -> Result<()> {
        // A mistake in the last sweep is told before the first is measured.
        let specs = self.sweeps.iter().map(|path| Ok(Spec::read(path)?)).collect::<Result<Vec<_>>>()?;
        specs.iter().try_for_each(|spec| spec.of_two_masses("`tradeoff`"))?;
        let names: Vec<_> = self.sweeps.iter().map(|path| stem(path)).collect::<Result<_>>()?;
        if let Some(twice) = (1..names.len()).find(|at| names[..*at].contains(&names[*at])) {
            return Err(Error::SameName { name: names[twice].to_string_lossy().into_owned() });
        }
        if !self.no_store {
            frontier::writable(self.store.as_deref())?;
        }
        let settings = Settings {
            sample: self.sample as usize,
            seed: self.seed,
            threads: self.threads.map_or_else(rayon::current_num_threads, usize::from),
            software: self.software,
        };
        let mut all = Vec::new();
        for (path, spec) in self.sweeps.iter().zip(&specs) {
            let stem = stem(path)?;
            let asked = self.output.as_ref().map(|output| match specs.len() {
                1 => output.clone(),
                _ => output.join(stem),
            });
            let mut output = prepare(path, asked.as_deref(), &FILES)?;
            self.replace.file(output.directory(), path, FILES[0])?;
            output.made_from(path)?;
            let measured = measure(spec, settings, &Options::default(), &note)?;
            let stem = stem.to_string_lossy().into_owned();
            let (done, paths) = write(output, spec, stem, measured)?;
            print(&report::summary(&done.measured));
            print(&list(&paths));
            all.push(done);
        }
        let mut paths = Vec::new();
        let told = |done: &&Done| done.measured.truth.judged >= FEWEST_JUDGED;
        for done in all.iter().filter(|done| !told(done)) {
            note(&format!(
                "`{}`: judged from {} settled oscillation(s), too few for a 95th percentile, so that `run --accuracy` will not \
                 choose by them; take a larger --sample, or a longer `settle`",
                done.stem, done.measured.truth.judged
            ));
        }
        let rows: Vec<Row> = all.iter().filter(told).flat_map(|done| done.measured.rows.clone()).collect();
        if !self.no_store && !rows.is_empty() {
            paths.extend(frontier::store(self.store.clone(), &rows)?);
        }
        if let Some(report) = &self.report {
            paths.extend(write_report(report, &all, &self.command())?);
        }
        print(&list(&paths));
        Ok(())
    }

    /// The command that measures the same again.
    fn command(&self) -> String {
        let mut command = "squealmap tradeoff".to_owned();
        for sweep in &self.sweeps {
            let _ = write!(command, " {}", sweep.display());
        }
        let mut option = |name: &str, value: Option<String>| {
            if let Some(value) = value {
                let _ = write!(command, " {name}{value}");
            }
        };
        let path = |path: &Option<PathBuf>| path.as_ref().map(|path| format!(" {}", path.display()));
        let flag = |set: bool| set.then(String::new);
        option("--output", path(&self.output));
        option("--sample", (self.sample != SAMPLE).then(|| format!(" {}", self.sample)));
        option("--seed", (self.seed != SEED).then(|| format!(" {}", self.seed)));
        option("--threads", self.threads.map(|threads| format!(" {threads}")));
        option("--software", flag(self.software));
        option("--report", path(&self.report));
        option("--store", path(&self.store));
        option("--no-store", flag(self.no_store));
        command
    }
}

/// Writes table, summary and figure of a sweep.
fn write(output: Output, spec: &Spec, stem: String, measured: Measurement) -> Result<(Done, Vec<PathBuf>)> {
    let title = if spec.title.is_empty() { "Speed against error".to_owned() } else { spec.title.clone() };
    let svg = report::figure(&spec.title, &measured.rows, &Look::default());
    let png = png_of(&svg)?;
    let files = [
        (FILES[0], to_csv(&measured.rows)?),
        (FILES[1], report::to_json(&spec.title, &measured)?),
        (FILES[2], png.clone()),
        (FILES[3], svg.into_bytes()),
    ];
    let paths = output.write(&files)?;
    Ok((Done { stem, title, measured, png }, paths))
}

/// Writes the report, and the figures into a directory of its name.
fn write_report(report: &Path, all: &[Done], command: &str) -> Result<Vec<PathBuf>> {
    let name = report.file_name().unwrap_or(report.as_os_str()).to_string_lossy().into_owned();
    let figures = report.file_stem().unwrap_or(report.as_os_str()).to_string_lossy().into_owned();
    let figure = |done: &Done| format!("{figures}/{}.png", done.stem);
    let sections: Vec<Section> = all
        .iter()
        .map(|done| Section { title: &done.title, figure: figure(done), measured: &done.measured })
        .collect();
    let text = report::to_markdown(&sections, command).into_bytes();
    let drawn: Vec<(String, Vec<u8>)> = all.iter().map(|done| (figure(done), done.png.clone())).collect();
    let mut files: Vec<(&str, Vec<u8>)> = vec![(&name, text)];
    files.extend(drawn.iter().map(|(name, png)| (name.as_str(), png.clone())));
    let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
    let directory = report.parent().unwrap_or(Path::new("")).to_owned();
    let directory = if directory.as_os_str().is_empty() { PathBuf::from(".") } else { directory };
    Output::prepare(directory, &names)?.write(&files)
}
