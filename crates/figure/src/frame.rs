//! The frame of a panel: border, ticks outside and their labels.

use std::fmt::Write as _;

use crate::scale::{Scale, Tick};
use crate::svg::{Anchor, Style, Svg};
use crate::words::number;

/// Size of tick labels, points.
pub const TICK_SIZE: f64 = 7.0;
/// Size of axis labels, panel titles and legends, points.
pub const LABEL_SIZE: f64 = 8.0;
/// Size of headings and titles, points.
pub const TITLE_SIZE: f64 = 9.0;
/// Length of a tick, points.
pub const TICK_LENGTH: f64 = 2.5;
/// Between a tick and its label, points.
const TICK_SPACE: f64 = 1.5;
/// Height of a digit relative to the size of the text.
const DIGIT_HEIGHT: f64 = 0.716;
/// Stroke of frames and ticks.
const STROKE: &str = r##"fill="none" stroke="#000000" stroke-width="0.6""##;

/// A plot rectangle in points; `y` is its upper end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Left side, points.
    pub x: f64,
    /// Upper side, points.
    pub y: f64,
    /// Width, points.
    pub width: f64,
    /// Height, points.
    pub height: f64,
}

impl Frame {
    /// Position 0..1 from the left, in points.
    #[must_use]
    pub fn across(&self, at: f64) -> f64 {
        self.x + at * self.width
    }

    /// Position 0..1 from the bottom, in points.
    #[must_use]
    pub fn up(&self, at: f64) -> f64 {
        self.y + (1.0 - at) * self.height
    }

    /// The lower end.
    #[must_use]
    pub fn bottom(&self) -> f64 {
        self.y + self.height
    }

    /// Draws the border.
    pub fn border(&self, svg: &mut Svg) {
        svg.rect([self.x, self.y, self.width, self.height], STROKE);
    }

    /// Ticks below the frame.
    pub fn x_ticks(&self, svg: &mut Svg, ticks: &[Tick], labels: bool) {
        let mut marks = String::new();
        for tick in ticks.iter().filter(|tick| (0.0..=1.0).contains(&tick.at)) {
            let x = self.across(tick.at);
            let _ = write!(marks, "M{} {}v{}", number(x), number(self.bottom()), number(TICK_LENGTH));
            if labels {
                let y = self.bottom() + TICK_LENGTH + TICK_SPACE + DIGIT_HEIGHT * TICK_SIZE;
                svg.text(x, y, &tick.label, Style::new(TICK_SIZE, Anchor::Middle));
            }
        }
        svg.path(&marks, STROKE);
    }

    /// Labelled ticks above the frame.
    pub fn x_ticks_above(&self, svg: &mut Svg, ticks: &[Tick]) {
        let mut marks = String::new();
        for tick in ticks.iter().filter(|tick| (0.0..=1.0).contains(&tick.at)) {
            let x = self.across(tick.at);
            let _ = write!(marks, "M{} {}v{}", number(x), number(self.y), number(-TICK_LENGTH));
            let base = self.y - TICK_LENGTH - TICK_SPACE;
            svg.text(x, base, &tick.label, Style::new(TICK_SIZE, Anchor::Middle));
        }
        svg.path(&marks, STROKE);
    }

    /// Ticks left of the frame.
    pub fn y_ticks(&self, svg: &mut Svg, ticks: &[Tick], labels: bool) {
        let mut marks = String::new();
        for tick in ticks.iter().filter(|tick| (0.0..=1.0).contains(&tick.at)) {
            let y = self.up(tick.at);
            let _ = write!(marks, "M{} {}h{}", number(self.x), number(y), number(-TICK_LENGTH));
            if labels {
                let x = self.x - TICK_LENGTH - TICK_SPACE;
                let base = y + 0.5 * DIGIT_HEIGHT * TICK_SIZE;
                svg.text(x, base, &tick.label, Style::new(TICK_SIZE, Anchor::End));
            }
        }
        svg.path(&marks, STROKE);
    }
}

/// How many ticks a vertical axis of this length takes at most.
#[must_use]
pub fn y_tick_count(height: f64) -> usize {
    /// A tick takes about this much, points.
    const EACH: f64 = 11.0;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to few")]
    let count = (height / EACH).clamp(2.0, 5.0) as usize;
    count
}

/// The ticks of a vertical axis of this length: two or more where they fit, as one is no scale.
#[must_use]
pub fn y_ticks(scale: &Scale, height: f64) -> Vec<Tick> {
    let most = y_tick_count(height);
    let fits =
        |ticks: &[Tick]| ticks.windows(2).all(|pair| (pair[1].at - pair[0].at) * height >= TICK_SIZE + 1.0);
    let usual = scale.ticks(most);
    if usual.len() > 1 {
        return usual;
    }
    let finer = (most + 1..=3 * most).map(|most| scale.ticks(most));
    let some = finer.flat_map(|ticks| {
        (1..ticks.len()).map(move |stride| ticks.iter().step_by(stride).cloned().collect::<Vec<_>>())
    });
    let mut some = some.filter(|ticks| ticks.len() > 1 && fits(ticks));
    some.next().unwrap_or(usual)
}

/// Room below a frame for ticks and their labels.
#[must_use]
pub fn x_tick_room() -> f64 {
    TICK_LENGTH + TICK_SPACE + TICK_SIZE
}

/// Room left of a frame for ticks and the widest of their labels.
pub fn y_tick_room(ticks: &[Tick]) -> f64 {
    TICK_LENGTH + TICK_SPACE + ticks.iter().map(|tick| tick.label.width(TICK_SIZE, false)).fold(0.0, f64::max)
}
