//! The report, the figure and the spectrogram of measured signals.
//!
//! - [`report`]: the table of windows and the report.
//! - [`rig`]: the structure that a sweep file describes.
//! - [`spectrogram`]: the spectrogram as NetCDF.
//! - [`shown`]: what the figure shows; [`read`]: the same, read back; [`figure`]: its page, and what stands in its panels.

pub mod figure;
pub(crate) mod panels;
pub mod read;
pub mod report;
pub mod rig;
pub mod shown;
pub mod spectrogram;
