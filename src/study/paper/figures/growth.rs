//! Figure 7: both accelerations while a vibration grows on the ramp, whole and a few periods close up.

use serde_json::{Value as Json, json};

use crate::model::Param;
use crate::results::csv::Table;
use crate::results::figure::look::Look;
use crate::results::figure::panels::setting;
use crate::study::error::Result;
use crate::study::paper::{Growth, LIMITS, PhaseCase, Study, Window, degrees, extremes};
use crate::sweep::columns::Cell;
use crate::sweep::grid::{AxisKey, Value};
use squealmap_figure::frame::{Frame, LABEL_SIZE, x_tick_room, y_tick_count, y_tick_room};
use squealmap_figure::key;
use squealmap_figure::page::{DOUBLE_COLUMN, MARGIN, title};
use squealmap_figure::plot::{FIRST, Plot, SECOND};
use squealmap_figure::scale::{Scale, axis_unit};
use squealmap_figure::svg::{Anchor, Style, Svg};
use squealmap_figure::text::Text;

/// Height of the whole growth, and of the close-up, points.
const HEIGHT: f64 = 105.0;
/// Between the two, points: ticks of time and words.
const GAP: f64 = 34.0;
/// Between the columns, points: their own tick labels.
const COLUMN_GAP: f64 = 34.0;
/// Right of the panels, points.
const RIGHT: f64 = 8.0;
/// Margin above and below curves, as a fraction of the panel.
const HEADROOM: f64 = 0.07;
/// Periods of the close-up, the last of the growth.
const PERIODS: usize = 3;
/// From the lower end of one case to the one below, points.
const BETWEEN: f64 = 52.0;
/// On narrower pages the cases do not fit side by side, points.
const NARROW: f64 = 420.0;
/// Heading of picture and document.
pub(super) const HEADING: &str = "Accelerations while the vibration grows, the belt slowing down";

/// The names of the cases in the table.
const NAMES: [&str; 2] = ["7a", "7b"];
/// The columns of the table.
pub(crate) const COLUMNS: [&str; 5] = ["figure", "t", "belt_velocity", "ax2", "ay1"];

/// A growing oscillation as the picture shows it.
#[derive(Clone, Debug)]
pub struct Growing {
    /// The mechanism in words.
    pub words: String,
    /// `μ_s` and `μ_d`.
    pub friction: [f64; 2],
    /// Lowest and highest phase of `ÿ1` against `ẍ2`, measured and of the eigenvectors, degrees; `None` where the vibration
    /// does not grow.
    pub phases: Option<[[f64; 2]; 2]>,
    /// Time (s), belt velocity (m/s), `ẍ2` and `ÿ1` (m/s²).
    pub samples: Vec<[f64; 4]>,
}

impl From<&Growth> for Growing {
    fn from(growth: &Growth) -> Growing {
        let range = |phase: fn(&Window) -> Option<f64>| extremes(growth.windows.iter().filter_map(phase));
        let measured = range(|window| Some(window.measured));
        Growing {
            words: growth.case.words().to_owned(),
            friction: growth.friction(),
            phases: measured.zip(range(|window| window.eigenvector)).map(|(measured, mode)| [measured, mode]),
            samples: growth.samples.clone(),
        }
    }
}

/// Both cases.
pub(super) fn compute(study: &Study) -> Result<Vec<Growing>> {
    PhaseCase::ALL.into_iter().map(|case| study.growth(case).map(Growing::from)).collect()
}

/// The names of cases and what the table does not hold of each.
pub(super) fn to_json(growths: &[Growing]) -> Json {
    let case = |(growth, name): (&Growing, &str)| {
        json!({
            "figure": name,
            "mechanism": growth.words,
            "mu_s": growth.friction[0],
            "mu_d": growth.friction[1],
            "phase_measured": growth.phases.map(|phases| phases[0]),
            "phase_eigenvector": growth.phases.map(|phases| phases[1]),
        })
    };
    json!({ "title": HEADING, "cases": growths.iter().zip(NAMES).map(case).collect::<Vec<_>>() })
}

