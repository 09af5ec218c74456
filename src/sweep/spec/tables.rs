//! Files of tables of friction: one, or one for every temperature of a material.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use crate::model;
use crate::model::friction::MuTable;
use crate::sweep::error::{Error, Result};
use crate::sweep::spec::rows::{Role, Rows};
use squealmap_input::place::Source;

/// What a column of tables holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Column {
    Velocity,
    Mu,
    /// The standard error of μ, which a sweep does not read.
    MuError,
}

/// The columns of tables by their names; a table by itself has the first two.
pub(super) const COLUMNS: [(&str, Column); 3] =
    [(VELOCITY, Column::Velocity), ("mu", Column::Mu), ("mu_error", Column::MuError)];

const VELOCITY: &str = "velocity";

/// Reads a table of friction against velocity: `velocity`, `mu`.
pub(super) fn read(source: &Source, span: Range<usize>, name: &str, base_dir: &Path) -> Result<Arc<MuTable>> {
    table_of(&Rows::read(source, span, Role::Table, &names(), name, base_dir)?)
}

fn names() -> [&'static str; 2] {
    [COLUMNS[0].0, COLUMNS[1].0]
}

/// The table of friction that some rows are.
pub(super) fn table_of(file: &Rows) -> Result<Arc<MuTable>> {
    let known = &COLUMNS[..2];
    let columns = file
        .columns(&names(), |text| known.iter().find(|(name, _)| *name == text).map(|(_, column)| *column))?;
    let whole =
        Whole::read(file, "a friction table", |wanted| columns.iter().position(|one| *one == wanted))?;
    whole.part(0..file.len(), None)
}

/// The temperatures of a material with the table of each; `place` is the position of a column. Rows of one temperature stand
/// together.
pub(super) fn by_temperature(
    file: &Rows,
    (column, values): (usize, &[f64]),
    place: impl Fn(Column) -> Option<usize>,
) -> Result<(Vec<f64>, Vec<Arc<MuTable>>)> {
    let whole = Whole::read(file, "a material of tables of friction", place)?;
    let (mut temperatures, mut tables) = (Vec::new(), Vec::new());
    let mut start = 0;
    for rows in values.chunk_by(|a, b| a.total_cmp(b).is_eq()) {
        let value = rows[0];
        if let Some(last) = temperatures.last().filter(|last| **last >= value) {
            return Err(Error::OutOfRange {
                at: file.source.place(file.span(start, column)),
                key: "column `temperature`".to_owned(),
                value: value.to_string(),
                limit: format!(
                    "above {last}, that of the rows before: put all rows of a temperature together, and temperatures in rising order"
                ),
            });
        }
        tables.push(whole.part(start..start + rows.len(), Some(value))?);
        temperatures.push(value);
        start += rows.len();
    }
    Ok((temperatures, tables))
}

/// Columns of velocity and μ, of one table or several.
struct Whole<'a> {
    file: &'a Rows,
    velocity: (usize, Vec<f64>),
    mu: Vec<f64>,
}

impl Whole<'_> {
    /// The columns of `what` by their places.
    fn read<'a>(file: &'a Rows, what: &str, place: impl Fn(Column) -> Option<usize>) -> Result<Whole<'a>> {
        let numbers = |(name, column)| -> Result<(usize, Vec<f64>)> {
            let index = place(column).ok_or_else(|| file.no_column(name, what))?;
            Ok((index, file.numbers(index, name, model::Range::NonNegative)?))
        };
        let (velocity, (_, mu)) = (numbers(COLUMNS[0])?, numbers(COLUMNS[1])?);
        Ok(Whole { file, velocity, mu })
    }

    /// The table of some rows, at a temperature where there are several.
    fn part(&self, rows: Range<usize>, temperature: Option<f64>) -> Result<Arc<MuTable>> {
        let place = |row: usize| self.file.source.place(self.file.span(row, self.velocity.0));
        let (velocity, mu) = (&self.velocity.1[rows.clone()], &self.mu[rows.clone()]);
        let at = temperature.map(|temperature| format!(" at {temperature} °C")).unwrap_or_default();
        if let Some(row) = velocity.windows(2).position(|pair| pair[0] >= pair[1]) {
            let (previous, value) = (velocity[row], velocity[row + 1]);
            let at_row = place(rows.start + row + 1);
            return Err(match temperature {
                None => Error::NotRising { at: at_row, column: VELOCITY, value, previous },
                Some(_) => Error::OutOfRange {
                    at: at_row,
                    key: "column `velocity`".to_owned(),
                    value: value.to_string(),
                    limit: format!(
                        "above {previous}, that of the row before{at}: sort the rows of each temperature, with each velocity once"
                    ),
                },
            });
        }
        if velocity[0] > 0.0 {
            return Err(Error::OutOfRange {
                at: place(rows.start),
                key: format!("the first `velocity`{at}"),
                value: velocity[0].to_string(),
                limit: "0, where the table gives the limit of stick".to_owned(),
            });
        }
        if velocity.len() < 2 {
            return Err(Error::OutOfRange {
                at: place(rows.start),
                key: format!("the number of rows of a friction table{at}"),
                value: velocity.len().to_string(),
                limit: "at least 2; for one value choose law = \"constant\"".to_owned(),
            });
        }
        Ok(Arc::new(MuTable { velocity: velocity.to_vec(), mu: mu.to_vec() }))
    }
}
