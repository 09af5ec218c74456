//! `spectrogram.nc`: the spectrogram of `identify` as a NetCDF classic file (CDF-2), which MATLAB, Julia, R and xarray read.
//!
//! Both normalisations on one grid of at most 1000 times and 400 frequencies, so 3.2 MB at most.

use crate::results::netcdf::{ATTRIBUTES, DIMENSIONS, DOUBLE, FLOAT, VARIABLES, Writer};
use crate::version::VERSION;
use squealmap_identify::Spectrogram;

/// A variable: name, its dimensions, unit and meaning, type and bytes.
type Variable<'a> = (&'a str, &'a [u64], [&'a str; 2], u32, Vec<u8>);

/// The file. `time` (s): the middle of a column; `frequency` (Hz): that of a row; `normalised`: amplitude over the largest
/// one of the same window; `decibel`: power over the largest one of the record, dB.
#[must_use]
pub fn spectrogram_nc(spectrogram: &Spectrogram, title: &str) -> Vec<u8> {
    let Spectrogram { columns, rows, .. } = *spectrogram;
    let numbers = |values: &[f32]| values.iter().flat_map(|value| value.to_be_bytes()).collect();
    let normalised = ["1", "amplitude over the largest one of the same window"];
    let decibel = ["dB", "power over the largest one of the record"];
    let middle = ["middle of the windows", "middle of the bins"];
    let variables: [Variable; 4] = [
        ("time", &[0], ["s", middle[0]], DOUBLE, middles(spectrogram.time, columns)),
        ("frequency", &[1], ["Hz", middle[1]], DOUBLE, middles(spectrogram.frequency, rows)),
        ("normalised", &[0, 1], normalised, FLOAT, numbers(&spectrogram.normalised)),
        ("decibel", &[0, 1], decibel, FLOAT, numbers(&spectrogram.decibel)),
    ];
    // The length of the header does not depend on what it says of the beginnings.
    let length = header(spectrogram, title, &variables, 0).len();
    let mut bytes = header(spectrogram, title, &variables, length as u64);
    for (.., values) in &variables {
        bytes.extend(values);
    }
    bytes
}

/// The numbers of the file of a spectrogram whose ranges and sizes are known; `None` when these are not the bytes that
/// [`spectrogram_nc`] writes of it.
#[must_use]
pub fn filled_from(spectrogram: &Spectrogram, title: &str, bytes: &[u8]) -> Option<Spectrogram> {
    let count = spectrogram.columns.checked_mul(spectrogram.rows)?;
    let both = bytes.get(bytes.len().checked_sub(count.checked_mul(8)?)?..)?;
    let number = |four: &[u8]| four.try_into().map_or(f32::NAN, f32::from_be_bytes);
    let mut numbers = both.chunks_exact(4).map(number);
    let filled = Spectrogram {
        normalised: numbers.by_ref().take(count).collect(),
        decibel: numbers.collect(),
        ..spectrogram.clone()
    };
    (spectrogram_nc(&filled, title) == bytes).then_some(filled)
}

/// The middles of equal parts of a range.
fn middles([low, high]: [f64; 2], count: usize) -> Vec<u8> {
    let width = (high - low) / count.max(1) as f64;
    (0..count).flat_map(|k| (low + (k as f64 + 0.5) * width).to_be_bytes()).collect()
}

fn header(spectrogram: &Spectrogram, title: &str, variables: &[Variable], mut begin: u64) -> Vec<u8> {
    let mut out = Writer::new(false);
    out.list(DIMENSIONS, 2);
    for (name, length) in [("time", spectrogram.columns), ("frequency", spectrogram.rows)] {
        out.name(name);
        out.count(length as u64);
    }
    out.list(ATTRIBUTES, 4);
    out.text("title", title);
    out.text("source", &format!("squealmap {VERSION}"));
    out.text("Conventions", "CF-1.11");
    out.text("window", &format!("Hann, {} s", spectrogram.window));
    out.list(VARIABLES, variables.len());
    for (name, dimensions, [unit, meaning], kind, values) in variables {
        out.name(name);
        out.count(dimensions.len() as u64);
        dimensions.iter().for_each(|dimension| out.count(*dimension));
        out.list(ATTRIBUTES, 2);
        out.text("units", unit);
        out.text("long_name", meaning);
        let size = values.len() as u64;
        out.place(*kind, Some((&size, &begin)));
        begin += size;
    }
    out.bytes
}
