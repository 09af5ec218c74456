//! `squealmap trace`: one instance in full.

use std::f64::consts::TAU;
use std::process::ExitCode;

use crate::cli::error::Result;
use crate::cli::failed::without_result;
use crate::cli::files::Files;
use crate::cli::hysteresis;
use crate::cli::hysteresis::Range;
use crate::cli::numbers::{index, rate};
use crate::cli::output::list;
use crate::cli::pictures::png_of;
use crate::cli::talk::{note, print};
use clap::Args;
use squealmap::engine::judged;
use squealmap::engine::plan::Plan;
use squealmap::model::instance::Instance;
use squealmap::model::linear;
use squealmap::model::status::Status;
use squealmap::results::figure::heading::Heading;
use squealmap::results::figure::look::Look;
use squealmap::study::signals::sensors::{Recording, record};
use squealmap::study::signals::table::signals_csv;
use squealmap::study::trace::run::{has_room, trace};
use squealmap::study::trace::table::{document, trace_csv, trace_svg};
use squealmap::sweep::spec::Spec;
use squealmap_input::quote::rounded;

/// The files that are written.
const FILES: [&str; 4] = ["trace.csv", "trace.json", "trace.png", "trace.svg"];
/// The file that `--rate` adds.
const SIGNALS: &str = "signals.csv";

/// Arguments of `trace`.
#[derive(Debug, Args)]
pub(crate) struct TraceCommand {
    #[command(flatten)]
    files: Files,
    /// The instance: every parameter that the sweep varies, and any other; values may lie off the grid
    #[arg(long, value_name = "NAME=VALUE,...", default_value = "", hide_default_value = true)]
    at: String,
    /// The instance by its number in map.csv, where the first is 0
    #[arg(long, value_name = "N", value_parser = index, conflicts_with_all = ["at", "sweep_up_down"])]
    instance: Option<usize>,
    /// Rows per period 2π/ω0, 1 to 10000, besides the events
    #[arg(long, value_name = "N", default_value_t = 50, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    samples_per_period: u32,
    /// Also write signals.csv, evenly sampled with this rate, which `identify` reads
    #[arg(long, value_name = "HZ", value_parser = rate)]
    rate: Option<u32>,
    /// Follow the motion while this parameter rises and falls in steps, each from the state in which the one before
    /// ended: hysteresis.csv and its figure instead of the trace
    #[arg(long, value_name = "NAME=FROM..TO", value_parser = Range::parse, conflicts_with_all = ["rate", "samples_per_period"])]
    sweep_up_down: Option<Range>,
    /// Values of `--sweep-up-down`, 2 to 10000
    #[arg(long, value_name = "N", default_value_t = 41, requires = "sweep_up_down", value_parser = clap::value_parser!(u32).range(2..=10_000))]
    points: u32,
}

impl TraceCommand {
    pub(crate) fn execute(self) -> Result<ExitCode> {
        let spec = Spec::read(&self.files.sweep)?;
        spec.of_two_masses("`trace`")?;
        if let Some(range) = &self.sweep_up_down {
            return hysteresis::execute(&spec, &self.files, &self.at, range, self.points);
        }
        let (instance, at) = match self.instance {
            None => (spec.instance_at(&self.at)?, self.at.clone()),
            Some(number) => spec.numbered(number)?,
        };
        has_room(&spec, &instance, self.samples_per_period)?;
        let names: &[&str] =
            if self.rate.is_some() { &[FILES[0], FILES[1], FILES[2], FILES[3], SIGNALS] } else { &FILES };
        let output = self.files.prepare_beside(names)?;
        let trace = trace(&spec, &instance, self.samples_per_period);
        let heading = Heading::new(&spec.title, &at);
        let svg = trace_svg(&trace, &heading, &Look::default())?;
        let mut files = vec![
            (FILES[0], trace_csv(&trace)?),
            (FILES[1], document(&trace, &heading)?),
            (FILES[2], png_of(&svg)?),
            (FILES[3], svg.into_bytes()),
        ];
        if let Some(rate) = self.rate {
            let recording = Recording {
                rate: f64::from(rate),
                duration: trace.rows.last().map_or(0.0, |row| row.t),
                skew: 0.0,
                force_skew: 0.0,
            };
            let signals = record(&instance, &Plan::new(&spec), &recording);
            files.push((SIGNALS, signals_csv(&signals.samples, Some(&instance))?));
        }
        let paths = output.write(&files)?;
        let (kind, _) = linear::analyse(&instance);
        let end = match trace.outcome.status {
            Status::Ok => judged::regime(&instance, kind, &trace.outcome).0.name(),
            failed => failed.name(),
        };
        let outcome = &trace.outcome;
        if self.instance.is_some() {
            print(&format!("at {at}\n"));
        }
        print(&format!(
            "{end}: {} s in {} steps, {} rows\n{}",
            rounded(outcome.simulated_time),
            outcome.steps,
            trace.rows.len(),
            list(&paths)
        ));
        if let Some(why) = self.rate.and_then(|rate| too_slow(rate, &instance)) {
            note(&format!("warning: {why}"));
        }
        if outcome.status == Status::Ok {
            return Ok(ExitCode::SUCCESS);
        }
        note(&format!("error: {}", without_result(outcome.status)));
        Ok(ExitCode::FAILURE)
    }
}

/// A sentence that a rate (Hz) is below twice the highest frequency of an instance's modes, with a rate that would do;
/// `None` where it is high enough.
fn too_slow(rate: u32, instance: &Instance) -> Option<String> {
    /// Samples per period from which on an oscillation is recorded well.
    const ENOUGH: f64 = 20.0;
    let modes = linear::eigenvalues(instance)?;
    let highest = modes.iter().map(|mode| mode.im.abs() / TAU).fold(0.0, f64::max);
    (f64::from(rate) < 2.0 * highest).then(|| {
        format!(
            "--rate {rate} is below twice {highest:.1} Hz, the highest frequency of the modes, so that {SIGNALS} shows the motion at \
             a frequency it does not have; give --rate {:.0} or more",
            (ENOUGH * highest).ceil()
        )
    })
}
