//! Figures 4 to 6: both accelerations and the state of the contact while the belt slows down to rest.

use serde_json::{Value as Json, json};

use crate::model::Param;
use crate::results::csv::Table;
use crate::results::figure::look::Look;
use crate::study::error::Result;
use crate::study::paper::{Case, Stretch, Study, millimetres};
use crate::sweep::columns::Cell;
use squealmap_figure::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_count, y_tick_room};
use squealmap_figure::page::{DOUBLE_COLUMN, MARGIN, title};
use squealmap_figure::plot::{CRITICAL, Plot};
use squealmap_figure::scale::{Scale, Tick, axis_unit, value_label};
use squealmap_figure::svg::{Anchor, Style, Svg, polyline};
use squealmap_figure::text::Text;
use squealmap_figure::{key, letters};

/// Heights of the panels, points.
const HEIGHTS: [f64; 3] = [96.0, 96.0, 46.0];
/// Between panels, points; names of curves stand there.
const GAP: f64 = TICK_SIZE + 7.0;
/// Right of the panels, points.
const RIGHT: f64 = 8.0;
/// Margin above and below curves, as a fraction of the panel.
const HEADROOM: f64 = 0.06;
/// Ticks of the axes of time and belt velocity take about this much each, points ...
const TICK_WIDTH: f64 = 58.0;
/// ... and there are about so many at least.
const FEWEST_TICKS: f64 = 5.0;
/// The key of the shares takes about this much, points.
const KEY_WIDTH: f64 = 130.0;
/// An acceleration: the area between its lowest and highest value per column.
const ACCELERATION: &str = r##"fill="#9DB4DC" stroke="#1F3F8F" stroke-width="0.5" stroke-linejoin="round""##;
/// Strokes of the shares of stick and free flight.
const STATES: [&str; 2] = [
    r##"fill="none" stroke="#1E8A6C" stroke-width="0.8" stroke-linejoin="round""##,
    r##"fill="none" stroke="#A03785" stroke-width="0.8" stroke-dasharray="3.2 1.4" stroke-linejoin="round""##,
];

/// The columns of the table.
pub(crate) const COLUMNS: [&str; 8] =
    ["t", "belt_velocity", "ax2_low", "ax2_high", "ay1_low", "ay1_high", "stick", "free"];

/// A ramp as its picture shows it.
#[derive(Clone, Debug)]
pub struct Slowdown {
    /// The heading above it.
    pub heading: String,
    /// The belt velocity from which on friction is constant, m/s; `None` where it is constant everywhere.
    pub knee: Option<f64>,
    /// Its duration, s.
    pub duration: f64,
    /// The belt velocity at its begin and end, m/s.
    pub velocity: [f64; 2],
    /// The ramp in stretches of a period each.
    pub columns: Vec<Stretch>,
    /// The ramp in wider stretches, whose shares are shown.
    pub parts: Vec<Stretch>,
}

impl Slowdown {
    /// The ramp of a case.
    pub(super) fn compute(study: &Study, case: Case) -> Result<Slowdown> {
        let ramp = study.ramp(case)?;
        let spec = study.sweep(case);
        let kick = millimetres(ramp.kick);
        let heading = format!("{} in {} s, displaced by {kick} mm at the start", spec.title, ramp.duration);
        let instance = study.instance(case);
        let value = |param| instance.params.require(param);
        Ok(Slowdown {
            heading,
            knee: (instance.law.slope(0.0) != 0.0).then(|| value(Param::KneeVelocity)),
            duration: ramp.duration,
            velocity: [Param::BeltVelocity, Param::BeltVelocityEnd].map(value),
            columns: ramp.columns.clone(),
            parts: ramp.parts.clone(),
        })
    }

    /// The document beside the table.
    pub(super) fn to_json(&self) -> Json {
        let shares: Vec<[f64; 2]> = self.parts.iter().map(|part| [part.stick, part.free]).collect();
        json!({
            "title": self.heading,
            "knee_velocity": self.knee,
            "ramp_duration": self.duration,
            "belt_velocity": self.velocity,
            "stick_and_free": shares,
        })
    }
}

pub(super) fn table(ramp: &Slowdown) -> Result<Vec<u8>> {
    let mut table = Table::new(COLUMNS.into_iter())?;
    for column in &ramp.columns {
        let ([t, belt], [ax, ay]) = (centre(column), [column.tangential, column.normal]);
        let numbers = [t, belt, ax[0], ax[1], ay[0], ay[1], column.stick, column.free];
        table.row(numbers.into_iter().map(|x| Cell::from(x).to_string()))?;
    }
    Ok(table.finish()?)
}

/// Time and belt velocity in the middle of a stretch.
fn centre(stretch: &Stretch) -> [f64; 2] {
    [stretch.time, stretch.velocity].map(|[from, to]| 0.5 * (from + to))
}

/// Accelerations as lowest and highest value per column, double column width unless the look says otherwise.
pub(super) fn picture(ramp: &Slowdown, look: &Look<'_>) -> String {
    let draw = |part: f64| draw(ramp, look, HEIGHTS.map(|height| part * height));
    look.fitted(&ramp.heading, HEIGHTS.iter().sum(), draw)
}

