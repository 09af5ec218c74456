//! Which line is which: sample lines with words in a row.

use super::svg::{Anchor, Style, Svg, polyline};
use super::text::Text;

/// Length of a sample line, points.
pub(super) const SAMPLE: f64 = 15.0;
/// Between a sample and its words, points.
const WORD_GAP: f64 = 3.0;
/// Between entries, points.
const ENTRY_GAP: f64 = 12.0;
/// Height of the sample line above the base line, relative to the size of the words.
pub(super) const MIDDLE: f64 = 0.35;

/// Draws words and strokes from `x` on, the words on the base line `base`; returns where the next entry would begin.
pub(super) fn lines(svg: &mut Svg, mut x: f64, base: f64, size: f64, entries: &[(Text, &str)]) -> f64 {
    for (words, stroke) in entries {
        let y = base - MIDDLE * size;
        svg.path(&polyline([(x, y), (x + SAMPLE, y)]), stroke);
        svg.text(x + SAMPLE + WORD_GAP, base, words, Style::new(size, Anchor::Start));
        x += SAMPLE + WORD_GAP + words.width(size, false) + ENTRY_GAP;
    }
    x
}
