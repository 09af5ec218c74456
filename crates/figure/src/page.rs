//! The measures of a figure, and its title.

use crate::frame::TITLE_SIZE;
use crate::svg::{Anchor, MM, Style, Svg};
use crate::text::{Text, wrap};

/// Width of a figure of two columns of a journal, points.
pub const DOUBLE_COLUMN: f64 = 180.0 * MM;
/// Width of a figure of one column of a journal, points.
pub const SINGLE_COLUMN: f64 = 88.0 * MM;
/// White margin around everything, points.
pub const MARGIN: f64 = 4.0;

/// Draws a title and returns the height it takes.
pub fn title(svg: &mut Svg, text: &str, width: f64) -> f64 {
    let lines = wrap(text, width, TITLE_SIZE, true);
    for (number, line) in lines.iter().enumerate() {
        let base = MARGIN + TITLE_SIZE + number as f64 * (TITLE_SIZE + 3.0);
        svg.text(MARGIN, base, &Text::from(line.as_str()), Style::new(TITLE_SIZE, Anchor::Start).bold());
    }
    if lines.is_empty() { 0.0 } else { lines.len() as f64 * (TITLE_SIZE + 3.0) + 5.0 }
}