/// The picture and its size, with panels of these heights.
fn draw(ramp: &Slowdown, look: &Look<'_>, heights: [f64; 3]) -> (Svg, [f64; 2]) {
    let page = look.points().unwrap_or(DOUBLE_COLUMN);
    let mut svg = Svg::new();
    let mut y = MARGIN + title(&mut svg, look.title(&ramp.heading), page - 2.0 * MARGIN);
    let time = Scale::Linear { low: 0.0, high: ramp.duration };
    let [fastest, slowest] = ramp.velocity;
    let belt = Scale::Linear { low: fastest, high: slowest };
    let spread = |value: fn(&Stretch) -> [f64; 2]| {
        Scale::spanning(ramp.columns.iter().flat_map(value)).widened(HEADROOM)
    };
    let shares = ramp.parts.iter().flat_map(|part| [part.stick, part.free]);
    let most = shares.fold(0.1, f64::max);
    let scales = [
        spread(|column| column.tangential),
        spread(|column| column.normal),
        Scale::Linear { low: 0.0, high: (1.0 + HEADROOM) * most },
    ];
    let ticks: [Vec<Tick>; 3] = std::array::from_fn(|k| scales[k].ticks(y_tick_count(heights[k])));
    let room = ticks.iter().map(|ticks| y_tick_room(ticks)).fold(0.0, f64::max);
    let left = MARGIN + LABEL_SIZE + 6.0 + room;
    let width = page - left - RIGHT;
    y += LABEL_SIZE + 2.0;
    let label = Text::from("Belt velocity ").symbol("V").plain(" (m/s)");
    svg.text(left + 0.5 * width, y, &label, Style::new(LABEL_SIZE, Anchor::Middle));
    y += x_tick_room() + 2.0;
    let top = y;
    // Ticks are made on a rising scale; this one falls from left to right.
    let rising = Scale::Linear { low: slowest, high: fastest };
    let mirrored = |tick: Tick| Tick { at: 1.0 - tick.at, ..tick };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive count")]
    let most = (width / TICK_WIDTH).round().max(FEWEST_TICKS) as usize;
    let velocities: Vec<Tick> = rising.ticks(most).into_iter().map(mirrored).collect();
    let labels = [
        Text::default().symbol("ẍ_2").then(axis_unit("m/s^2", scales[0].exponent())),
        Text::default().symbol("ÿ_1").then(axis_unit("m/s^2", scales[1].exponent())),
        Text::from("Share"),
    ];
    // The line of the knee does not cross the key.
    let knee = ramp.knee.map(|knee| left + belt.position(knee) * width);
    let beside = knee.filter(|at| *at < left + KEY_WIDTH).map_or(left, |at| at + 6.0);
    for (number, height) in heights.into_iter().enumerate() {
        let frame = Frame { x: left, y, width, height };
        let plot = Plot { frame, x: &time, y: &scales[number] };
        let between = |value: fn(&Stretch) -> [f64; 2]| {
            let at = move |column: &Stretch, end: usize| (centre(column)[0], value(column)[end]);
            let above = ramp.columns.iter().map(move |column| at(column, 1));
            above.chain(ramp.columns.iter().rev().map(move |column| at(column, 0)))
        };
        // Within a period the states alternate: a share needs several.
        let along =
            |value: fn(&Stretch) -> f64| ramp.parts.iter().map(move |part| (centre(part)[0], value(part)));
        match number {
            0 => plot.area(&mut svg, between(|column| column.tangential), ACCELERATION),
            1 => plot.area(&mut svg, between(|column| column.normal), ACCELERATION),
            _ => {
                plot.curve(&mut svg, along(|column| column.stick), STATES[0]);
                plot.curve(&mut svg, along(|column| column.free), STATES[1]);
                let words = ["stick", "free flight"].map(Text::from).into_iter().zip(STATES);
                key::lines(&mut svg, beside, y - 4.0, TICK_SIZE, &words.collect::<Vec<_>>());
            }
        }
        frame.border(&mut svg);
        frame.y_ticks(&mut svg, &ticks[number], true);
        frame.x_ticks(&mut svg, &time.ticks(most), number + 1 == heights.len());
        if number == 0 {
            frame.x_ticks_above(&mut svg, &velocities);
        }
        letters::side(&mut svg, (number, heights.len()), &frame, &labels[number..=number]);
        y += frame.height + GAP;
    }
    let bottom = y - GAP;
    if let (Some(at), Some(knee)) = (knee, ramp.knee) {
        svg.path(&polyline([(at, top), (at, bottom)]), CRITICAL);
        let words =
            Text::default().symbol("V").plain(" = ").symbol("v_k").plain(" = ").then(value_label(knee));
        svg.text(
            at + 3.0,
            top + heights[0] + GAP - 4.0,
            &words.plain(" m/s"),
            Style::new(TICK_SIZE, Anchor::Start),
        );
    }
    let base = bottom + x_tick_room() + LABEL_SIZE + 1.0;
    let label = Text::from("Time ").symbol("t").plain(" (s)");
    svg.text(left + 0.5 * width, base, &label, Style::new(LABEL_SIZE, Anchor::Middle));
    (svg, [page, base + 3.0 + MARGIN])
}
