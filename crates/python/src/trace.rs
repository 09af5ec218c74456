//! One instance in time.

use pyo3::prelude::*;
use pyo3::types::PyTuple;
use squealmap::cli::failed::without_result;
use squealmap::model::contact::ContactState;
use squealmap::model::status::Status;
use squealmap::results::figure::heading::Heading;
use squealmap::study::trace::run::{Trace, TraceRow, has_room, trace as traced};
use squealmap::study::trace::table::{COLUMNS, document};
use squealmap::sweep::spec::Spec;

use crate::dataset::{Column, Dataset, Named};
use crate::failure::Failure;
use crate::map::attributes;
use crate::sweep::Sweep;
use crate::watch::whole;

/// Unit and meaning of the columns but the last, in the order of [`COLUMNS`].
const SAID: [[&str; 2]; 12] = [
    ["s", "time"],
    ["m", "displacement of m2 along the belt"],
    ["m", "displacement of m2 normal to the belt"],
    ["m", "displacement of m1 normal to the belt"],
    ["m/s", "velocity of m2 along the belt"],
    ["m/s", "velocity of m2 normal to the belt"],
    ["m/s", "velocity of m1 normal to the belt"],
    ["m/s2", "acceleration of m2 along the belt"],
    ["m/s2", "acceleration of m2 normal to the belt"],
    ["m/s2", "acceleration of m1 normal to the belt"],
    ["N", "normal force of the contact"],
    ["N", "tangential force of the contact"],
];

/// Samples per period that the command line takes.
const SAMPLES: std::ops::RangeInclusive<u32> = 1..=10_000;

/// The motion of one instance, which `at` or a number chooses.
#[pyfunction]
pub(crate) fn trace(
    py: Python<'_>,
    sweep: Sweep,
    at: String,
    instance: Option<usize>,
    samples_per_period: u32,
) -> PyResult<Bound<'_, PyTuple>> {
    whole(py, move |_| {
        if !SAMPLES.contains(&samples_per_period) {
            return Err(Failure::input(format!(
                "samples_per_period is {samples_per_period} but must be from {} to {}",
                SAMPLES.start(),
                SAMPLES.end()
            )));
        }
        let spec = sweep.spec()?;
        spec.of_two_masses("`trace`")?;
        let (instance, at) = match instance {
            None => (spec.instance_at(&at)?, at),
            Some(number) => spec.numbered(number)?,
        };
        has_room(&spec, &instance, samples_per_period)?;
        let trace = traced(&spec, &instance, samples_per_period);
        if trace.rows.is_empty() && trace.outcome.status != Status::Ok {
            return Err(Failure::run(without_result(trace.outcome.status)));
        }
        dataset(&spec, &trace, &at)
    })?
    .handed(py)
}

fn dataset(spec: &Spec, trace: &Trace, at: &str) -> Result<Dataset, Failure> {
    let column = |of: fn(&TraceRow) -> f64| Column::Numbers(trace.rows.iter().map(of).collect());
    let columns = [
        column(|row| row.t),
        column(|row| row.position[0]),
        column(|row| row.position[1]),
        column(|row| row.position[2]),
        column(|row| row.velocity[0]),
        column(|row| row.velocity[1]),
        column(|row| row.velocity[2]),
        column(|row| row.acceleration[0]),
        column(|row| row.acceleration[1]),
        column(|row| row.acceleration[2]),
        column(|row| row.normal_force),
        column(|row| row.tangential_force),
    ];
    let named = COLUMNS.iter().zip(columns).zip(SAID);
    let mut named = named.map(|((name, column), said)| Named::new(*name, &["t"], column, said));
    let coordinates = named.next().into_iter().collect();
    let mut variables: Vec<Named> = named.collect();
    let codes: Vec<(i8, String)> =
        (0..).zip(ContactState::ALL).map(|(code, state)| (code, state.name().to_owned())).collect();
    let code = |row: &TraceRow| {
        let found = (0..).zip(ContactState::ALL).find(|(_, state)| *state == row.state);
        found.map_or(-1, |(code, _)| code)
    };
    let states = Column::Codes(trace.rows.iter().map(code).collect(), codes);
    variables.push(Named::new(COLUMNS[12], &["t"], states, ["", "state of the contact"]));
    let document = String::from_utf8_lossy(&document(trace, &Heading::new(&spec.title, at))?).into_owned();
    let mut attributes = attributes("trace", &spec.title, document);
    attributes.extend([("at", at.to_owned()), ("status", trace.outcome.status.name().to_owned())]);
    Ok(Dataset { dimensions: vec![("t".to_owned(), trace.rows.len())], coordinates, variables, attributes })
}
