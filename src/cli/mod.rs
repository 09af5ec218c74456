//! The commands: one file each, the only code that prints, and with [`squealmap::store`] the only code that opens
//! files for writing.

pub mod accuracy;
mod adapters;
mod calibrate;
mod campaign;
mod check;
mod compare;
mod curves;
mod engine;
mod environment;
mod error;
mod excerpt;
mod explore;
mod export;
pub mod failed;
mod fem;
mod files;
mod fit;
mod frontier;
mod home;
mod hysteresis;
mod identify;
mod init;
mod keys;
mod merge;
mod modes;
mod numbers;
mod onset;
mod output;
mod paper;
mod paper_fem;
mod pictures;
mod plot;
mod plot_beside;
mod plot_map;
mod progress;
mod records;
mod refine;
mod refined;
mod report;
mod results;
mod run;
mod scheduler;
pub mod serve;
mod shell;
mod signal;
mod signals;
mod status;
mod submit;
mod summary;
mod summed;
mod talk;
mod threads;
mod trace;
mod tradeoff;
mod verify;

use crate::cli::error::Result;
use crate::cli::signal::INTERRUPTED;
use crate::cli::talk::Manner;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Arg, CommandFactory, FromArgMatches, Parser, Subcommand};

/// Stability maps of friction-induced vibration: for which friction, temperature and belt velocity does a
/// brake contact become unstable, by which mechanism, and what does it then do?
#[derive(Debug, Parser)]
#[command(version, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    manner: Manner,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Compute every instance of a sweep: map.csv, map.svg, map.png, manifest.json
    Run(run::Run),
    /// The lines of a large map from few of its instances: boundaries.csv, points.csv, refined.svg, refined.png, refine.json
    Refine(refine::RefineCommand),
    /// How far a run has come: tiles that are done, in work or bad, rate, time left
    Status(status::StatusCommand),
    /// Check tiles, results and description of a directory against their checksums; --repair computes again what is bad
    Verify(verify::Verify),
    /// Submit a sweep to a cluster: an array job that computes its tiles, and one that merges them
    Submit(submit::Submit),
    /// Bring the tiles of several directories together; when all are there, write the results
    Merge(merge::Merge),
    /// Write the tiles of a directory as CSV, Zarr v3, NetCDF or Parquet, at any time
    Export(export::Export),
    /// Write a commented sweep file to begin with: map, temperature, bistable, basin, hysteresis, single-mass, tuples, trace
    Init(init::Init),
    /// Every key of a sweep file with its unit, meaning, default and range
    Keys(keys::KeysCommand),
    /// List the GPUs of this machine: names, drivers, limits and features
    Adapters,
    /// Validate a sweep, say what it would compute and measure what it would cost; writes nothing
    Check(check::Check),
    /// Eigenvalues against the first numeric axis of a sweep: modes.csv, modes.json, modes.svg, modes.png
    Modes(modes::Modes),
    /// The figure of a command again from its directory, for print: plot.svg, plot.pdf, plot.png
    Plot(plot::Plot),
    /// Two result directories of the same grid, and where they differ: compare.csv, compare.json, compare.svg, compare.png
    Compare(compare::Compare),
    /// One instance in full, as a time series: trace.csv, trace.json, trace.svg, trace.png
    Trace(trace::TraceCommand),
    /// Where limit cycles meet, double their period, or are born, as curves over the planes of a sweep: curves.csv, curves.json,
    /// curves.svg, curves.png
    Curves(curves::CurvesCommand),
    /// The map of a sweep or a run to look into, in the browser: computed here, or with -o by whoever reads the page
    Explore(explore::ExploreCommand),
    /// What measured signals say: identify.json, identify.svg, identify.png, windows.csv
    Identify(identify::Identify),
    /// What the strokes of many records say, and those of one condition together: strokes.csv, conditions.csv, campaign.svg
    Campaign(campaign::CampaignCommand),
    /// The source paper computed again: its figures, and what becomes of its claims
    Paper(paper::PaperCommand),
    /// Speed against error of every engine on a sweep: tradeoff.csv, tradeoff.json, tradeoff.svg, tradeoff.png
    Tradeoff(tradeoff::Tradeoff),
    /// Bodies in sliding contact by finite elements, over friction: fem.csv, manifest.json, fem.svg, shapes.svg, shapes.vtu
    Fem(fem::FemCommand),
    /// A material file for sweeps from measured velocity, friction and temperature
    Fit(fit::FitCommand),
    /// The two-mass model with two measured frequencies, their damping, and the friction at which squeal began: calibrated.toml
    Calibrate(calibrate::Calibrate),
    /// What a shell needs to complete commands and options, on standard output
    Completions(shell::Completions),
    /// Pages for `man`, one for the program and one for each command
    Man(shell::ManPages),
}

impl Cli {
    /// Runs the command and gives the exit code.
    fn execute(self) -> Result<ExitCode> {
        match self.command.threads() {
            Workers::None => self.command.execute(),
            Workers::Of(asked) => threads::pool(asked)?.install(|| self.command.execute()),
        }
    }
}

