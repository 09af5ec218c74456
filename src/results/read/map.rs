//! A map read back from the directory that `squealmap run` wrote: what its figures need, and its columns.

use std::path::Path;

use serde::Deserialize;
use serde_json::Value as Json;

use crate::engine::computation::Stopped;
use crate::engine::plan::{Duration, StartKind};
use crate::engine::record::{Basin, Others, Record};
use crate::model::Params;
use crate::model::friction::LawKind;
use crate::model::motion::Motion;
use crate::results::error::Result;
use crate::results::manifest::{Explained, Manifest};
use crate::results::number::NumberColumn;
use crate::results::read::folder::{Folder, HEALED, Table, Why, text};
use crate::sweep::columns::{Column, Values, computed, find};
use crate::sweep::grid::{Axis, AxisKey, Grid, Value};
use crate::sweep::map::{Map, Provenance};
use crate::sweep::spec::duration::{AUTO, CYCLE};
use crate::sweep::spec::{Analysis, Pass, STEPS_PER_PERIOD, Spec, Starts, start};

/// The files of a map that are read.
pub(crate) const FILES: [&str; 2] = ["manifest.json", "map.csv"];

/// A map read back.
#[derive(Clone, Debug)]
pub struct Archive {
    /// The map. Only what figures need is read: title, analysis and grid of its sweep; type, regime, status and `settled` of
    /// its records. Everything else has its default value.
    pub map: Map,
    /// The numeric columns of `map.csv` without the instance and the swept values.
    pub columns: Vec<NumberColumn>,
    /// The program that computed it: version, and commit where known.
    pub program: String,
}

impl Archive {
    /// Reads the directory of a finished or stopped run.
    ///
    /// # Errors
    /// When a file is missing or is not what a run writes.
    pub fn read(directory: &Path) -> Result<Archive> {
        let folder = Folder(directory);
        let document = folder.sealed(FILES[0], HEALED)?;
        let manifest =
            Manifest::deserialize(&document).map_err(|why| folder.bad(FILES[0], why.to_string()))?;
        let table = Table::read(&folder.named(FILES[1], [FILES[0], HEALED], &document)?)
            .map_err(|why| folder.bad(FILES[1], why))?;
        numbers_are_numbers(&manifest, &table).map_err(|why| folder.bad(FILES[1], why))?;
        let spec = spec(&manifest, &table).map_err(|why| folder.bad(FILES[0], why))?;
        let mut records = records(&table).map_err(|why| folder.bad(FILES[1], why))?;
        // The rows of a list of instances are those of the table itself.
        let listed = manifest.spec["points"]["rows"].as_u64();
        let instances = listed.unwrap_or(spec.grid.len() as u64);
        if records.len() as u64 != instances {
            let why = format!("{} rows for {instances} instances", records.len());
            return Err(folder.bad(FILES[1], why));
        }
        let stopped = manifest.computation.stopped.clone().map(|why| match why.as_str() {
            "cancelled" => Stopped::Cancelled,
            _ => Stopped::Failed(why),
        });
        let provenance = Provenance {
            linear: manifest.computation.linear.clone(),
            response: manifest.computation.response.clone(),
            threads: 0,
            elapsed: std::time::Duration::ZERO,
        };
        let columns = columns(&manifest, &table, &spec).map_err(|why| folder.bad(FILES[1], why))?;
        match spec.analysis.starts {
            Starts::Box(starts) => take_basins(&mut records, &columns, starts),
            Starts::Both => {
                take_large(&mut records, &table).map_err(|why| folder.bad(FILES[1], why))?;
            }
            Starts::One => {}
        }
        let program = manifest.program.to_string();
        Ok(Archive { map: Map { spec, records, stopped, provenance }, columns, program })
    }
}

