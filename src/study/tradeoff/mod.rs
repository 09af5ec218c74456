//! Speed against error of every way to compute a sweep.
//!
//! - [`report`]: the table and its summary.
//! - [`figure`]: the figure; [`read`]: both read back.

pub mod figure;
pub mod read;
pub mod report;
