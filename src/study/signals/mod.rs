//! An instance as sensors record it.
//!
//! - [`sensors`]: the sampled channels.
//! - [`table`]: their table, `signals.csv`.

pub mod filter;
pub mod sensors;
#[cfg(feature = "identify")]
pub mod table;
