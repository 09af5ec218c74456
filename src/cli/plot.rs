//! `squealmap plot`: the figure of a command again from its directory, for a journal or a talk.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use squealmap::archive::{Archive, Kind, NumberColumn, Picture};
use squealmap::export::boundary_lines::boundary_lines;
use squealmap::export::look::{Content, Journal, Look, WIDTHS};
use squealmap::export::palette::Colouring;
use squealmap::export::{figure, pdf, png};
use squealmap::{Error, Result};

use crate::cli::identify::number;
use crate::cli::output::{Output, list};
use crate::cli::{note, print};

/// What is written of every figure.
const FILES: [&str; 3] = ["plot.pdf", "plot.png", "plot.svg"];
/// What is written of a map too.
const BOUNDARIES: &str = "boundaries.csv";

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
    /// Output directory of a command that draws a figure: run, trace, modes, tradeoff; the figure goes there too
    directory: PathBuf,
    /// Which figure, where the directory holds several [default: the first of those named here]
    #[arg(long, value_parser = kinds())]
    figure: Option<Kind>,
    /// Where the figure goes instead
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// The width that a journal or a talk asks for
    #[arg(long, value_parser = journals(), conflicts_with = "width")]
    journal: Option<Journal>,
    /// Width of the figure, 60mm to 400mm
    #[arg(long, value_name = "MM", value_parser = width)]
    width: Option<f64>,
    /// Of a map, what to show, separated by commas, one block each: type, regime, growth, amplitude, frequency, phase,
    /// `stick_fraction` or any column of numbers in map.csv [default: type and regime, as far as computed]
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    quantity: Vec<String>,
    /// Of a map, types by hatching too, not by colour alone
    #[arg(long)]
    hatch: bool,
}

impl Plot {
    pub(crate) fn execute(self) -> Result<()> {
        let kind = Kind::choose(&self.directory, self.figure)?;
        let picture = Picture::read(&self.directory, kind)?;
        let command = self.command();
        let look = Look {
            width: self.journal.map(Journal::width).or(self.width),
            enlarged: self.journal.map_or(1.0, Journal::enlarged),
            contents: self.contents(&picture, kind)?,
            command: Some(format!("{command}, of results of {}", picture.program)),
        };
        let names: Vec<&str> = FILES.into_iter().chain(picture.map().map(|_| BOUNDARIES)).collect();
        let output = Output::prepare(self.output.clone().unwrap_or_else(|| self.directory.clone()), &names)?;
        let svg = picture.svg(&look)?;
        let title = picture.title();
        let provenance = look.command.clone().unwrap_or_default();
        let mut files = vec![
            (FILES[0], pdf::render(&svg, title, &provenance)?),
            (FILES[1], png::render_described(&svg, title, &provenance)?),
        ];
        if let Some(archive) = picture.map() {
            files.insert(0, (BOUNDARIES, boundary_lines(&archive.map)?));
        }
        files.push((FILES[2], svg.into_bytes()));
        print(&list(&output.write(&files)?));
        self.tell_others(kind);
        Ok(())
    }

    /// What is shown of a map; other figures show what they show.
    fn contents<'a>(&self, picture: &'a Picture, kind: Kind) -> Result<Vec<Content<'a>>> {
        let Some(archive) = picture.map() else {
            let of_maps = [("--quantity", !self.quantity.is_empty()), ("--hatch", self.hatch)];
            return match of_maps.into_iter().find(|(_, given)| *given) {
                Some((option, _)) => {
                    let path = self.directory.clone();
                    Err(Error::OnlyOfMaps { option, figure: kind.name(), path })
                }
                None => Ok(Vec::new()),
            };
        };
        if self.quantity.is_empty() {
            return Ok(figure::computed(archive.map.spec.analysis, self.hatch));
        }
        self.quantity.iter().map(|name| content(archive, name, self.hatch)).collect()
    }

    /// Names the figures that were not asked for.
    fn tell_others(&self, drawn: Kind) {
        let held = Kind::held(&self.directory);
        let others: Vec<&str> = held.into_iter().filter(|kind| *kind != drawn).map(Kind::name).collect();
        if self.figure.is_none() && !others.is_empty() {
            let (drawn, others) = (drawn.name(), others.join(", "));
            note(&format!("drawn is the figure `{drawn}`; with --figure there is also {others}"));
        }
    }

    /// The command that makes the same again.
    fn command(&self) -> String {
        let mut command = format!("squealmap plot {}", self.directory.display());
        let mut add = |text: String| command.push_str(&text);
        if let Some(figure) = self.figure {
            add(format!(" --figure {}", figure.name()));
        }
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

/// The names of figures.
fn kinds() -> impl TypedValueParser<Value = Kind> {
    let named = |name: &str| Kind::ALL.into_iter().find(|kind| kind.name() == name);
    PossibleValuesParser::new(Kind::ALL.map(Kind::name))
        .map(move |name| named(&name).expect("only names of figures pass"))
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
