//! Keys of figures, which say which line is which: samples with words, in one row or in as many as a width asks for.

use crate::svg::{Anchor, Style, Svg, polyline};
use crate::text::Text;

/// Length of a sample line, points.
pub const SAMPLE: f64 = 15.0;
/// Length of a sample of an area, points.
const AREA: f64 = 10.0;
/// Between rows, points.
const LINE_GAP: f64 = 3.0;
/// Between a sample and its words, points.
const WORD_GAP: f64 = 3.0;
/// Between entries, points.
const ENTRY_GAP: f64 = 12.0;
/// From one cross to the next, in radii.
const CROSS_PITCH: f64 = 3.0;
/// Height of the sample line above the base line, relative to the size of the words.
pub const MIDDLE: f64 = 0.35;

/// Draws words and strokes from `x` on, the words on the base line `base`; returns where the next entry would begin.
pub fn lines(svg: &mut Svg, mut x: f64, base: f64, size: f64, entries: &[(Text, &str)]) -> f64 {
    for (words, stroke) in entries {
        let y = base - MIDDLE * size;
        svg.path(&polyline([(x, y), (x + SAMPLE, y)]), stroke);
        svg.text(x + SAMPLE + WORD_GAP, base, words, Style::new(size, Anchor::Start));
        x += SAMPLE + WORD_GAP + words.width(size, false) + ENTRY_GAP;
    }
    x
}

/// The outline of a cross of this radius, points.
#[must_use]
pub fn cross((x, y): (f64, f64), radius: f64) -> String {
    [-radius, radius].map(|tilt| polyline([(x - radius, y - tilt), (x + radius, y + tilt)])).concat()
}

/// The sample before the words of an entry.
#[derive(Clone, Copy, Debug)]
pub enum Sample<'a> {
    /// A line.
    Line(&'a str),
    /// A filled area.
    Area(&'a str),
    /// A mark of this radius, points.
    Mark(f64, &'a str),
    /// Crosses of this radius, points, one in each stroke.
    Crosses(f64, &'a [&'a str]),
    /// An upright bar.
    Bar(&'a str),
    /// Nothing: words by themselves.
    Nothing,
}

impl Sample<'_> {
    /// Draws it left of words on a base line.
    fn draw(self, svg: &mut Svg, x: f64, base: f64, size: f64) {
        let y = base - MIDDLE * size;
        match self {
            Sample::Line(stroke) => svg.path(&polyline([(x, y), (x + SAMPLE, y)]), stroke),
            Sample::Area(fill) => svg.rect([x, base - 0.75 * size, AREA, 0.8 * size], fill),
            Sample::Mark(radius, fill) => svg.circle(x + radius, y, radius, fill),
            Sample::Crosses(radius, strokes) => {
                for (number, stroke) in strokes.iter().enumerate() {
                    let middle = x + radius * (1.0 + CROSS_PITCH * number as f64);
                    svg.path(&cross((middle, y), radius), stroke);
                }
            }
            Sample::Bar(stroke) => {
                let middle = x + 0.5 * AREA;
                svg.path(&polyline([(middle, base), (middle, base - 0.75 * size)]), stroke);
            }
            Sample::Nothing => {}
        }
    }

    fn width(self) -> f64 {
        match self {
            Sample::Line(_) => SAMPLE,
            Sample::Area(_) | Sample::Bar(_) => AREA,
            Sample::Mark(radius, _) => 2.0 * radius,
            Sample::Crosses(radius, strokes) => {
                radius * (2.0 + CROSS_PITCH * (strokes.len().max(1) - 1) as f64)
            }
            Sample::Nothing => -WORD_GAP,
        }
    }
}

/// Draws entries from `[x, y]` on, in as many rows as they take within `width`; returns the height of the rows.
pub fn rows(svg: &mut Svg, [x, y]: [f64; 2], width: f64, size: f64, entries: &[(Text, Sample<'_>)]) -> f64 {
    let line = size + LINE_GAP;
    let (mut left, mut height) = (x, if entries.is_empty() { 0.0 } else { line });
    for (words, sample) in entries {
        let lines = words.wrapped(width - sample.width() - WORD_GAP, size);
        let words = lines.iter().map(|words| words.width(size, false)).fold(0.0, f64::max);
        let room = sample.width() + WORD_GAP + words;
        if left > x && left + room > x + width {
            left = x;
            height += line;
        }
        let base = y + height - LINE_GAP;
        sample.draw(svg, left, base, size);
        for (number, words) in lines.iter().enumerate() {
            let base = base + number as f64 * line;
            svg.text(left + sample.width() + WORD_GAP, base, words, Style::new(size, Anchor::Start));
        }
        height += lines.len().saturating_sub(1) as f64 * line;
        left += room + ENTRY_GAP;
    }
    height
}
