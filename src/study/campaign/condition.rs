//! `conditions.csv`: what strokes of one temperature, one law of the velocity and one speed have in common.

use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};

use crate::results::csv::Table;
use crate::study::campaign::row::{Said, VelocityLaw};
use crate::study::error::Result;
use crate::study::identify::shown::Colour;
use crate::sweep::columns::Cell;
use squealmap_input::quote::rounded;

/// Temperatures with less than this between neighbours, °C, are one condition.
const APART: f64 = 20.0;
/// Speeds with less than this factor between neighbours are one condition …
const FASTER: f64 = 1.25;
/// … which is no wider than this many of such steps: a test that heats up slowly is several.
const WIDEST: i32 = 2;

const COLUMNS: [&str; 14] = [
    "temperature",
    "velocity_law",
    "velocity",
    "strokes",
    "vibrating",
    "frequency",
    "amplitude",
    "no_instability",
    "negative_slope",
    "negative_slope_at_least",
    "mode_coupling",
    "mode_coupling_at_least",
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
    /// Their mean speed, m/s; `None` where the velocity was not recorded.
    pub speed: Option<f64>,
    /// How many there are.
    pub strokes: usize,
    /// The part of their time in which they vibrate.
    pub vibrating: f64,
    /// Medians of the frequency (Hz) and of the amplitude (m/s²) of those that vibrate.
    pub vibration: Option<[f64; 2]>,
    /// The parts of their time with each verdict, in the order of [`Colour::ALL`].
    pub shares: [f64; Colour::ALL.len()],
}

/// A sentence on a condition.
impl Display for Condition {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let or_none = |text: Option<String>| text.unwrap_or_default();
        let temperature = or_none(self.temperature.map(|temperature| format!("{temperature:.0} °C, ")));
        let law = or_none(self.law.map(|law| format!("{} velocity, ", law.name())));
        let speed = or_none(self.speed.map(|speed| format!("{} m/s on average, ", rounded(speed))));
        let at = or_none(self.vibration.map(|[frequency, _]| format!(" at {frequency:.1} Hz")));
        let strokes =
            if self.strokes == 1 { "1 stroke".to_owned() } else { format!("{} strokes", self.strokes) };
        let shares = Colour::ALL.iter().zip(self.shares).filter(|(_, share)| *share >= 0.005);
        let shares: Vec<String> =
            shares.map(|(kind, share)| format!("{} {:.0} %", kind.words(), 100.0 * share)).collect();
        let vibrating = 100.0 * self.vibrating;
        write!(
            f,
            "{temperature}{law}{speed}{strokes}: vibrating {vibrating:.0} % of the time{at}; {}",
            shares.join(", ")
        )
    }
}

/// Strokes together by temperature, law of the velocity, and speed; the latter two are a column of the figure.
pub(super) type Groups<'a> = BTreeMap<(usize, (Option<VelocityLaw>, usize)), Vec<&'a Said>>;

/// The strokes of each condition, by temperature, law and speed.
pub(super) fn groups(all: &[Said]) -> Groups<'_> {
    let temperatures = classes(all, |said| said.temperature.map(|temperature| temperature / APART));
    let speeds = classes(all, |said| said.speed.map(|speed| speed.ln() / FASTER.ln()));
    let mut groups = Groups::new();
    for ((said, temperature), speed) in all.iter().zip(temperatures).zip(speeds) {
        groups.entry((temperature, (said.law, speed))).or_default().push(said);
    }
    groups
}

/// The conditions of a campaign.
#[must_use]
pub fn conditions(all: &[Said]) -> Vec<Condition> {
    groups(all).values().map(|some| together(some)).collect()
}

/// The class of each stroke by a quantity in steps, 0 of the lowest and of those without it: neighbours that are less than a step apart are in
/// one, unless it would be too wide.
fn classes(all: &[Said], of: impl Fn(&Said) -> Option<f64>) -> Vec<usize> {
    let value = |place: usize| of(&all[place]).unwrap_or(f64::NEG_INFINITY);
    let mut rising: Vec<usize> = (0..all.len()).collect();
    rising.sort_by(|a, b| value(*a).total_cmp(&value(*b)));
    let mut classes = vec![0; all.len()];
    let mut class = 0;
    let mut open = vec![&rising[..]];
    while let Some(some) = open.pop() {
        if let Some(at) = cut(&some.iter().map(|place| value(*place)).collect::<Vec<f64>>()) {
            let (low, high) = some.split_at(at);
            open.extend([high, low]);
            continue;
        }
        for place in some {
            classes[*place] = class;
        }
        class += 1;
    }
    classes
}

/// Where rising values, in steps, are no one class: at the widest gap.
fn cut(values: &[f64]) -> Option<usize> {
    let gap = |at: usize| if values[at] > values[at - 1] { values[at] - values[at - 1] } else { 0.0 };
    let widest = (1..values.len()).rev().max_by(|a, b| gap(*a).total_cmp(&gap(*b)))?;
    let width = values[values.len() - 1] - values[0];
    (gap(widest) >= 1.0 || width >= f64::from(WIDEST)).then_some(widest)
}

/// The middle of some values.
pub(super) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    if values.len() % 2 == 1 { values[middle] } else { 0.5 * (values[middle - 1] + values[middle]) }
}

/// The condition of some strokes.
pub(super) fn together(some: &[&Said]) -> Condition {
    let length = |said: &Said| said.time[1] - said.time[0];
    let whole: f64 = some.iter().map(|said| length(said)).sum();
    let mean =
        |of: &dyn Fn(&Said) -> f64| some.iter().map(|said| of(said) * length(said)).sum::<f64>() / whole;
    let vibrations: Vec<[f64; 2]> = some.iter().filter_map(|said| said.vibration).collect();
    Condition {
        temperature: some[0].temperature.map(|_| mean(&|said| said.temperature.unwrap_or(0.0))),
        law: some[0].law,
        speed: some[0].speed.map(|_| mean(&|said| said.speed.unwrap_or(0.0))),
        strokes: some.len(),
        vibrating: mean(&|said| said.vibrating),
        vibration: (!vibrations.is_empty()).then(|| {
            [0, 1].map(|which| median(vibrations.iter().map(|vibration| vibration[which]).collect()))
        }),
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
        cells.push(number(one.speed));
        cells.push(one.strokes.to_string());
        cells.push(number(Some(one.vibrating)));
        cells.extend([0, 1].map(|which| number(one.vibration.map(|vibration| vibration[which]))));
        cells.extend(one.shares.map(|share| number(Some(share))));
        table.row(cells.into_iter())?;
    }
    Ok(table.finish()?)
}
