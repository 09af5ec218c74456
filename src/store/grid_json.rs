//! A grid as JSON and back, bit by bit.
//!
//! The rows of a file of points are many: as JSON values they would take ten times their memory. They stand beside the JSON,
//! which holds `null` in their place; they are written and read one by one.

use crate::sweep::grid::{Axis, AxisKey, Grid, Names, Rows, Value};
use serde::de::{DeserializeSeed, Error as _, MapAccess, SeqAccess, Visitor};
use serde::ser::{SerializeMap, SerializeSeq};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::{Map as Object, Value as Json, json};

/// The key of the grid.
pub const GRID: &str = "grid";

/// The key of the physics.
pub const PHYSICS: &str = "physics";

/// The key of the rows.
const ROWS: &str = "rows";

/// `{ "axes": [{ "name", "values", "log" }] }`, or `{ "columns": [...], "rows": null }` with the rows beside it.
#[must_use]
pub fn to_json(grid: &Grid) -> Json {
    match grid {
        Grid::Axes(axes) => {
            let axis = |axis: &Axis| json!({ "name": axis.key.name(), "values": values(&axis.values), "log": axis.log });
            json!({ "axes": axes.iter().map(axis).collect::<Vec<_>>() })
        }
        Grid::Tuples { keys, .. } => {
            let columns: Vec<&str> = keys.iter().map(|key| key.name()).collect();
            json!({ "columns": columns, ROWS: null })
        }
    }
}

fn values(values: &[Value]) -> Json {
    let one = |value: &Value| match value {
        Value::Number(number) => json!(number),
        Value::Text(text) => json!(text.as_str()),
    };
    values.iter().map(one).collect()
}

/// The rows of a grid that lists its instances.
#[must_use]
pub fn rows(grid: &Grid) -> Option<&Rows> {
    match grid {
        Grid::Axes(_) => None,
        Grid::Tuples { rows, .. } => Some(rows),
    }
}

/// The grid of [`to_json`] and its rows; `None` when it is none.
#[must_use]
pub fn from_json(json: &Json, rows: Option<Rows>) -> Option<Grid> {
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
        let rows = rows?;
        let fit = rows.iter().all(|row| row.len() == keys.len());
        fit.then_some(Grid::Tuples { keys, rows })
    }
}

fn read(values: &Json) -> Option<Vec<Value>> {
    let one = |value: &Json| match value {
        Json::Number(number) => number.as_f64().map(Value::Number),
        Json::String(text) => Some(Value::Text(text.clone().into())),
        _ => None,
    };
    values.as_array()?.iter().map(one).collect()
}

/// JSON as it is written: with the rows in their place, and for an id with sorted keys.
pub(super) struct Whole<'a> {
    pub(super) json: &'a Json,
    pub(super) rows: Option<&'a Rows>,
    pub(super) sorted: bool,
}

impl Serialize for Whole<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let of = |json| Whole { json, ..*self };
        match self.json {
            Json::Object(entries) => {
                let mut entries: Vec<(&String, &Json)> = entries.iter().collect();
                if self.sorted {
                    entries.sort_by_key(|(key, _)| *key);
                }
                let mut map = to.serialize_map(Some(entries.len()))?;
                for (key, json) in entries {
                    match self.rows.filter(|_| key == ROWS && json.is_null()) {
                        Some(rows) => map.serialize_entry(key, &Written(rows))?,
                        None => map.serialize_entry(key, &of(json))?,
                    }
                }
                map.end()
            }
            Json::Array(values) => to.collect_seq(values.iter().map(of)),
            simple => simple.serialize(to),
        }
    }
}

/// Rows as an array of arrays.
struct Written<'a>(&'a Rows);

impl Serialize for Written<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut all = to.serialize_seq(Some(self.0.len()))?;
        for row in self.0.iter() {
            all.serialize_element(&WrittenRow(row))?;
        }
        all.end()
    }
}

