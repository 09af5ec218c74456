//! A grid as JSON and back, bit by bit.

use serde_json::{Value as Json, json};

use crate::grid::{Axis, AxisKey, Grid, Value};

/// `{ "axes": [{ "name", "values", "log" }] }`, or `{ "columns": [...], "rows": [[...]] }`.
#[must_use]
pub fn to_json(grid: &Grid) -> Json {
    match grid {
        Grid::Axes(axes) => {
            let axis = |axis: &Axis| json!({ "name": axis.key.name(), "values": values(&axis.values), "log": axis.log });
            json!({ "axes": axes.iter().map(axis).collect::<Vec<_>>() })
        }
        Grid::Tuples { keys, rows } => {
            let columns: Vec<&str> = keys.iter().map(|key| key.name()).collect();
            let rows: Vec<Json> = rows.iter().map(|row| values(row)).collect();
            json!({ "columns": columns, "rows": rows })
        }
    }
}

fn values(values: &[Value]) -> Json {
    let one = |value: &Value| match value {
        Value::Number(number) => json!(number),
        Value::Text(text) => json!(text),
    };
    values.iter().map(one).collect()
}

/// The grid of [`to_json`]; `None` when it is none.
#[must_use]
pub fn from_json(json: &Json) -> Option<Grid> {
    if let Some(axes) = json.get("axes") {
        let axis = |axis: &Json| {
            let key = AxisKey::from_name(axis.get("name")?.as_str()?)?;
            let values = read(axis.get("values")?)?;
            let log = axis.get("log")?.as_bool()?;
            (!values.is_empty()).then_some(Axis { key, values, log })
        };
        let grid = Grid::Axes(axes.as_array()?.iter().map(axis).collect::<Option<_>>()?);
        grid.checked_len().map(|_| grid)
    } else {
        let name = |name: &Json| AxisKey::from_name(name.as_str()?);
        let keys: Vec<AxisKey> = json.get("columns")?.as_array()?.iter().map(name).collect::<Option<_>>()?;
        let row = |row: &Json| read(row).filter(|row| row.len() == keys.len());
        let rows = json.get("rows")?.as_array()?.iter().map(row).collect::<Option<_>>()?;
        Some(Grid::Tuples { keys, rows })
    }
}

fn read(values: &Json) -> Option<Vec<Value>> {
    let one = |value: &Json| match value {
        Json::Number(number) => number.as_f64().map(Value::Number),
        Json::String(text) => Some(Value::Text(text.clone())),
        _ => None,
    };
    values.as_array()?.iter().map(one).collect()
}
