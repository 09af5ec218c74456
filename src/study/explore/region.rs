//! The cells of a rectangle of the map.

use serde::Deserialize;
use serde_json::json;
use squealmap_input::quote::quoted;

use crate::engine::record::Record;
use crate::study::explore::answer::Answer;
use crate::study::explore::by::By;
use crate::study::explore::finished::Known;
use crate::study::explore::opened::Opened;
use crate::study::explore::place::{At, allowed, value};
use crate::sweep::accuracy::sample::subset;
use crate::sweep::columns::{Cell, Column, Content, Values, columns};
use crate::sweep::grid::{Axis, AxisKey, Grid, Value, spaced};
use crate::sweep::spec::{Analysis, Spec, Starts};

/// The most cells of one question: an engine answers in seconds, and can be asked for something else.
pub const MOST_CELLS: usize = 1 << 18;

/// The most numbers of one answer.
pub const MOST_NUMBERS: usize = 1 << 24;

/// One side of a rectangle.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Side {
    /// The parameter.
    pub key: String,
    /// Its first value.
    pub from: f64,
    /// Its last value.
    pub to: f64,
    /// How many values, the first and the last among them.
    pub points: usize,
    /// Whether they are spaced by a factor.
    #[serde(default)]
    pub log: bool,
    /// The values themselves, where they are spaced otherwise: as many, with the same ends.
    #[serde(default)]
    pub values: Vec<f64>,
}

impl Side {
    fn axis(&self) -> Result<Axis, String> {
        let Some(AxisKey::Param(param)) = AxisKey::from_name(&self.key) else {
            return Err(format!("`{}` is no parameter that a side may have", self.key));
        };
        if self.points == 0 || self.points > MOST_CELLS {
            return Err(format!("`{}` has {} points, and may have 1 to {MOST_CELLS}", self.key, self.points));
        }
        if self.log && (self.from <= 0.0 || self.to <= 0.0) {
            return Err(format!("`{}` is spaced by a factor, and has to be above 0", self.key));
        }
        for value in [self.from, self.to].iter().chain(&self.values) {
            allowed(param, *value)?;
        }
        let ends = [self.values.first(), self.values.last()];
        let listed = !self.values.is_empty();
        if listed && (self.values.len() != self.points || ends != [Some(&self.from), Some(&self.to)]) {
            let count = self.values.len();
            return Err(format!(
                "the {count} `values` of `{}` have to be {} from {} to {}",
                self.key, self.points, self.from, self.to
            ));
        }
        let number = |k: usize| match self.values.get(k) {
            Some(value) => *value,
            None => spaced([self.from, self.to], self.points, self.log, k),
        };
        let value = |k| Value::Number(number(k));
        Ok(Axis { key: AxisKey::Param(param), values: (0..self.points).map(value).collect(), log: self.log })
    }
}

/// A rectangle of the map.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Region {
    /// Across; varies fastest.
    pub x: Side,
    /// Up.
    pub y: Side,
    /// Everything else that has a value of its own: every other axis of the sweep, and any parameter.
    #[serde(default)]
    pub at: At,
    /// Whether transients are integrated.
    #[serde(default)]
    pub response: bool,
    /// Whether they are integrated in f32: twice as fast.
    #[serde(default)]
    pub f32: bool,
    /// The columns that are wanted.
    pub columns: Vec<String>,
}

impl Region {
    /// The sweep of the region.
    ///
    /// # Errors
    /// A sentence that names what is wrong.
    pub fn spec(&self, opened: &Opened) -> Result<Spec, String> {
        let (x, y) = (self.x.axis()?, self.y.axis()?);
        if x.key == y.key {
            return Err(format!("`{}` stands on both sides", self.x.key));
        }
        let cells = self.x.points.checked_mul(self.y.points).filter(|cells| *cells <= MOST_CELLS);
        if cells.is_none() {
            let Side { points, .. } = self.y;
            return Err(format!("{} x {points} cells are more than {MOST_CELLS} at once", self.x.points));
        }
        let mut axes = Vec::new();
        for (name, given) in &self.at {
            let (key, value) = value(name, given)?;
            if [x.key, y.key].contains(&key) {
                return Err(format!("`{name}` stands on a side and in `at`"));
            }
            // What a law or a material needs is known of those of the sweep alone.
            let of_sweep = || opened.axes.iter().any(|axis| axis.key == key && axis.values.contains(&value));
            if let Value::Text(text) = &value
                && !of_sweep()
            {
                let text = quoted(text);
                return Err(format!("`{name}` is `{text}`, which is no value of an axis of the sweep"));
            }
            axes.push(Axis { key, values: vec![value], log: false });
        }
        for open in &opened.axes {
            if [x.key, y.key].contains(&open.key) || axes.iter().any(|axis| axis.key == open.key) {
                continue;
            }
            return Err(format!("`at` has no value of `{}`, which the sweep varies", open.key.name()));
        }
        axes.extend([y, x]);
        let spec = &opened.spec;
        for axis in &axes {
            let AxisKey::Param(param) = axis.key else { continue };
            if let Some(by) = spec.unread(param) {
                return Err(format!("`{}` has no effect here: only {by} reads it", param.info().name));
            }
        }
        let response = self.response && spec.modal.is_none();
        let analysis = Analysis {
            linear: true,
            response,
            until_settled: response && spec.settle_limit.is_some(),
            finds_cycles: response && spec.analysis.finds_cycles,
            checked: false,
            starts: Starts::One,
        };
        Ok(Spec { analysis, grid: Grid::Axes(axes), refine: None, ..spec.clone() })
    }

