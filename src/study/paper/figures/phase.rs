//! The phase method on trial: maps of the phase and of its verdict, and how thresholds do.

use crate::model::Param;
use crate::model::kind::InstabilityType;
use crate::results::csv::Table;
use crate::results::figure::fills::define_patterns;
use crate::results::figure::look::Look;
use crate::results::figure::panels::setting;
use crate::study::error::Result;
use crate::study::paper::figures::distinct::distinct;
use crate::study::paper::{CUSTOMARY, PhaseTrial, Source, Witness};
use crate::sweep::columns::Cell;
use crate::sweep::grid::{AxisKey, Value};
use squealmap_figure::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_count, y_tick_room};
use squealmap_figure::key::Sample;
use squealmap_figure::page::{DOUBLE_COLUMN, MARGIN, title};
use squealmap_figure::plot::{CRITICAL, FIRST, Plot, SECOND, THIRD};
use squealmap_figure::scale::Scale;
use squealmap_figure::svg::{Anchor, Style, Svg};
use squealmap_figure::text::{Text, wrap};
use squealmap_figure::{key, raster};

/// Between panels, points.
const GAP: f64 = 8.0;
/// Right of the panels, points.
const RIGHT: f64 = 6.0;
/// Room for the heading of a row of panels, points.
const HEADING_ROOM: f64 = 13.0;
/// Height of the panel of thresholds, points.
const CURVES: f64 = 120.0;
/// Steps of the fill over 90°.
const STEPS: u32 = 45;
/// Height of the bar of the phase, points.
const BAR_HEIGHT: f64 = 7.0;
/// Width of the bar with its words, points.
const BAR: f64 = 136.0;
/// About the room that the labels of the vertical axis take, points.
const MAPS_LEFT: f64 = 32.0;
/// Least width of a map, points.
const LEAST: f64 = 55.0;
/// The fill of an instance.
type Fill<'a> = &'a dyn Fn(&Witness) -> String;

/// Heading of the panel of thresholds.
const CURVES_HEADING: &str =
    "(d) Mean share of right verdicts where one mechanism acts alone, against the threshold";
/// Heading of picture and document.
pub(super) const HEADING: &str =
    "The phase method on trial: does the phase of normal against tangential acceleration tell the mechanism?";

/// The results that a verdict at the customary threshold can have, with their fills from light to dark.
const VERDICTS: [(&str, &str); 5] = [
    ("#FFFFFF", "stable"),
    ("#DCDCDC", "both mechanisms, or neither alone"),
    ("#A6D0E8", "right"),
    ("#E08A2E", "negative slope taken for mode coupling"),
    ("#5B2A6E", "mode coupling taken for negative slope"),
];

/// The columns of the table.
pub(crate) const COLUMNS: [&str; 7] =
    ["belt_velocity", "mu_s", "mu_d", "type", "phase", "phase_measured", "phase_cycle"];

pub(super) fn table(trial: &PhaseTrial) -> Result<Vec<u8>> {
    let mut table = Table::new(COLUMNS.into_iter())?;
    for witness in &trial.witnesses {
        let number = |x: f64| Cell::from(x).to_string();
        let numbers = [witness.velocity, witness.friction[0], witness.friction[1]].map(number);
        let kind = witness.kind.map_or("", InstabilityType::name).to_owned();
        let phases = witness.phases.map(|phase| phase.map(number).unwrap_or_default());
        table.row(numbers.into_iter().chain([kind]).chain(phases))?;
    }
    Ok(table.finish()?)
}

/// The fill of a phase.
#[expect(clippy::cast_possible_truncation, reason = "a share of 90°")]
fn shade(phase: f64) -> String {
    raster::fill((phase / 90.0) as f32)
}

/// The fill of a phase in whole steps, hatched where there is none.
fn phase_fill(phase: Option<f64>) -> String {
    let step = 90.0 / f64::from(STEPS);
    phase.map_or_else(|| "url(#not-computed)".to_owned(), |phase| shade((phase / step).floor() * step))
}

/// The class of a witness at the customary threshold.
fn verdict(witness: &Witness) -> usize {
    match (witness.kind, witness.couples(), witness.phases[0]) {
        (Some(InstabilityType::Stable), ..) => 0,
        (_, Some(couples), Some(phase)) => match (couples, phase >= CUSTOMARY) {
            (false, true) => 3,
            (true, false) => 4,
            _ => 2,
        },
        _ => 1,
    }
}

/// Maps and curves, double column width unless the look says otherwise; on a narrow page the maps take several rows.
pub(super) fn picture(trial: &PhaseTrial, look: &Look<'_>) -> String {
    let page = look.points().unwrap_or(DOUBLE_COLUMN);
    // The labels of the axis take about as much on every page.
    let (_, lines, width) = rows(trial, page - MAPS_LEFT - RIGHT);
    look.fitted(HEADING, 3.0 * lines as f64 * width + CURVES, |part| draw(trial, look, part))
}

