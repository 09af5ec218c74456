//! Map → bytes. Every exporter returns bytes (or text) in full precision and base units; none opens a file.
//!
//! [`sheet`] is what an export says of a sweep beside its records; [`columns`] is the one table of output columns;
//! [`csv`], [`manifest`] and [`figure`] write `map.csv`, `manifest.json` and `map.svg`; [`png`] and [`pdf`] draw any of
//! the figures, [`look`] says at which width and what of a map, [`boundary_lines`] gives its lines as a table, [`isolines`] those of
//! equal value, [`cut`] curves through it, and [`tikz`] its source for LaTeX. [`heading`] stands above figures of one instance.
//! [`zarr`] and [`netcdf`] write the labelled [`arrays`] of a sweep, part by part, [`parquet`] its table. [`modes`],
//! [`trace`] and [`hysteresis`] serve the commands `modes` and `trace`, [`tradeoff`] speed against error, [`identify`], [`spectrogram`] and [`signals`] to and
//! from measured signals, [`paper`] the figures of the source paper, [`fem`] those of finite elements.

pub mod arrays;
mod beside;
mod block;
pub mod boundaries;
pub mod boundary_lines;
mod cells;
pub mod columns;
pub mod compare;
pub mod csv;
mod curve_block;
pub mod cut;
mod cut_figure;
mod cyclic;
pub mod fem;
pub mod figure;
mod frame;
pub mod glyphs;
pub mod heading;
pub mod hysteresis;
mod hysteresis_figure;
pub mod identify;
mod identify_figure;
pub mod isolines;
mod jumps;
mod key;
mod layout;
mod legend;
mod letters;
pub mod look;
pub mod manifest;
pub mod marching;
mod marks;
pub mod material;
pub mod modes;
mod modes_figure;
pub mod netcdf;
mod page;
pub mod palette;
mod panels;
pub mod paper;
pub mod parquet;
pub mod pdf;
mod picture_axis;
mod plot;
pub mod png;
mod points;
mod quantity;
mod raster;
pub mod refined;
pub mod scale;
pub mod sheet;
mod sides;
pub mod signals;
pub mod spectrogram;
mod starts_block;
pub mod svg;
mod tex;
pub mod text;
pub mod tikz;
pub mod trace;
mod trace_figure;
pub mod tradeoff;
mod tradeoff_figure;
mod trust;
mod words;
pub mod zarr;

use crate::error::{Error, Result};
use crate::map::{Map, Record};
use crate::outcome::Status;

/// A map with a missing or an unwritten record is an error, never a row or a picture; so is one that lacks
/// instances without having been stopped.
fn accounted(map: &Map) -> Result<()> {
    let expected = map.spec.grid.len();
    if map.records.len() != expected {
        return Err(Error::Incomplete { records: map.records.len(), instances: expected });
    }
    let unaccounted = |record: &Record| match record.status {
        Status::Unwritten => true,
        Status::NotComputed => map.stopped.is_none(),
        _ => false,
    };
    match map.records.iter().position(unaccounted) {
        Some(instance) => Err(Error::Unwritten { instance }),
        None => Ok(()),
    }
}