    /// Its cells: the wanted columns one after the other, each row by row from the first value up; names by their codes. What a finished
    /// run has computed comes from there, the others `by` an engine; `of_run` says how many are the run's.
    ///
    /// # Errors
    /// A sentence that names what is wrong.
    pub fn answer(&self, opened: &Opened, by: &By<'_>) -> Result<Answer, String> {
        let spec = self.spec(opened)?;
        let wanted = self.wanted(&spec)?;
        let Some(Known { cells, columns }) = self.known(opened, &spec) else {
            return Ok(answered(&spec, &wanted, &self.columns, &by.records(&spec, self.f32)?));
        };
        let lacking: Vec<usize> = (0..cells.len()).filter(|cell| cells[*cell].is_none()).collect();
        let others = subset(&spec, &lacking);
        let records = if lacking.is_empty() { Vec::new() } else { by.records(&others, self.f32)? };
        let mut numbers = Vec::with_capacity(cells.len() * wanted.len());
        for (column, known) in wanted.iter().zip(columns) {
            let fresh = |(cell, record): (&usize, &Record)| number(column, &spec.grid, *cell, record);
            let mut computed = lacking.iter().zip(&records).map(fresh);
            numbers.extend(cells.iter().map(|instance| match instance {
                Some(instance) => known[*instance],
                None => computed.next().unwrap_or(f64::NAN),
            }));
        }
        Ok(headed(&spec, &self.columns, numbers, cells.len() - lacking.len()))
    }

    /// What a finished run has of it.
    fn known<'a>(&self, opened: &'a Opened, spec: &Spec) -> Option<Known<'a>> {
        let Grid::Axes(axes) = &spec.grid else { return None };
        opened.finished.as_ref()?.known(&self.columns, axes, &opened.spec)
    }

    /// The wanted columns.
    ///
    /// # Errors
    /// A sentence, when there is none of a name.
    pub fn wanted(&self, spec: &Spec) -> Result<Vec<Column>, String> {
        let all = columns(&spec.grid, spec.analysis);
        let numbers = spec.grid.len().saturating_mul(self.columns.len());
        if numbers > MOST_NUMBERS {
            let count = self.columns.len();
            return Err(format!(
                "{count} columns of {} cells are more than {MOST_NUMBERS} numbers at once",
                spec.grid.len()
            ));
        }
        let wanted = |name: &String| {
            let found = all.iter().find(|column| column.name == name).copied();
            found.ok_or_else(|| format!("there is no column `{name}` here"))
        };
        self.columns.iter().map(wanted).collect()
    }
}

/// The wanted columns of the cells of a region, by `names`, all of them computed.
#[must_use]
pub fn answered(spec: &Spec, wanted: &[Column], names: &[String], records: &[Record]) -> Answer {
    let mut numbers = Vec::with_capacity(records.len() * wanted.len());
    for column in wanted {
        let cells = records.iter().enumerate();
        numbers.extend(cells.map(|(index, record)| number(column, &spec.grid, index, record)));
    }
    headed(spec, names, numbers, 0)
}

fn headed(spec: &Spec, names: &[String], numbers: Vec<f64>, of_run: usize) -> Answer {
    let shape = match &spec.grid {
        Grid::Axes(axes) => axes.iter().rev().take(2).rev().map(|axis| axis.values.len()).collect(),
        Grid::Tuples { rows, .. } => vec![rows.len()],
    };
    let head = json!({ "columns": names, "shape": shape, "of_run": of_run });
    Answer { head, numbers, ..Answer::default() }
}

/// The names that a column may hold, in the order of their codes.
#[must_use]
pub fn names(column: &Column) -> Vec<&'static str> {
    let class = column.values().filter(|_| column.content() == Content::Name).and_then(Values::class);
    class.map_or_else(Vec::new, |class| class.names().collect())
}

/// The number of a column for an instance of a grid and its record: a name by its place among those of its column, NaN where it is
/// undefined. Nothing is made on the way that is thrown away: a map has many cells.
#[must_use]
pub fn number(column: &Column, grid: &Grid, index: usize, record: &Record) -> f64 {
    let cell = match column.values() {
        Some(Values::Name(class)) => {
            return class.position(column.of(record)).map_or(f64::NAN, |place| place as f64);
        }
        Some(_) => column.cell(index, &[], record),
        None => column.cell(index, &grid.coordinates(index), record),
    };
    match cell {
        Cell::Number(number) => number,
        Cell::Count(count) => count as f64,
        Cell::Empty | Cell::Text(_) => f64::NAN,
    }
}