fn spec(manifest: &Manifest, table: &Table) -> Why<Spec> {
    let resolved = manifest.spec.as_object().ok_or("has no `spec`")?;
    let analysis = manifest.spec["analysis"].as_array().ok_or("has no `analysis` in `spec`")?;
    let asked = |name: &str| analysis.iter().any(|one| one == name);
    let grid = match (resolved.get("axes").and_then(Json::as_object), resolved.get("points")) {
        (Some(axes), _) => Grid::Axes(axes.iter().map(axis).collect::<std::result::Result<_, _>>()?),
        (None, Some(points)) => tuples(points, table)?,
        (None, None) => return Err("has neither `axes` nor `points` in `spec`".to_owned()),
    };
    let settles = |words: &[&str]| {
        resolved.get("response").is_some_and(|response| words.iter().any(|word| response["settle"] == *word))
    };
    let analysis = Analysis {
        linear: asked("linear"),
        response: asked("response"),
        until_settled: settles(&[AUTO, CYCLE]),
        finds_cycles: settles(&[CYCLE]),
        checked: resolved.get("response").is_some_and(|response| response["check"] == true),
        starts: start::from_json(&manifest.spec["start"]),
    };
    Ok(drawn_spec(manifest.title.clone(), analysis, grid))
}

/// A sweep with the parts that a figure reads; everything else has its default value.
pub(crate) fn drawn_spec(title: String, analysis: Analysis, grid: Grid) -> Spec {
    Spec {
        title,
        analysis,
        base: Params::default(),
        modal: None,
        impact_friction: true,
        law: LawKind::Bilinear,
        material: None,
        materials: Vec::new(),
        table: None,
        motion: Motion::Ramp,
        grid,
        start: StartKind::Kick,
        pass: Pass::Own,
        settle: Duration::Seconds(0.0),
        settle_limit: None,
        measure: Duration::Seconds(0.0),
        steps_per_period: STEPS_PER_PERIOD,
        steps_given: None,
        refine: None,
    }
}

fn key(name: &str) -> Why<AxisKey> {
    AxisKey::from_name(name).ok_or_else(|| format!("`{name}` is no parameter"))
}

fn axis((name, axis): (&String, &Json)) -> Why<Axis> {
    let key = key(name)?;
    let values = axis["values"].as_array().ok_or_else(|| format!("axis `{name}` has no values"))?;
    let value = |value: &Json| match value.as_f64() {
        Some(number) => Value::Number(number),
        None => Value::Text(text(value).into()),
    };
    Ok(Axis { key, values: values.iter().map(value).collect(), log: axis["scale"] == "log" })
}

fn tuples(points: &Json, table: &Table) -> Why<Grid> {
    let names: Vec<String> =
        points["columns"].as_array().map(|names| names.iter().map(text).collect()).unwrap_or_default();
    let keys = names.iter().map(|name| key(name)).collect::<std::result::Result<Vec<_>, _>>()?;
    let value = |key: &AxisKey, cell: &str| match (key, cell.parse::<f64>()) {
        (AxisKey::Param(_), Ok(number)) => Value::Number(number),
        _ => Value::Text(cell.to_owned().into()),
    };
    let row = |row: &csv::StringRecord| {
        keys.iter().zip(&names).map(|(key, name)| value(key, table.cell(row, name))).collect()
    };
    let rows = table.rows.iter().map(row).collect();
    Ok(Grid::Tuples { keys, rows })
}

/// Whether the coordinates of listed instances are numbers, where they are parameters.
fn numbers_are_numbers(manifest: &Manifest, table: &Table) -> Why<()> {
    let names = manifest.spec["points"]["columns"].as_array().into_iter().flatten().map(text);
    for name in names.filter(|name| matches!(AxisKey::from_name(name), Some(AxisKey::Param(_)))) {
        let numbers = table.numbers([name.as_str()])?;
        if let Some(row) = numbers.iter().position(|[number]| !number.is_finite()) {
            let cell = table.cell(&table.rows[row], &name);
            return Err(format!("row {}: `{name}` is `{cell}`, no number", row + 1));
        }
    }
    Ok(())
}

fn records(table: &Table) -> Why<Vec<Record>> {
    if table.find("status").is_none() {
        return Err("has no column `status`".to_owned());
    }
    // A program that sorts rows leaves the numbers of the instances.
    if table.find("instance").is_some() {
        let number = |row: &csv::StringRecord| table.cell(row, "instance").to_owned();
        let moved = (0..).zip(&table.rows).find(|(place, row)| number(row) != usize::to_string(place));
        if let Some((place, row)) = moved {
            return Err(format!(
                "row {} is of instance `{}`, not {place}; keep the rows in order",
                place + 1,
                number(row)
            ));
        }
    }
    table.rows.iter().map(|row| record(table, row)).collect()
}

