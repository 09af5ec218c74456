//! TDMS, byte by byte.

use crate::common::{NAMES, RATE, columns, found, named, record, reference, refused, run};
use crate::units::is_read_in_its_units;
use squealmap_identify::Settings;

const META: u32 = 2;
const NEW: u32 = 4;
const RAW: u32 = 8;
const INTERLEAVED: u32 = 32;
const DAQMX: u32 = 128;
const DOUBLE: u32 = 10;

fn text(text: &str) -> Vec<u8> {
    [&u32::try_from(text.len()).expect("short").to_le_bytes(), text.as_bytes()].concat()
}

/// A channel of a segment: its name, the type and number of its values, and its properties.
fn object(path: &str, index: Option<(u32, u64)>, numbers: &[(&str, f64)], texts: &[(&str, &str)]) -> Vec<u8> {
    let mut all = text(path);
    match index {
        None => all.extend(u32::MAX.to_le_bytes()),
        Some((kind, count)) => {
            all.extend([20_u32.to_le_bytes(), kind.to_le_bytes(), 1_u32.to_le_bytes()].concat());
            all.extend(count.to_le_bytes());
        }
    }
    all.extend(u32::try_from(numbers.len() + texts.len()).expect("few").to_le_bytes());
    for (name, value) in numbers {
        all.extend([text(name), DOUBLE.to_le_bytes().to_vec(), value.to_le_bytes().to_vec()].concat());
    }
    for (name, value) in texts {
        all.extend([text(name), 0x20_u32.to_le_bytes().to_vec(), text(value)].concat());
    }
    all
}

fn segment(toc: u32, objects: &[Vec<u8>], raw: &[u8]) -> Vec<u8> {
    let mut meta = u32::try_from(objects.len()).expect("few").to_le_bytes().to_vec();
    meta.extend(objects.concat());
    let mut all = b"TDSm".to_vec();
    all.extend([toc.to_le_bytes(), 4713_u32.to_le_bytes()].concat());
    all.extend(((meta.len() + raw.len()) as u64).to_le_bytes());
    all.extend((meta.len() as u64).to_le_bytes());
    [all, meta, raw.to_vec()].concat()
}

