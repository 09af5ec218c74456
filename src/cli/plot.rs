//! `squealmap plot`: the figure of a command again from its directory, for a journal or a talk.

use std::path::PathBuf;

use crate::cli::error::{Error, Result};
use crate::cli::numbers::number;
use crate::cli::output::{Output, list};
use crate::cli::pictures::tell_missing;
use crate::cli::plot_beside;
use crate::cli::plot_map::{OfMaps, Tables};
use crate::cli::talk::{note, print};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use squealmap::cluster::slurm::quote;
use squealmap::results::figure::look::{Journal, Look, WIDTHS};
use squealmap::study::curves::read::Curves;
use squealmap::study::observed::Strokes;
use squealmap::study::{Kind, Picture};
use squealmap::version::program;
use squealmap_figure::{pdf, png};

/// The files that are written for every figure.
const FILES: [&str; 3] = ["plot.pdf", "plot.png", "plot.svg"];

/// Ways to make a figure lower.
const OF_A_MAP: &str =
    "take a wider journal or --width, name fewer with --quantity, or show part of the map with --cut";
const OF_OTHERS: &str = "take another --journal, or --width, which sets no height";

/// Where `paper` puts its figures.
const PAPER: &str = "paper";

/// Arguments of `plot`.
#[derive(Debug, Args)]
pub(crate) struct Plot {
    /// Output directory of a command that draws a figure (run, refine, trace, curves, modes, tradeoff, identify, fem, paper); plot.svg,
    /// plot.pdf and plot.png go there too
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
    /// Width of the figure, 60mm to 400mm; some figures need more than 60mm for their words
    #[arg(long, value_name = "MM", allow_hyphen_values = true, value_parser = width)]
    width: Option<f64>,
    /// What stands above the figure instead of the title of the sweep; "" for nothing
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,
    /// Of a map, computed or refined: with the lines of this directory of `curves`, where cycles end
    #[arg(long, value_name = "DIR", conflicts_with = "cut")]
    curves: Option<PathBuf>,
    /// Of a map, computed or refined: with the measured strokes of this table, which has a column for each axis of the map, a standard
    /// error where that is known (`mu_s_error`), and `observed`: `no_instability`, `negative_slope`, `mode_coupling`, `both`, `undecided`;
    /// or of the `strokes.csv` of a campaign
    #[arg(long, value_name = "FILE", conflicts_with = "cut")]
    strokes: Option<PathBuf>,
    #[command(flatten)]
    map: OfMaps,
}

/// A figure that is drawn and not written yet.
pub(crate) struct Drawn {
    pub(crate) svg: String,
    kind: Kind,
    title: String,
    provenance: String,
    /// The tables beside it, and the names of all files.
    tables: Tables,
    names: Vec<&'static str>,
    is_map: bool,
}

impl Plot {
    pub(crate) fn execute(mut self) -> Result<()> {
        let Drawn { svg, kind, title, provenance, tables: mut files, names, is_map } = self.draw()?;
        let output = Output::prepare(self.output.clone().unwrap_or_else(|| self.directory.clone()), &names)?;
        let beside =
            if is_map { plot_beside::stale(output.directory(), FILES[2], &names) } else { Vec::new() };
        let directory = output.directory().to_owned();
        let svg = plot_beside::with_tables(svg, &files);
        tell_missing(&svg)?;
        files.push((FILES[0], pdf::render(&svg, &title, &provenance, &program())?));
        files.push((FILES[1], png::render_described(&svg, &title, &provenance)?));
        files.push((FILES[2], svg.into_bytes()));
        print(&list(&output.write(&files)?));
        plot_beside::remove(&directory, &beside);
        self.tell_others(kind);
        Ok(())
    }

    /// Reads the directory and draws the figure.
    pub(crate) fn draw(&mut self) -> Result<Drawn> {
        // What `paper` was told to write to holds its figures one further down.
        let inside = self.directory.join(PAPER);
        if Kind::held(&self.directory).is_empty() && !Kind::held(&inside).is_empty() {
            self.directory = inside;
        }
        let kind = Kind::choose(&self.directory, self.figure)?;
        if let Some(width) = self.width.filter(|width| *width < kind.narrowest()) {
            return Err(Error::TooNarrow { width, figure: kind.name(), least: kind.narrowest() });
        }
        let picture = Picture::read(&self.directory, kind)?;
        let provenance = format!("{}, of results of {}", self.command(), picture.program);
        let mut lines = match (&self.curves, picture.grid()) {
            (None, _) => Vec::new(),
            (Some(curves), Some(grid)) => Curves::over(curves, &self.directory, grid)?,
            (Some(_), None) => {
                let path = self.directory.clone();
                return Err(Error::OnlyOfMaps { option: "--curves", figure: kind.name(), path });
            }
        };
        match (&self.strokes, picture.grid()) {
            (None, _) => {}
            (Some(strokes), Some(grid)) => {
                let found = Strokes::over(strokes, grid)?;
                if found.outside > 0 {
                    note(&format!(
                        "{} of the strokes lie outside of the map, or have no verdict, and are not drawn",
                        found.outside
                    ));
                }
                lines.extend(found.lines);
            }
            (Some(_), None) => {
                let path = self.directory.clone();
                return Err(Error::OnlyOfMaps { option: "--strokes", figure: kind.name(), path });
            }
        }
        let look = Look {
            lines,
            width: self.journal.map(Journal::width).or(self.width),
            title: self.title.clone(),
            command: Some(provenance.clone()),
            ..self.journal.map_or_else(Look::default, Look::of_journal)
        };
        let beside = picture.map().map_or(Vec::new(), |_| self.map.tables());
        let names: Vec<&str> = FILES.into_iter().chain(beside).collect();
        let (svg, tables) = match (picture.map(), self.map.given()) {
            (Some(archive), _) => self.map.draw(archive, look.clone())?,
            (None, None) => (picture.svg(&look)?, Vec::new()),
            (None, Some(option)) => {
                let path = self.directory.clone();
                return Err(Error::OnlyOfMaps { option, figure: kind.name(), path });
            }
        };
        look.check_height(&svg, if picture.map().is_some() { OF_A_MAP } else { OF_OTHERS })?;
        let (title, is_map) = (look.title(picture.title()).to_owned(), picture.map().is_some());
        Ok(Drawn { svg, kind, title, provenance, tables, names, is_map })
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
        let mut command = format!("squealmap plot {}", quote(&self.directory.display().to_string()));
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
        if let Some(title) = &self.title {
            add(format!(" --title {}", quote(title)));
        }
        if let Some(strokes) = &self.strokes {
            add(format!(" --strokes {}", quote(&strokes.display().to_string())));
        }
        if let Some(curves) = &self.curves {
            add(format!(" --curves {}", quote(&curves.display().to_string())));
        }
        command + &self.map.command()
    }
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
