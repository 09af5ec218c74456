//! Universal files, line by line.

use crate::common::{NAMES, RATE, columns, found, record, reference, refused, run};
use crate::units::is_read_in_its_units;
use squealmap_identify::Settings;
use std::fmt::Write;

/// A record in single precision whose fields stand close.
fn dataset(
    names: [&str; 2],
    [function, stored, spacing]: [u32; 3],
    count: u64,
    direction: i32,
    values: &[f64],
) -> String {
    let mut text = format!("    -1\n    58\n{}\n{}\nNONE\nNONE\nNONE\n", names[0], names[1]);
    let _ = writeln!(
        text,
        "{function:5}{:10}{:5}{:10} {:10}{:10}{direction:4} {:10}{:10}{:4}",
        0, 0, 0, "NONE", 7, "NONE", 0, 0
    );
    let _ = writeln!(text, "{stored:10}{count:10}{spacing:10}  0.00000E+00  2.00000E-05  0.00000E+00");
    let _ = writeln!(text, "{:10}{:5}{:5}{:5} {:20} {:20}", 17, 0, 0, 0, "NONE", "s");
    text += &"         0    0    0    0 NONE                 NONE\n".repeat(3);
    for line in values.chunks(6) {
        for value in line {
            // As Fortran writes 1.25e1: ` 1.25000E+01`.
            let plain = format!("{value:.5e}");
            let (digits, exponent) = plain.split_once('e').expect("an exponent");
            let exponent: i32 = exponent.parse().expect("a number");
            let sign = if exponent < 0 { '-' } else { '+' };
            let _ = write!(text, "{:>13}", format!("{digits}E{sign}{:02}", exponent.abs()));
        }
        text.push('\n');
    }
    text + "    -1\n"
}

const PLAIN: [u32; 3] = [1, 2, 1];

fn stroke() -> String {
    NAMES.iter().zip(columns()).map(|(name, values)| dataset([name, "x"], PLAIN, 600, 1, &values)).collect()
}

#[test]
fn single_precision_says_what_csv_says() {
    assert_eq!(found(stroke().as_bytes(), &Settings::default()), reference());
    // With other datasets around it, and line ends of another system.
    let frf = dataset(["ax2", "FRF"], [4, 2, 1], 600, 1, &columns()[1]);
    let other = "    -1\n   151\nrig\n    -1\n".to_owned();
    let text = (other + &frf + &stroke()).replace('\n', "\r\n");
    assert_eq!(found(text.as_bytes(), &Settings::default()), reference());
}

#[test]
fn names_are_what_tells_the_records_apart() {
    let of = |names: &[[&str; 2]], direction: fn(usize) -> i32| -> String {
        let all = names.iter().enumerate();
        all.map(|(k, names)| dataset(*names, PLAIN, 600, direction(k), &columns()[k])).collect()
    };
    #[expect(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "three at most")]
    let rising = |k: usize| k as i32 + 1;
    for (text, header) in [
        (of(&[["a", "same"], ["b", "same"]], |_| 1), "`a`, `b`"),
        (of(&[["same", "a"], ["same", "b"]], |_| 1), "`a`, `b`"),
        (of(&[["same", "NONE"], ["same", "NONE"]], rising), "`7:+X`, `7:+Y`"),
        (of(&[["same", "NONE"], ["same", "NONE"]], |_| -3), "`record_1`, `record_2`"),
    ] {
        refused(text.as_bytes(), &Settings::default(), &["the header has ", header]);
    }
}

#[test]
fn the_unit_of_time_is_read() {
    let text = stroke().replace("NONE                 s  ", "NONE                 ms ");
    let text = text.replace("2.00000E-05", "2.00000E-02");
    let found = run(text.as_bytes(), &Settings::default()).expect("a whole record");
    assert!((found.rate / RATE - 1.0).abs() < 1e-9, "{}", found.rate);
}

#[test]
fn units_of_the_ordinate_are_read() {
    let records = NAMES.iter().zip(columns()).map(|(name, values)| {
        let (factor, unit) = match *name {
            "V" => (1e3, "mm/s"),
            "T" => (1e-3, "kN"),
            _ => (1.0, "NONE"),
        };
        let values: Vec<f64> = values.iter().map(|value| factor * value).collect();
        let axis = |unit: &str| format!("{:10}{:5}{:5}{:5} {:20} {unit:20}\n", 0, 0, 0, 0, "NONE");
        dataset([name, "x"], PLAIN, 600, 1, &values).replacen(
            "         0    0    0    0 NONE                 NONE\n",
            &axis(unit),
            1,
        )
    });
    is_read_in_its_units(records.collect::<String>().as_bytes());
}

#[test]
fn broken_files_end_in_a_sentence() {
    let settings = Settings::default();
    let [values, ..] = columns();
    let one = |kinds: [u32; 3], count: u64| dataset(["ax2", "x"], kinds, count, 1, &values);
    let whole = one(PLAIN, 600);
    for length in [20, 60, 300, 700, whole.len() - 8] {
        refused(&whole.as_bytes()[..length], &settings, &["universal (UFF) file is cut off", "CSV"]);
    }
    refused(one(PLAIN, 601).as_bytes(), &settings, &["no number 601 of the 601", "`ax2`"]);
    refused(one(PLAIN, 594).as_bytes(), &settings, &["more than the 594 numbers"]);
    refused(one(PLAIN, 595).as_bytes(), &settings, &["more than the 595 numbers"]);
    refused(one(PLAIN, 9_999_999_999).as_bytes(), &settings, &["more than 1073741824 numbers"]);
    refused(one([1, 5, 1], 600).as_bytes(), &settings, &["`ax2`", "complex"]);
    refused(one([1, 2, 0], 600).as_bytes(), &settings, &["`ax2`", "uneven"]);
    refused(one([4, 2, 1], 600).as_bytes(), &settings, &["no time response"]);
    let text = whole.replacen("2.00000E-05", "0.00000E+00", 1);
    refused(text.as_bytes(), &settings, &["step of time of 0 s"]);
    let text = whole.replacen("2.43000E-01", "        NaN", 1);
    refused(text.as_bytes(), &settings, &["sample 1: column `ax2` holds NaN"]);
    let text = whole.replacen("2.43000E-01", "        ***", 1);
    refused(text.as_bytes(), &settings, &["no number 1 of the 600"]);
    let mut slow = columns()[1].clone();
    slow.truncate(594);
    let text = one(PLAIN, 600) + &dataset(["ay1", "x"], PLAIN, 594, 1, &slow);
    assert!(run(text.as_bytes(), &settings).is_ok(), "nobody asks for it");
    let binary = record("binary_58b.uff");
    refused(&binary[..binary.len() - 100], &settings, &["universal (UFF) file is cut off"]);
    let text = |from: &str, to: &str| -> Vec<u8> {
        let at = binary.windows(from.len()).position(|part| part == from.as_bytes()).expect("a part");
        [&binary[..at], to.as_bytes(), &binary[at + from.len()..]].concat()
    };
    refused(&text("  4800", "  4792"), &settings, &["600 numbers, but not in 4792 bytes"]);
    refused(&text("58b     1     2", "58b     1     1"), &settings, &["IEEE 754"]);
    refused(&text("       600 ", "9999999999 "), &settings, &["numbers, but not in 4800 bytes"]);
}
