//! Measured strokes over a map: what was observed beside what is predicted.

use std::path::Path;

use crate::results::figure::overlay::{Overlay, Stroke};
use crate::results::figure::panels::Panels;
use crate::results::figure::picture_axis::PictureAxis;
use crate::study::error::{Error, Result};
use crate::sweep::grid::{Axis, AxisKey, Grid, Value};
use squealmap_input::files;
use squealmap_input::quote::quoted;

/// The largest table that is read, bytes.
const MOST: u64 = 1 << 24;
/// The column of what was observed.
const OBSERVED: &str = "observed";

/// Columns of a campaign that stand for those of a map.
const OF_CAMPAIGN: [(&str, &str); 1] = [("belt_velocity", "velocity")];

/// The line of a standard error, and the rim of a mark.
const ERROR: Stroke =
    Stroke::line("standard error", r##"class="error" fill="none" stroke="#000000" stroke-width="0.7""##);
const RIM: Stroke = Stroke::line(
    "",
    r##"class="rim" fill="none" stroke="#000000" stroke-width="5.6" stroke-linecap="round""##,
);

/// A mark on its rim.
const fn mark(words: &'static str, attributes: &'static str) -> Stroke {
    Stroke { words, attributes, rim: Some(RIM.attributes) }
}

/// What may be observed: its name, and its mark in the colour that maps give the same type.
const MARKS: [(&str, Stroke); 7] = [
    (
        "no_instability",
        mark(
            "measured: no instability",
            r##"class="observed" fill="none" stroke="#F2F2EE" stroke-width="4.2" stroke-linecap="round""##,
        ),
    ),
    (
        "negative_slope",
        mark(
            "measured: negative slope",
            r##"class="observed" fill="none" stroke="#56B4E9" stroke-width="4.2" stroke-linecap="round""##,
        ),
    ),
    (
        "negative_slope_at_least",
        mark(
            "measured: negative slope at least",
            r##"class="observed" fill="none" stroke="#BFE2F7" stroke-width="4.2" stroke-linecap="round""##,
        ),
    ),
    (
        "mode_coupling",
        mark(
            "measured: mode coupling",
            r##"class="observed" fill="none" stroke="#B5441A" stroke-width="4.2" stroke-linecap="round""##,
        ),
    ),
    (
        "mode_coupling_at_least",
        mark(
            "measured: mode coupling at least",
            r##"class="observed" fill="none" stroke="#DFB09E" stroke-width="4.2" stroke-linecap="round""##,
        ),
    ),
    (
        "both",
        mark(
            "measured: both",
            r##"class="observed" fill="none" stroke="#452087" stroke-width="4.2" stroke-linecap="round""##,
        ),
    ),
    (
        "undecided",
        mark(
            "measured: undecided",
            r##"class="observed" fill="none" stroke="#808B81" stroke-width="4.2" stroke-linecap="round""##,
        ),
    ),
];

/// Measured strokes as lines over a map, and how many lie outside of it.
#[derive(Clone, Debug)]
pub struct Strokes {
    /// Their errors, rims and marks.
    pub lines: Vec<Overlay>,
    /// Strokes in no panel, or without a verdict.
    pub outside: usize,
}

impl Strokes {
    /// Reads a table of strokes: a column for each axis of the map, named as it, `NAME_error` for its standard error where that
    /// is known, and `observed`. The table of a campaign is one: its `velocity` is that of the belt, and observed is what fills most of a
    /// stroke. A stroke is in the panel nearest to it, and outside where that is far.
    ///
    /// # Errors
    /// When the map has no plane, or the table is none of such strokes.
    pub fn over(path: &Path, grid: &Grid) -> Result<Strokes> {
        let bad = |why: String| Error::BadStrokes { path: path.to_owned(), why };
        let Grid::Axes(axes) = grid else {
            return Err(bad(
                "are to be drawn over a map of axes, and this one is of listed instances".to_owned()
            ));
        };
        let panels = Panels::new(grid);
        let sides = panels.x.key().zip(panels.y.as_ref().and_then(PictureAxis::key));
        let (x, y) =
            sides.ok_or_else(|| bad("are to be drawn over a plane, and this map has none".to_owned()))?;
        let text = files::table(path, MOST).map_err(|why| bad(format!("cannot be read: {why}")))?;
        let mut reader =
            csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(text.as_bytes());
        let header = reader.headers().map_err(|why| bad(why.to_string()))?.clone();
        let named = |name: &str| header.iter().position(|other| other == name);
        let column =
            |name: &str| named(name).or_else(|| named(OF_CAMPAIGN.iter().find(|(own, _)| *own == name)?.1));
        let needed = |name: &str| {
            let listed: Vec<String> = header.iter().map(|name| format!("`{}`", quoted(name))).collect();
            column(name).ok_or_else(|| bad(format!("have no column `{name}`, only {}", listed.join(", "))))
        };
        let places = [needed(x.name())?, needed(y.name())?];
        let errors = [x, y].map(|side| column(&format!("{}_error", side.name())));
        let observed = match Observed::of_campaign(&named) {
            Some(shares) => shares,
            None => Observed::Named(needed(OBSERVED)?),
        };
        let others: Vec<(&Axis, usize)> = axes
            .iter()
            .filter(|axis| axis.key != x && axis.key != y && axis.values.len() > 1)
            .map(|axis| Ok((axis, needed(axis.key.name())?)))
            .collect::<Result<_>>()?;
        // A table need not have what the map has one value of.
        let alone = axes.iter().filter(|axis| axis.values.len() == 1);
        let alone: Vec<(&Axis, usize)> =
            alone.filter_map(|axis| Some((axis, column(axis.key.name())?))).collect();
        let (mut bars, mut rims, mut marks, mut outside) = (Vec::new(), Vec::new(), Vec::new(), 0);
        for (number, row) in reader.records().enumerate() {
            let row = row.map_err(|why| bad(why.to_string()))?;
            let stroke = number + 1;
            if !observed.has_verdict(&row) {
                outside += 1;
                continue;
            }
            let value = |place: usize| {
                let cell = row.get(place).unwrap_or_default();
                let value = cell.parse::<f64>().ok().filter(|value| value.is_finite());
                value.ok_or_else(|| {
                    bad(format!(
                        "have `{}` as `{}` in row {stroke}, which is no number",
                        quoted(cell),
                        quoted(&header[place])
                    ))
                })
            };
            let at = [value(places[0])?, value(places[1])?];
            let panel = |(axis, place): &(&Axis, usize)| {
                let (cell, name) = (row.get(*place).unwrap_or_default(), axis.key.name());
                let none = format!(
                    "have `{}` as `{name}` in row {stroke}, which is no value of the map",
                    quoted(cell)
                );
                Ok((axis.key, nearest(axis, cell).ok_or_else(|| bad(none))?))
            };
            let here = others.iter().map(panel).collect::<Result<Vec<_>>>()?;
            let mark = observed.mark(&row, value, |name, names| {
                bad(format!("have `{name}` as `{OBSERVED}` in row {stroke}; it must be one of {names}"))
            })?;
            let is_far = others
                .iter()
                .chain(&alone)
                .any(|(axis, place)| !is_near(axis, row.get(*place).unwrap_or_default()));
            if is_far || !([x, y].into_iter().zip(at).all(|(side, value)| covers(axes, side, value))) {
                outside += 1;
                continue;
            }
            let line = |stroke: Stroke, points: [[f64; 2]; 2]| Overlay {
                axes: [x, y],
                others: here.clone(),
                stroke,
                points: points.to_vec(),
            };
            for (side, error) in errors.into_iter().enumerate() {
                // An error that is not known is an empty cell.
                let Some(error) = error.filter(|place| row.get(*place).is_some_and(|cell| !cell.is_empty()))
                else {
                    continue;
                };
                let error = value(error)?.abs();
                let mut ends = [at; 2];
                ends[0][side] -= error;
                ends[1][side] += error;
                bars.push(line(ERROR, ends));
            }
            rims.push(line(RIM, [at; 2]));
            marks.push(line(mark, [at; 2]));
        }
        bars.extend(rims);
        bars.extend(marks);
        Ok(Strokes { lines: bars, outside })
    }
}

/// Where the rows of a table say what was observed.
enum Observed {
    /// By its name.
    Named(usize),
    /// By the parts of a stroke that each verdict of [`MARKS`] fills; the status of a stroke that could not be judged is not `ok`.
    Shares { shares: Vec<usize>, status: Option<usize> },
}

impl Observed {
    /// That of a campaign, by the places of its columns.
    fn of_campaign(named: &impl Fn(&str) -> Option<usize>) -> Option<Observed> {
        if named(OBSERVED).is_some() {
            return None;
        }
        let shares = MARKS.iter().map(|(name, _)| named(name)).collect::<Option<_>>()?;
        Some(Observed::Shares { shares, status: named("status") })
    }

    fn has_verdict(&self, row: &csv::StringRecord) -> bool {
        let Observed::Shares { status: Some(status), .. } = self else { return true };
        row.get(*status) == Some("ok")
    }

    /// The mark of a row; `value` reads a cell, `bad` refuses a name for one of some.
    fn mark(
        &self,
        row: &csv::StringRecord,
        value: impl Fn(usize) -> Result<f64>,
        bad: impl Fn(String, String) -> Error,
    ) -> Result<Stroke> {
        match self {
            Observed::Named(place) => {
                let name = row.get(*place).unwrap_or_default();
                let mark = MARKS.into_iter().find(|(known, _)| *known == name).map(|(_, mark)| mark);
                mark.ok_or_else(|| bad(quoted(name), MARKS.map(|(name, _)| name).join(", ")))
            }
            Observed::Shares { shares, .. } => {
                let shares = shares.iter().map(|place| value(*place)).collect::<Result<Vec<f64>>>()?;
                let most = (0..shares.len()).max_by(|a, b| shares[*a].total_cmp(&shares[*b]));
                Ok(MARKS[most.unwrap_or_default()].1)
            }
        }
    }
}

/// Whether an axis reaches a value.
fn covers(axes: &[Axis], side: AxisKey, value: f64) -> bool {
    let numbers = axes.iter().filter(|axis| axis.key == side).flat_map(|axis| &axis.values);
    let numbers = numbers.filter_map(Value::number);
    let [low, high] = numbers.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(x), h.max(x)]);
    (low..=high).contains(&value)
}

