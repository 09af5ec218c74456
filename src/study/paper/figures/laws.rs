//! Figure 3: the friction laws of the three ramps.

use crate::model::Param;
use crate::results::csv::Table;
use crate::results::figure::look::Look;
use crate::study::error::Result;
use crate::study::paper::{Case, Study};
use crate::sweep::columns::Cell;
use squealmap_figure::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_count, y_tick_room};
use squealmap_figure::key;
use squealmap_figure::key::Sample;
use squealmap_figure::page::{MARGIN, SINGLE_COLUMN, title};
use squealmap_figure::plot::{FIRST, Plot, SECOND, THIRD};
use squealmap_figure::scale::Scale;
use squealmap_figure::svg::{Anchor, Style, Svg};
use squealmap_figure::text::Text;

/// Points of a curve: every 0.05 m/s up to the belt velocity of the ramps.
const POINTS: usize = 141;
/// Height of the panel, points.
const HEIGHT: f64 = 130.0;
/// Right of the panel, points.
const RIGHT: f64 = 8.0;
/// Room above the highest curve, as a factor.
const HEADROOM: f64 = 1.15;
/// The columns of the table.
pub(crate) const COLUMNS: [&str; 4] = ["relative_velocity", "mu_figure4", "mu_figure5", "mu_figure6"];
/// Heading of picture and document.
pub(super) const HEADING: &str = "Friction laws of the three ramps";

/// The laws as a table.
#[derive(Clone, Debug)]
pub struct Laws {
    /// Relative velocity, m/s, and the friction coefficient of each case there.
    pub rows: Vec<[f64; 4]>,
}

impl Laws {
    /// The laws up to the belt velocity of the ramps.
    pub(super) fn compute(study: &Study) -> Laws {
        let instances = Case::ALL.map(|case| study.instance(case));
        let fastest = instances.iter().map(|one| one.params.require(Param::BeltVelocity)).fold(0.0, f64::max);
        let row = |v: f64| {
            let [a, b, c] = instances.each_ref().map(|one| one.law.mu(v));
            [v, a, b, c]
        };
        Laws { rows: (0..POINTS).map(|k| row(fastest * k as f64 / (POINTS - 1) as f64)).collect() }
    }

    pub(super) fn table(&self) -> Result<Vec<u8>> {
        let mut table = Table::new(COLUMNS.into_iter())?;
        for row in &self.rows {
            table.row(row.iter().map(|x| Cell::from(*x).to_string()))?;
        }
        Ok(table.finish()?)
    }

    /// Friction against the relative velocity, single column width unless the look says otherwise.
    pub(super) fn picture(&self, look: &Look<'_>) -> String {
        look.fitted(HEADING, HEIGHT, |part| self.draw(look, part * HEIGHT))
    }

    /// The picture and its size, with a panel of this height.
    fn draw(&self, look: &Look<'_>, height: f64) -> (Svg, [f64; 2]) {
        let page = look.points().unwrap_or(SINGLE_COLUMN);
        let mut svg = Svg::new();
        let mut y = MARGIN + title(&mut svg, look.title(HEADING), page - 2.0 * MARGIN);
        let fastest = self.rows.iter().map(|row| row[0]).fold(0.0, f64::max);
        let velocity = Scale::Linear { low: 0.0, high: fastest };
        let largest = self.rows.iter().flat_map(|row| row[1..].iter().copied()).fold(0.0, f64::max);
        let friction = Scale::Linear { low: 0.0, high: HEADROOM * largest };
        let ticks = friction.ticks(y_tick_count(height));
        let left = MARGIN + LABEL_SIZE + 6.0 + y_tick_room(&ticks);
        let width = page - left - RIGHT;
        let strokes = [FIRST, SECOND, THIRD];
        let words = ["(a) ", "(b) ", "(c) "].into_iter().zip(Case::ALL);
        let words = words.map(|(letter, case)| Text::from(letter).plain(case.words()));
        let entries: Vec<(Text, Sample<'_>)> = words.zip(strokes.map(Sample::Line)).collect();
        y += key::rows(&mut svg, [left, y], width, TICK_SIZE, &entries) + 3.0;
        let frame = Frame { x: left, y, width, height };
        let plot = Plot { frame, x: &velocity, y: &friction };
        for (k, stroke) in strokes.into_iter().enumerate() {
            plot.curve(&mut svg, self.rows.iter().map(|row| (row[0], row[k + 1])), stroke);
        }
        frame.border(&mut svg);
        frame.x_ticks(&mut svg, &velocity.ticks(7), true);
        frame.y_ticks(&mut svg, &ticks, true);
        let label = Text::from("Friction coefficient ").symbol("μ");
        let upwards = Style::new(LABEL_SIZE, Anchor::Middle).upwards();
        svg.text(MARGIN + LABEL_SIZE, frame.y + 0.5 * height, &label, upwards);
        let base = frame.bottom() + x_tick_room() + LABEL_SIZE + 1.0;
        let label = Text::from("Relative velocity ").symbol("v").plain(" (m/s)");
        svg.text(frame.across(0.5), base, &label, Style::new(LABEL_SIZE, Anchor::Middle));
        (svg, [page, base + 2.0 + MARGIN])
    }
}
