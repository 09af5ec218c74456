//! A value of an axis by its name, as `--cut` and `--select` take it: `theta=0.01` is the nearest value that the axis has.

use crate::sweep::grid::{Axis, AxisKey, Grid, Value};
use crate::sweep::spec::names::advice;

/// Two values are the same where they differ by no more than this part of them, or of the length of a linear axis: what
/// rounding leaves of a step times an index.
const SAME: f64 = 1e-9;

/// A value that was taken for another one that the axis does not have.
#[derive(Clone, Debug, PartialEq)]
pub struct Taken {
    /// The axis.
    pub key: AxisKey,
    /// What was asked for.
    pub asked: f64,
    /// The nearest value of the axis.
    pub value: f64,
}

impl std::fmt::Display for Taken {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let name = self.key.name();
        write!(f, "`{name}` has no value {}; the nearest is taken, {}", self.asked, plain(self.value))
    }
}

/// Where a value stands.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Choice {
    /// The place of the axis.
    pub(crate) axis: usize,
    /// The place of the value on it.
    pub(crate) value: usize,
    /// The value that was taken instead, where the axis does not have the one that was asked for.
    pub(crate) taken: Option<Taken>,
}

/// The axes of a grid with their values. In a list of instances every column is an axis with the values that occur in it,
/// rising.
pub(crate) fn axes(grid: &Grid) -> Vec<Axis> {
    match grid {
        Grid::Axes(axes) => axes.clone(),
        Grid::Tuples { keys, rows } => {
            let of = |(column, key): (usize, &AxisKey)| {
                let mut values: Vec<Value> = rows.iter().map(|row| row[column].clone()).collect();
                values.sort_by(|a, b| match (a, b) {
                    (Value::Number(a), Value::Number(b)) => a.total_cmp(b),
                    (a, b) => a.to_string().cmp(&b.to_string()),
                });
                values.dedup();
                Axis { key: *key, values, log: false }
            };
            keys.iter().enumerate().map(of).collect()
        }
    }
}

/// All the values that a text such as `mu_d=0.3,law=bilinear` names.
pub(crate) fn choose_all(axes: &[Axis], text: &str) -> Result<Vec<Choice>, String> {
    text.split(',').map(|one| choose(axes, one.trim())).collect()
}

/// The axis and the value that `name=value` names.
fn choose(axes: &[Axis], text: &str) -> Result<Choice, String> {
    let (name, asked) = text.split_once('=').ok_or("write name=value, such as mu_d=0.3")?;
    let (name, asked) = (name.trim(), asked.trim());
    let names: Vec<&str> = axes.iter().map(|axis| axis.key.name()).collect();
    let axis = names.iter().position(|one| *one == name);
    let axis = axis.ok_or_else(|| format!("the map has no axis `{name}`; {}", advice(name, &names)))?;
    let values = &axes[axis].values;
    let numbers: Option<Vec<f64>> = values.iter().map(Value::number).collect();
    let Some(numbers) = numbers else {
        let values: Vec<String> = values.iter().map(ToString::to_string).collect();
        let found = values.iter().position(|value| value == asked);
        let all: Vec<&str> = values.iter().map(String::as_str).collect();
        let found = found.ok_or_else(|| format!("`{name}` has no value `{asked}`; {}", advice(asked, &all)));
        return Ok(Choice { axis, value: found?, taken: None });
    };
    let wanted = asked.parse::<f64>().ok().filter(|x| x.is_finite());
    let wanted = wanted.ok_or_else(|| format!("`{name}` has numbers, which `{asked}` is not"))?;
    let value = nearest(&axes[axis], &numbers, wanted).ok_or_else(|| {
        let [low, high] = ends(&numbers).map(plain);
        format!("`{name}` has no value {wanted}; its values go from {low} to {high}")
    })?;
    let found = numbers[value];
    let taken = (!is_same(&axes[axis], &numbers, found, wanted)).then_some(Taken {
        key: axes[axis].key,
        asked: wanted,
        value: found,
    });
    Ok(Choice { axis, value, taken })
}

/// The place of the nearest of some numbers, on a log axis by their ratio; none for what lies further outside than the
/// next value would.
fn nearest(axis: &Axis, numbers: &[f64], wanted: f64) -> Option<usize> {
    let on_axis = |x: f64| if axis.log { x.ln() } else { x };
    let apart = |x: f64| (on_axis(x) - on_axis(wanted)).abs();
    let place = (0..numbers.len()).min_by(|a, b| apart(numbers[*a]).total_cmp(&apart(numbers[*b])))?;
    let [low, high] = ends(numbers);
    if (low..=high).contains(&wanted) || is_same(axis, numbers, numbers[place], wanted) {
        return Some(place);
    }
    let others = numbers.iter().filter(|x| x.to_bits() != numbers[place].to_bits());
    let step = others.map(|x| (on_axis(*x) - on_axis(numbers[place])).abs()).fold(f64::INFINITY, f64::min);
    (step.is_finite() && apart(numbers[place]) <= 0.5 * step).then_some(place)
}

/// Whether two values of an axis differ by rounding alone.
fn is_same(axis: &Axis, numbers: &[f64], a: f64, b: f64) -> bool {
    let [low, high] = ends(numbers);
    let length = if axis.log { 0.0 } else { high - low };
    (a - b).abs() <= SAME * a.abs().max(b.abs()).max(length)
}

fn ends(numbers: &[f64]) -> [f64; 2] {
    let (low, high) = (f64::INFINITY, f64::NEG_INFINITY);
    numbers.iter().fold([low, high], |[low, high], x| [low.min(*x), high.max(*x)])
}

/// A number without the rounding of a step times an index.
fn plain(x: f64) -> f64 {
    format!("{x:.11e}").parse().unwrap_or(x)
}
