//! A map as bytes, and a map read back.
//!
//! Every writer returns bytes (or text) in full precision and base units; none opens a file.
//!
//! | question | where |
//! |---|---|
//! | `map.csv` and `manifest.json` | [`csv`], [`manifest`] |
//! | Zarr and NetCDF, part by part; Parquet | [`arrays`], [`zarr`], [`netcdf`], [`parquet`] |
//! | lines between classes as a table | [`boundary_lines`] |
//! | curves through a map | [`cut`] |
//! | `refine.json` and its figure | [`refined`] |
//! | the figure of a map | [`figure`] |
//! | a map read back | [`read`], [`number`] |
//! | the files of a comparison of two maps | [`comparison`] |
//! | the columns of a map in memory, by name | [`by_name`] |
//! | a sweep computed as arrays alone | [`gathered`] |
//! | values of axes as users name them | [`choose`] |
//! | whether a map is whole, and which of its numbers to trust | [`accounted`], [`trust`] |
//! | why results cannot be written, drawn or read | [`error`] |

pub mod accounted;
pub mod arrays;
#[cfg(feature = "figures")]
pub mod boundary_lines;
pub mod by_name;
pub mod choose;
#[cfg(feature = "figures")]
pub mod comparison;
pub mod csv;
pub mod cut;
pub mod error;
#[cfg(feature = "figures")]
pub mod figure;
pub mod gathered;
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
