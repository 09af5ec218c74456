//! Figure 7: both accelerations during exponential growth, whole and a few periods close up.

use super::Drawn;
use crate::error::Result;
use crate::export::columns::Cell;
use crate::export::csv::Table;
use crate::export::figure::{DOUBLE_COLUMN, MARGIN, program, title};
use crate::export::frame::{Frame, LABEL_SIZE, x_tick_room, y_tick_room};
use crate::export::key;
use crate::export::panels::setting;
use crate::export::plot::{FIRST, Plot, SECOND};
use crate::export::scale::{Scale, axis_unit};
use crate::export::svg::{Anchor, Style, Svg};
use crate::export::text::Text;
use crate::grid::{AxisKey, Value};
use crate::model::Param;
use crate::paper::{Growth, PhaseCase};

/// Heights of the whole growth and of the close-up, points.
const HEIGHTS: [f64; 2] = [105.0, 105.0];
/// Between the two, points: ticks of time and words.
const GAP: f64 = 34.0;
/// Between the columns, points: their own tick labels.
const COLUMN_GAP: f64 = 34.0;
/// Right of the panels, points.
const RIGHT: f64 = 8.0;
/// Margin above and below curves, as a fraction of the panel.
const HEADROOM: f64 = 0.07;
/// Periods of the close-up, the last before the first event.
const PERIODS: f64 = 3.0;
/// Heading of picture and document.
const HEADING: &str = "Accelerations during exponential growth, up to the first event";

/// Both cases side by side, double column width.
pub(super) fn draw() -> Result<Drawn> {
    let growths: Vec<Growth> = PhaseCase::ALL.into_iter().map(Growth::compute).collect::<Result<_>>()?;
    let mut table = Table::new(["figure", "t", "ax2", "ay1"].into_iter())?;
    for (growth, name) in growths.iter().zip(["7a", "7b"]) {
        for sample in &growth.samples {
            let numbers = sample.map(|x| Cell::from(x).to_string());
            table.row(std::iter::once(name.to_owned()).chain(numbers))?;
        }
    }
    Ok(Drawn { svg: picture(&growths), csv: table.finish()? })
}

fn picture(growths: &[Growth]) -> String {
    let mut svg = Svg::new();
    let mut y = MARGIN + title(&mut svg, HEADING, DOUBLE_COLUMN - 2.0 * MARGIN);
    let scales = |growth: &Growth| {
        let all = growth.samples.iter().flat_map(|[_, x, y]| [*x, *y]);
        let close = Scale::Linear { low: -1.0, high: 1.0 };
        [Scale::spanning(all).widened(HEADROOM), close.widened(HEADROOM)]
    };
    let room =
        |growth: &Growth| scales(growth).iter().map(|scale| y_tick_room(&scale.ticks(5))).fold(0.0, f64::max);
    let room = growths.iter().map(room).fold(0.0, f64::max);
    let left = MARGIN + LABEL_SIZE + 6.0 + room;
    let count = growths.len() as f64;
    let width = (DOUBLE_COLUMN - left - RIGHT - (count - 1.0) * COLUMN_GAP) / count;
    let words = ["ẍ_2", "ÿ_1"].map(|symbol| Text::default().symbol(symbol));
    let entries: Vec<(Text, &str)> = words.into_iter().zip([FIRST, SECOND]).collect();
    key::lines(&mut svg, left, y + LABEL_SIZE, LABEL_SIZE, &entries);
    y += 2.0 * LABEL_SIZE + 12.0;
    let tops = [y, y + HEIGHTS[0] + GAP];
    for (number, growth) in growths.iter().enumerate() {
        let x = left + number as f64 * (width + COLUMN_GAP);
        let letter = Text::from(["(a) ", "(b) "][number % 2]);
        svg.text(x, y - 4.0, &letter.then(caption(growth)), Style::new(LABEL_SIZE, Anchor::Start));
        let scales = scales(growth);
        let close = close_up(growth);
        let largest = [1, 2].map(|k| close.iter().map(|sample| sample[k].abs()).fold(0.0, f64::max));
        svg.text(x, tops[1] - 4.0, &phases(growth), Style::new(LABEL_SIZE, Anchor::Start));
        for (row, samples) in [&growth.samples, close].into_iter().enumerate() {
            let frame = Frame { x, y: tops[row], width, height: HEIGHTS[row] };
            let time = Scale::spanning(samples.iter().map(|sample| sample[0]));
            let plot = Plot { frame, x: &time, y: &scales[row] };
            for (k, stroke) in [FIRST, SECOND].into_iter().enumerate() {
                let unit = if row == 0 { 1.0 } else { largest[k] };
                plot.curve(&mut svg, samples.iter().map(|sample| (sample[0], sample[k + 1] / unit)), stroke);
            }
            frame.border(&mut svg);
            frame.x_ticks(&mut svg, &time.ticks(5), true);
            frame.y_ticks(&mut svg, &scales[row].ticks(5), true);
        }
        let base = tops[1] + HEIGHTS[1] + x_tick_room() + LABEL_SIZE + 1.0;
        let label = Text::from("Time ").symbol("t").plain(" (s)");
        svg.text(x + 0.5 * width, base, &label, Style::new(LABEL_SIZE, Anchor::Middle));
    }
    let exponent = growths.first().map_or(0, |growth| scales(growth)[0].exponent());
    let labels =
        [Text::from("Acceleration").then(axis_unit("m/s^2", exponent)), Text::from("Each over its largest")];
    for (row, label) in labels.iter().enumerate() {
        let style = Style::new(LABEL_SIZE, Anchor::Middle).upwards();
        svg.text(MARGIN + LABEL_SIZE, tops[row] + 0.5 * HEIGHTS[row], label, style);
    }
    let bottom = tops[1] + HEIGHTS[1] + x_tick_room() + LABEL_SIZE + 3.0;
    svg.finish(DOUBLE_COLUMN, bottom + MARGIN, HEADING, &program())
}

/// The last periods.
fn close_up(growth: &Growth) -> &[[f64; 3]] {
    let samples = growth.samples.as_slice();
    let end = samples.last().map_or(0.0, |sample| sample[0]);
    let start = end - PERIODS / growth.linear.frequency;
    &samples[samples.partition_point(|sample| sample[0] < start)..]
}

/// `negative slope, μ_s = 0.07, μ_d = 0.02`.
fn caption(growth: &Growth) -> Text {
    let [mu_s, mu_d] = growth.friction();
    let value = |param, number| setting(AxisKey::Param(param), &Value::Number(number));
    let words = Text::from(growth.case.words()).plain(", ").then(value(Param::MuS, mu_s));
    words.plain(", ").then(value(Param::MuD, mu_d))
}

/// `ÿ_1 against ẍ_2: −13.1° (eigenvector), −13.1° (measured)`.
fn phases(growth: &Growth) -> Text {
    let degrees = |phase: f64| format!("{phase:.1}°").replace('-', "−");
    let [eigenvector, measured] = [growth.phase.eigenvector, growth.phase.measured].map(degrees);
    let pair = Text::default().symbol("ÿ_1").plain(" against ").symbol("ẍ_2");
    pair.plain(&format!(": {eigenvector} (eigenvector), {measured} (measured)"))
}
