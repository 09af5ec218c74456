//! A swept quantity along one side of a picture: cells around its values, ticks and label.

use crate::results::figure::words::capital;
use crate::sweep::grid::{Axis, AxisKey, Value};
use squealmap_figure::scale::{Scale, Tick, axis_unit, snapped, value_label};
use squealmap_figure::text::Text;

/// Room between the ends of tick labels, points.
const TICK_GAP: f64 = 6.0;
/// Tick labels of round values take about this much of a horizontal axis, points.
const TICK_WIDTH: f64 = 26.0;
/// The room that a tick needs on a vertical axis, points.
const TICK_HEIGHT: f64 = 20.0;
/// An axis of no more values than this has its ticks at the values themselves.
const FEW_VALUES: usize = 7;
/// Values whose labels are longer than this (in ems: about five digits) are no ticks.
const SHORT_LABEL: f64 = 2.6;
/// A log axis is wide from this ratio of its ends on.
const WIDE: f64 = 1e3;
/// Margin around scattered points, as a fraction of the axis.
const SCATTER_MARGIN: f64 = 0.08;

/// Which way an axis runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Direction {
    Horizontal,
    Vertical,
}

/// One side of a picture.
#[derive(Clone, Debug)]
pub(crate) struct PictureAxis {
    key: Option<AxisKey>,
    pub(crate) scale: Scale,
    /// Cell borders, from 0 to 1, one more than cells; empty for scattered points.
    pub(crate) edges: Vec<f64>,
    /// The index on the sweep's axis of each cell.
    pub(crate) order: Vec<usize>,
    /// Distinct numeric values in rising order.
    values: Vec<f64>,
}

impl PictureAxis {
    /// Cells around the values of an axis: borders halfway between neighbours, in the logarithm on a log axis.
    pub(crate) fn cells(axis: &Axis) -> PictureAxis {
        let numbers: Option<Vec<f64>> = axis.values.iter().map(Value::number).collect();
        let Some(numbers) = numbers else { return PictureAxis::names(axis) };
        let order = axis.rising();
        let values: Vec<f64> = order.iter().map(|i| numbers[*i]).collect();
        let rising = values.windows(2).all(|pair| pair[0] < pair[1]);
        if !rising || values.is_empty() || values.iter().any(|x| !x.is_finite()) {
            return PictureAxis::names(axis);
        }
        let log = axis.log && values.len() > 1 && values[0] > 0.0;
        let centres: Vec<f64> = values.iter().map(|x| if log { x.ln() } else { *x }).collect();
        let ends = borders(&centres);
        let (low, high) = (ends[0], ends[ends.len() - 1]);
        let scale =
            if log { Scale::Log { low: low.exp(), high: high.exp() } } else { Scale::Linear { low, high } };
        let edges = ends.iter().map(|end| (end - low) / (high - low)).collect();
        PictureAxis { key: Some(axis.key), scale, edges, order, values }
    }

    /// Equal cells with a name each.
    fn names(axis: &Axis) -> PictureAxis {
        let names: Vec<String> = axis.values.iter().map(as_name).collect();
        let n = names.len();
        let edges = (0..=n).map(|i| i as f64 / n.max(1) as f64).collect();
        PictureAxis {
            key: Some(axis.key),
            scale: Scale::Names(names),
            edges,
            order: (0..n).collect(),
            values: Vec::new(),
        }
    }

    /// One cell without a meaning: a sweep without axes.
    pub(crate) fn single() -> PictureAxis {
        let scale = Scale::Names(vec![String::new()]);
        PictureAxis { key: None, scale, edges: vec![0.0, 1.0], order: vec![0], values: Vec::new() }
    }

    /// A scale around scattered values of a column.
    pub(crate) fn scatter(key: AxisKey, column: &[&Value]) -> PictureAxis {
        let numbers: Option<Vec<f64>> = column.iter().map(|value| value.number()).collect();
        let (scale, values) = if let Some(mut values) = numbers {
            values.sort_by(f64::total_cmp);
            values.dedup();
            (Scale::spanning(values.iter().copied()).widened(SCATTER_MARGIN), values)
        } else {
            let mut names: Vec<String> = Vec::new();
            for value in column {
                let name = as_name(value);
                if !names.contains(&name) {
                    names.push(name);
                }
            }
            (Scale::Names(names), Vec::new())
        };
        PictureAxis { key: Some(key), scale, edges: Vec::new(), order: Vec::new(), values }
    }

    /// This axis for curves: it ends at the first and the last value, not half a cell beyond them.
    pub(crate) fn edge_to_edge(self, scale: &Scale) -> PictureAxis {
        PictureAxis { scale: scale.clone(), ..self }
    }

    /// The position of a value on a scatter axis.
    pub(crate) fn position(&self, value: &Value) -> f64 {
        match (&self.scale, value) {
            (Scale::Names(names), value) => {
                let name = as_name(value);
                self.scale.position(names.iter().position(|other| *other == name).unwrap_or(0) as f64)
            }
            (scale, Value::Number(x)) => scale.position(*x),
            (_, Value::Text(_)) => 0.0,
        }
    }

    /// The parameter that the axis shows, if it shows one.
    pub(crate) fn key(&self) -> Option<AxisKey> {
        self.key
    }

