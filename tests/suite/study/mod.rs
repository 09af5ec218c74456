//! Studies: modes, branches, traces, fits, measured signals, the source paper.

pub(crate) mod bound;
pub(crate) mod calibrate;
pub(crate) mod claims;
pub(crate) mod confusion;
pub(crate) mod curves;
mod doubled;
mod explore;
pub(crate) mod fem;
pub(crate) mod fit;
pub(crate) mod fit_errors;
pub(crate) mod fit_records;
pub(crate) mod hysteresis;
pub(crate) mod identify;
pub(crate) mod identify_faults;
pub(crate) mod identify_files;
pub(crate) mod identify_growth;
pub(crate) mod judged;
pub(crate) mod laboratory;
pub(crate) mod modes_figure;
pub(crate) mod observed;
pub(crate) mod paper;
pub(crate) mod report_numbers;
pub(crate) mod sampling;
pub(crate) mod segments;
pub(crate) mod stroke_table;
pub(crate) mod strokes;
pub(crate) mod trace_figure;
