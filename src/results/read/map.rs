//! A map read back from the directory that `squealmap run` wrote: what its figures need, and its columns.

use std::path::Path;

use serde_json::Value as Json;

use crate::engine::computation::{Computation, Stopped};
use crate::engine::plan::{Duration, StartKind};
use crate::engine::record::{Basin, Others, Record};
use crate::engine::regime::Regime;
use crate::model::Params;
use crate::model::friction::LawKind;
use crate::model::kind::InstabilityType;
use crate::model::status::Status;
use crate::results::error::Result;
use crate::results::number::NumberColumn;
use crate::results::read::folder::{Folder, Table, Why, program, text};
use crate::sweep::grid::{Axis, AxisKey, Grid, Value};
use crate::sweep::map::{Map, Provenance};
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
        let manifest = folder.sealed(FILES[0])?;
        let table = Table::read(&folder.named(FILES[1], FILES[0], &manifest)?)
            .map_err(|why| folder.bad(FILES[1], why))?;
        numbers_are_numbers(&manifest, &table).map_err(|why| folder.bad(FILES[1], why))?;
        let spec = spec(&manifest, &table).map_err(|why| folder.bad(FILES[0], why))?;
        let mut records = records(&table).map_err(|why| folder.bad(FILES[1], why))?;
        // The rows of a list of instances are those of the table itself.
        let listed = manifest["spec"]["points"]["rows"].as_u64();
        let instances = listed.unwrap_or(spec.grid.len() as u64);
        if records.len() as u64 != instances {
            let why = format!("{} rows for {instances} instances", records.len());
            return Err(folder.bad(FILES[1], why));
        }
        let stopped = manifest["computation"]["stopped"].as_str().map(|why| match why {
            "cancelled" => Stopped::Cancelled,
            why => Stopped::Failed(why.to_owned()),
        });
        let provenance = Provenance {
            linear: computation(&manifest["computation"]["linear"]),
            response: computation(&manifest["computation"]["response"]),
            threads: 0,
            elapsed: std::time::Duration::ZERO,
        };
        let columns = columns(&manifest, &table, &spec).map_err(|why| folder.bad(FILES[1], why))?;
        match spec.analysis.starts {
            Starts::Box(starts) => take_basins(&mut records, &columns, starts),
            Starts::Both => take_large(&mut records, &table),
            Starts::One => {}
        }
        let program = program(&manifest);
        Ok(Archive { map: Map { spec, records, stopped, provenance }, columns, program })
    }
}

fn spec(manifest: &Json, table: &Table) -> Why<Spec> {
    let resolved = manifest["spec"].as_object().ok_or("has no `spec`")?;
    let analysis = manifest["spec"]["analysis"].as_array().ok_or("has no `analysis` in `spec`")?;
    let asked = |name: &str| analysis.iter().any(|one| one == name);
    let grid = match (resolved.get("axes").and_then(Json::as_object), resolved.get("points")) {
        (Some(axes), _) => Grid::Axes(axes.iter().map(axis).collect::<std::result::Result<_, _>>()?),
        (None, Some(points)) => tuples(points, table)?,
        (None, None) => return Err("has neither `axes` nor `points` in `spec`".to_owned()),
    };
    let analysis = Analysis {
        linear: asked("linear"),
        response: asked("response"),
        until_settled: resolved.get("response").is_some_and(|response| response["settle"] == "auto"),
        checked: resolved.get("response").is_some_and(|response| response["check"] == true),
        starts: start::from_json(&manifest["spec"]["start"]),
    };
    Ok(drawn_spec(text(&manifest["title"]), analysis, grid))
}