pub(super) fn table(growths: &[Growing]) -> Result<Vec<u8>> {
    let mut table = Table::new(COLUMNS.into_iter())?;
    for (growth, name) in growths.iter().zip(NAMES) {
        for sample in &growth.samples {
            let numbers = sample.map(|x| Cell::from(x).to_string());
            table.row(std::iter::once(name.to_owned()).chain(numbers))?;
        }
    }
    Ok(table.finish()?)
}

/// Both cases side by side, double column width unless the look says otherwise; one below the other on a narrow page.
pub(super) fn picture(growths: &[Growing], look: &Look<'_>) -> String {
    let rows = growths.len().div_ceil(columns(growths, look.points().unwrap_or(DOUBLE_COLUMN))) as f64;
    look.fitted(HEADING, rows * 2.0 * HEIGHT, |part| draw(growths, look, part * HEIGHT))
}

/// How many cases stand side by side on a page.
fn columns(growths: &[Growing], page: f64) -> usize {
    if page < NARROW { 1 } else { growths.len().max(1) }
}

/// The picture and its size, with panels of this height.
fn draw(growths: &[Growing], look: &Look<'_>, height: f64) -> (Svg, [f64; 2]) {
    let page = look.points().unwrap_or(DOUBLE_COLUMN);
    let mut svg = Svg::new();
    let mut y = MARGIN + title(&mut svg, look.title(HEADING), page - 2.0 * MARGIN);
    let room = |growth: &Growing| {
        scales(growth).iter().map(|scale| y_tick_room(&scale.ticks(y_tick_count(height)))).fold(0.0, f64::max)
    };
    let room = growths.iter().map(room).fold(0.0, f64::max);
    let left = MARGIN + LABEL_SIZE + 6.0 + room;
    let columns = columns(growths, page);
    let width = (page - left - RIGHT - (columns - 1) as f64 * COLUMN_GAP) / columns as f64;
    let words = ["ẍ_2", "ÿ_1"].map(|symbol| Text::default().symbol(symbol));
    let entries: Vec<(Text, &str)> = words.into_iter().zip([FIRST, SECOND]).collect();
    key::lines(&mut svg, left, y + LABEL_SIZE, LABEL_SIZE, &entries);
    y += 2.0 * LABEL_SIZE + 12.0;
    let exponent = growths.first().map_or(0, |growth| scales(growth)[0].exponent());
    let mut bottom = y;
    for (number, growth) in growths.iter().enumerate() {
        let (column, row) = (number % columns, number / columns);
        let x = left + column as f64 * (width + COLUMN_GAP);
        let top = y + row as f64 * (2.0 * height + GAP + BETWEEN);
        let words = caption(["(a) ", "(b) "][number % 2], growth, width + RIGHT);
        svg.text(x, top - 4.0, &words, Style::new(LABEL_SIZE, Anchor::Start));
        panels(&mut svg, growth, [x, top], [width, height]);
        if column == 0 {
            labels(&mut svg, top, height, exponent);
        }
        bottom = top + 2.0 * height + GAP + x_tick_room() + LABEL_SIZE + 3.0;
    }
    (svg, [page, bottom + MARGIN])
}

/// Scales of the whole growth and of the close-up.
fn scales(growth: &Growing) -> [Scale; 2] {
    let all = growth.samples.iter().flat_map(|[.., x, y]| [*x, *y]);
    let close = Scale::Linear { low: -1.0, high: 1.0 };
    [Scale::spanning(all).widened(HEADROOM), close.widened(HEADROOM)]
}

