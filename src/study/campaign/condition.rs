//! `conditions.csv`: what strokes of one temperature and one law of the velocity have in common.

use crate::results::csv::Table;
use crate::study::campaign::row::{Said, StrokeRow, VelocityLaw};
use crate::study::error::Result;
use crate::sweep::columns::Cell;
use squealmap_identify::Kind;

/// Temperatures with less than this between neighbours, °C, are one condition.
const APART: f64 = 20.0;

const COLUMNS: [&str; 11] = [
    "temperature",
    "velocity_law",
    "strokes",
    "vibrating",
    "frequency",
    "amplitude",
    "no_instability",
    "negative_slope",
    "mode_coupling",
    "both",
    "undecided",
];

/// Strokes of one condition.
#[derive(Clone, Debug, PartialEq)]
pub struct Condition {
    /// Their mean temperature, °C; `None` where it was not recorded.
    pub temperature: Option<f64>,
    /// How the velocity goes; `None` where it was not recorded.
    pub law: Option<VelocityLaw>,
    /// How many there are.
    pub strokes: usize,
    /// The part of their time in which they vibrate.
    pub vibrating: f64,
    /// Medians of the frequency (Hz) and of the amplitude (m/s²) of those that vibrate.
    pub vibration: Option<[f64; 2]>,
    /// The parts of their time with each verdict, in the order of [`Kind::ALL`].
    pub shares: [f64; Kind::ALL.len()],
}

/// The conditions of a campaign, by temperature and law; strokes that say nothing are in none.
#[must_use]
pub fn conditions(rows: &[StrokeRow]) -> Vec<Condition> {
    let mut known: Vec<(&Said, Option<VelocityLaw>)> =
        rows.iter().filter_map(|row| Some((row.said.as_ref().ok()?, row.law))).collect();
    let temperature = |said: &Said| said.temperature.unwrap_or(f64::NEG_INFINITY);
    known.sort_by(|(a, _), (b, _)| temperature(a).total_cmp(&temperature(b)));
    let near = |a: &Said, b: &Said| match (a.temperature, b.temperature) {
        (Some(a), Some(b)) => b - a < APART,
        (a, b) => a.is_none() && b.is_none(),
    };
    let mut all = Vec::new();
    for group in known.chunk_by(|(a, _), (b, _)| near(a, b)) {
        let mut laws: Vec<Option<VelocityLaw>> = group.iter().map(|(_, law)| *law).collect();
        laws.sort_unstable();
        laws.dedup();
        for law in laws {
            let some: Vec<&Said> = group.iter().filter(|(_, of)| *of == law).map(|(said, _)| *said).collect();
            all.push(together(&some, law));
        }
    }
    all
}

fn together(some: &[&Said], law: Option<VelocityLaw>) -> Condition {
    let length = |said: &Said| said.time[1] - said.time[0];
    let whole: f64 = some.iter().map(|said| length(said)).sum();
    let mean =
        |of: &dyn Fn(&Said) -> f64| some.iter().map(|said| of(said) * length(said)).sum::<f64>() / whole;
    let vibrations: Vec<[f64; 2]> = some.iter().filter_map(|said| said.vibration).collect();
    let median = |which: usize| {
        let mut values: Vec<f64> = vibrations.iter().map(|vibration| vibration[which]).collect();
        values.sort_by(f64::total_cmp);
        let middle = values.len() / 2;
        if values.len() % 2 == 1 { values[middle] } else { 0.5 * (values[middle - 1] + values[middle]) }
    };
    Condition {
        temperature: some[0].temperature.map(|_| mean(&|said| said.temperature.unwrap_or(0.0))),
        law,
        strokes: some.len(),
        vibrating: mean(&|said| said.vibrating),
        vibration: (!vibrations.is_empty()).then(|| [median(0), median(1)]),
        shares: std::array::from_fn(|kind| mean(&|said| said.shares[kind])),
    }
}

/// `conditions.csv`.
///
/// # Errors
/// When it cannot be written.
pub fn conditions_csv(all: &[Condition]) -> Result<Vec<u8>> {
    let mut table = Table::new(COLUMNS.iter())?;
    for one in all {
        let number = |value: Option<f64>| Cell::from(value).to_string();
        let mut cells = vec![number(one.temperature), one.law.map_or("", VelocityLaw::name).to_owned()];
        cells.push(one.strokes.to_string());
        cells.push(number(Some(one.vibrating)));
        cells.extend([0, 1].map(|which| number(one.vibration.map(|vibration| vibration[which]))));
        cells.extend(one.shares.map(|share| number(Some(share))));
        table.row(cells.into_iter())?;
    }
    Ok(table.finish()?)
}
