//! Axes, index ↔ coordinates, order. The first axis varies slowest.

use std::ops::Index;
use std::sync::Arc;

use crate::model::{PARAMS, Param};

/// Names beyond these are not shared: looking them up would cost more than they.
const SHARED_NAMES: usize = 256;

/// One coordinate of an instance.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A numeric parameter's value.
    Number(f64),
    /// A name: of a friction law, or a material file as written in the sweep file.
    ///
    /// One pointer wide, and one text for all rows that name it: rows are many.
    Text(Arc<String>),
}

impl Value {
    /// The number, where it is none of a name.
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        match self {
            Value::Number(number) => Some(*number),
            Value::Text(_) => None,
        }
    }
}

impl std::fmt::Display for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Value::Number(number) => write!(f, "{number}"),
            Value::Text(text) => f.write_str(text),
        }
    }
}

/// Value `index` of `points` values between two ends, which are met exactly. Steps are equal, or those of the logarithms are
/// if `log`.
#[must_use]
pub fn spaced([from, to]: [f64; 2], points: usize, log: bool, index: usize) -> f64 {
    if index == 0 {
        return from;
    }
    if index + 1 == points {
        return to;
    }
    let last = (points - 1) as f64;
    let value = if log {
        // Logarithms rather than the ratio, which could overflow.
        (from.ln() + index as f64 * ((to.ln() - from.ln()) / last)).exp()
    } else {
        from + index as f64 * ((to - from) / last)
    };
    // What rounding leaves of a zero, as in −0.05 … 0.1 with 61 points, is none: any other value is a step away from it.
    let most = from.abs().max(to.abs());
    if !log && value.abs() <= 4.0 * f64::EPSILON * most {
        return 0.0;
    }
    value.clamp(from.min(to), from.max(to))
}

/// What an axis (or a column of a tuple file) varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxisKey {
    /// A numeric parameter.
    Param(Param),
    /// The friction law.
    Law,
    /// The material file.
    Material,
}

impl AxisKey {
    /// The flat name, the same in TOML and CSV.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            AxisKey::Param(param) => param.info().name,
            AxisKey::Law => "law",
            AxisKey::Material => "material",
        }
    }

    /// The key with this flat name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<AxisKey> {
        match name {
            "law" => Some(AxisKey::Law),
            "material" => Some(AxisKey::Material),
            _ => Param::from_name(name).map(AxisKey::Param),
        }
    }

    /// The names of everything that can vary.
    pub fn names() -> impl Iterator<Item = &'static str> {
        PARAMS.iter().map(|row| row.name).chain(["law", "material"])
    }
}

/// One axis: what it varies and its values in order.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What varies.
    pub key: AxisKey,
    /// The values, at least one.
    pub values: Vec<Value>,
    /// Whether figures should draw the axis logarithmically.
    pub log: bool,
}

impl Axis {
    /// Whether its values are numbers, and not names of laws or materials.
    #[must_use]
    pub fn is_of_numbers(&self) -> bool {
        self.values.iter().all(|value| matches!(value, Value::Number(_)))
    }

    /// The positions of its values, rising; names stay where they are.
    #[must_use]
    pub fn rising(&self) -> Vec<usize> {
        let number = |i: usize| self.values[i].number().unwrap_or_default();
        let mut order: Vec<usize> = (0..self.values.len()).collect();
        order.sort_by(|a, b| number(*a).total_cmp(&number(*b)));
        order
    }
}

/// The instances of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub enum Grid {
    /// The product of the axes; the first varies slowest. No axes: one instance.
    Axes(Vec<Axis>),
    /// Explicit tuples: the keys of the columns and one row of values per instance.
    Tuples {
        /// The column keys.
        keys: Vec<AxisKey>,
        /// One row per instance, as long as `keys`.
        rows: Rows,
    },
}

/// Rows of equally many values, in one piece of memory that copies share.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rows {
    width: usize,
    count: usize,
    values: Arc<Vec<Value>>,
}