/// The whole growth, and its close-up below.
fn panels(svg: &mut Svg, growth: &Growing, [x, top]: [f64; 2], [width, height]: [f64; 2]) {
    let scales = scales(growth);
    let close = close_up(growth);
    let largest = [2, 3].map(|k| close.iter().map(|sample| sample[k].abs()).fold(0.0, f64::max));
    let tops = [top, top + height + GAP];
    svg.text(x, tops[1] - 4.0, &phases(growth, width + RIGHT), Style::new(LABEL_SIZE, Anchor::Start));
    for (row, samples) in [growth.samples.as_slice(), close].into_iter().enumerate() {
        let frame = Frame { x, y: tops[row], width, height };
        let time = Scale::spanning(samples.iter().map(|sample| sample[0]));
        let plot = Plot { frame, x: &time, y: &scales[row] };
        for (k, stroke) in [FIRST, SECOND].into_iter().enumerate() {
            let unit = if row == 0 { 1.0 } else { largest[k] };
            plot.curve(svg, samples.iter().map(|sample| (sample[0], sample[k + 2] / unit)), stroke);
        }
        frame.border(svg);
        frame.x_ticks(svg, &time.ticks(5), true);
        frame.y_ticks(svg, &scales[row].ticks(y_tick_count(height)), true);
    }
    let base = tops[1] + height + x_tick_room() + LABEL_SIZE + 1.0;
    let label = Text::from("Time ").symbol("t").plain(" (s)");
    svg.text(x + 0.5 * width, base, &label, Style::new(LABEL_SIZE, Anchor::Middle));
}

/// The labels of both panels of the first column.
fn labels(svg: &mut Svg, top: f64, height: f64, exponent: i32) {
    let labels =
        [Text::from("Acceleration").then(axis_unit("m/s^2", exponent)), Text::from("Each over its largest")];
    let middles = [top + 0.5 * height, top + height + GAP + 0.5 * height];
    for (label, middle) in labels.iter().zip(middles) {
        let style = Style::new(LABEL_SIZE, Anchor::Middle).upwards();
        svg.text(MARGIN + LABEL_SIZE, middle, label, style);
    }
}

/// The last periods.
fn close_up(growth: &Growing) -> &[[f64; 4]] {
    let samples = growth.samples.as_slice();
    let crossings = (1..samples.len()).rev().filter(|k| samples[k - 1][2] <= 0.0 && samples[*k][2] > 0.0);
    // From a rise of the tangential acceleration on: one more would be a part of a period too many.
    &samples[crossings.take(PERIODS).last().unwrap_or(0)..]
}

/// `(a) negative slope, μ_s = 0.07, μ_d = 0.02, V = 4.27 to 3.34 m/s`; shorter where there is less room, points.
fn caption(letter: &str, growth: &Growing, room: f64) -> Text {
    let [mu_s, mu_d] = growth.friction;
    let value = |param, number| setting(AxisKey::Param(param), &Value::Number(number));
    let words = Text::from(letter).plain(&growth.words).plain(", ").then(value(Param::MuS, mu_s));
    let words = words.plain(", ").then(value(Param::MuD, mu_d));
    let [Some(first), Some(last)] = [growth.samples.first(), growth.samples.last()] else { return words };
    let velocity = format!(" = {:.2} to {:.2} m/s", first[1], last[1]);
    let long = words.clone().plain(", ").symbol("V").plain(&velocity);
    if long.width(LABEL_SIZE, false) <= room { long } else { words }
}

/// `ÿ_1 against ẍ_2: −16.3 to −11.1°, modes: −13.0 to −12.8°`; shorter where there is less room, points.
fn phases(growth: &Growing, room: f64) -> Text {
    let Some([measured, eigenvector]) = growth.phases else {
        return Text::from(format!("Not grown: below {} times what disturbs it", LIMITS.growth));
    };
    let short =
        Text::default().symbol("ÿ_1").plain(" against ").symbol("ẍ_2").plain(": ").plain(&degrees(measured));
    let long = short.clone().plain(", modes: ").plain(&degrees(eigenvector));
    if long.width(LABEL_SIZE, false) <= room { long } else { short }
}
