//! One instance over time.
//!
//! - [`run`]: the sampled trajectory.
//! - [`table`], [`figure`]: its files.
//! - [`read`]: these read back.

#[cfg(feature = "figures")]
pub mod figure;
#[cfg(feature = "figures")]
pub mod read;
pub mod run;
#[cfg(feature = "figures")]
pub mod table;
