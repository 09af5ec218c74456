//! The report, the figure and the spectrogram of measured signals.
//!
//! - [`report`]: the table of windows and the report.
//! - [`spectrogram`]: the spectrogram as NetCDF.
//! - [`figure`]: the figure; [`read`]: what it needs, read back.

pub mod figure;
pub mod read;
pub mod report;
pub mod spectrogram;
