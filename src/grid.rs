//! Axes, index ↔ coordinates, order. The first axis varies slowest.

use crate::model::{PARAMS, Param};

/// One coordinate of an instance.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A numeric parameter's value.
    Number(f64),
    /// A name: of a friction law, or a material file as written in the sweep file.
    Text(String),
}

impl std::fmt::Display for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Value::Number(number) => write!(f, "{number}"),
            Value::Text(text) => f.write_str(text),
        }
    }
}

/// Value `index` of so many from end to end: equal steps, of logarithms if `log`; both ends exact.
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
        rows: Vec<Vec<Value>>,
    },
}

impl Grid {
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