/// A sweep with the parts that a figure reads; everything else has its default value.
pub(crate) fn drawn_spec(title: String, analysis: Analysis, grid: Grid) -> Spec {
    Spec {
        title,
        analysis,
        base: Params::default(),
        impact_friction: true,
        law: LawKind::Bilinear,
        material: None,
        materials: Vec::new(),
        table: None,
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
fn numbers_are_numbers(manifest: &Json, table: &Table) -> Why<()> {
    let names = manifest["spec"]["points"]["columns"].as_array().into_iter().flatten().map(text);
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

/// The entry of a list with the name in a cell; none of an empty cell.
fn named<T: Copy>(all: &[T], name: fn(T) -> &'static str, column: &str, cell: &str) -> Why<Option<T>> {
    if cell.is_empty() {
        return Ok(None);
    }
    let found = all.iter().copied().find(|one| name(*one) == cell);
    found.map(Some).ok_or_else(|| format!("`{column}` is `{cell}`, which is none"))
}

/// The parts of a record that figures read.
pub(crate) fn record(table: &Table, row: &csv::StringRecord) -> Why<Record> {
    let cell = |name: &str| table.cell(row, name);
    let status = cell("status");
    let status = Status::IN_MAP
        .into_iter()
        .find(|one| one.name() == status)
        .ok_or_else(|| format!("`{status}` is no status"))?;
    Ok(Record {
        status,
        kind: named(&InstabilityType::ALL, InstabilityType::name, "type", cell("type"))?,
        regime: named(&Regime::ALL, Regime::name, "regime", cell("regime"))?,
        settled: flag(cell("settled")),
        bistable: flag(cell("bistable")),
        ..Record::default()
    })
}

/// Takes what became of the large start of every instance.
fn take_large(records: &mut [Record], table: &Table) {
    for (record, row) in records.iter_mut().zip(&table.rows) {
        let cell = |name: &str| table.cell(row, name);
        let status = Status::IN_MAP.into_iter().find(|one| one.name() == cell("status_large"));
        let large = status.map(|status| Record {
            status,
            regime: Regime::ALL.into_iter().find(|regime| regime.name() == cell("regime_large")),
            settled: flag(cell("settled_large")),
            ..Record::default()
        });
        record.others = large.map(|large| Others::Large(Box::new(large)));
    }
}

/// Takes what became of so many starts of every instance from the columns of fractions.
fn take_basins(records: &mut [Record], columns: &[NumberColumn], starts: u32) {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a fraction of a count is one"
    )]
    let count = |name: &str, instance: usize| {
        let column = columns.iter().find(|column| column.name == name)?;
        Some((column.values.get(instance).copied().flatten()? * f64::from(starts)).round() as u32)
    };
    for (instance, record) in records.iter_mut().enumerate() {
        let counts = ["basin_equilibrium", "basin_oscillation", "basin_other", "basin_failed"]
            .map(|name| count(name, instance));
        if let [Some(equilibrium), Some(oscillation), Some(other), Some(failed)] = counts {
            record.others = Some(Others::Basin(Basin { equilibrium, oscillation, other, failed }));
        }
    }
}

/// A column of yes and no.
fn flag(cell: &str) -> Option<bool> {
    match cell {
        "0" => Some(false),
        "1" => Some(true),
        _ => None,
    }
}

pub(crate) fn computation(value: &Json) -> Option<Computation> {
    value.is_object().then(|| Computation {
        backend: text(&value["backend"]),
        precision: text(&value["precision"]),
        method: text(&value["method"]),
        adapter: value["adapter"].as_str().map(str::to_owned),
        strict: value["strict"].as_bool(),
    })
}

/// The columns with a number in them that are not swept.
fn columns(manifest: &Json, table: &Table, spec: &Spec) -> Why<Vec<NumberColumn>> {
    let swept: Vec<&str> = spec.grid.keys().into_iter().map(AxisKey::name).collect();
    let described = manifest["columns"].as_array().map(Vec::as_slice).unwrap_or_default();
    let column = |column: &Json| {
        let name = text(&column["name"]);
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
        let (unit, meaning) = (text(&column["unit"]), text(&column["meaning"]));
        Ok(values.iter().any(Option::is_some).then_some(NumberColumn { name, unit, meaning, values }))
    };
    described.iter().filter_map(|one| column(one).transpose()).collect()
}