impl Rows {
    /// `count` rows of `width` values, one row after the other.
    ///
    /// # Panics
    /// When there are not `count * width` values.
    #[must_use]
    pub fn new(width: usize, count: usize, values: Vec<Value>) -> Rows {
        assert_eq!(Some(values.len()), width.checked_mul(count), "rows are whole");
        Rows { width, count, values: Arc::new(values) }
    }

    /// The number of rows.
    #[must_use]
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The rows in order.
    pub fn iter(&self) -> impl Iterator<Item = &[Value]> {
        (0..self.count).map(|row| &self[row])
    }
}

impl Index<usize> for Rows {
    type Output = [Value];

    fn index(&self, row: usize) -> &[Value] {
        assert!(row < self.count, "row {row} of {}", self.count);
        &self.values[row * self.width..(row + 1) * self.width]
    }
}

impl From<Vec<Vec<Value>>> for Rows {
    fn from(rows: Vec<Vec<Value>>) -> Rows {
        rows.into_iter().collect()
    }
}

impl FromIterator<Vec<Value>> for Rows {
    /// # Panics
    /// When a row is longer or shorter than the first.
    fn from_iter<I: IntoIterator<Item = Vec<Value>>>(rows: I) -> Rows {
        let (mut width, mut count, mut values) = (None, 0, Vec::new());
        for row in rows {
            assert_eq!(*width.get_or_insert(row.len()), row.len(), "rows are equally long");
            count += 1;
            values.extend(row);
        }
        Rows::new(width.unwrap_or(0), count, values)
    }
}

/// Names, each kept once.
#[derive(Debug, Default)]
pub(crate) struct Names(Vec<Arc<String>>);

impl Names {
    /// The name as a value.
    pub(crate) fn value(&mut self, name: &str) -> Value {
        if let Some(known) = self.0.iter().find(|known| known.as_str() == name) {
            return Value::Text(Arc::clone(known));
        }
        let name = Arc::new(name.to_owned());
        if self.0.len() < SHARED_NAMES {
            self.0.push(Arc::clone(&name));
        }
        Value::Text(name)
    }
}

impl Grid {
    /// The axes of numbers; a table of tuples has none.
    pub fn axes_of_numbers(&self) -> impl Iterator<Item = &Axis> {
        let axes = match self {
            Grid::Axes(axes) => axes.as_slice(),
            Grid::Tuples { .. } => &[],
        };
        axes.iter().filter(|axis| axis.is_of_numbers())
    }

    /// The number of instances; `None` when the product overflows `usize`.
    #[must_use]
    pub fn checked_len(&self) -> Option<usize> {
        match self {
            Grid::Axes(axes) => axes.iter().try_fold(1_usize, |n, axis| n.checked_mul(axis.values.len())),
            Grid::Tuples { rows, .. } => Some(rows.len()),
        }
    }

    /// The number of instances.
    ///
    /// # Panics
    /// When the product overflows, which validation excludes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.checked_len().expect("the product of the axes was validated to fit")
    }

    /// Whether there is nothing to compute.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// What varies, in column order.
    #[must_use]
    pub fn keys(&self) -> Vec<AxisKey> {
        match self {
            Grid::Axes(axes) => axes.iter().map(|axis| axis.key).collect(),
            Grid::Tuples { keys, .. } => keys.clone(),
        }
    }

    /// The swept values of instance `index`, in the order of [`Grid::keys`].
    #[must_use]
    pub fn coordinates(&self, index: usize) -> Vec<&Value> {
        let mut values = Vec::new();
        self.each(index, |_, value| values.push(value));
        values.reverse();
        values
    }

    /// Gives what varies and its value at instance `index` to `take`, from the last axis to the first.
    pub fn each<'a>(&'a self, index: usize, mut take: impl FnMut(AxisKey, &'a Value)) {
        match self {
            Grid::Axes(axes) => {
                let mut rest = index;
                for axis in axes.iter().rev() {
                    take(axis.key, &axis.values[rest % axis.values.len()]);
                    rest /= axis.values.len();
                }
            }
            Grid::Tuples { keys, rows } => {
                keys.iter().zip(&rows[index]).rev().for_each(|(key, value)| take(*key, value));
            }
        }
    }
}
