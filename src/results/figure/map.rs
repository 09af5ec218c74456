//! `map.svg`: the print-ready stability map.
//!
//! The first two numeric axes (of more than seven values, where there are such) are the picture, further axes small
//! multiples. Colour is the type of instability and, in a second block, the regime of the response. Explicit tuples
//! are points.

use crate::engine::computation::Computation;
use crate::engine::record::Record;
use crate::results::accounted::accounted;
use crate::results::error::Result;
use crate::results::figure::block::Block;
use crate::results::figure::fills::define_patterns;
use crate::results::figure::look::{Content, Look};
use crate::results::figure::overlay::Overlay;
use crate::results::figure::palette::Colouring;
use crate::results::figure::panels::Panels;
use crate::results::trust;
use crate::sweep::label::{Label, Tally};
use crate::sweep::map::Map;
use crate::sweep::sheet::Sheet;
use crate::sweep::spec::{Analysis, Starts};
use crate::version::program;
use squealmap_figure::frame::LABEL_SIZE;
use squealmap_figure::layout::Layout;
use squealmap_figure::page::{DOUBLE_COLUMN, MARGIN, SINGLE_COLUMN, title};
use squealmap_figure::svg::{Anchor, Style, Svg};
use squealmap_figure::text::{Text, wrap};

/// Between blocks side by side, points.
const GAP_ACROSS: f64 = 16.0;
/// Blocks side by side are as wide as this, points, in pairs ...
const HALF: f64 = 0.6 * SINGLE_COLUMN - 0.5 * GAP_ACROSS;
/// ... and where there are three in a row; more only where a page has no other room.
const THIRD: f64 = 120.0;
/// No block is narrower than this, points.
const NARROWEST: f64 = 88.0;

/// The stability map as an SVG document: double column width, single column when it is one picture only.
///
/// # Errors
/// When an instance was never computed, and not because the run was stopped.
pub fn map_svg(map: &Map) -> Result<String> {
    look_svg(map, &Look::default())
}

/// All classes as far as they were computed, the regime from a second start, and the basins of starts from a box.
#[must_use]
pub fn computed(analysis: Analysis, hatched: bool) -> Vec<Content<'static>> {
    let mut contents = Vec::new();
    for colouring in Colouring::of(analysis) {
        contents.push(Content::classes(colouring, hatched));
        if colouring == Colouring::Regime && analysis.starts == Starts::Both {
            contents.push(Content::LargeRegime);
        }
    }
    contents.extend(matches!(analysis.starts, Starts::Box(_)).then_some(Content::Basin));
    contents
}

/// A map as an SVG document with this look.
///
/// # Errors
/// When an instance was never computed, and not because the run was stopped.
pub fn look_svg(map: &Map, look: &Look<'_>) -> Result<String> {
    accounted(map)?;
    let mut figure = MapFigure::new(Sheet::from(map));
    figure.add(0, &map.records);
    Ok(figure.look(look))
}

/// The figure of a sweep that is filled part by part; it keeps the labels of what it shows.
#[derive(Debug)]
pub struct MapFigure<'a> {
    sheet: Sheet<'a>,
    panels: Panels,
    tally: Tally,
    /// Panels and counts of the large start, where there is one.
    large: Option<(Panels, Tally)>,
    /// The counts of computed instances alone; `None` where every instance was computed. In a refined map the others have
    /// labels, too.
    computed: Option<Tally>,
}

impl<'a> MapFigure<'a> {
    /// An empty figure.
    #[must_use]
    pub fn new(sheet: Sheet<'a>) -> MapFigure<'a> {
        let panels = Panels::new(sheet.grid);
        let boxed = matches!(sheet.analysis.starts, Starts::Box(_));
        let panels = if boxed { panels.with_basins() } else { panels };
        let both = sheet.analysis.starts == Starts::Both;
        let large = both.then(|| (Panels::new(sheet.grid), Tally::default()));
        MapFigure { sheet, panels, tally: Tally::default(), large, computed: None }
    }

    /// Says that only these instances were computed: the others have the labels of their surroundings.
    #[must_use]
    pub fn of_computed(self, computed: Tally) -> MapFigure<'a> {
        MapFigure { computed: Some(computed), ..self }
    }

    /// Takes the records from instance `first` on; every instance has to come once, here or in
    /// [`MapFigure::add_missing`].
    pub fn add(&mut self, first: usize, records: &[Record]) {
        self.panels.add(first, records);
        self.tally.add(records);
        if let Some((panels, tally)) = &mut self.large {
            let records: Vec<Record> = records.iter().map(from_large_start).collect();
            panels.add(first, &records);
            tally.add(&records);
        }
    }

    /// Takes instances that were not computed.
    pub fn add_missing(&mut self, count: usize) {
        self.tally.add_missing(count);
        if let Some((_, tally)) = &mut self.large {
            tally.add_missing(count);
        }
    }

    /// How many instances have which label.
    #[must_use]
    pub fn tally(&self) -> &Tally {
        &self.tally
    }

    /// The SVG document.
    #[must_use]
    pub fn svg(&self) -> String {
        self.look(&Look::default())
    }

    /// The SVG document with a look.
    #[must_use]
    pub fn look(&self, look: &Look<'_>) -> String {
        draw(self, look)
    }
}

/// The labels of an instance from its large start; the type belongs to the equilibrium, whatever the start.
fn from_large_start(record: &Record) -> Record {
    let of_large = record.large().map_or(Record::NOT_COMPUTED, |large| Record::from(Label::from(large)));
    Record { kind: record.kind, ..of_large }
}