    /// The number of cells.
    pub(crate) fn len(&self) -> usize {
        self.order.len()
    }

    /// The position of the middle of a cell, moved on by a part of the way to the next: on a log axis in the logarithm.
    pub(crate) fn between(&self, place: f64) -> f64 {
        let last = self.len().saturating_sub(1);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the cells")]
        let cell = (place.max(0.0) as usize).min(last);
        let middle = |cell: usize| match self.values.get(cell) {
            Some(value) => self.scale.position(*value),
            None => self.scale.position(cell as f64),
        };
        let (from, to) = (middle(cell), middle((cell + 1).min(last)));
        from + (place - cell as f64) * (to - from)
    }

    /// Whether the axis has names instead of numbers.
    pub(crate) fn is_named(&self) -> bool {
        matches!(self.scale, Scale::Names(_))
    }

    /// Ticks for an axis of this length: at the values when they are few and fit, else at round values.
    pub(crate) fn ticks(&self, length: f64, direction: Direction, size: f64) -> Vec<Tick> {
        let extent = |label: &Text| match direction {
            Direction::Horizontal => label.width(size, false) + TICK_GAP,
            Direction::Vertical => size + 1.0,
        };
        let fits = |ticks: &[Tick]| {
            ticks.windows(2).all(|pair| {
                (pair[1].at - pair[0].at) * length >= 0.5 * (extent(&pair[0].label) + extent(&pair[1].label))
            })
        };
        if self.key.is_none() {
            return Vec::new();
        }
        let readable = match self.scale {
            // Values over many decades are labelled as powers.
            Scale::Log { low, high } => high / low < WIDE,
            _ => self.scale.exponent() == 0,
        };
        if readable && (1..=FEW_VALUES).contains(&self.values.len()) {
            let at_values: Vec<Tick> = self
                .values
                .iter()
                .map(|x| Tick { at: snapped(self.scale.position(*x)), label: value_label(*x) })
                .collect();
            let short = at_values.iter().all(|tick| tick.label.width(size, false) <= SHORT_LABEL * size);
            if short && fits(&at_values) {
                return at_values;
            }
        }
        let each = if direction == Direction::Horizontal { TICK_WIDTH } else { TICK_HEIGHT };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive count")]
        let most = (length / each).clamp(2.0, 8.0) as usize;
        let ticks = self.scale.ticks(most);
        // Every one, or every second and so on, as far as their labels fit.
        let some = |ticks: Vec<Tick>| -> Vec<Tick> {
            let every = |stride: usize| ticks.iter().step_by(stride).cloned().collect::<Vec<_>>();
            (1..=ticks.len()).map(every).find(|ticks| fits(ticks)).unwrap_or_default()
        };
        let ticks = some(ticks);
        if ticks.len() > 1 || self.values.len() < 2 {
            return ticks;
        }
        // One value is no scale: two of more round values, or the ends.
        let ends = || {
            let at =
                |value: &f64| Tick { at: snapped(self.scale.position(*value)), label: value_label(*value) };
            let all: Vec<Tick> = self.values.iter().map(at).collect();
            if let [first, .., last] = &all[..] { vec![first.clone(), last.clone()] } else { all }
        };
        let round = (most + 1..=3 * most).map(|most| some(self.scale.ticks(most)));
        let ends = (self.scale.exponent() == 0).then(ends).into_iter();
        round.chain(ends).find(|ticks| ticks.len() > 1 && fits(ticks)).unwrap_or(ticks)
    }

    /// The longest of the words, symbol and unit that fits into `available` points.
    pub(crate) fn label(&self, available: f64, size: f64) -> Text {
        let Some(key) = self.key else { return Text::default() };
        let AxisKey::Param(param) = key else { return Text::from(capital(key.name())) };
        let row = param.info();
        let short = Text::default().symbol(row.symbol).then(axis_unit(row.unit, self.scale.exponent()));
        let long = Text::from(quantity(row.name, row.meaning)).plain(" ").then(short.clone());
        if long.width(size, false) <= available { long } else { short }
    }
}

/// The words of an axis label: the meaning where it is a short phrase, else the name.
fn quantity(name: &str, meaning: &str) -> String {
    /// Longer phrases are explanations, not names.
    const SHORT: usize = 30;
    let phrase = meaning.split(" (").next().unwrap_or(meaning);
    let phrase = if phrase.chars().count() <= SHORT && !phrase.contains(':') {
        phrase.to_owned()
    } else {
        name.replace('_', " ")
    };
    capital(&phrase)
}

fn as_name(value: &Value) -> String {
    match value {
        Value::Number(x) => x.to_string(),
        Value::Text(text) => text.to_string(),
    }
}

/// Borders of cells around rising centres: midpoints, and the same half-width beyond both ends.
fn borders(centres: &[f64]) -> Vec<f64> {
    let n = centres.len();
    if n == 1 {
        let half = if centres[0] == 0.0 { 1.0 } else { 0.1 * centres[0].abs() };
        return vec![centres[0] - half, centres[0] + half];
    }
    let first = centres[0] - 0.5 * (centres[1] - centres[0]);
    let last = centres[n - 1] + 0.5 * (centres[n - 1] - centres[n - 2]);
    let inner = centres.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    std::iter::once(first).chain(inner).chain(std::iter::once(last)).collect()
}