fn doubles(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

const STEP: [(&str, f64); 1] = [("wf_increment", 2e-5)];

fn path(channel: &str) -> String {
    format!("/'Rig'/'{channel}'")
}

/// The stroke in chunks of 100 samples, all in one segment.
fn stroke(toc: u32, count: u64, properties: &[(&str, f64)]) -> Vec<u8> {
    let columns = columns();
    let objects = NAMES.map(|name| object(&path(name), Some((DOUBLE, count)), properties, &[]));
    let chunk =
        |number: usize| columns.each_ref().map(|column| column[100 * number..][..100].to_vec()).concat();
    let raw: Vec<f64> = (0..6).flat_map(chunk).collect();
    segment(toc, &objects, &doubles(&raw))
}

const PLAIN: u32 = META | NEW | RAW;

#[test]
fn chunks_and_segments_say_what_csv_says() {
    let settings = Settings::default();
    assert_eq!(found(&stroke(PLAIN, 100, &STEP), &settings), reference());
    // A second segment that changes nothing and says nothing.
    let [first, second] = [0..300, 300..600].map(|part| {
        let values = columns().map(|column| column[part.clone()].to_vec()).concat();
        doubles(&values)
    });
    let objects = NAMES.map(|name| object(&path(name), Some((DOUBLE, 300)), &STEP, &[]));
    let mut bare = segment(RAW, &[], &second);
    // Without a description there is no number of objects either.
    bare.drain(28..32);
    bare[12..20].copy_from_slice(&(second.len() as u64).to_le_bytes());
    bare[20..28].fill(0);
    assert_eq!(found(&[segment(PLAIN, &objects, &first), bare].concat(), &settings), reference());
}

#[test]
fn the_units_of_channels_are_read() {
    let columns = columns();
    let (mut objects, mut raw) = (Vec::new(), Vec::new());
    for (name, values) in NAMES.iter().zip(&columns) {
        let (factor, unit) = match *name {
            "V" => (1e3, "mm/s"),
            "T" => (1e-3, "kN"),
            "N" => (1.0, "N"),
            _ => (1.0, "m/s^2"),
        };
        objects.push(object(&path(name), Some((DOUBLE, 600)), &STEP, &[("unit_string", unit)]));
        raw.extend(values.iter().map(|value| factor * value));
    }
    is_read_in_its_units(&segment(PLAIN, &objects, &doubles(&raw)));
}

#[test]
fn a_name_that_two_groups_have_is_told_with_its_group() {
    let [values, ..] = columns();
    let objects =
        ["/'a'/'x'", "/'b'/'x'", "/'b'/'y''s'"].map(|path| object(path, Some((DOUBLE, 600)), &STEP, &[]));
    let bytes = segment(PLAIN, &objects, &doubles(&[&values[..], &values, &values].concat()));
    refused(&bytes, &Settings::default(), &["the header has `a/x`, `b/x`, `y's`"]);
    assert!(run(&bytes, &named(&["b/x"], Settings::default())).is_ok());
}

#[test]
fn channels_of_other_rates_and_times_are_named() {
    let columns = columns();
    let of = |properties: &[(&str, f64)]| {
        let objects = [
            object(&path("ax2"), Some((DOUBLE, 600)), &STEP, &[]),
            object(&path("ay1"), Some((DOUBLE, 600)), properties, &[]),
        ];
        segment(PLAIN, &objects, &doubles(&columns[..2].concat()))
    };
    let settings = named(&["ax2", "ay1"], Settings::default());
    refused(&of(&[("wf_increment", 1e-5)]), &settings, &["50000 and 100000 samples per second"]);
    let late = [STEP[0], ("wf_start_offset", 0.5)];
    refused(&of(&late), &settings, &["column `ay1` begins 0.5 s after column `ax2`"]);
    let near = [STEP[0], ("wf_start_offset", 0.5e-5)];
    assert!(run(&of(&near), &settings).is_ok());
    let found = run(&stroke(PLAIN, 100, &late), &Settings::default()).expect("a whole record");
    assert_eq!((found.rate, found.time[0]), (RATE, 0.5));
}

#[test]
fn broken_files_end_in_a_sentence() {
    let settings = Settings::default();
    let whole = stroke(PLAIN, 100, &STEP);
    for length in [10, 28, 40, 100, 200, 1000, whole.len() - 1] {
        refused(&whole[..length], &settings, &["TDMS file", "is cut off", "export it as CSV"]);
    }
    let mut stopped = whole.clone();
    stopped[12..20].fill(0xff);
    refused(&stopped, &settings, &["not written to its end"]);
    refused(&stroke(PLAIN | INTERLEAVED, 100, &STEP), &settings, &["interleaved"]);
    refused(&stroke(PLAIN | DAQMX, 100, &STEP), &settings, &["raw data of DAQmx"]);
    refused(&stroke(PLAIN, 101, &STEP), &settings, &["24000 bytes", "make 4040", "counts are wrong"]);
    refused(&stroke(PLAIN, 1 << 60, &STEP), &settings, &["24000 bytes", "more than there can be"]);
    let mut wrong = whole.clone();
    // What the segment says of its end.
    wrong[12..20].copy_from_slice(&(1_u64 << 60).to_le_bytes());
    refused(&wrong, &settings, &["counts are wrong"]);
    wrong[20..28].copy_from_slice(&(1_u64 << 61).to_le_bytes());
    refused(&wrong, &settings, &["counts are wrong"]);
    let alone = object(&path("ax2"), Some((DOUBLE, 1 << 58)), &STEP, &[]);
    let mut absurd = segment(PLAIN, &[alone], &[0; 80]);
    let meta = u64::from_le_bytes(absurd[20..28].try_into().expect("eight bytes"));
    absurd[12..20].copy_from_slice(&(meta + (1 << 61)).to_le_bytes());
    refused(&absurd, &settings, &["more than 1073741824 numbers"]);
    let counts = object(&path("ax2"), Some((3, 600)), &[STEP[0], ("NI_Number_Of_Scales", 1.0)], &[]);
    refused(&segment(PLAIN, &[counts], &[0; 2400]), &settings, &["column `ax2`", "still to be scaled"]);
    let scales = [STEP[0], ("NI_Number_Of_Scales", 1.0)];
    let scaled = object(&path("ax2"), Some((DOUBLE, 600)), &scales, &[("NI_Scaling_Status", "scaled")]);
    assert!(run(&segment(PLAIN, &[scaled], &doubles(&columns()[0])), &settings).is_ok());
    let group = object("/'Rig'", None, &[], &[("author", "nobody")]);
    refused(&segment(PLAIN, &[group], &[]), &settings, &["no channel of numbers"]);
    let mut index = record("stroke.tdms");
    index[3] = b'h';
    refused(&index, &settings, &["index of a TDMS file", ".tdms"]);
    let mut values = columns()[0].clone();
    values[599] = f64::INFINITY;
    let alone = object(&path("ax2"), Some((DOUBLE, 600)), &STEP, &[]);
    refused(&segment(PLAIN, &[alone], &doubles(&values)), &settings, &["sample 600: column `ax2` holds inf"]);
}
