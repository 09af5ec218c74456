//! How a figure is shown: at which width, what of a map, and where the picture comes from.

use crate::results::figure::heading::Heading;
use crate::results::figure::overlay::Overlay;
use crate::results::figure::palette::Colouring;
use crate::results::number::NumberColumn;
use crate::version::program;
use squealmap_figure::svg::{MM, Svg};

/// Least and most width of a figure, mm: narrower ones do not hold their labels, wider ones fit no page.
pub const WIDTHS: [f64; 2] = [60.0, 400.0];

/// The command that draws a picture again.
pub const AGAIN: &str = "squealmap plot DIR, with DIR the directory of this file";

/// Widths that journals and talks ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Journal {
    /// One column of an Elsevier journal.
    Elsevier1Col,
    /// Two columns of an Elsevier journal.
    Elsevier2Col,
    /// One column of a Nature journal.
    Nature1Col,
    /// A slide of 16:9, to be read from afar: everything is twice as large.
    Slide,
}

impl Journal {
    /// All journals and talks.
    pub const ALL: [Journal; 4] =
        [Journal::Elsevier1Col, Journal::Elsevier2Col, Journal::Nature1Col, Journal::Slide];

    /// The name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Journal::Elsevier1Col => "elsevier-1col",
            Journal::Elsevier2Col => "elsevier-2col",
            Journal::Nature1Col => "nature-1col",
            Journal::Slide => "slide",
        }
    }

    /// Width of the figure, mm.
    #[must_use]
    pub fn width(self) -> f64 {
        match self {
            Journal::Elsevier1Col => 90.0,
            Journal::Elsevier2Col => 190.0,
            Journal::Nature1Col => 89.0,
            Journal::Slide => 300.0,
        }
    }

    /// The tallest figure that fits, mm: the text area of a page, or a slide of 16:9.
    #[must_use]
    pub fn height(self) -> f64 {
        match self {
            Journal::Elsevier1Col | Journal::Elsevier2Col => 240.0,
            Journal::Nature1Col => 247.0,
            Journal::Slide => 168.75,
        }
    }

    /// How much larger than in print everything is.
    #[must_use]
    pub fn enlarged(self) -> f64 {
        if self == Journal::Slide { 2.0 } else { 1.0 }
    }
}

/// The content of a block of panels.
#[derive(Clone, Copy, Debug)]
pub enum Content<'a> {
    /// Classes by colour.
    Classes {
        /// Which classes.
        colouring: Colouring,
        /// Whether each has its own hatching on top.
        hatched: bool,
    },
    /// A number by lightness, with a bar.
    Quantity {
        /// Its values.
        column: &'a NumberColumn,
        /// Values at which lines of equal value are drawn, none where empty.
        levels: &'a [f64],
    },
    /// Numbers that stand for names: 0 for the first.
    Named {
        /// One of an instance.
        column: &'a NumberColumn,
        /// The heading above it.
        heading: &'a str,
        /// The names and their fills.
        names: &'a [(&'a str, &'a str)],
    },
    /// The regime from the large start of two, by colour.
    LargeRegime,
    /// The fraction of the starts of a box that end in a settled oscillation, by lightness, with a bar.
    Basin,
    /// The lines of the look alone.
    Lines,
}

impl Content<'_> {
    /// Classes by colour, and where asked for types by hatching too; regimes have the hatching of what has not settled.
    #[must_use]
    pub fn classes(colouring: Colouring, hatched: bool) -> Content<'static> {
        Content::Classes { colouring, hatched: hatched && colouring == Colouring::Type }
    }
}

impl<'a> Content<'a> {
    /// A number by lightness, without lines.
    #[must_use]
    pub fn quantity(column: &'a NumberColumn) -> Content<'a> {
        Content::Quantity { column, levels: &[] }
    }
}

/// A look at a figure.
#[derive(Clone, Debug)]
pub struct Look<'a> {
    /// Width of the figure, mm. With `None` it is one or two columns wide, whichever its panels need.
    pub width: Option<f64>,
    /// The most height that the figure may have, mm; `None` for any. To keep to it, panels become flatter or stand beside
    /// one another.
    pub height: Option<f64>,
    /// Stands above the figure instead of the title of the sweep. An empty text leaves the title out.
    pub title: Option<String>,
    /// How much larger than in print everything is.
    pub enlarged: f64,
    /// The blocks of a map from top to bottom. Where it is empty, they are those that were computed. Other figures have
    /// none.
    pub contents: Vec<Content<'a>>,
    /// Lines over the panels of a map; other figures have none.
    pub lines: Vec<Overlay>,
    /// The command that makes the picture again, for its metadata.
    pub command: Option<String>,
}

impl Default for Look<'_> {
    fn default() -> Self {
        Look {
            width: None,
            height: None,
            title: None,
            enlarged: 1.0,
            contents: Vec::new(),
            lines: Vec::new(),
            command: None,
        }
    }
}

impl Look<'_> {
    /// A look for a journal or a talk.
    #[must_use]
    pub fn of_journal(journal: Journal) -> Self {
        let (width, height) = (Some(journal.width()), Some(journal.height()));
        Look { width, height, enlarged: journal.enlarged(), ..Look::default() }
    }

    /// The title of the figure: the one that was asked for, or its own.
    #[must_use]
    pub fn title<'a>(&'a self, own: &'a str) -> &'a str {
        self.title.as_deref().unwrap_or(own)
    }

    /// The heading of the figure: with the title that was asked for, or its own, and with its own settings.
    pub(crate) fn headed(&self, own: &Heading) -> Heading {
        Heading { title: self.title(&own.title).to_owned(), settings: own.settings.clone() }
    }

    /// The width in which to draw, points.
    pub(crate) fn points(&self) -> Option<f64> {
        self.width.map(|mm| mm * MM / self.enlarged)
    }

    /// The finished document of a figure that was drawn in this size in points; the program and the command that makes it
    /// again stand in its metadata.
    pub(crate) fn finish(&self, svg: Svg, size: [f64; 2], name: &str) -> String {
        svg.finish_enlarged(self.enlarged, size, name, &(program() + &self.made_by()))
    }

    /// The command, for the end of a line of metadata; that of any command is `plot` of its directory.
    pub(crate) fn made_by(&self) -> String {
        let again = || format!("; drawn again by: {AGAIN}");
        self.command.as_ref().map_or_else(again, |command| format!("; made by: {command}"))
    }
}
