//! The largest accelerations for other ramps and kicks: three small maps with their numbers in the cells.

use serde_json::{Value as Json, json};

use crate::results::csv::Table;
use crate::results::figure::look::Look;
use crate::study::error::Result;
use crate::study::paper::figures::distinct::distinct;
use crate::study::paper::{LIMITS, Trial};
use crate::sweep::columns::Cell;
use squealmap_figure::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_room};
use squealmap_figure::page::{DOUBLE_COLUMN, MARGIN, title};
use squealmap_figure::scale::{Scale, Tick, value_label};
use squealmap_figure::svg::{Anchor, Style, Svg};
use squealmap_figure::text::{Text, wrap};

/// Size of the numbers in the cells, points.
const NUMBER_SIZE: f64 = 7.0;
/// Height of a row of cells, points.
const ROW: f64 = 17.0;
/// Between the maps, points.
const GAP: f64 = 8.0;
/// Right of the maps, points.
const RIGHT: f64 = 4.0;
/// Fill of ratios above 1, light enough for numbers on top.
const LARGER: &str = r##"fill="#F0B878" stroke="#FFFFFF" stroke-width="0.5""##;
/// Fill of ratios up to 1.
const SMALLER: &str = r##"fill="#D8E4F2" stroke="#FFFFFF" stroke-width="0.5""##;
/// Fill of trials in which not every case grew.
const NOT_GROWN: &str = r##"fill="#F4F4F4" stroke="#FFFFFF" stroke-width="0.5""##;
/// Between maps that stand one below the other, points: ticks, axis label and name.
const BETWEEN: f64 = 40.0;
/// On narrower pages the maps do not fit side by side, points.
const NARROW: f64 = 400.0;
/// Heading of picture and document.
pub(super) const HEADING: &str =
    "Largest accelerations during the ramp, as ratios, against its duration and the first kick";
/// The note that explains the fills.
const NOTE: &str = "Orange: above 1. Blue: up to 1. Grey, in italics: not in every case has the vibration grown to ten \
    times the acceleration of the kick and of the belt, so that the ratio says little.";

/// A ratio of a trial.
type Ratio = fn(&Trial) -> Option<f64>;

/// The titles of the maps, and the numbers that they show.
const MAPS: [(&str, &str, Ratio); 3] = [
    ("(a) ", "both / larger of the two", |trial| trial.coexistence().map(|ratio| ratio[0])),
    ("(b) ", "both / larger of the two", |trial| trial.coexistence().map(|ratio| ratio[1])),
    ("(c) ", "slope / coupling", Trial::slope_over_coupling),
];
/// The acceleration of each map.
const SYMBOLS: [&str; 3] = ["ẍ_2", "ÿ_1", "ẍ_2"];

/// The columns of the table.
pub(crate) const COLUMNS: [&str; 8] = [
    "ramp_duration",
    "start_displacement",
    "ax_peak_figure4",
    "ay_peak_figure4",
    "ax_peak_figure5",
    "ay_peak_figure5",
    "ax_peak_figure6",
    "ay_peak_figure6",
];

pub(super) fn table(trials: &[Trial]) -> Result<Vec<u8>> {
    let mut table = Table::new(COLUMNS.into_iter())?;
    for trial in trials {
        let peaks = trial.peaks.iter().flat_map(|peaks| [peaks.map(|p| p[0]), peaks.map(|p| p[1])]);
        let numbers = [Some(trial.duration), Some(trial.kick)].into_iter().chain(peaks);
        table.row(numbers.map(|x| Cell::from(x).to_string()))?;
    }
    Ok(table.finish()?)
}

/// The document beside the table: the disturbance of the equilibrium in each row, m/s².
pub(super) fn to_json(trials: &[Trial]) -> Json {
    let disturbances: Vec<f64> = trials.iter().map(|trial| trial.disturbance).collect();
    json!({ "title": HEADING, "disturbance": disturbances })
}

/// Three maps over ramp duration and kick, double column width unless the look says otherwise; one below the other on
/// a narrow page.
pub(super) fn picture(trials: &[Trial], look: &Look<'_>) -> String {
    let rows = distinct(trials.iter().map(|trial| trial.kick)).len() as f64;
    let maps = MAPS.len() / columns(look.points().unwrap_or(DOUBLE_COLUMN));
    look.fitted(HEADING, maps as f64 * rows * ROW, |part| draw(trials, look, part * ROW))
}