/// What figures read of a record: its classes.
pub(crate) fn record(table: &Table, row: &csv::StringRecord) -> Why<Record> {
    classes(table, row, false)
}

/// The classes of an instance, or of its large start, from the cells of its row.
fn classes(table: &Table, row: &csv::StringRecord, large: bool) -> Why<Record> {
    let mut record = Record::default();
    for column in computed().filter(|column| column.is_of_large_start == large) {
        take_class(&mut record, column, table.cell(row, column.name))?;
    }
    Ok(record)
}

/// Takes the cell of a column of classes; what it does not say is left undefined.
fn take_class(record: &mut Record, column: &Column, cell: &str) -> Why<()> {
    let Some(values) = column.values() else { return Ok(()) };
    match values {
        Values::Name(class) => {
            let found = class.names().position(|name| name == cell);
            match (found, class.is_always_there()) {
                (None, true) => return Err(format!("`{cell}` is no {}", column.quantity())),
                (None, false) if !cell.is_empty() => {
                    return Err(format!("`{}` is `{cell}`, which is none", column.name));
                }
                _ => class.put(record, found),
            }
        }
        Values::Flag(class) => class.put(record, ["0", "1"].iter().position(|one| *one == cell)),
        Values::Number(_) | Values::Count(_) | Values::Share(_) | Values::Summary(_) => {}
    }
    Ok(())
}

/// Takes what became of the large start of every instance, where the table says it.
fn take_large(records: &mut [Record], table: &Table) -> Why<()> {
    let is_of_large_start = |name: &String| find(name).is_some_and(|column| column.is_of_large_start);
    if table.header.iter().any(is_of_large_start) {
        for (record, row) in records.iter_mut().zip(&table.rows) {
            record.others = Some(Others::Large(Box::new(classes(table, row, true)?)));
        }
    }
    Ok(())
}

/// Takes what became of so many starts of every instance from the columns of their shares.
fn take_basins(records: &mut [Record], columns: &[NumberColumn], starts: u32) {
    let shares: Vec<_> = computed()
        .filter(|column| !column.is_of_large_start)
        .filter_map(|column| match column.values() {
            Some(Values::Share(share)) => Some((columns.iter().find(|one| one.name == column.name), share)),
            _ => None,
        })
        .collect();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a fraction of a count is one"
    )]
    let basin = |instance: usize| {
        let mut basin = Basin::default();
        for (column, share) in &shares {
            let part = column.and_then(|column| column.values.get(instance).copied().flatten())?;
            *share(&mut basin) = (part * f64::from(starts)).round() as u32;
        }
        Some(basin)
    };
    for (instance, record) in records.iter_mut().enumerate() {
        if let Some(basin) = basin(instance) {
            record.others = Some(Others::Basin(basin));
        }
    }
}

/// The columns with a number in them that are not swept.
fn columns(manifest: &Manifest, table: &Table, spec: &Spec) -> Why<Vec<NumberColumn>> {
    let swept: Vec<&str> = spec.grid.keys().into_iter().map(AxisKey::name).collect();
    let column = |Explained { name, unit, meaning }: Explained| {
        if name == "instance" || swept.contains(&name.as_str()) {
            return Ok(None);
        }
        let place = table.column(&name)?;
        let cell = |row: &csv::StringRecord| row.get(place).unwrap_or_default().to_owned();
        let number = |cell: String| cell.parse().ok().filter(|x: &f64| x.is_finite());
        let values: Vec<Option<f64>> = table.rows.iter().map(|row| number(cell(row))).collect();
        let words = table
            .rows
            .iter()
            .map(cell)
            .zip(&values)
            .find(|(cell, value)| !cell.is_empty() && value.is_none());
        // A column of names has no number at all.
        if let (Some((cell, _)), true) = (words, values.iter().any(Option::is_some)) {
            return Err(format!("`{name}` is `{cell}` in a row, no number"));
        }
        Ok(values.iter().any(Option::is_some).then_some(NumberColumn { name, unit, meaning, values }))
    };
    manifest.columns.iter().cloned().filter_map(|one| column(one).transpose()).collect()
}
