//! A map's columns by name, as numbers per instance and as arrays over its axes.

use crate::results::arrays::{Arrays, Coordinate};
use crate::results::error::Result;
use crate::sweep::columns::{Cell, Column, Content, columns};
use crate::sweep::error::Error;
use crate::sweep::map::Map;
use crate::sweep::sheet::Sheet;
use crate::sweep::spec::names::advice;
use squealmap_input::place::Place;

impl Map {
    /// The columns that a map has, those of `map.csv`: what varies, then what was computed.
    #[must_use]
    pub fn columns(&self) -> Vec<Column> {
        columns(&self.spec.grid, self.spec.analysis)
    }

    /// The numbers of a column, one per instance, in the unit of the column; NaN where one is undefined.
    ///
    /// # Errors
    /// When the map has no such column, or it is one of names.
    pub fn column(&self, name: &str) -> Result<Vec<f64>> {
        let column = self.named(name, false)?;
        Ok(self.cells(&column, |cell| match cell {
            Cell::Number(number) => number,
            Cell::Count(count) => count as f64,
            Cell::Empty | Cell::Text(_) => f64::NAN,
        }))
    }

    /// The names in a column such as `type` or `regime`, one per instance; `None` where one is undefined.
    ///
    /// # Errors
    /// When the map has no such column, or it is one of numbers.
    pub fn names(&self, name: &str) -> Result<Vec<Option<String>>> {
        let column = self.named(name, true)?;
        Ok(self.cells(&column, |cell| match cell {
            Cell::Text(text) => Some(text),
            Cell::Empty | Cell::Number(_) | Cell::Count(_) => None,
        }))
    }

    /// A column of numbers over the axes of the map.
    ///
    /// # Errors
    /// As [`Map::column`].
    pub fn array(&self, name: &str) -> Result<Array> {
        let column = self.named(name, false)?;
        let Arrays { dimensions, coordinates, .. } = Arrays::new(Sheet::from(self));
        let values = self.column(name)?;
        Ok(Array { name: column.name, unit: column.unit, dimensions, coordinates, values })
    }

    fn cells<T>(&self, column: &Column, value: impl Fn(Cell) -> T) -> Vec<T> {
        let records = self.records.iter().enumerate();
        records
            .map(|(index, record)| value(column.cell(index, &self.spec.grid.coordinates(index), record)))
            .collect()
    }

    /// The column of this name, of names or of numbers.
    fn named(&self, name: &str, of_names: bool) -> Result<Column> {
        let all = self.columns();
        let at = || Place::argument(if of_names { ".names" } else { ".column" }, name, 0..name.len());
        let Some(column) = all.iter().find(|column| column.name == name) else {
            let names: Vec<&str> = all.iter().map(|column| column.name).collect();
            return Err(Error::Unknown {
                at: at(),
                what: "column",
                name: name.to_owned(),
                within: "of the map".to_owned(),
                advice: advice(name, &names),
            }
            .into());
        };
        if (column.content() == Content::Name) == of_names {
            return Ok(*column);
        }
        let kinds = ["a column of numbers, which `column` gives", "a column of names, which `names` gives"];
        let [expected, found] = if of_names { [kinds[1], kinds[0]] } else { kinds };
        let (expected, found) = (expected.to_owned(), found.to_owned());
        Err(Error::WrongType { at: at(), key: format!("`{name}`"), expected, found }.into())
    }
}

/// The numbers of a column over the axes of a map; NaN where one is undefined.
#[derive(Clone, Debug)]
pub struct Array {
    /// The name of the column.
    pub name: &'static str,
    /// Its SI unit; empty when dimensionless.
    pub unit: &'static str,
    /// Names and lengths of the dimensions: the axes in their order, or `instance` of single points.
    pub dimensions: Vec<(&'static str, usize)>,
    /// The values along the dimensions.
    pub coordinates: Vec<Coordinate>,
    /// The numbers; the last dimension varies fastest.
    pub values: Vec<f64>,
}

impl Array {
    /// The lengths of the dimensions.
    #[must_use]
    pub fn shape(&self) -> Vec<usize> {
        self.dimensions.iter().map(|(_, length)| *length).collect()
    }

    /// The values of an axis; `None` where there is no such axis.
    #[must_use]
    pub fn along(&self, axis: &str) -> Option<&[f64]> {
        let found = self.coordinates.iter().find(|coordinate| coordinate.name == axis)?;
        Some(&found.values)
    }

    /// The number at one place of every dimension; `None` beyond.
    #[must_use]
    pub fn get(&self, indices: &[usize]) -> Option<f64> {
        if indices.len() != self.dimensions.len() {
            return None;
        }
        let mut at = 0;
        for (index, (_, length)) in indices.iter().zip(&self.dimensions) {
            if index >= length {
                return None;
            }
            at = at * length + index;
        }
        self.values.get(at).copied()
    }

    /// The array over the other axes at value `index` of an axis; `None` where there is no such axis or value.
    #[must_use]
    pub fn at(&self, axis: &str, index: usize) -> Option<Array> {
        let dimension = self.dimensions.iter().position(|(name, _)| *name == axis)?;
        let length = self.dimensions[dimension].1;
        if index >= length {
            return None;
        }
        let inner: usize = self.dimensions[dimension + 1..].iter().map(|(_, length)| length).product();
        let mut taken = Array { values: Vec::with_capacity(self.values.len() / length), ..self.clone() };
        for block in self.values.chunks_exact(length * inner) {
            taken.values.extend_from_slice(&block[index * inner..(index + 1) * inner]);
        }
        taken.dimensions.remove(dimension);
        taken.coordinates.retain(|coordinate| coordinate.dimension != dimension);
        for coordinate in &mut taken.coordinates {
            coordinate.dimension -= usize::from(coordinate.dimension > dimension);
        }
        Some(taken)
    }
}
