//! `map.csv` and `manifest.json` of maps made by hand.

use crate::synthetic::{axis, failed, map, record};
use squealmap::engine::outcome::Outcome;
use squealmap::engine::record::Record;
use squealmap::engine::regime::Regime;
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType;
use squealmap::model::linear::Linear;
use squealmap::model::status::Status;
use squealmap::results::csv::map_csv;
use squealmap::results::manifest::manifest_json;
use squealmap::sweep::grid::{AxisKey, Grid, Value};
use squealmap::sweep::map::Map;

const HEADER: &str = "instance,mu_s,mu_d,type,growth_rate,frequency,phase,growth_rate_flat,growth_rate_frozen,\
regime,x2_mean,x2_std,y1_mean,y1_std,ax_rms,ay_rms,ax_peak,ay_peak,friction_mean,n_peak,response_frequency,\
phase_cycle,growth_rate_measured,frequency_measured,phase_measured,stick,free,reverse,impacts_per_second,\
settled,simulated_time,steps,status";

fn small(make: impl Fn(usize) -> Record) -> Map {
    let axes = vec![axis(Param::MuS, &[0.1, 0.3]), axis(Param::MuD, &[0.0, 0.1, 0.2])];
    map(Grid::Axes(axes), |i, _| make(i))
}

fn good(_: usize) -> Record {
    record(InstabilityType::ModeCoupling, Regime::StickSlip, false)
}

/// Header and rows of a table.
fn parse(bytes: &[u8]) -> (Vec<String>, Vec<Vec<String>>) {
    let mut reader = csv::Reader::from_reader(bytes);
    let owned = |row: &csv::StringRecord| row.iter().map(str::to_owned).collect::<Vec<_>>();
    let header = owned(reader.headers().expect("a header"));
    let rows = reader.records().map(|row| owned(&row.expect("an even row"))).collect();
    (header, rows)
}

fn cell<'a>(table: &'a (Vec<String>, Vec<Vec<String>>), row: usize, name: &str) -> &'a str {
    let column = table.0.iter().position(|header| header == name).expect("a column of that name");
    &table.1[row][column]
}

#[test]
fn columns_stand_in_the_documented_order() {
    let bytes = map_csv(&small(good)).expect("a complete map");
    let text = String::from_utf8(bytes).expect("UTF-8");
    assert_eq!(text.lines().next(), Some(HEADER));
    assert_eq!(text.lines().count(), 1 + 6);
}

#[test]
fn an_analysis_not_asked_for_has_no_columns() {
    let mut sweep = small(good);
    sweep.spec.analysis.response = false;
    let (header, _) = parse(&map_csv(&sweep).expect("a complete map"));
    let linear =
        "instance,mu_s,mu_d,type,growth_rate,frequency,phase,growth_rate_flat,growth_rate_frozen,status";
    assert_eq!(header.join(","), linear);
    sweep.spec.analysis =
        squealmap::sweep::spec::Analysis { linear: false, response: true, ..sweep.spec.analysis };
    let (header, _) = parse(&map_csv(&sweep).expect("a complete map"));
    assert_eq!(header[3], "regime");
    assert!(!header.contains(&"growth_rate".to_owned()));
    assert!(header.contains(&"growth_rate_measured".to_owned()));
}

#[test]
fn swept_values_follow_the_grid_and_undefined_ones_are_empty() {
    let table = parse(&map_csv(&small(good)).expect("a complete map"));
    assert_eq!(
        (cell(&table, 4, "instance"), cell(&table, 4, "mu_s"), cell(&table, 4, "mu_d")),
        ("4", "0.3", "0.1")
    );
    assert_eq!(cell(&table, 0, "mu_d"), "0");
    assert_eq!(cell(&table, 0, "settled"), "0");
    assert_eq!(cell(&table, 0, "type"), "mode_coupling");
    assert_eq!(cell(&table, 0, "x2_std"), "");
    let broken = small(|i| if i == 2 { failed(Status::Painleve) } else { good(i) });
    let table = parse(&map_csv(&broken).expect("a complete map"));
    for name in ["type", "growth_rate", "phase", "regime", "x2_mean", "settled"] {
        assert_eq!(cell(&table, 2, name), "", "{name}");
    }
    assert_eq!(cell(&table, 2, "status"), "painleve");
}

#[test]
fn numbers_read_back_to_the_same_bits() {
    let values = [0.1 + 0.2, -1.0 / 3.0, 5e-324, f64::MAX, 1e-5 / 3.0, -2.171_401e-7];
    let sweep = small(|i| {
        let mut record = good(i);
        record.outcome =
            Some(Box::new(Outcome { status: Status::Ok, x2_mean: Some(values[i]), ..Outcome::default() }));
        record
    });
    let table = parse(&map_csv(&sweep).expect("a complete map"));
    for (row, value) in values.iter().enumerate() {
        let text = cell(&table, row, "x2_mean");
        let back: f64 = text.parse().expect("a number");
        assert_eq!(back.to_bits(), value.to_bits(), "{text}");
        assert!(text.len() < 25, "{text} is not the shortest form");
    }
}

#[test]
fn numbers_that_are_not_finite_are_empty() {
    let sweep = small(|i| {
        let mut record = good(i);
        let values = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
        record.outcome = Some(Box::new(Outcome { x2_mean: Some(values[i % 3]), ..Outcome::default() }));
        record
    });
    let table = parse(&map_csv(&sweep).expect("a complete map"));
    assert!((0..6).all(|row| cell(&table, row, "x2_mean").is_empty()));
}

