//! Map → bytes, and a map read back.
//!
//! Every writer returns bytes (or text) in full precision and base units; none opens a file. [`columns`] is the table of output
//! columns, [`by_name`] gives those of a map; [`csv`] and [`manifest`] write `map.csv` and `manifest.json`, [`zarr`] and [`netcdf`] the labelled [`arrays`] of a
//! sweep, part by part, [`parquet`] its table, [`boundary_lines`] its lines, [`cut`] curves through it. [`figure`] draws it and
//! [`read`] reads it back.

pub mod accounted;
pub mod arrays;
#[cfg(feature = "figures")]
pub mod boundary_lines;
pub mod by_name;
pub mod choose;
pub mod columns;
#[cfg(feature = "figures")]
pub mod comparison;
pub mod csv;
pub mod cut;
pub mod error;
#[cfg(feature = "figures")]
pub mod figure;
pub mod manifest;
pub mod netcdf;
pub mod number;
#[cfg(feature = "parquet")]
pub mod parquet;
#[cfg(feature = "figures")]
pub mod read;
#[cfg(feature = "figures")]
pub mod refined;
pub mod trust;
pub mod zarr;
