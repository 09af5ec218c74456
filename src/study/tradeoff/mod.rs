//! Speed against error of every way to compute a sweep.

pub mod figure;
pub mod read;
pub mod report;
