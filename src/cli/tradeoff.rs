//! `squealmap tradeoff`: speed against error of every engine on a sweep.

use std::path::PathBuf;

use clap::Args;
use squealmap::accuracy::measure::{Settings, measure};
use squealmap::backend::choice::Options;
use squealmap::export::{png, tradeoff};
use squealmap::spec::Spec;
use squealmap::{Result, accuracy};

use crate::cli::output::{Output, list};
use crate::cli::{Files, frontier, note, print};

/// What is written.
const FILES: [&str; 4] = ["tradeoff.csv", "tradeoff.json", "tradeoff.png", "tradeoff.svg"];

/// Arguments of `tradeoff`.
#[derive(Debug, Args)]
pub(crate) struct Tradeoff {
    #[command(flatten)]
    files: Files,
    /// Instances that are judged, 16 to 100000, of all types and regimes, more near the borders between them
    #[arg(long, value_name = "N", default_value_t = 512, value_parser = clap::value_parser!(u32).range(16..=100_000))]
    sample: u32,
    /// Another seed draws another sample
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Worker threads, 1 to 1024 [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Also the table as Markdown on standard output
    #[arg(long)]
    markdown: bool,
    /// The table that `run --accuracy` chooses from gets these rows [default: a file in the user's cache directory]
    #[arg(long, value_name = "FILE", conflicts_with = "no_store")]
    store: Option<PathBuf>,
    /// Leave that table as it is
    #[arg(long)]
    no_store: bool,
}

impl Tradeoff {
    pub(crate) fn execute(self) -> Result<()> {
        let spec = Spec::read(&self.files.sweep)?;
        let output = Output::prepare(self.files.directory(), &FILES)?;
        let settings = Settings {
            sample: self.sample as usize,
            seed: self.seed,
            threads: self.threads.map_or_else(rayon::current_num_threads, usize::from),
        };
        let measured = measure(&spec, settings, &Options::default(), &note)?;
        let title = if spec.title.is_empty() { "Speed against error" } else { &spec.title };
        let svg = tradeoff::figure(title, &measured);
        let files = [
            (FILES[0], accuracy::row::to_csv(&measured.rows)?),
            (FILES[1], tradeoff::to_json(&spec.title, &measured)?),
            (FILES[2], png::render(&svg)?),
            (FILES[3], svg.into_bytes()),
        ];
        let mut paths = output.write(&files)?;
        if !self.no_store {
            paths.extend(frontier::store(self.store, &measured.rows)?);
        }
        if self.markdown {
            print(&tradeoff::to_markdown(title, &measured));
        } else {
            print(&tradeoff::summary(&measured));
        }
        print(&list(&paths));
        Ok(())
    }
}