/// How many maps stand side by side in a width, in how many lines, and their width.
fn rows(trial: &PhaseTrial, room: f64) -> (usize, usize, f64) {
    let velocities = distinct(trial.witnesses.iter().map(|witness| witness.velocity)).len();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive count")]
    let most = ((room + GAP) / (LEAST + GAP)).max(1.0) as usize;
    let columns = velocities.clamp(1, most);
    (columns, velocities.div_ceil(columns), (room - (columns - 1) as f64 * GAP) / columns as f64)
}

/// The picture and its size, with maps and curves of this part of their usual height.
fn draw(trial: &PhaseTrial, look: &Look<'_>, part: f64) -> (Svg, [f64; 2]) {
    let page = look.points().unwrap_or(DOUBLE_COLUMN);
    let mut svg = Svg::new();
    define_patterns(&mut svg);
    let inner = page - 2.0 * MARGIN;
    let mut y = MARGIN + title(&mut svg, look.title(HEADING), inner) + LABEL_SIZE;
    let velocities = distinct(trial.witnesses.iter().map(|witness| witness.velocity));
    let sides = [0, 1].map(|k| distinct(trial.witnesses.iter().map(|witness| witness.friction[k])));
    let scales = sides.each_ref().map(|values| {
        let (low, high) = (values.first().copied().unwrap_or(0.0), values.last().copied().unwrap_or(1.0));
        let half = 0.5 * (high - low) / (values.len().max(2) - 1) as f64;
        Scale::Linear { low: low - half, high: high + half }
    });
    let ticks = scales.each_ref().map(|scale| scale.ticks(4));
    let left = MARGIN + LABEL_SIZE + 6.0 + y_tick_room(&ticks[1]);
    let room = page - left - RIGHT;
    let (columns, lines, width) = rows(trial, room);
    let height = part * width;
    let pair = Text::from("|phase of ").symbol("ÿ_1").plain(" against ").symbol("ẍ_2").plain("|, ");
    let fills: [(Text, Fill); 3] = [
        (Text::from("(a) ").then(pair.clone()).plain("eigenvector"), &|one| phase_fill(one.phases[0])),
        (Text::from("(b) ").then(pair).plain("settled limit cycle"), &|one| phase_fill(one.phases[2])),
        (Text::from("(c) Verdict of the eigenvector's phase at 45°"), &|one| {
            VERDICTS[verdict(one)].0.to_owned()
        }),
    ];
    for (row, (heading, fill)) in fills.iter().enumerate() {
        svg.text(left, y, heading, Style::new(LABEL_SIZE, Anchor::Start));
        if row == 0 {
            // Beside the heading where there is room, else below.
            let at = page - RIGHT - BAR;
            if left + heading.width(LABEL_SIZE, false) + GAP > at {
                y += HEADING_ROOM;
            }
            bar(&mut svg, at, y);
        }
        y += if row == 0 || lines > 1 { HEADING_ROOM } else { 4.0 };
        for (number, velocity) in velocities.iter().enumerate() {
            let (column, line) = (number % columns, number / columns);
            if column == 0 && line > 0 {
                y += height + HEADING_ROOM;
            }
            let frame = Frame { x: left + column as f64 * (width + GAP), y, width, height };
            if row == 0 || lines > 1 {
                let words = setting(AxisKey::Param(Param::BeltVelocity), &Value::Number(*velocity));
                svg.text(frame.across(0.5), y - 3.0, &words, Style::new(TICK_SIZE, Anchor::Middle));
            }
            let shown = trial.witnesses.iter().filter(|one| one.velocity.to_bits() == velocity.to_bits());
            cells(&mut svg, &frame, &sides, shown, fill);
            frame.border(&mut svg);
            frame.x_ticks(&mut svg, &ticks[0], row == 2 && line + 1 == lines);
            frame.y_ticks(&mut svg, &ticks[1], column == 0);
            if column == 0 {
                let upwards = Style::new(LABEL_SIZE, Anchor::Middle).upwards();
                svg.text(MARGIN + LABEL_SIZE, y + 0.5 * height, &Text::default().symbol("μ_d"), upwards);
            }
        }
        y += height + LABEL_SIZE + 9.0;
    }
    y += x_tick_room() - 7.0;
    svg.text(left + 0.5 * room, y, &Text::default().symbol("μ_s"), Style::new(LABEL_SIZE, Anchor::Middle));
    y = legend(&mut svg, [left, y + 6.0], room) + LABEL_SIZE + 10.0;
    for line in wrap(CURVES_HEADING, room, LABEL_SIZE, false) {
        y += LABEL_SIZE + 2.0;
        svg.text(left, y - 6.0, &Text::from(line), Style::new(LABEL_SIZE, Anchor::Start));
    }
    let frame = Frame { x: left, y, width: room, height: part * CURVES };
    let bottom = thresholds(&mut svg, trial, &frame);
    (svg, [page, bottom + MARGIN])
}

