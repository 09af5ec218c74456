//! What a sweep varies: the `[axes]` table or the tuples of `points`, with the place of every value.

use std::ops::Range;
use std::path::Path;

use crate::sweep::error::{Error, Result};
use crate::sweep::grid;
use crate::sweep::grid::{Axis, AxisKey, Grid, Names, Value};
use crate::sweep::spec::MAX_INSTANCES;
use crate::sweep::spec::axis::axis;
use crate::sweep::spec::document::{Entry, entries, table};
use crate::sweep::spec::keys::is_fixed;
use crate::sweep::spec::model::no_key;
use crate::sweep::spec::names::advice;
use crate::sweep::spec::rows::{Role, Rows};
use crate::sweep::spec::sections::law_value;
use squealmap_input::place::{Place, Source};

/// The grid and where everything of it stands.
#[derive(Debug)]
pub(super) struct Varied {
    pub(super) grid: Grid,
    /// The file that the spans belong to: the sweep file, or the one of the tuples.
    pub(super) source: Source,
    /// Where each key of the grid stands.
    pub(super) keys: Vec<(AxisKey, Range<usize>)>,
    /// Where each value of an axis stands: `[axis][value]` (a single place when the values are from `from` to `to`).
    spans: Vec<Vec<Range<usize>>>,
    /// The file of tuples, which is asked where a value stands.
    file: Option<Rows>,
}

impl Varied {
    /// A single instance.
    pub(super) fn nothing(source: &Source) -> Varied {
        let grid = Grid::Axes(Vec::new());
        Varied { grid, source: source.clone(), keys: Vec::new(), spans: Vec::new(), file: None }
    }

    /// Reads `[axes]`.
    pub(super) fn axes(source: &Source, entry: Entry) -> Result<Varied> {
        let mut varied = Varied::nothing(source);
        let expected = "a table, written as a line [axes] above its axes";
        for entry in entries(table(source, entry.node, "`axes`", expected)?) {
            let Some(key) = AxisKey::from_name(entry.key) else {
                return Err(unknown_axis(source, entry));
            };
            varied.add(source, key, &entry.key_span(), &entry.node.span(), |admit| {
                axis(source, key, entry.node, admit)
            })?;
        }
        Ok(varied)
    }

    /// Adds an axis; `make` gives it with the places of its values, and tells their number before they are made.
    pub(super) fn add(
        &mut self,
        source: &Source,
        key: AxisKey,
        at: &Range<usize>,
        whole: &Range<usize>,
        make: impl FnOnce(&mut dyn FnMut(usize) -> Result<()>) -> Result<(Axis, Vec<Range<usize>>)>,
    ) -> Result<()> {
        let Grid::Axes(axes) = &mut self.grid else { return Ok(()) };
        if self.keys.iter().any(|(known, _)| *known == key) {
            let (at, key) = (source.place(at.clone()), format!("axis `{}`", key.name()));
            return Err(Error::Conflict { at, key, other: "an axis of the same name".to_owned() });
        }
        let so_far = axes.iter().fold(1_u128, |count, axis| count.saturating_mul(axis.values.len() as u128));
        // Checked before the values are made: a product that is too large costs no memory.
        let (axis, spans) = make(&mut |points| {
            let count = so_far.saturating_mul(points as u128);
            if count > MAX_INSTANCES as u128 { Err(too_many(source, whole.clone(), count)) } else { Ok(()) }
        })?;
        axes.push(axis);
        self.keys.push((key, at.clone()));
        self.spans.push(spans);
        Ok(())
    }

    /// Reads the file of tuples named `name`.
    pub(super) fn tuples(sweep: &Source, span: Range<usize>, name: &str, base_dir: &Path) -> Result<Varied> {
        let names: Vec<&str> = AxisKey::names().collect();
        Varied::of_rows(Rows::read(sweep, span, Role::Points, &names, name, base_dir)?)
    }

