//! `map.svg`: the print-ready stability map.
//!
//! The first two numeric axes are the picture, further axes small multiples. Colour is the type of
//! instability and, in a second block, the regime of the response. Explicit tuples are points.

use super::accounted;
use super::block::Block;
use super::cells::define_patterns;
use super::frame::{LABEL_SIZE, TITLE_SIZE};
use super::look::{Content, Look};
use super::manifest::{COMMIT, VERSION};
use super::palette::Colouring;
use super::panels::Panels;
use super::svg::{Anchor, MM, Style, Svg};
use super::text::{Text, wrap};
use crate::error::Result;
use crate::map::{Computation, Map};

/// Width of a figure of two columns of a journal, points.
pub const DOUBLE_COLUMN: f64 = 180.0 * MM;
/// Width of a figure of one column of a journal, points.
pub const SINGLE_COLUMN: f64 = 88.0 * MM;
/// White margin around everything, points.
pub(super) const MARGIN: f64 = 4.0;
/// The names of blocks.
const LETTERS: [char; 8] = ['a', 'b', 'c', 'd', 'e', 'f', 'g', 'h'];
/// Between blocks, points.
const BLOCK_GAP: f64 = 16.0;

/// The stability map as an SVG document: double column width, single column when it is one picture only.
///
/// # Errors
/// When an instance was never computed, and not because the run was stopped.
pub fn map_svg(map: &Map) -> Result<String> {
    look_svg(map, &Look::default())
}

/// Both classes, as far as they were computed.
#[must_use]
pub fn computed(map: &Map, hatched: bool) -> Vec<Content<'static>> {
    let analysis = map.spec.analysis;
    [(Colouring::Type, analysis.linear), (Colouring::Regime, analysis.response)]
        .into_iter()
        .filter(|(_, asked)| *asked)
        .map(|(colouring, _)| Content::classes(colouring, hatched))
        .collect()
}

/// A map as an SVG document with this look.
///
/// # Errors
/// When an instance was never computed, and not because the run was stopped.
pub fn look_svg(map: &Map, look: &Look<'_>) -> Result<String> {
    accounted(map)?;
    let panels = Panels::new(&map.spec.grid);
    let contents = if look.contents.is_empty() { computed(map, false) } else { look.contents.clone() };
    let one_panel = panels.all.len() <= 1;
    let usual = if one_panel && contents.len() < 2 { SINGLE_COLUMN } else { DOUBLE_COLUMN };
    let width = look.points().unwrap_or(usual);
    let inner = width - 2.0 * MARGIN;
    let mut svg = Svg::new();
    define_patterns(&mut svg);
    let mut y = MARGIN + title(&mut svg, &map.spec.title, inner);
    // Blocks of one picture stand side by side.
    let beside = one_panel && contents.len() == 2 && inner > SINGLE_COLUMN * 1.2;
    let across = if beside { 0.5 * (inner - BLOCK_GAP) } else { inner };
    let mut tallest: f64 = 0.0;
    for (number, content) in contents.iter().enumerate() {
        let letter = (contents.len() > 1).then(|| LETTERS[number % LETTERS.len()]);
        let blocks = if beside { 1 } else { contents.len() };
        let block = Block { map, panels: &panels, content: *content, blocks, letter };
        if beside {
            let x = MARGIN + number as f64 * (across + BLOCK_GAP);
            tallest = tallest.max(block.draw(&mut svg, x, y, across));
        } else {
            let gap = if number == 0 { 0.0 } else { BLOCK_GAP };
            y += gap;
            y += block.draw(&mut svg, MARGIN, y, across);
        }
    }
    y += tallest;
    if let Some(note) = &panels.note {
        for line in wrap(note, inner, LABEL_SIZE, false) {
            y += LABEL_SIZE + 3.0;
            svg.text(MARGIN, y, &Text::from(line), Style::new(LABEL_SIZE, Anchor::Start));
        }
    }
    let name = if map.spec.title.is_empty() { "Stability map" } else { &map.spec.title };
    let command = look.command.as_ref().map(|command| format!("; made by: {command}")).unwrap_or_default();
    let metadata = provenance(map) + &command;
    Ok(svg.finish_enlarged(look.enlarged, [width, y + MARGIN], name, &metadata))
}

/// Draws a title and returns the height it takes.
pub(super) fn title(svg: &mut Svg, text: &str, width: f64) -> f64 {
    let lines = wrap(text, width, TITLE_SIZE, true);
    for (number, line) in lines.iter().enumerate() {
        let base = MARGIN + TITLE_SIZE + number as f64 * (TITLE_SIZE + 3.0);
        svg.text(MARGIN, base, &Text::from(line.as_str()), Style::new(TITLE_SIZE, Anchor::Start).bold());
    }
    if lines.is_empty() { 0.0 } else { lines.len() as f64 * (TITLE_SIZE + 3.0) + 5.0 }
}

/// What made the picture; nothing that differs between two runs of the same sweep.
fn provenance(map: &Map) -> String {
    let made = &map.provenance;
    let part = |name: &str, computation: &Option<Computation>| {
        computation.as_ref().map(|computation| format!("; {name} {computation}")).unwrap_or_default()
    };
    format!(
        "{}{}{}; {} instances{}",
        program(),
        part("linear", &made.linear),
        part("response", &made.response),
        map.records.len(),
        map.stopped.as_ref().map(|_| format!(", {} of them computed", map.computed())).unwrap_or_default()
    )
}

/// Program, version and commit.
pub(super) fn program() -> String {
    let commit = COMMIT.map(|commit| format!(" ({commit})")).unwrap_or_default();
    format!("{} {VERSION}{commit}", env!("CARGO_PKG_NAME"))
}
