//! Units of columns: in the header, in a row below it, and where a format has them.

use std::fmt::Write as _;
use std::io::{Cursor, Read};

use crate::common::{NAMES, RATE, at_rate, columns, csv, run};
use squealmap_identify::{FrictionColumn, Points, Settings, read_points};

/// What a file gives as rows, at 20 °C where it has no temperature.
pub(crate) fn rows(bytes: &[u8], temperature: Option<f64>) -> Points {
    let input = Box::new(Cursor::new(bytes.to_owned())) as Box<dyn Read>;
    read_points(input, "record", &Settings::default(), &FrictionColumn::Forces, temperature).expect("points")
}

/// Asserts that a record whose `V` is in mm/s and whose `T` is in kN, as it says itself, gives the points of the stroke.
pub(crate) fn is_read_in_its_units(bytes: &[u8]) {
    let [expected, got] = [&csv(&NAMES, &columns()), bytes].map(|bytes| rows(bytes, Some(20.0)));
    assert_eq!(got.points.len(), expected.points.len());
    for (point, other) in got.points.iter().zip(&expected.points) {
        assert!((point.velocity - other.velocity).abs() < 1e-7, "{point:?} {other:?}");
        assert!((point.friction - other.friction).abs() < 1e-5, "{point:?} {other:?}");
    }
    for said in ["`V` is read in mm/s, as the file says", "`T` is read in kN, as the file says"] {
        assert!(got.remarks.iter().any(|remark| remark.contains(said)), "{:?}", got.remarks);
    }
}

/// The columns of the stroke in these units, of which so many are one of SI.
fn in_units(units: [f64; NAMES.len()]) -> [Vec<f64>; NAMES.len()] {
    let mut all = columns();
    for (column, unit) in all.iter_mut().zip(units) {
        for value in column.iter_mut() {
            *value *= unit;
        }
    }
    all
}

#[test]
fn a_row_of_units_is_heeded() {
    let text = String::from_utf8(csv(&NAMES, &in_units([1.0, 1.0, 1e-3, 1.0, 1e3]))).expect("text");
    for units in ["m/s²,m/s²,kN,N,mm/s", "[m/s^2],[-],[kN],[N],[mm / s]"] {
        is_read_in_its_units(text.replacen('\n', &format!("\n{units}\n"), 1).as_bytes());
    }
    // Accelerations: the amplitude is the same to the digits that the file has.
    let g = 1.0 / 9.80665;
    let text = String::from_utf8(csv(&NAMES, &in_units([g, g, 1.0, 1.0, 1.0]))).expect("text");
    let text = text.replacen('\n', "\ng,g,N,N,m/s\n", 1);
    let [one, other] = [csv(&NAMES, &columns()), text.into_bytes()]
        .map(|bytes| run(&bytes, &at_rate(RATE)).expect("a whole record"));
    for (one, other) in one.segments.iter().zip(&other.segments) {
        let [one, other] = [one, other].map(|segment| segment.amplitude);
        assert!((one / other - 1.0).abs() < 1e-9, "{one} {other}");
    }
    assert_eq!(one.segments.len(), other.segments.len());
    assert!(!one.segments.is_empty());
}

#[test]
fn the_unit_of_time_stands_in_the_row_of_units_too() {
    let mut text = "t,ax2\nms,m/s²\n".to_owned();
    for (k, value) in columns()[0].iter().enumerate() {
        let _ = writeln!(text, "{:.3},{value}", 0.02 * k as f64);
    }
    let found = run(text.as_bytes(), &Settings::default()).expect("a whole record");
    assert!((found.rate / RATE - 1.0).abs() < 1e-9, "{}", found.rate);
}

#[test]
fn a_unit_that_is_not_known_is_said() {
    let table = |header: &str, row: &str| format!("{header}\n{row}\n0.1,3,10,473.15\n0.2,3,10,473.15\n");
    let header = |header: &str| rows(table(header, "0.3,3,10,473.15").as_bytes(), None);
    let kelvin = header("V,T,N,temperature [K]");
    assert!(kelvin.points.iter().all(|point| (point.temperature - 200.0).abs() < 1e-9), "{kelvin:?}");
    let unknown = rows(table("V,T,N,temperature", "m/s,V,N,°C").as_bytes(), None);
    assert_eq!(unknown.points.len(), 2);
    let said = unknown.remarks.join("; ");
    assert!(said.contains("`T` is read in N, as `V` is no unit of the tangential force"), "{said}");
    // One that would be that of a channel by its name.
    let left = rows(table("V,T,N,temperature [R]", "0.3,3,10,851").as_bytes(), Some(20.0));
    let said = left.remarks.join("; ");
    assert!(said.contains("`temperature [R]` is not read") && said.contains("--temperature"), "{said}");
}

#[test]
fn blanks_of_a_slow_channel_have_the_value_before() {
    let found = rows(b"V,T,N,temperature\n0.1,3,10,100\n0.2,3,10,\n0.3,3,10, \n0.4,3,10,200\n", None);
    let temperatures: Vec<f64> = found.points.iter().map(|point| point.temperature).collect();
    assert_eq!(temperatures, [100.0, 100.0, 100.0, 200.0]);
    assert!(found.remarks.join("; ").contains("`temperature` is blank in 2 row(s)"), "{:?}", found.remarks);
    let first = Box::new(Cursor::new(b"V,T,N,temperature\n0.1,3,10,\n0.2,3,10,100\n")) as Box<dyn Read>;
    let fault = read_points(first, "record", &Settings::default(), &FrictionColumn::Forces, None);
    assert!(fault.expect_err("a fault").to_string().contains("line 2: column `temperature` holds ``"));
}

#[test]
fn a_last_line_that_is_cut_off_is_left_out() {
    let whole = "V,T,N\n0.1,3,10\n0.2,3,10\n";
    for cut in ["0.3,", "0.3,3", "0.3,3,"] {
        let found = rows(format!("{whole}{cut}").as_bytes(), Some(20.0));
        assert_eq!(found.points.len(), 2, "{cut}");
        assert!(found.remarks.join("; ").contains("last line of the file is cut off"), "{:?}", found.remarks);
    }
    // A whole one without its end stays, and a short one with it is a fault.
    assert_eq!(rows(format!("{whole}0.3,3,10").as_bytes(), Some(20.0)).points.len(), 3);
    let short = Box::new(Cursor::new(format!("{whole}0.3,3\n").into_bytes())) as Box<dyn Read>;
    let fault = read_points(short, "record", &Settings::default(), &FrictionColumn::Forces, Some(20.0));
    assert!(fault.expect_err("a fault").to_string().contains("line 4"));
}

#[test]
fn lines_before_the_header_are_passed_over() {
    let text = "Test: brake 7\nDate;29.11.2026;x\n\nV;T;N\nmm/s;N;N\n100,5;3;10\n200;3;10\n";
    let found = rows(text.as_bytes(), Some(20.0));
    let velocities: Vec<f64> = found.points.iter().map(|point| point.velocity).collect();
    assert_eq!(velocities, [0.1005, 0.2]);
    assert!(found.remarks.join("; ").contains("2 line(s) before the header"), "{:?}", found.remarks);
    // Lines are counted as in the file.
    let wrong = Box::new(Cursor::new(text.replace("200;3", "200;x").into_bytes())) as Box<dyn Read>;
    let fault = read_points(wrong, "record", &Settings::default(), &FrictionColumn::Forces, Some(20.0));
    assert!(fault.expect_err("a fault").to_string().contains("line 7"));
}
