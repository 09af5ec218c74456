//! The cells of a rectangle of the map.

use serde::Deserialize;
use serde_json::json;
use squealmap::engine::precision::Precision;
use squealmap::engine::record::Record;
use squealmap::sweep::columns::{Cell, Column, Content, Values, columns};
use squealmap::sweep::grid::{Axis, AxisKey, Grid, Value, spaced};
use squealmap::sweep::solver::Solver;
use squealmap::sweep::spec::{Analysis, Spec, Starts};
use squealmap::{Backend, Options};

use crate::answer::Answer;
use crate::opened::Opened;
use crate::place::{At, allowed, value};

/// The most cells of one question: a worker answers in seconds, and can be asked for something else.
pub const MOST_CELLS: usize = 1 << 20;

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
        for end in [self.from, self.to] {
            allowed(param, end)?;
        }
        let value = |k| Value::Number(spaced([self.from, self.to], self.points, self.log, k));
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

    /// Its cells: the wanted columns one after the other, each row by row from the first value up; names by their codes.
    ///
    /// # Errors
    /// A sentence that names what is wrong.
    pub fn answer(&self, opened: &Opened) -> Result<Answer, String> {
        let spec = self.spec(opened)?;
        let wanted = self.wanted(&spec)?;
        let options = Options {
            backend: Backend::Cpu,
            precision: (self.f32 && spec.analysis.response).then_some(Precision::F32),
            ..Options::default()
        };
        let mut solver = Solver::new(&spec, &options).map_err(|why| why.to_string())?;
        let records = solver.records(0..spec.grid.len(), &|_| ()).map_err(|why| why.to_string())?.records;
        Ok(answered(&spec, &wanted, &self.columns, &records))
    }

    /// The wanted columns.
    ///
    /// # Errors
    /// A sentence, when there is none of a name.
    pub fn wanted(&self, spec: &Spec) -> Result<Vec<Column>, String> {
        let all = columns(&spec.grid, spec.analysis);
        let wanted = |name: &String| {
            let found = all.iter().find(|column| column.name == name).copied();
            found.ok_or_else(|| format!("there is no column `{name}` here"))
        };
        self.columns.iter().map(wanted).collect()
    }
}

/// The wanted columns of the cells of a region, by `names`.
#[must_use]
pub fn answered(spec: &Spec, wanted: &[Column], names: &[String], records: &[Record]) -> Answer {
    let mut numbers = Vec::with_capacity(records.len() * wanted.len());
    for column in wanted {
        numbers.extend(records.iter().enumerate().map(|(index, record)| {
            match column.cell(index, &spec.grid.coordinates(index), record) {
                Cell::Number(number) => number,
                Cell::Count(count) => count as f64,
                Cell::Empty => f64::NAN,
                Cell::Text(name) => code(column, &name),
            }
        }));
    }
    let shape = match &spec.grid {
        Grid::Axes(axes) => axes.iter().rev().take(2).rev().map(|axis| axis.values.len()).collect(),
        Grid::Tuples { .. } => vec![records.len()],
    };
    Answer { head: json!({ "columns": names, "shape": shape }), numbers, ..Answer::default() }
}

/// The names that a column may hold, in the order of their codes.
#[must_use]
pub fn names(column: &Column) -> Vec<&'static str> {
    let class = column.values().filter(|_| column.content() == Content::Name).and_then(Values::class);
    class.map_or_else(Vec::new, |class| class.names().collect())
}

/// The place of a name among those of its column.
fn code(column: &Column, name: &str) -> f64 {
    names(column).iter().position(|one| *one == name).map_or(f64::NAN, |place| place as f64)
}