struct WrittenRow<'a>(&'a [Value]);

impl Serialize for WrittenRow<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut row = to.serialize_seq(Some(self.0.len()))?;
        for value in self.0 {
            match value {
                Value::Number(number) => row.serialize_element(number)?,
                Value::Text(text) => row.serialize_element(text.as_str())?,
            }
        }
        row.end()
    }
}

/// An identity as it is read: its JSON without the rows, and the rows.
#[derive(Debug)]
pub(super) struct Parted {
    pub(super) json: Json,
    pub(super) rows: Option<Rows>,
}

impl<'de> Deserialize<'de> for Parted {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Parted, D::Error> {
        let mut rows = None;
        let json = Part { path: &[PHYSICS, GRID], rows: &mut rows }.deserialize(from)?;
        Ok(Parted { json, rows })
    }
}

/// An object in which the rows stand so many keys down.
struct Part<'a> {
    path: &'static [&'static str],
    rows: &'a mut Option<Rows>,
}

impl<'de> DeserializeSeed<'de> for Part<'_> {
    type Value = Json;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<Json, D::Error> {
        from.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for Part<'_> {
    type Value = Json;

    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Json, A::Error> {
        let mut object = Object::new();
        while let Some(key) = map.next_key::<String>()? {
            let json = match self.path {
                [first, path @ ..] if *first == key => {
                    map.next_value_seed(Part { path, rows: &mut *self.rows })?
                }
                [] if key == ROWS => {
                    *self.rows = Some(map.next_value::<Read>()?.0);
                    Json::Null
                }
                _ => map.next_value()?,
            };
            object.insert(key, json);
        }
        Ok(Json::Object(object))
    }
}

/// Rows that were read.
struct Read(Rows);

impl<'de> Deserialize<'de> for Read {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Read, D::Error> {
        from.deserialize_seq(ReadRows)
    }
}

struct ReadRows;

impl<'de> Visitor<'de> for ReadRows {
    type Value = Read;

    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("rows")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Read, A::Error> {
        let (mut names, mut values) = (Names::default(), Vec::new());
        let (mut width, mut count) = (None, 0);
        let mut before = 0;
        while seq.next_element_seed(ReadRow { names: &mut names, values: &mut values })?.is_some() {
            let found = values.len() - before;
            if *width.get_or_insert(found) != found {
                return Err(A::Error::custom("its rows differ in length"));
            }
            before = values.len();
            count += 1;
        }
        Ok(Read(Rows::new(width.unwrap_or(0), count, values)))
    }
}

/// Appends the values of a row.
struct ReadRow<'a> {
    names: &'a mut Names,
    values: &'a mut Vec<Value>,
}

impl<'de> DeserializeSeed<'de> for ReadRow<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<(), D::Error> {
        from.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for ReadRow<'_> {
    type Value = ();

    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("a row of numbers and names")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<(), A::Error> {
        while let Some(value) = seq.next_element_seed(ReadValue { names: &mut *self.names })? {
            self.values.push(value);
        }
        Ok(())
    }
}

/// A number, or a name.
struct ReadValue<'a> {
    names: &'a mut Names,
}

impl<'de> DeserializeSeed<'de> for ReadValue<'_> {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<Value, D::Error> {
        from.deserialize_any(self)
    }
}

impl Visitor<'_> for ReadValue<'_> {
    type Value = Value;

    fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str("a number or a name")
    }

    fn visit_f64<E>(self, number: f64) -> Result<Value, E> {
        Ok(Value::Number(number))
    }

    fn visit_u64<E>(self, number: u64) -> Result<Value, E> {
        Ok(Value::Number(number as f64))
    }

    fn visit_i64<E>(self, number: i64) -> Result<Value, E> {
        Ok(Value::Number(number as f64))
    }

    fn visit_str<E>(self, name: &str) -> Result<Value, E> {
        Ok(self.names.value(name))
    }
}
