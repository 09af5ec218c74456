//! The files of `identify`: the spectrogram, rows as they come, and memory that does not grow with the file.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::f64::consts::TAU;
use std::io::{BufWriter, Write as _};
use std::path::Path;
use std::process::Command;

use crate::cli::program::squealmap;
use crate::common::near;
use crate::results::netcdf_file::netcdf;
use crate::study::strokes::Random;

/// Sampling rate, Hz.
const RATE: f64 = 20e3;
/// The tone, Hz, and its growth, 1/s.
const TONE: f64 = 1500.0;
const GROWTH: f64 = 12.0;

/// Of many segments a line each is printed, and all of it where more is asked for.
#[test]
fn many_segments_have_a_line_each() {
    let directory = tempfile::tempdir().unwrap();
    let mut table = b"ax2\n".to_vec();
    let mut random = Random::new(1);
    for k in 0..40_000 {
        let t = f64::from(k) / RATE;
        let loud = if k % 8000 < 4000 { 1.0 } else { 0.0 };
        writeln!(table, "{}", loud * (TAU * TONE * t).sin() + 1e-3 * random.normal()).unwrap();
    }
    std::fs::write(directory.path().join("bursts.csv"), table).unwrap();
    let said = |more: &[&str]| {
        let words = [&["identify", "bursts.csv", "--rate", "20000", "-o", "found"], more].concat();
        let ended = squealmap(directory.path(), &words);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        ended.out
    };
    let [brief, full] = [said(&[]), said(&["--verbose"])];
    let segments = brief.lines().filter(|line| line.contains(" s, ")).count();
    assert!(segments > 8 && full.lines().filter(|line| line.contains(" s, ")).count() == segments, "{brief}");
    assert!(brief.contains("--verbose prints it") && !brief.contains("cannot speak"), "{brief}");
    assert!(!full.contains("--verbose prints it"));
    assert_eq!(full.matches("cannot speak").count(), 3 * segments, "{full}");
}

#[test]
fn the_spectrogram_shows_a_growing_tone_where_it_is() {
    let directory = tempfile::tempdir().unwrap();
    let mut table = b"ax2\n".to_vec();
    for k in 0..10_000 {
        let t = f64::from(k) / RATE;
        let value = (GROWTH * t).exp() * (TAU * TONE * t).sin();
        writeln!(table, "{value}").unwrap();
    }
    std::fs::write(directory.path().join("tone.csv"), table).unwrap();
    let ended = squealmap(directory.path(), &["identify", "tone.csv", "--rate", "20000", "-o", "found"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let path = directory.path().join("found/spectrogram.nc");
    // At most 1000 × 400 cells of two numbers, and what names them.
    assert!(path.metadata().unwrap().len() < 3_220_000);
    let variables = netcdf(&path, "tone");
    let (dimensions, units, normalised) = &variables["normalised"];
    assert_eq!(
        (dimensions.as_slice(), units["units"].as_str()),
        (&["time".into(), "frequency".into()][..], "1")
    );
    let (_, units, decibel) = &variables["decibel"];
    assert_eq!(units["units"], "dB");
    let (times, frequencies) = (&variables["time"].2, &variables["frequency"].2);
    assert_eq!((normalised.len(), decibel.len()), (times.len() * frequencies.len(), normalised.len()));
    let width = frequencies[1] - frequencies[0];
    let highest = |column: usize| {
        let cells = &decibel[column * frequencies.len()..(column + 1) * frequencies.len()];
        (0..cells.len()).max_by(|a, b| cells[*a].total_cmp(&cells[*b])).map(|row| (row, cells[row])).unwrap()
    };
    for column in 0..times.len() {
        let (row, _) = highest(column);
        near("tone", frequencies[row], TONE, width);
        near("over its own maximum", normalised[column * frequencies.len() + row], 1.0, 1e-5);
    }
    let last = times.len() - 1;
    near("loudest", highest(last).1, 0.0, 1e-6);
    // An amplitude exp(σt) rises by 20 σ/ln 10 decibel per second.
    let rise = (highest(last).1 - highest(0).1) / (times[last] - times[0]);
    near("rise", rise, 20.0 * GROWTH / std::f64::consts::LN_10, 0.01 * rise);
    // Another rise is told apart: the judge is not blind.
    assert!((rise - 20.0 * 1.1 * GROWTH / std::f64::consts::LN_10).abs() > 0.01 * rise);
}

/// Writes a record of so many bytes: a squeal of 7 kHz every 0.2 s at 100 kHz, in noise.
fn squeals(path: &Path, bytes: u64) -> usize {
    let mut file = BufWriter::new(std::fs::File::create(path).unwrap());
    let mut random = Random::new(1);
    // Drawing is slower than analysing: noise from a table that no squeal is in step with.
    let noise: Vec<f64> = (0..100_003).map(|_| 0.1 * random.normal()).collect();
    let (mut written, mut rows) = (12, 0);
    file.write_all(b"ax2,ay1,T,N\n").unwrap();
    while written < bytes {
        let t = (rows % 20_000) as f64 / 100e3;
        let envelope = (60.0 * (t.min(0.1) - 0.1)).exp() * (-80.0 * (t - 0.15).max(0.0)).exp();
        let (sin, cos) = (7000.0 * TAU * t).sin_cos();
        let (x, y) = (100.0 * envelope * sin, 60.0 * envelope * (0.8 * sin - 0.6 * cos));
        let normal = 1000.0 + 5.0 * y;
        let mut at = 4 * rows;
        let mut drawn = || {
            at += 1;
            noise[at % noise.len()]
        };
        let row = [x + drawn(), y + drawn(), 0.4 * normal + drawn(), normal + drawn()];
        let line = format!("{:.9},{:.9},{:.9},{:.9}\n", row[0], row[1], row[2], row[3]);
        file.write_all(line.as_bytes()).unwrap();
        written += line.len() as u64;
        rows += 1;
    }
    file.flush().unwrap();
    rows
}

/// Peak memory (MB), time (s) and rows of an analysis of a record of so many bytes.
fn measured(bytes: u64) -> [f64; 3] {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("long.csv");
    let rows = squeals(&path, bytes);
    let ended = Command::new("/usr/bin/time")
        .args(["-f", "%M %e", env!("CARGO_BIN_EXE_squealmap"), "identify", "long.csv", "--rate", "100000"])
        .current_dir(directory.path())
        .output()
        .unwrap();
    let (out, err) = (String::from_utf8(ended.stdout).unwrap(), String::from_utf8(ended.stderr).unwrap());
    assert!(ended.status.success() && crate::common::says_mode_coupling(&out), "{out}{err}");
    let numbers: Vec<f64> =
        err.lines().last().unwrap().split(' ').map(|number| number.parse().unwrap()).collect();
    [numbers[0] / 1024.0, numbers[1], rows as f64]
}

/// What docs/identify.md says of memory. With GNU time; 2 GB of the temporary directory.
#[test]
#[ignore = "takes minutes: cargo test --release --test suite -- --ignored --nocapture two_gigabytes"]
fn two_gigabytes_take_little_more_memory_than_fifty_megabytes() {
    let [short, long] = [50_000_000, 2_000_000_000].map(measured);
    println!("MB, s, rows: {short:?} {long:?}");
    let per_million = (long[0] - short[0]) / ((long[2] - short[2]) / 1e6);
    assert!(per_million < 1.0, "{per_million} MB per 1e6 rows");
}
