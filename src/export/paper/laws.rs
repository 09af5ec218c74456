//! Figure 3: the friction laws of the three ramps.

use super::Drawn;
use crate::error::Result;
use crate::export::columns::Cell;
use crate::export::csv::Table;
use crate::export::figure::{MARGIN, SINGLE_COLUMN, program, title};
use crate::export::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_room};
use crate::export::key;
use crate::export::plot::{FIRST, Plot, SECOND, THIRD};
use crate::export::scale::Scale;
use crate::export::svg::{Anchor, Style, Svg};
use crate::export::text::Text;
use crate::model::Param;
use crate::paper::{Case, Study};

/// Points of a curve: every 0.05 m/s up to the belt velocity of the ramps.
const POINTS: usize = 141;
/// Height of the panel, points.
const HEIGHT: f64 = 130.0;
/// Right of the panel, points.
const RIGHT: f64 = 8.0;
/// Room above the highest curve, as a factor.
const HEADROOM: f64 = 1.15;
/// Heading of picture and document.
const HEADING: &str = "Friction laws of the three ramps";

/// Friction against the relative velocity, single column width.
pub(super) fn draw(study: &Study) -> Result<Drawn> {
    let instances = Case::ALL.map(|case| study.instance(case));
    let fastest = instances.iter().map(|one| one.params.require(Param::BeltVelocity)).fold(0.0, f64::max);
    let rows: Vec<(f64, [f64; 3])> = (0..POINTS)
        .map(|k| fastest * k as f64 / (POINTS - 1) as f64)
        .map(|v| (v, instances.each_ref().map(|one| one.law.mu(v))))
        .collect();
    let mut table = Table::new(["relative_velocity", "mu_figure4", "mu_figure5", "mu_figure6"].into_iter())?;
    for (v, mu) in &rows {
        table.row(std::iter::once(*v).chain(*mu).map(|x| Cell::from(x).to_string()))?;
    }

    let mut svg = Svg::new();
    let mut y = MARGIN + title(&mut svg, HEADING, SINGLE_COLUMN - 2.0 * MARGIN);
    let velocity = Scale::Linear { low: 0.0, high: fastest };
    let largest = rows.iter().flat_map(|(_, mu)| *mu).fold(0.0, f64::max);
    let friction = Scale::Linear { low: 0.0, high: HEADROOM * largest };
    let ticks = friction.ticks(6);
    let left = MARGIN + LABEL_SIZE + 6.0 + y_tick_room(&ticks);
    let strokes = [FIRST, SECOND, THIRD];
    let words = ["(a) ", "(b) ", "(c) "].into_iter().zip(Case::ALL);
    let entries: Vec<(Text, &str)> =
        words.map(|(letter, case)| Text::from(letter).plain(case.words())).zip(strokes).collect();
    key::lines(&mut svg, left, y + TICK_SIZE, TICK_SIZE, &entries);
    y += TICK_SIZE + 6.0;
    let frame = Frame { x: left, y, width: SINGLE_COLUMN - left - RIGHT, height: HEIGHT };
    let plot = Plot { frame, x: &velocity, y: &friction };
    for (k, stroke) in strokes.into_iter().enumerate() {
        plot.curve(&mut svg, rows.iter().map(|(v, mu)| (*v, mu[k])), stroke);
    }
    frame.border(&mut svg);
    frame.x_ticks(&mut svg, &velocity.ticks(7), true);
    frame.y_ticks(&mut svg, &ticks, true);
    let label = Text::from("Friction coefficient ").symbol("μ");
    let upwards = Style::new(LABEL_SIZE, Anchor::Middle).upwards();
    svg.text(MARGIN + LABEL_SIZE, frame.y + 0.5 * HEIGHT, &label, upwards);
    let base = frame.bottom() + x_tick_room() + LABEL_SIZE + 1.0;
    let label = Text::from("Relative velocity ").symbol("v").plain(" (m/s)");
    svg.text(frame.across(0.5), base, &label, Style::new(LABEL_SIZE, Anchor::Middle));
    Ok(Drawn {
        svg: svg.finish(SINGLE_COLUMN, base + 2.0 + MARGIN, HEADING, &program()),
        csv: table.finish()?,
    })
}
