//! Files by other programs: `records/make.py` has written them.

use crate::common::NAMES;
use crate::common::{RATE, at_rate, columns, csv, found, named, record, reference, refused, run};
use squealmap_identify::{FrictionColumn, Settings, read_measurements, strokes};
use std::io::{Cursor, Read};

/// The records that say their rate.
const TIMED: [&str; 3] = ["ascii_58.uff", "binary_58b.uff", "stroke.tdms"];

#[test]
fn every_format_says_what_csv_says() {
    let reference = reference();
    for name in TIMED {
        assert_eq!(found(&record(name), &Settings::default()), reference, "{name}");
        assert_eq!(found(&record(name), &at_rate(RATE)), reference, "{name}");
    }
    assert_eq!(found(&record("columns_v7.mat"), &at_rate(RATE)), reference);
    let matrix = ["data_2", "data_3", "data_4", "data_5", "data_6"];
    assert_eq!(found(&record("matrix_v6.mat"), &named(&matrix, at_rate(RATE))), reference);
    // The comparison tells a single number.
    let mut columns = columns();
    columns[1][300] += 0.001;
    assert_ne!(found(&csv(&NAMES, &columns), &at_rate(RATE)), reference);
}

#[test]
fn a_column_of_time_is_read_where_the_format_says_none() {
    let matrix = ["data_2", "data_3", "data_4", "data_5", "data_6"];
    let settings = named(&matrix, Settings::default());
    let settings = Settings { time: Some("data_1".to_owned()), ..settings };
    let found = run(&record("matrix_v6.mat"), &settings).expect("a whole record");
    assert!((found.rate / RATE - 1.0).abs() < 1e-9, "{}", found.rate);
    refused(&record("columns_v7.mat"), &Settings::default(), &["no column `t` for time", "--rate"]);
}

#[test]
fn a_rate_beside_that_of_the_file_is_said() {
    for name in TIMED {
        let parts = ["--rate is 51200 Hz", "file itself says 50000 samples per second", "leave out --rate"];
        refused(&record(name), &at_rate(51.2e3), &parts);
        let settings = Settings { time: Some("V".to_owned()), ..Settings::default() };
        // No column of time at all: it falls.
        refused(&record(name), &settings, &["sample 2: column `V`"]);
    }
}

#[test]
fn a_column_that_nobody_asks_for_and_that_has_another_length_is_passed_over() {
    // `fs` is a number beside the columns.
    let settings = named(&["ax2", "ay1"], at_rate(RATE));
    assert!(run(&record("columns_v7.mat"), &settings).is_ok());
    let mut asked = at_rate(RATE);
    asked.columns[5] = Some("fs".to_owned());
    refused(&record("columns_v7.mat"), &asked, &["`ax2` and `fs` have 600 and 1 samples"]);
}

#[test]
fn strokes_and_points_are_read_as_of_csv() {
    let text = csv(&NAMES, &columns());
    let open = |bytes: Vec<u8>| move || Ok(Box::new(Cursor::new(bytes.clone())) as Box<dyn Read>);
    let parts = |bytes: Vec<u8>| strokes(open(bytes), "record", &at_rate(RATE)).expect("strokes");
    let points = |bytes: Vec<u8>| {
        read_measurements(open(bytes), "record", &at_rate(RATE), &FrictionColumn::Forces, Some(20.0))
            .expect("points")
    };
    for name in TIMED.into_iter().chain(["columns_v7.mat"]) {
        assert_eq!(parts(record(name)), parts(text.clone()), "{name}");
        assert_eq!(points(record(name)), points(text.clone()), "{name}");
        assert!(!points(record(name)).points.is_empty());
    }
}

#[test]
fn a_part_of_a_record_has_its_own_time() {
    let settings = Settings { rows: Some([100, 400]), ..Settings::default() };
    let found = run(&record("stroke.tdms"), &settings).expect("a whole record");
    assert_eq!((found.samples, found.time[0]), (400, 100.0 / RATE));
}