/// Whether a panel of an axis is near a number: half a step beyond its ends at most, of a single value a quarter of it. A text is near.
fn is_near(axis: &Axis, cell: &str) -> bool {
    /// The part of a speed by which those of one condition of a campaign may differ.
    const ALONE: f64 = 0.25;
    let Some(number) = cell.parse::<f64>().ok() else { return true };
    let mut values: Vec<f64> = axis.values.iter().filter_map(Value::number).collect();
    values.sort_by(f64::total_cmp);
    match values[..] {
        [] => true,
        [only] => (number - only).abs() <= ALONE * only.abs(),
        [first, second, ..] => {
            let [before, last] = [values[values.len() - 2], values[values.len() - 1]];
            (first - 0.5 * (second - first)..=last + 0.5 * (last - before)).contains(&number)
        }
    }
}

/// The value of an axis nearest to a number, or the same text.
fn nearest(axis: &Axis, cell: &str) -> Option<Value> {
    let number = cell.parse::<f64>().ok().filter(|number| number.is_finite());
    let off = |value: &Value| match (value, number) {
        (Value::Number(value), Some(number)) => (value - number).abs(),
        (Value::Text(text), _) if text.as_str() == cell => 0.0,
        _ => f64::INFINITY,
    };
    let best = axis.values.iter().min_by(|a, b| off(a).total_cmp(&off(b)))?;
    off(best).is_finite().then(|| best.clone())
}