    /// The tuples of a table.
    pub(super) fn of_rows(file: Rows) -> Result<Varied> {
        let names: Vec<&str> = AxisKey::names().collect();
        let keys = file.columns(&names, AxisKey::from_name)?;
        let mut names = Names::default();
        let mut values = Vec::with_capacity(file.len() * keys.len());
        file.each(|_, fields| {
            for (&key, field) in keys.iter().zip(fields) {
                values.push(match key {
                    AxisKey::Param(param) => {
                        Value::Number(file.number(field, key.name(), param.info().range)?)
                    }
                    AxisKey::Law => {
                        law_value(&file.source, field.span.clone(), &field.text, "in column `law`")?;
                        names.value(&field.text)
                    }
                    AxisKey::Material => names.value(&field.text),
                });
            }
            Ok(())
        })?;
        let rows = grid::Rows::new(keys.len(), file.len(), values);
        Ok(Varied {
            keys: keys.iter().copied().zip(file.header.iter().map(|field| field.span.clone())).collect(),
            grid: Grid::Tuples { keys, rows },
            spans: Vec::new(),
            source: file.source.clone(),
            file: Some(file),
        })
    }

    /// Whether its instances are listed one by one.
    pub(super) fn is_tuples(&self) -> bool {
        matches!(self.grid, Grid::Tuples { .. })
    }

    /// How messages name a key of the grid.
    pub(super) fn label(&self, key: AxisKey) -> String {
        match self.grid {
            Grid::Axes(_) => format!("axis `{}`", key.name()),
            Grid::Tuples { .. } => format!("column `{}`", key.name()),
        }
    }

    /// Where a key stands, if it varies.
    pub(super) fn find(&self, key: AxisKey) -> Option<Range<usize>> {
        self.keys.iter().find(|(varied, _)| *varied == key).map(|(_, span)| span.clone())
    }

    /// The place of a value, see [`Varied::value_span`].
    pub(super) fn value_place(&self, key: usize, value: usize) -> Place {
        self.source.place(self.value_span(key, value))
    }

    /// Where a value of axis or column `key` (by position) stands; `value` counts values or rows.
    fn value_span(&self, key: usize, value: usize) -> Range<usize> {
        match &self.file {
            None => self.spans[key].get(value).or_else(|| self.spans[key].last()).cloned().unwrap_or(0..0),
            Some(file) => file.span(value, key),
        }
    }

    /// The position of a key among the axes or columns.
    pub(super) fn position(&self, key: AxisKey) -> Option<usize> {
        self.keys.iter().position(|(varied, _)| *varied == key)
    }

    /// The distinct names of the key `law` or `material` with the place of their first use.
    pub(super) fn names(&self, key: AxisKey) -> Vec<(&str, Range<usize>)> {
        let Some(at) = self.position(key) else { return Vec::new() };
        let values: Box<dyn Iterator<Item = &Value>> = match &self.grid {
            Grid::Axes(axes) => Box::new(axes[at].values.iter()),
            Grid::Tuples { rows, .. } => Box::new(rows.iter().map(move |row| &row[at])),
        };
        let mut first: Vec<(&str, usize)> = Vec::new();
        for (index, value) in values.enumerate() {
            if let Value::Text(name) = value
                && !first.iter().any(|(known, _)| *known == name.as_str())
            {
                first.push((name, index));
            }
        }
        first.into_iter().map(|(name, index)| (name, self.value_span(at, index))).collect()
    }
}

fn too_many(source: &Source, span: Range<usize>, count: u128) -> Error {
    let more = if count == u128::MAX { "more than 10^38".to_owned() } else { format!("at least {count}") };
    Error::TooMany { at: source.place(span), count: more, limit: MAX_INSTANCES }
}

fn unknown_axis(source: &Source, entry: Entry) -> Error {
    let names: Vec<&str> = AxisKey::names().collect();
    let advice = if let Some(why) = no_key(entry.key) {
        why.to_owned()
    } else if is_fixed(entry.key) {
        "this key holds for the whole sweep and cannot vary".to_owned()
    } else {
        advice(entry.key, &names)
    };
    Error::Unknown {
        at: source.place(entry.key_span()),
        what: "axis",
        name: entry.key.to_owned(),
        within: "in [axes]".to_owned(),
        advice,
    }
}
