//! Where many instances run.
//!
//! - [`choice`]: which of the two computes, in which precision, and why.
//! - [`cpu`]: the f64 reference on all cores.
//! - [`gpu`]: compute kernels through wgpu.

pub mod choice;
pub mod cpu;
pub mod gpu;
