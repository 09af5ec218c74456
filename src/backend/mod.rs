//! Where many instances run.
//!
//! - [`cpu`]: the f64 reference on all cores.

pub mod cpu;