#[test]
fn unwritten_and_missing_instances_are_errors() {
    let sweep = small(|i| if i == 3 { Record::default() } else { good(i) });
    assert_eq!(
        map_csv(&sweep).expect_err("as the test has set it up").to_string(),
        "instance 3 was never computed; nothing was exported"
    );
    assert_eq!(
        manifest_json(&sweep).expect_err("as the test has set it up").to_string(),
        "instance 3 was never computed; nothing was exported"
    );
    let mut short = small(good);
    short.records.pop();
    assert!(matches!(
        map_csv(&short),
        Err(squealmap::results::error::Error::Incomplete { records: 5, instances: 6 })
    ));
}

#[test]
fn tuples_keep_their_columns_and_quote_names() {
    let keys = vec![AxisKey::Material, AxisKey::Param(Param::Temperature)];
    let rows = vec![vec![Value::Text("pad, new.csv".to_owned().into()), Value::Number(350.0)]];
    let sweep = map(Grid::Tuples { keys, rows: rows.into() }, |i, _| good(i));
    let table = parse(&map_csv(&sweep).expect("a complete map"));
    assert_eq!(table.0[1..3], ["material", "temperature"]);
    assert_eq!(cell(&table, 0, "material"), "pad, new.csv");
    assert_eq!(cell(&table, 0, "temperature"), "350");
}

#[test]
fn the_manifest_counts_and_explains() {
    let sweep = small(|i| match i {
        0 => failed(Status::Painleve),
        1 => record(InstabilityType::Stable, Regime::Equilibrium, true),
        _ => {
            let mut record = good(i);
            if let Some(outcome) = &mut record.outcome {
                outcome.energy_gaining_impacts = Some(3);
            }
            record
        }
    });
    let bytes = manifest_json(&sweep).expect("a complete map");
    let manifest: serde_json::Value = serde_json::from_slice(&bytes).expect("JSON");
    assert_eq!(manifest["title"], "Stability map");
    assert_eq!(manifest["counts"]["type"], serde_json::json!({ "stable": 1, "mode_coupling": 4 }));
    assert_eq!(manifest["counts"]["regime"], serde_json::json!({ "equilibrium": 1, "stick_slip": 4 }));
    assert_eq!(manifest["counts"]["status"], serde_json::json!({ "ok": 5, "painleve": 1 }));
    assert_eq!(manifest["counts"]["unsettled"], 4);
    assert_eq!(manifest["energy_gaining_impacts"], 12);
    assert_eq!(manifest["computation"]["response"]["backend"], "reference");
    assert_eq!(manifest["computation"]["elapsed_seconds"], 2.5);
    assert_eq!(manifest["program"]["version"], env!("CARGO_PKG_VERSION"));
    let columns = manifest["columns"].as_array().expect("a list");
    let names: Vec<&str> = columns.iter().filter_map(|column| column["name"].as_str()).collect();
    assert_eq!(names.join(","), HEADER);
    assert!(columns.iter().all(|column| column["meaning"].as_str().is_some_and(|text| text.len() > 3)));
    assert_eq!(columns[4]["unit"], "1/s");
}

#[test]
fn every_column_holds_its_own_value() {
    let names: Vec<&str> = HEADER.split(',').collect();
    // The value of a column is its position in the header.
    let at = |name: &str| names.iter().position(|other| *other == name).expect("a column") as f64;
    let some = |name: &str| Some(at(name));
    let sweep = small(|_| Record {
        linear: Some(Linear {
            growth_rate: at("growth_rate"),
            frequency: Some(at("frequency")),
            phase: some("phase"),
            growth_rate_flat: at("growth_rate_flat"),
            growth_rate_frozen: at("growth_rate_frozen"),
        }),
        outcome: Some(Box::new(Outcome {
            status: Status::Ok,
            x2_mean: some("x2_mean"),
            x2_std: some("x2_std"),
            y1_mean: some("y1_mean"),
            y1_std: some("y1_std"),
            ax_rms: some("ax_rms"),
            ay_rms: some("ay_rms"),
            ax_peak: some("ax_peak"),
            ay_peak: some("ay_peak"),
            friction_mean: some("friction_mean"),
            n_peak: some("n_peak"),
            response_frequency: some("response_frequency"),
            phase_cycle: some("phase_cycle"),
            growth_rate_measured: some("growth_rate_measured"),
            frequency_measured: some("frequency_measured"),
            phase_measured: some("phase_measured"),
            stick: some("stick"),
            free: some("free"),
            reverse: some("reverse"),
            impacts_per_second: some("impacts_per_second"),
            simulated_time: at("simulated_time"),
            steps: 31,
            ..Outcome::default()
        })),
        ..record(InstabilityType::Interaction, Regime::Detaching, true)
    });
    let table = parse(&map_csv(&sweep).expect("a complete map"));
    let words = ["interaction", "detaching", "1", "ok"];
    let special = ["type", "regime", "settled", "status"];
    for (column, name) in names.iter().enumerate().skip(3) {
        let expected = special.iter().position(|other| other == name);
        let expected = expected.map_or_else(|| column.to_string(), |k| words[k].to_owned());
        assert_eq!(cell(&table, 0, name), expected, "{name}");
    }
}
