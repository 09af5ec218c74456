//! MAT of version 5, byte by byte.

use crate::common::{NAMES, RATE, at_rate, columns, found, named, record, reference, refused};
use squealmap_identify::Settings;

/// An element: its type, its bytes, and what fills the last eight.
fn element(kind: u32, bytes: &[u8]) -> Vec<u8> {
    let size = u32::try_from(bytes.len()).expect("a short file");
    let mut all = [kind.to_le_bytes(), size.to_le_bytes()].concat();
    all.extend(bytes);
    all.resize(all.len().next_multiple_of(8), 0);
    all
}

/// An array of a class with sizes, and its numbers of a type as bytes.
fn array(name: &str, class: u32, sizes: [u32; 2], (kind, bytes): (u32, &[u8])) -> Vec<u8> {
    let mut all = element(6, &[class.to_le_bytes(), [0; 4]].concat());
    all.extend(element(5, &sizes.map(u32::to_le_bytes).concat()));
    all.extend(element(1, name.as_bytes()));
    all.extend(element(kind, bytes));
    element(14, &all)
}

/// A file of elements.
fn file(elements: &[Vec<u8>]) -> Vec<u8> {
    let mut all = b"MATLAB 5.0 MAT-file, by hand".to_vec();
    all.resize(124, b' ');
    all.extend(b"\x00\x01IM");
    all.extend(elements.concat());
    all
}

fn doubles(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

fn column(name: &str, values: &[f64]) -> Vec<u8> {
    let samples = u32::try_from(values.len()).expect("few");
    array(name, 6, [samples, 1], (9, &doubles(values)))
}

/// The stroke, a column for each channel.
fn stroke() -> Vec<Vec<u8>> {
    NAMES.iter().zip(columns()).map(|(name, values)| column(name, &values)).collect()
}

#[test]
fn the_longer_side_is_time() {
    assert_eq!(found(&file(&stroke()), &at_rate(RATE)), reference());
    let columns = columns();
    let rows: Vec<f64> = (0..600).flat_map(|row| columns.each_ref().map(|column| column[row])).collect();
    let upright = array("all", 6, [600, 5], (9, &doubles(&columns.concat())));
    let lying = array("all", 6, [5, 600], (9, &doubles(&rows)));
    let settings = named(&["all_1", "all_2", "all_3", "all_4", "all_5"], at_rate(RATE));
    for matrix in [upright, lying] {
        assert_eq!(found(&file(&[matrix]), &settings), reference());
    }
}

#[test]
fn integers_and_a_length_beside_a_name_are_read() {
    // Thousandths as 16-bit integers in an array of doubles, as MATLAB stores whole numbers.
    let columns = columns();
    #[expect(clippy::cast_possible_truncation, reason = "small numbers")]
    let whole =
        |column: &[f64]| -> Vec<i16> { column.iter().map(|value| (value * 1e3).round() as i16).collect() };
    let stored = |name: &str, values: &[i16]| {
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        array(name, 6, [600, 1], (3, &bytes))
    };
    let elements: Vec<Vec<u8>> =
        NAMES.iter().zip(&columns).map(|(name, column)| stored(name, &whole(column))).collect();
    let as_doubles: Vec<Vec<u8>> = NAMES
        .iter()
        .zip(&columns)
        .map(|(name, values)| column(name, &whole(values).into_iter().map(f64::from).collect::<Vec<f64>>()))
        .collect();
    let settings = at_rate(RATE);
    assert_eq!(found(&file(&elements), &settings), found(&file(&as_doubles), &settings));
    let short = as_doubles.iter().zip(NAMES).map(|(array, name)| {
        // The name in the eight bytes of its length, which are then eight fewer.
        let mut array = array.clone();
        let at = 8 + 16 + 16;
        array.splice(at..at + 16, [1, 0, u8::try_from(name.len()).expect("short"), 0]);
        array.splice(at + 4..at + 4, name.bytes().chain([0; 4]).take(4));
        let size = u32::try_from(array.len() - 8).expect("short");
        array[4..8].copy_from_slice(&size.to_le_bytes());
        array
    });
    assert_eq!(found(&file(&short.collect::<Vec<_>>()), &settings), found(&file(&as_doubles), &settings));
}

#[test]
fn a_scalar_of_the_name_of_a_channel_is_passed_over() {
    let mut elements = stroke();
    elements[3] = column("N", &[600.0]);
    elements.push(column("t", &[0.012]));
    let found = crate::common::run(&file(&elements), &at_rate(RATE)).expect("a whole record");
    let said = found.notes.join("\n");
    refused(&file(&elements), &Settings::default(), &["columns `ax2` and `t` have 600 and 1 samples"]);
    assert!(
        said.contains("the normal force is not read: columns `ax2` and `N` have 600 and 1 samples"),
        "{said}"
    );
}

#[test]
fn broken_files_end_in_a_sentence() {
    let settings = at_rate(RATE);
    let whole = file(&stroke());
    for length in [130, 150, 180, 200, 1000, whole.len() - 1] {
        refused(&whole[..length], &settings, &["MAT file is cut off", "-v7"]);
    }
    let packed = record("columns_v7.mat");
    refused(&packed[..packed.len() - 20], &settings, &["MAT file", "-v7"]);
    let mut torn = packed.clone();
    torn[200..220].fill(0xff);
    refused(&torn, &settings, &["MAT file", "-v7"]);
    let absurd = array("ax2", 6, [u32::MAX, 1], (9, &doubles(&[1.0; 100])));
    refused(
        &file(&[absurd]),
        &settings,
        &["says that `ax2` has 4294967295 × 1 numbers, but not in 800 bytes"],
    );
    let mut values = columns();
    values[0][41] = f64::NAN;
    let unknown: Vec<Vec<u8>> =
        NAMES.iter().zip(&values).map(|(name, values)| column(name, values)).collect();
    refused(&file(&unknown), &settings, &["sample 42: column `ax2` holds NaN"]);
    refused(&file(&[]), &settings, &["no numeric arrays"]);
    let letters = array("ax2", 4, [600, 1], (4, &[0; 1200]));
    refused(&file(&[letters]), &settings, &["no numeric arrays", "structs"]);
    // Complex numbers are no signal.
    refused(&record("columns_v7.mat"), &named(&["z"], settings.clone()), &["no column `z`", "`fs`"]);
    let mut long = columns().to_vec();
    long[1].push(0.0);
    let uneven: Vec<Vec<u8>> = NAMES.iter().zip(&long).map(|(name, values)| column(name, values)).collect();
    refused(&file(&uneven), &named(&["ax2", "ay1"], settings), &["`ax2` and `ay1` have 600 and 601 samples"]);
}
