//! `squealmap paper`: the source paper computed again.

use std::fmt::Write as _;
use std::path::PathBuf;

use crate::cli::error::Result;
use crate::cli::numbers::number;
use crate::cli::output::{Output, list};
use crate::cli::paper_fem;
use crate::cli::talk::print;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use squealmap::study::paper::{Claim, Evidence, Figure, Settings, Study, claims, figures};

/// The report.
const REPORT: &str = "paper.md";
/// The directory of the figures, inside the output directory.
const FIGURES: &str = "paper";
/// The extensions of the files that are written for a figure.
const EXTENSIONS: [&str; 4] = ["png", "svg", "csv", "json"];

/// Arguments of `paper`.
#[derive(Debug, Args)]
pub(crate) struct PaperCommand {
    /// Output directory: paper.md, and the figures in paper/
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    output: PathBuf,
    /// Only these figures, separated by commas, and no paper.md, which needs them all
    #[arg(long, value_delimiter = ',', value_name = "FIGURE,...", value_parser = figures())]
    only: Vec<Figure>,
    /// Duration of the ramp of Figures 4 to 7, 0.5 to 100 s [default: 10]
    #[arg(long, value_name = "S", value_parser = ramp_duration)]
    ramp_duration: Option<f64>,
    /// Displacement at the start of that ramp, 1e-9 to 0.01 m [default: 1e-4]
    #[arg(long, value_name = "M", value_parser = kick)]
    kick: Option<f64>,
    /// The paper's finite-element model instead, in minutes and 2 GB of memory: Figures 15 to 17 and a report; or another study
    /// of it
    #[arg(
        long,
        value_name = "STUDY",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = paper_fem::BUILT_IN,
        conflicts_with_all = ["only", "ramp_duration", "kick"]
    )]
    fem: Option<PathBuf>,
}

impl PaperCommand {
    pub(crate) fn execute(self) -> Result<()> {
        if let Some(study) = &self.fem {
            return paper_fem::execute(self.output, study);
        }
        let chosen = |figure: &Figure| self.only.is_empty() || self.only.contains(figure);
        let figures: Vec<Figure> = Figure::ALL.into_iter().filter(chosen).collect();
        let path = |figure: Figure, extension: &str| format!("{FIGURES}/{}.{extension}", figure.name());
        let names: Vec<String> =
            figures.iter().flat_map(|figure| EXTENSIONS.map(|extension| path(*figure, extension))).collect();
        let report = self.only.is_empty().then_some(REPORT);
        let names: Vec<&str> = names.iter().map(String::as_str).chain(report).collect();
        let command = self.command();
        let output = Output::prepare(self.output, &names)?;

        let study = Study::new(Settings { ramp_duration: self.ramp_duration, kick: self.kick });
        let mut files = Vec::new();
        for figure in figures {
            let drawn = figures::draw(figure, &study)?.files()?;
            files.extend(drawn.map(|(extension, bytes)| (path(figure, extension), bytes)));
        }
        if report.is_some() {
            let evidence = Evidence::gather(&study)?;
            print(&verdicts(&evidence));
            let text = figures::report(&evidence, FIGURES, &command);
            files.push((REPORT.to_owned(), text.into_bytes()));
        }
        let files: Vec<(&str, Vec<u8>)> =
            files.iter_mut().map(|(name, bytes)| (name.as_str(), std::mem::take(bytes))).collect();
        print(&list(&output.write(&files)?));
        Ok(())
    }

    /// The command that makes the same again.
    fn command(&self) -> String {
        let mut command = format!("squealmap paper -o {}", self.output.display());
        for (option, value) in [("--ramp-duration", self.ramp_duration), ("--kick", self.kick)] {
            if let Some(value) = value {
                let _ = write!(command, " {option} {value}");
            }
        }
        command
    }
}

/// One line per claim.
fn verdicts(evidence: &Evidence) -> String {
    let line = |claim: Claim| format!("{}: {}\n", claim.says, claim.verdict.words());
    claims(evidence).into_iter().map(line).collect()
}

/// The names of the figures.
fn figures() -> impl TypedValueParser<Value = Figure> {
    let named = |name: &str| Figure::ALL.into_iter().find(|figure| figure.name() == name);
    PossibleValuesParser::new(Figure::ALL.map(Figure::name))
        .map(move |name| named(&name).expect("only names of figures pass"))
}

fn ramp_duration(text: &str) -> std::result::Result<f64, String> {
    number(text, |x| (0.5..=100.0).contains(&x), "a number of seconds from 0.5 to 100")
}

fn kick(text: &str) -> std::result::Result<f64, String> {
    number(text, |x| (1e-9..=0.01).contains(&x), "a length in metres from 1e-9 to 0.01")
}
