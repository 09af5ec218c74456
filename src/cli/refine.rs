//! `squealmap refine`: the lines of a large map from few of its instances.

use clap::Args;
use squealmap::Result;
use squealmap::accuracy::sample::subset;
use squealmap::backend::choice::Options;
use squealmap::backend::solver::Solver;
use squealmap::export::boundary_lines::refined_lines;
use squealmap::export::csv::MapCsv;
use squealmap::export::figure::MapFigure;
use squealmap::export::look::Look;
use squealmap::export::png;
use squealmap::export::refined::document;
use squealmap::export::sheet::Sheet;
use squealmap::kernel::source::Precision;
use squealmap::map::Record;
use squealmap::refine::{Refined, Settings, planes_of, refine};
use squealmap::spec::{Spec, Starts};

use crate::cli::output::{Output, list};
use crate::cli::run::{BackendName, PrecisionName, stop_at_signal};
use crate::cli::summary::summary;
use crate::cli::{Files, note, print};

/// What is written.
const FILES: [&str; 5] = ["boundaries.csv", "points.csv", "refine.json", "refined.png", "refined.svg"];

/// Labels that become records at a time, for the figure.
const BLOCK: usize = 1 << 16;

/// Arguments of `refine`.
#[derive(Debug, Args)]
pub(crate) struct RefineCommand {
    #[command(flatten)]
    files: Files,
    /// Cells along each side of a map to begin with, 2 to 4096: a region smaller than one of them may be missed
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = clap::value_parser!(u16).range(2..=4096))]
    coarse: u16,
    /// Instances drawn among those that no line asks for, to see what is missed
    #[arg(long, value_name = "N", default_value_t = 1000)]
    sample: u32,
    /// Seed of the drawing
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// What computes, as of `run`
    #[arg(long, value_enum, default_value_t)]
    backend: BackendName,
    /// Arithmetic, as of `run`
    #[arg(long, value_enum)]
    precision: Option<PrecisionName>,
}

impl RefineCommand {
    pub(crate) fn execute(self) -> Result<()> {
        let cancel = stop_at_signal()?;
        let mut spec = Spec::read(&self.files.sweep)?;
        // Checks are drawn by the place in a sweep, and what is computed here has another: no columns of theirs either.
        spec.analysis.checked = false;
        // So are the starts of a box; two starts are the same at any place, and their verdicts have lines too.
        if let Starts::Box(_) = spec.analysis.starts {
            spec.analysis.starts = Starts::One;
        }
        planes_of(&spec.grid)?;
        let output = Output::prepare(self.files.directory(), &FILES)?;
        let settings =
            Settings { coarse: usize::from(self.coarse), sample: self.sample as usize, seed: self.seed };
        let say = |text: &str| note(text);
        let options = Options {
            backend: self.backend.into(),
            precision: self.precision.map(Precision::from),
            cancel: Some(&cancel),
            note: Some(&say),
            ..Options::default()
        };
        let mut solver = Solver::new(&spec, &options)?;
        let engine = solver.computations();
        let sheet = Sheet::new(&spec, engine.each_ref().map(Option::as_ref));
        let mut rows = MapCsv::new(sheet, Vec::new())?;
        let mut done = 0;
        let refined = refine(&spec.grid, settings, &mut |instances| {
            let mut part = subset(&spec, instances);
            part.analysis.starts = spec.analysis.starts;
            let computed = solver.records_of(&part, 0..instances.len(), &|_| ())?;
            if let Some(why) = computed.stopped {
                return Err(why.error(done, spec.grid.len()));
            }
            done += instances.len();
            rows.add_some(instances, &computed.records)?;
            Ok(computed.records)
        })?;
        let figure = figure(sheet, &refined);
        let command = format!("squealmap refine, from {} computed instances", refined.computed);
        let svg = figure.look(&Look { command: Some(command), ..Look::default() });
        let files = [
            (FILES[0], refined_lines(&spec, &refined)?),
            (FILES[1], rows.finish()),
            (FILES[2], document(sheet, &refined, settings)?),
            (FILES[3], png::render(&svg)?),
            (FILES[4], svg.into_bytes()),
        ];
        print(&report(&refined, &summary(spec.analysis, figure.tally())));
        print(&list(&output.write(&files)?));
        Ok(())
    }
}

/// The figure of all labels.
fn figure<'a>(sheet: Sheet<'a>, refined: &Refined) -> MapFigure<'a> {
    let mut figure = MapFigure::new(sheet);
    for (block, labels) in refined.labels.chunks(BLOCK).enumerate() {
        let records: Vec<Record> = labels.iter().map(|label| Record::from(*label)).collect();
        figure.add(block * BLOCK, &records);
    }
    figure
}

/// What was computed, what came out, and what may be missed.
fn report(refined: &Refined, summary: &str) -> String {
    let instances = refined.labels.len();
    let share = 100.0 * refined.computed as f64 / instances as f64;
    if refined.computed == instances {
        return format!("computed all of {instances} instances\n\n{summary}\n");
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
    format!("computed {} of {instances} instances ({share:.2} %); {missed}\n\n{summary}\n", refined.computed)
}
