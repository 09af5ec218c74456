//! Where many instances run.
//!
//! - [`choice`]: which of the two computes, in which precision, and why.
//! - [`computed`]: what an engine made of a sweep, all or a part.
//! - [`cpu`]: the f64 reference on all cores.
//! - [`gpu`]: compute kernels through wgpu.

pub mod choice;
pub mod computed;
pub mod cpu;
pub mod gpu;