/// The worker threads that a command takes.
enum Workers {
    /// None: nothing in it computes or draws.
    None,
    /// As many as asked for, or one per core.
    Of(Option<u16>),
}

impl Command {
    fn threads(&self) -> Workers {
        match self {
            Command::Run(command) => Workers::Of(command.threads()),
            Command::Refine(command) => Workers::Of(command.engine.threads),
            Command::Verify(command) => Workers::Of(command.threads),
            Command::Submit(_)
            | Command::Status(_)
            | Command::Init(_)
            | Command::Keys(_)
            | Command::Explore(_)
            | Command::Adapters
            | Command::Fit(_)
            | Command::Calibrate(_)
            | Command::Completions(_)
            | Command::Man(_) => Workers::None,
            Command::Merge(_)
            | Command::Export(_)
            | Command::Check(_)
            | Command::Modes(_)
            | Command::Plot(_)
            | Command::Compare(_)
            | Command::Trace(_)
            | Command::Curves(_)
            | Command::Identify(_)
            | Command::Campaign(_)
            | Command::Fem(_)
            | Command::Paper(_)
            | Command::Tradeoff(_) => Workers::Of(None),
        }
    }

    fn execute(self) -> Result<ExitCode> {
        match self {
            Command::Run(command) => return command.execute(),
            Command::Merge(command) => return command.execute(),
            Command::Refine(command) => return command.execute(),
            Command::Verify(command) => return command.execute(),
            Command::Check(command) => return command.execute(),
            Command::Trace(command) => return command.execute(),
            Command::Campaign(command) => return command.execute(),
            Command::Curves(command) => command.execute()?,
            Command::Explore(command) => command.execute()?,
            Command::Submit(command) => command.execute()?,
            Command::Status(command) => command.execute()?,
            Command::Export(command) => command.execute()?,
            Command::Adapters => adapters::execute(),
            Command::Modes(command) => command.execute()?,
            Command::Plot(command) => command.execute()?,
            Command::Compare(command) => command.execute()?,
            Command::Identify(command) => command.execute()?,
            Command::Paper(command) => command.execute()?,
            Command::Tradeoff(command) => command.execute()?,
            Command::Fem(command) => command.execute()?,
            Command::Fit(command) => command.execute()?,
            Command::Calibrate(command) => command.execute()?,
            Command::Init(command) => command.execute()?,
            Command::Keys(command) => command.execute()?,
            Command::Completions(command) => command.execute(definition()),
            Command::Man(command) => command.execute(definition())?,
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// Parses the arguments, the name of the program first, executes, reports an error and gives the exit code. `program` is the
/// file that starts the same program again, where it is not that of this process, as in an interpreter.
///
/// Once in a process, before anything else: how it talks is kept, and the environment is changed.
#[must_use]
pub fn main(program: Option<PathBuf>, arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    environment::look_for_no_display();
    environment::started_by(program);
    let parsed = definition()
        .try_get_matches_from(arguments)
        .and_then(|found| Ok((Cli::from_arg_matches(&found)?, found)));
    let (cli, found) = match parsed {
        Ok(parsed) => parsed,
        Err(said) => {
            let code = u8::try_from(said.exit_code()).map_or(ExitCode::FAILURE, ExitCode::from);
            return talk::after_help(said.print(), code);
        }
    };
    talk::begin(cli.manner);
    let code = cli.execute().unwrap_or_else(|error| {
        report::report(&error);
        talk::tell("error", squealmap_input::quote::message(&error.to_string()));
        ExitCode::from(match error {
            error if error.is_cancelled() => INTERRUPTED,
            error if error.is_bad_input() => 2,
            _ => 1,
        })
    });
    talk::end(found.subcommand_name().unwrap_or_default(), code)
}

/// The figure that `squealmap plot` draws with these arguments, without the name of the program, as SVG; nothing is written.
///
/// # Errors
/// The sentence that the command would end with.
pub fn figure(arguments: impl IntoIterator<Item = OsString>) -> std::result::Result<String, String> {
    let words = ["squealmap", "plot"].map(OsString::from).into_iter().chain(arguments);
    let parsed = definition().try_get_matches_from(words).and_then(|found| Cli::from_arg_matches(&found));
    match parsed.map(|cli| cli.command) {
        Ok(Command::Plot(mut plot)) => plot.draw().map(|drawn| drawn.svg).map_err(|why| why.to_string()),
        Ok(_) => Err("only `plot` draws".to_owned()),
        Err(why) => {
            // Its usage is of the command line.
            let text = why.to_string();
            let sentence = text.split("\n\n").next().unwrap_or_default();
            Err(sentence.trim_start_matches("error: ").replace('\n', " "))
        }
    }
}

/// The commands and their options; every option that takes a value takes a negative number, too, and says itself what is wrong
/// with it.
fn definition() -> clap::Command {
    let option = |arg: Arg| {
        let takes_one = arg.get_action().takes_values() && !arg.is_positional();
        if takes_one && !arg.is_allow_hyphen_values_set() { arg.allow_negative_numbers(true) } else { arg }
    };
    Cli::command().mut_subcommands(|command| command.mut_args(option))
}
