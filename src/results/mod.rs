//! Map → bytes, and a map read back.
//!
//! Every writer returns bytes (or text) in full precision and base units; none opens a file. The columns are
//! those of [`crate::sweep::columns`]; [`csv`] and [`manifest`] write `map.csv` and `manifest.json`, [`zarr`] and [`netcdf`] the labelled [`arrays`] of a
//! sweep, part by part, [`parquet`] its table, [`boundary_lines`] its lines, [`cut`] curves through it. [`figure`] draws it and
//! [`read`] reads it back.

pub mod accounted;
pub mod arrays;
pub mod boundary_lines;
pub mod choose;
pub mod comparison;
pub mod csv;
pub mod cut;
pub mod error;
pub mod figure;
pub mod manifest;
pub mod netcdf;
pub mod number;
pub mod parquet;
pub mod read;
pub mod refined;
pub mod trust;
pub mod zarr;
