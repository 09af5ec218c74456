//! The file of a motion of the belt.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use crate::model;
use crate::model::motion::MotionTable;
use crate::sweep::error::{Error, Result};
use crate::sweep::spec::rows::{Role, Rows};
use squealmap_input::place::Source;

/// The columns of a motion.
const COLUMNS: [&str; 3] = ["time", "velocity", "temperature"];

/// Reads the file `name` of a motion, relative to `base_dir`, which stands at `span` of `sweep`.
pub(super) fn read(
    sweep: &Source,
    span: Range<usize>,
    name: &str,
    base_dir: &Path,
) -> Result<Arc<MotionTable>> {
    motion_of(name, &Rows::read(sweep, span, Role::Motion, &COLUMNS, name, base_dir)?)
}

/// The motion that some rows are.
pub(super) fn motion_of(name: &str, file: &Rows) -> Result<Arc<MotionTable>> {
    let columns = file.columns(&COLUMNS, |text| COLUMNS.iter().position(|name| *name == text))?;
    let mut values = [None, None, None];
    for (index, &which) in columns.iter().enumerate() {
        let range = if which == 2 { model::Range::Finite } else { model::Range::NonNegative };
        let numbers = file.numbers(index, COLUMNS[which], range)?;
        let wrong = |key: &str, value: String, limit: &str| Error::OutOfRange {
            at: file.source.place(file.span(0, index)),
            key: key.to_owned(),
            value,
            limit: limit.to_owned(),
        };
        if which == 0 {
            file.rising("time", index, &numbers)?;
            if numbers[0] > 0.0 {
                return Err(wrong("the first `time`", numbers[0].to_string(), "0, where a run begins"));
            }
            if numbers.len() < 2 {
                let limit = "at least 2; for one velocity give `belt_velocity` alone";
                return Err(wrong("the number of rows of a motion", numbers.len().to_string(), limit));
            }
        } else if which == 1 && numbers.iter().all(|velocity| *velocity == 0.0) {
            return Err(wrong("every `velocity`", "0".to_owned(), "above 0 somewhere"));
        }
        values[which] = Some(numbers);
    }
    let [time, velocity, temperature] = values;
    let time = time.ok_or_else(|| file.no_column("time", "a motion of the belt"))?;
    let velocity = velocity.ok_or_else(|| file.no_column("velocity", "a motion of the belt"))?;
    let corners = |values: Vec<f64>| time.iter().zip(values).map(|(time, value)| [*time, value]).collect();
    let (corners, temperature) = (corners(velocity), temperature.map(corners));
    Ok(Arc::new(MotionTable { name: name.to_owned(), corners, temperature }))
}
