//! `squealmap plot`: the figure of a map again from the directory of its run, for a journal or a talk.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use squealmap::archive::{Archive, NumberColumn};
use squealmap::export::boundary_lines::boundary_lines;
use squealmap::export::look::{Content, Journal, Look, WIDTHS};
use squealmap::export::palette::Colouring;
use squealmap::export::{figure, pdf, png};
use squealmap::{Error, Result};

use crate::cli::identify::number;
use crate::cli::output::{Output, list};
use crate::cli::print;

/// What is written.
const FILES: [&str; 4] = ["boundaries.csv", "plot.pdf", "plot.png", "plot.svg"];

/// Short names of quantities and their columns.
const ALIASES: [(&str, &str); 4] = [
    ("growth", "growth_rate"),
    ("amplitude", "x2_std"),
    ("stick_fraction", "stick"),
    ("cycle_frequency", "response_frequency"),
];

/// Arguments of `plot`.
#[derive(Debug, Args)]
pub(crate) struct Plot {
    /// Output directory of `squealmap run`; the figure goes there too
    directory: PathBuf,
    /// Where the figure goes instead
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// The width that a journal or a talk asks for
    #[arg(long, value_parser = journals(), conflicts_with = "width")]
    journal: Option<Journal>,
    /// Width of the figure, 60mm to 400mm
    #[arg(long, value_name = "MM", value_parser = width)]
    width: Option<f64>,
    /// What to show, separated by commas, one block each: type, regime, growth, amplitude, frequency, phase,
    /// `stick_fraction` or any column of numbers in map.csv [default: type and regime, as far as computed]
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    quantity: Vec<String>,
    /// Types by hatching too, not by colour alone
    #[arg(long)]
    hatch: bool,
}

impl Plot {
    pub(crate) fn execute(self) -> Result<()> {
        let archive = Archive::read(&self.directory)?;
        let mut contents = Vec::new();
        for name in &self.quantity {
            contents.push(content(&archive, name, self.hatch)?);
        }
        if contents.is_empty() {
            contents = figure::computed(archive.map.spec.analysis, self.hatch);
        }
        let command = self.command();
        let look = Look {
            width: self.journal.map(Journal::width).or(self.width),
            enlarged: self.journal.map_or(1.0, Journal::enlarged),
            contents,
            command: Some(format!("{command}, of results of {}", archive.program)),
        };
        let output = Output::prepare(self.output.clone().unwrap_or_else(|| self.directory.clone()), &FILES)?;
        let svg = figure::look_svg(&archive.map, &look)?;
        let title = &archive.map.spec.title;
        let provenance = look.command.clone().unwrap_or_default();
        let files = [
            (FILES[0], boundary_lines(&archive.map)?),
            (FILES[1], pdf::render(&svg, title, &provenance)?),
            (FILES[2], png::render(&svg)?),
            (FILES[3], svg.into_bytes()),
        ];
        print(&list(&output.write(&files)?));
        Ok(())
    }

    /// The command that makes the same again.
    fn command(&self) -> String {
        let mut command = format!("squealmap plot {}", self.directory.display());
        let mut add = |text: String| command.push_str(&text);
        if let Some(journal) = self.journal {
            add(format!(" --journal {}", journal.name()));
        }
        if let Some(width) = self.width {
            add(format!(" --width {width}mm"));
        }
        if !self.quantity.is_empty() {
            add(format!(" --quantity {}", self.quantity.join(",")));
        }
        if self.hatch {
            add(" --hatch".to_owned());
        }
        command
    }
}

/// What a name asks for.
fn content<'a>(archive: &'a Archive, name: &str, hatched: bool) -> Result<Content<'a>> {
    let asked = archive.map.spec.analysis;
    if let Some(colouring) = Colouring::of(asked).find(|colouring| colouring.name() == name) {
        return Ok(Content::classes(colouring, hatched));
    }
    let column = ALIASES.iter().find(|(alias, _)| *alias == name).map_or(name, |(_, column)| column);
    let found = archive.columns.iter().find(|one| one.name == column).map(Content::Quantity);
    found
        .ok_or_else(|| Error::NoSuchQuantity { name: name.to_owned(), names: names(&archive.columns, asked) })
}

/// Everything that can be shown.
fn names(columns: &[NumberColumn], asked: squealmap::spec::Analysis) -> String {
    let mut names: Vec<&str> = Colouring::of(asked).map(Colouring::name).collect();
    for column in columns.iter().map(|column| column.name.as_str()) {
        if !names.contains(&column) {
            names.push(column);
        }
    }
    names.join(", ")
}

/// The names of journals.
fn journals() -> impl TypedValueParser<Value = Journal> {
    let named = |name: &str| Journal::ALL.into_iter().find(|journal| journal.name() == name);
    PossibleValuesParser::new(Journal::ALL.map(Journal::name))
        .map(move |name| named(&name).expect("only names of journals pass"))
}

fn width(text: &str) -> std::result::Result<f64, String> {
    let [least, most] = WIDTHS;
    let digits = text.strip_suffix("mm").unwrap_or(text).trim();
    let words = format!("a width in millimetres from {least} to {most}, such as 90mm");
    number(digits, |x| (least..=most).contains(&x), &words)
}