/// How many maps stand side by side on a page.
fn columns(page: f64) -> usize {
    if page < NARROW { 1 } else { MAPS.len() }
}

/// The picture and its size, with rows of cells of this height.
fn draw(trials: &[Trial], look: &Look<'_>, cell_height: f64) -> (Svg, [f64; 2]) {
    let page = look.points().unwrap_or(DOUBLE_COLUMN);
    let mut svg = Svg::new();
    let inner = page - 2.0 * MARGIN;
    let y = MARGIN + title(&mut svg, look.title(HEADING), inner) + LABEL_SIZE + 5.0;
    let durations = distinct(trials.iter().map(|trial| trial.duration));
    let kicks = distinct(trials.iter().map(|trial| trial.kick));
    let ticks = |values: &[f64], unit: f64| -> Vec<Tick> {
        let names = Scale::Names(values.iter().map(f64::to_string).collect());
        let tick =
            |(k, x): (usize, &f64)| Tick { at: names.position(k as f64), label: value_label(x / unit) };
        values.iter().enumerate().map(tick).collect()
    };
    let [x_ticks, y_ticks] = [ticks(&durations, 1.0), ticks(&kicks, 1e-3)];
    let left = MARGIN + LABEL_SIZE + 6.0 + y_tick_room(&y_ticks);
    let columns = columns(page);
    let width = (page - left - RIGHT - (columns - 1) as f64 * GAP) / columns as f64;
    let cell = width / durations.len().max(1) as f64;
    let height = cell_height * kicks.len() as f64;
    for (number, (letter, words, ratio)) in MAPS.into_iter().enumerate() {
        let (column, row) = (number % columns, number / columns);
        let y = y + row as f64 * (height + BETWEEN);
        let frame = Frame { x: left + column as f64 * (width + GAP), y, width, height };
        let name = Text::from(letter).symbol(SYMBOLS[number]).plain(": ").plain(words);
        svg.text(frame.x, y - 4.0, &name, Style::new(LABEL_SIZE, Anchor::Start));
        for trial in trials {
            let place =
                |values: &[f64], x: f64| values.iter().position(|value| value.to_bits() == x.to_bits());
            let (Some(i), Some(j)) = (place(&durations, trial.duration), place(&kicks, trial.kick)) else {
                continue;
            };
            let (x, top) = (frame.x + i as f64 * cell, frame.bottom() - (j + 1) as f64 * cell_height);
            let value = ratio(trial);
            let grown = LIMITS.grown(trial);
            let fill = match value {
                Some(ratio) if grown => {
                    if ratio > 1.0 {
                        LARGER
                    } else {
                        SMALLER
                    }
                }
                _ => NOT_GROWN,
            };
            svg.rect([x, top, cell, cell_height], fill);
            let words = value.map_or_else(|| "–".to_owned(), |ratio| format!("{ratio:.2}"));
            let words = if grown { Text::from(words) } else { Text::default().symbol(&words) };
            let base = top + 0.5 * cell_height + 0.35 * NUMBER_SIZE;
            svg.text(x + 0.5 * cell, base, &words, Style::new(NUMBER_SIZE, Anchor::Middle));
        }
        frame.border(&mut svg);
        frame.x_ticks(&mut svg, &x_ticks, true);
        frame.y_ticks(&mut svg, &y_ticks, column == 0);
        let base = frame.bottom() + x_tick_room() + LABEL_SIZE + 1.0;
        let label = Text::from("Ramp duration (s)");
        svg.text(frame.across(0.5), base, &label, Style::new(LABEL_SIZE, Anchor::Middle));
        if column == 0 {
            let upwards = Style::new(LABEL_SIZE, Anchor::Middle).upwards();
            svg.text(MARGIN + LABEL_SIZE, y + 0.5 * height, &Text::from("First kick (mm)"), upwards);
        }
    }
    let below = (MAPS.len() / columns - 1) as f64 * (height + BETWEEN);
    let mut base = y + below + height + x_tick_room() + LABEL_SIZE + 6.0;
    for line in wrap(NOTE, inner, TICK_SIZE, false) {
        base += TICK_SIZE + 2.0;
        svg.text(MARGIN, base, &Text::from(line), Style::new(TICK_SIZE, Anchor::Start));
    }
    (svg, [page, base + 3.0 + MARGIN])
}
