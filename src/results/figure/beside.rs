//! Panels side by side: how many fit, how far apart they stand, and what their ticks say without touching one another.

use crate::results::figure::picture_axis::{Direction, PictureAxis};
use squealmap_figure::frame::TICK_SIZE;
use squealmap_figure::page::MARGIN;
use squealmap_figure::scale::Tick;
use squealmap_figure::text::Text;

/// Side by side no more panels of curves than this; the table holds all.
const MOST_PANELS: usize = 4;
/// Panels of curves are no narrower than this, points.
const NARROWEST: f64 = 90.0;
/// Least room between the labels of two panels, points.
const TICK_GAP: f64 = 3.0;
/// Panels that became a little narrower keep their labels, points.
const SLACK: f64 = 0.5;

/// How many panels of curves stand side by side on a page of this width, points.
pub(crate) fn most_panels(page: f64) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive count")]
    let fit = ((page - 2.0 * MARGIN) / NARROWEST).max(1.0) as usize;
    MOST_PANELS.min(fit)
}

/// How far the ticks of a panel let the next one stand from it, within these bounds.
pub(crate) fn gap_across(ticks: &[Tick], width: f64, [least, most]: [f64; 2]) -> f64 {
    let wanted = least - room_between(ticks, width, least);
    if wanted > most { least } else { wanted.max(least) }
}

/// Room between the words of the last tick of a panel and those of the first tick of the next, points. It is negative where
/// they would overlap.
fn room_between(ticks: &[Tick], width: f64, gap: f64) -> f64 {
    let [first, .., last] = ticks else { return 0.0 };
    let words = [first, last].map(|tick| 0.5 * tick.label.width(TICK_SIZE, false)).iter().sum::<f64>();
    (1.0 - last.at + first.at) * width + gap - words - TICK_GAP
}

/// The ticks of a panel of this width with another one at a gap beside it: without the words of the last where they would
/// touch its first. Two with words remain where any two have room: one is no scale.
pub(crate) fn parted(axis: &PictureAxis, width: f64, gap: f64) -> Vec<Tick> {
    /// The numbers of ticks that are tried.
    const TRIED: std::ops::RangeInclusive<usize> = 3..=8;
    let mut ticks = axis.ticks(width, Direction::Horizontal, TICK_SIZE);
    if room_between(&ticks, width, gap) >= -SLACK {
        return ticks;
    }
    if let [first, _] = &ticks[..] {
        let pairs = TRIED.flat_map(|most| axis.scale.ticks(most)).map(|last| vec![first.clone(), last]);
        let apart = |pair: &[Tick]| room_between(pair, width, gap).min(room_within(pair, width));
        let widest = pairs
            .filter(|pair| pair[1].at > pair[0].at && apart(pair) >= 0.0)
            .max_by(|a, b| a[1].at.total_cmp(&b[1].at));
        if let Some(pair) = widest {
            return pair;
        }
    }
    if let Some(end) = ticks.last_mut() {
        end.label = Text::default();
    }
    ticks
}

/// Room between the words of two neighbouring ticks of a panel, points.
fn room_within(pair: &[Tick], width: f64) -> f64 {
    let [first, last] = pair else { return 0.0 };
    let words = [first, last].map(|tick| 0.5 * tick.label.width(TICK_SIZE, false)).iter().sum::<f64>();
    (last.at - first.at) * width - words - TICK_GAP
}