/// One rectangle per run of equal fills of a row. Each reaches to the right and lower end of the panel and is
/// covered by those that follow: no seams.
fn cells<'a>(
    svg: &mut Svg,
    frame: &Frame,
    sides: &[Vec<f64>; 2],
    shown: impl Iterator<Item = &'a Witness>,
    fill: Fill,
) {
    let [columns, rows] = sides.each_ref().map(Vec::len);
    let place = |values: &[f64], x: f64| values.partition_point(|value| *value < x);
    let mut fills = vec![String::new(); columns * rows];
    for witness in shown {
        let [i, j] = [0, 1].map(|k| place(&sides[k], witness.friction[k]));
        fills[j * columns + i] = fill(witness);
    }
    let [wide, high] = [frame.width / columns as f64, frame.height / rows as f64];
    svg.open(r#"shape-rendering="crispEdges""#);
    for (j, row) in fills.chunks(columns).enumerate().rev() {
        let mut i = 0;
        for run in row.chunk_by(|a, b| a == b) {
            let top = frame.bottom() - (j + 1) as f64 * high;
            let x = frame.x + i as f64 * wide;
            let corner = [x, top, frame.x + frame.width - x, frame.bottom() - top];
            if run[0].starts_with("url") {
                svg.rect(corner, r##"fill="#FFFFFF""##);
            }
            svg.rect(corner, &format!(r#"fill="{}""#, run[0]));
            i += run.len();
        }
    }
    svg.close();
}

/// The bar of the phase, its words on the base line `base`.
fn bar(svg: &mut Svg, x: f64, base: f64) {
    let wide = 60.0 / f64::from(STEPS);
    svg.text(x, base, &Text::from("0°"), Style::new(TICK_SIZE, Anchor::Start));
    svg.open(r#"shape-rendering="crispEdges""#);
    for k in 0..STEPS {
        let fill = shade(90.0 * f64::from(k) / f64::from(STEPS));
        let corner = [x + 11.0 + f64::from(k) * wide, base - BAR_HEIGHT + 1.0, wide, BAR_HEIGHT];
        svg.rect(corner, &format!(r#"fill="{fill}""#));
    }
    svg.close();
    let words = Text::from("≥90°  hatched: none");
    svg.text(x + 74.0, base, &words, Style::new(TICK_SIZE, Anchor::Start));
}

/// Draws the legend of the verdicts' fills. Returns where it ends.
fn legend(svg: &mut Svg, [left, top]: [f64; 2], width: f64) -> f64 {
    let fills = VERDICTS.map(|(fill, _)| format!(r##"fill="{fill}" stroke="#000000" stroke-width="0.4""##));
    let words = VERDICTS.iter().map(|(_, words)| Text::from(*words));
    let entries: Vec<(Text, Sample<'_>)> = words.zip(fills.iter().map(|fill| Sample::Area(fill))).collect();
    top + key::rows(svg, [left, top], width, TICK_SIZE, &entries)
}

/// The share of right verdicts against the threshold; returns the lower end.
fn thresholds(svg: &mut Svg, trial: &PhaseTrial, frame: &Frame) -> f64 {
    let x = Scale::Linear { low: 0.0, high: 90.0 };
    let y = Scale::Linear { low: 0.4, high: 1.02 };
    let plot = Plot { frame: *frame, x: &x, y: &y };
    plot.curve(svg, [(CUSTOMARY, 0.4), (CUSTOMARY, 1.02)], CRITICAL);
    let strokes = [FIRST, SECOND, THIRD];
    for (source, stroke) in Source::ALL.into_iter().zip(strokes) {
        let scores = trial.scores(source);
        plot.curve(svg, scores.iter().map(|score| (score.threshold, score.balanced())), stroke);
    }
    frame.border(svg);
    frame.x_ticks(svg, &x.ticks(10), true);
    frame.y_ticks(svg, &y.ticks(y_tick_count(frame.height)), true);
    let upwards = Style::new(LABEL_SIZE, Anchor::Middle).upwards();
    svg.text(MARGIN + LABEL_SIZE, frame.y + 0.5 * frame.height, &Text::from("Share right"), upwards);
    let mut base = frame.bottom() + x_tick_room() + LABEL_SIZE + 1.0;
    svg.text(frame.across(0.5), base, &Text::from("Threshold (°)"), Style::new(LABEL_SIZE, Anchor::Middle));
    base += 5.0;
    let words = Source::ALL.into_iter().map(|source| Text::from(source.words()));
    let entries: Vec<(Text, Sample<'_>)> = words.zip(strokes.map(Sample::Line)).collect();
    base + key::rows(svg, [frame.x, base], frame.width, LABEL_SIZE, &entries)
}
