//! The words left of panels that stand one below the other: their letters, and the labels of their vertical axes.

use crate::frame::{Frame, LABEL_SIZE};
use crate::page::MARGIN;
use crate::svg::{Anchor, Style, Svg};
use crate::text::Text;

/// Height of a bracket above the base line, in ems.
pub const ASCENT: f64 = 0.73;
/// The height that a letter takes of a panel, points.
const HEIGHT: f64 = LABEL_SIZE + 3.0;
/// Behind a letter on top of curves.
const PLATE: &str = r##"fill="#FFFFFF" fill-opacity="0.85""##;

/// Between a letter and the words after it, points.
const GAP: f64 = 4.0;

/// `(a)` of the first.
pub fn letter(number: usize) -> String {
    let letter = (b'a'..=b'z').nth(number % 26).map_or('a', char::from);
    format!("({letter})")
}

/// The width that a letter takes before words, points.
#[must_use]
pub fn width(number: usize) -> f64 {
    Text::from(letter(number)).width(LABEL_SIZE, true) + GAP
}

/// Draws a letter with its upper left corner there.
pub fn draw_at(svg: &mut Svg, number: usize, [x, y]: [f64; 2]) {
    let style = Style::new(LABEL_SIZE, Anchor::Start).bold();
    svg.text(x, y + ASCENT * LABEL_SIZE, &Text::from(letter(number)), style);
}

/// The room that a letter leaves to the label of a vertical axis of this length, points.
#[must_use]
pub fn room(height: f64, rows: usize) -> f64 {
    if rows > 1 { height - HEIGHT } else { height }
}

/// Draws the letter of a row of panels, and the first of `labels` that has room beside it, from the left margin on. A figure
/// of one row has no letters. Where a panel is too flat for both, the letter stands in its first frame.
pub fn side(svg: &mut Svg, (number, rows): (usize, usize), frame: &Frame, labels: &[Text]) {
    let fits = |room: f64| labels.iter().find(|label| label.width(LABEL_SIZE, false) <= room);
    let left = room(frame.height, rows);
    let (label, middle) = match (fits(left), fits(frame.height).or(labels.last())) {
        (Some(label), _) => {
            if rows > 1 {
                draw_at(svg, number, [MARGIN, frame.y]);
            }
            (label, frame.bottom() - 0.5 * left)
        }
        (None, Some(label)) => {
            if rows > 1 {
                let width = Text::from(letter(number)).width(LABEL_SIZE, true);
                svg.rect([frame.x + 1.0, frame.y + 1.0, width + 2.0, LABEL_SIZE + 1.0], PLATE);
                draw_at(svg, number, [frame.x + 2.0, frame.y + 2.0]);
            }
            (label, frame.y + 0.5 * frame.height)
        }
        (None, None) => return,
    };
    svg.text(MARGIN + LABEL_SIZE, middle, label, Style::new(LABEL_SIZE, Anchor::Middle).upwards());
}
