//! A part of a map: the instances that have some values of its axes.

use crate::results::choose::{Taken, axes, choose_all};
use crate::results::error::{Error, Result};
use crate::results::number::NumberColumn;
use crate::results::read::Archive;
use crate::sweep::grid::{Axis, Grid, Value};
use crate::sweep::map::Map;
use crate::sweep::spec::Spec;

impl Archive {
    /// The instances whose axes have given values, such as `law=bilinear,theta=0.01`, and what was taken for each value that
    /// an axis does not have. An axis that is named several times keeps each of these values.
    ///
    /// # Errors
    /// When the map has no such axis or value.
    pub fn slice(&self, select: &str) -> Result<(Archive, Vec<Taken>)> {
        let refused = |why: String| Error::Select { select: select.to_owned(), why };
        let all = axes(&self.map.spec.grid);
        let choices = choose_all(&all, select).map_err(refused)?;
        // Whether a value of an axis stays: where none of it is named, all do.
        let stays_on = |number: usize, value: &Value| {
            let mut named = choices.iter().filter(|choice| choice.axis == number).peekable();
            named.peek().is_none() || named.any(|choice| same(&all[number].values[choice.value], value))
        };
        let grid = &self.map.spec.grid;
        let stays = |instance: &usize| {
            let mut held = grid.coordinates(*instance).into_iter().enumerate();
            held.all(|(number, value)| stays_on(number, value))
        };
        let instances: Vec<usize> = (0..grid.len()).filter(stays).collect();
        if instances.is_empty() {
            return Err(refused("no instance of the list has all of these values".to_owned()));
        }
        let grid = match grid {
            Grid::Axes(axes) => {
                let of = |(number, axis): (usize, &Axis)| Axis {
                    key: axis.key,
                    values: axis.values.iter().filter(|value| stays_on(number, value)).cloned().collect(),
                    log: axis.log,
                };
                Grid::Axes(axes.iter().enumerate().map(of).collect())
            }
            Grid::Tuples { keys, rows } => Grid::Tuples {
                keys: keys.clone(),
                rows: instances.iter().map(|instance| rows[*instance].to_vec()).collect(),
            },
        };
        let of = |column: &NumberColumn| NumberColumn {
            name: column.name.clone(),
            unit: column.unit.clone(),
            meaning: column.meaning.clone(),
            values: instances
                .iter()
                .map(|instance| column.values.get(*instance).copied().flatten())
                .collect(),
        };
        let map = Map {
            spec: Spec { grid, ..self.map.spec.clone() },
            records: instances.iter().filter_map(|one| self.map.records.get(*one).cloned()).collect(),
            stopped: self.map.stopped.clone(),
            provenance: self.map.provenance.clone(),
        };
        let columns = self.columns.iter().map(of).collect();
        let taken = choices.into_iter().filter_map(|choice| choice.taken).collect();
        Ok((Archive { map, columns, program: self.program.clone() }, taken))
    }
}

/// Whether two values are one, to the bit.
fn same(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => a.to_bits() == b.to_bits(),
        (a, b) => a == b,
    }
}
