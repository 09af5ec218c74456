//! One instance over time.

pub mod figure;
pub mod read;
pub mod run;
pub mod table;
