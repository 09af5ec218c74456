//! The report, the figure and the spectrogram of measured signals.

pub mod figure;
pub mod read;
pub mod report;
pub mod spectrogram;
