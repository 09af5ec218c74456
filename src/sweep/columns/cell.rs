//! The content of one cell of a table.

use crate::sweep::grid::Value;

/// The content of one cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// An undefined value.
    Empty,
    /// A number in base units.
    Number(f64),
    /// A count.
    Count(u64),
    /// A name.
    Text(String),
}

impl From<Option<f64>> for Cell {
    /// An undefined or non-finite number is an empty cell.
    fn from(value: Option<f64>) -> Cell {
        value.filter(|x| x.is_finite()).map_or(Cell::Empty, Cell::Number)
    }
}

impl From<f64> for Cell {
    fn from(value: f64) -> Cell {
        Cell::from(Some(value))
    }
}

impl From<&Value> for Cell {
    fn from(value: &Value) -> Cell {
        match value {
            Value::Number(x) => Cell::from(*x),
            Value::Text(text) => Cell::Text(text.to_string()),
        }
    }
}

impl std::fmt::Display for Cell {
    /// Numbers in the shortest form that reads back to the same bits; zero has no sign.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        /// Outside these magnitudes an exponent is shorter than the zeros it replaces.
        const PLAIN: std::ops::Range<f64> = 1e-5..1e16;
        match self {
            Cell::Empty => Ok(()),
            Cell::Number(0.0) => f.write_str("0"),
            Cell::Number(x) if PLAIN.contains(&x.abs()) => write!(f, "{x}"),
            Cell::Number(x) => write!(f, "{x:e}"),
            Cell::Count(n) => write!(f, "{n}"),
            Cell::Text(text) => f.write_str(text),
        }
    }
}
