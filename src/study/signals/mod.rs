//! An instance as sensors record it.

pub mod sensors;
pub mod table;
