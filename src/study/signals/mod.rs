//! An instance as sensors record it.

pub mod sensors;
#[cfg(feature = "identify")]
pub mod table;
