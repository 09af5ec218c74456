//! One instance over time.
//!
//! - [`run`]: the sampled trajectory.
//! - [`table`], [`figure`]: its files.
//! - [`read`]: these read back.

pub mod figure;
pub mod read;
pub mod run;
pub mod table;