fn draw(figure: &MapFigure<'_>, look: &Look<'_>) -> String {
    let MapFigure { sheet, panels, tally, large, computed: some } = figure;
    let mut contents =
        if look.contents.is_empty() { computed(sheet.analysis, false) } else { look.contents.clone() };
    // A map of labels alone, as that of `refine`, has none of a large start.
    let known = large.as_ref().is_some_and(|(_, tally)| tally.computed() > 0);
    contents.retain(|content| known || !matches!(content, Content::LargeRegime));
    let one_panel = panels.all.len() <= 1;
    let usual = if one_panel && contents.len() < 2 { SINGLE_COLUMN } else { DOUBLE_COLUMN };
    let width = look.points().unwrap_or(usual);
    let inner = width - 2.0 * MARGIN;
    // Blocks of one picture stand side by side; strips of one axis do so only in pairs.
    let row = contents.len() == 2 || (contents.len() > 2 && panels.y.is_some());
    let usual = Layout::usual(if one_panel && row { across(contents.len(), inner) } else { 1 });
    let layout = look.tallest().map_or(usual, |tallest| {
        let height = |layout| compose(figure, look, (&contents, layout, true), width).1[1];
        Layout::fitting(usual, most_across(contents.len(), inner), tallest, height)
    });
    let (svg, size) = compose(figure, look, (&contents, layout, false), width);
    let title = look.title(sheet.title);
    let name = if title.is_empty() { "Stability map" } else { title };
    let metadata = provenance(*sheet, tally.total(), some.as_ref().unwrap_or(tally)) + &look.made_by();
    svg.finish_enlarged(look.enlarged, size, name, &metadata)
}

/// How many of some blocks have room side by side in this width, points.
fn most_across(blocks: usize, inner: f64) -> usize {
    let least = |count: usize| if count == 2 { HALF } else { NARROWEST };
    let fits = |count: &usize| block_width(inner, *count) >= least(*count);
    (2..=blocks).filter(fits).max().unwrap_or(1)
}

/// How many of them stand side by side: two or three, whichever leaves less of the last row empty.
fn across(blocks: usize, inner: f64) -> usize {
    let fits = |count: &usize| block_width(inner, *count) >= if *count == 2 { HALF } else { THIRD };
    let empty = |count: &usize| (count - blocks % count) % count;
    [2, 3].into_iter().filter(fits).min_by_key(empty).unwrap_or(1)
}

/// The width of so many blocks side by side, points.
fn block_width(inner: f64, count: usize) -> f64 {
    (inner - (count - 1) as f64 * GAP_ACROSS) / count as f64
}

/// The picture in a layout and its size; one that is measured only has empty panels.
fn compose(
    figure: &MapFigure<'_>,
    look: &Look<'_>,
    (contents, layout, measured): (&[Content<'_>], Layout, bool),
    width: f64,
) -> (Svg, [f64; 2]) {
    let MapFigure { sheet, panels, tally, large, computed } = figure;
    let inner = width - 2.0 * MARGIN;
    let mut svg = Svg::new();
    define_patterns(&mut svg);
    let mut y = MARGIN + title(&mut svg, look.title(sheet.title), inner);
    let across = block_width(inner, layout.across);
    let overlays: Vec<Overlay> = look.lines.iter().filter(|line| line.is_in(sheet.grid)).cloned().collect();
    let mut blocks = Vec::with_capacity(contents.len());
    for (number, content) in contents.iter().enumerate() {
        let letter = (contents.len() > 1).then_some(number);
        let stacked = contents.len().div_ceil(layout.across);
        let starts = sheet.analysis.starts;
        let (panels, tally) = match (content, large) {
            (Content::LargeRegime, Some((panels, tally))) => (panels, tally),
            (Content::Quantity { column, .. }, Some((panels, tally))) if trust::is_of_large_start(column) => {
                (panels, tally)
            }
            _ => (panels, tally),
        };
        blocks.push(Block {
            grid: sheet.grid,
            tally,
            computed: computed.as_ref(),
            panels,
            content: *content,
            overlays: &overlays,
            starts,
            blocks: stacked,
            layout,
            letter,
            least_left: 0.0,
            more_lines: 0,
            measured,
        });
    }
    let least_left = blocks.iter().map(Block::left).fold(0.0, f64::max);
    for (row, blocks) in blocks.chunks(layout.across).enumerate() {
        y += if row == 0 { 0.0 } else { layout.gap };
        let more_lines = blocks.iter().map(|block| block.lines_beyond_one(across)).max().unwrap_or(0);
        let heights = blocks.iter().enumerate().map(|(column, block)| {
            let x = MARGIN + column as f64 * (across + GAP_ACROSS);
            Block { least_left, more_lines, ..*block }.draw(&mut svg, x, y, across)
        });
        y += heights.fold(0.0, f64::max);
    }
    let of_some = computed.as_ref().map(|some| {
        let (some, all) = (some.total(), tally.total());
        format!("{some} of {all} instances were computed; the others have the label of the cell around them.")
    });
    for note in panels.note.iter().chain(&of_some) {
        for line in wrap(note, inner, LABEL_SIZE, false) {
            y += LABEL_SIZE + 3.0;
            svg.text(MARGIN, y, &Text::from(line), Style::new(LABEL_SIZE, Anchor::Start));
        }
    }
    (svg, [width, y + MARGIN])
}

/// The program and the sweep that made the picture, without anything that differs between two runs of one sweep.
fn provenance(sheet: Sheet, total: usize, tally: &Tally) -> String {
    let part = |name: &str, computation: Option<&Computation>| {
        computation.map(|computation| format!("; {name} {computation}")).unwrap_or_default()
    };
    format!(
        "{}{}{}; {} instances{}",
        program(),
        part("linear", sheet.linear),
        part("response", sheet.response),
        total,
        if tally.computed() < total {
            format!(", {} of them computed", tally.computed())
        } else {
            String::new()
        }
    )
}
