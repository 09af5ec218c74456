//! The method of the engine of the CPU as a compute kernel: every invocation takes one stretch of one instance, and the host
//! keeps the instance as that engine does, as a [`Job`](crate::engine::lanes::job::Job).
//!
//! - [`kernel`]: the kernel for each part of a run.
//! - [`series`]: the series of a step, written out in WGSL.
//! - [`table`]: what stands where in its buffers.
//! - [`words`]: the next stretch of a job as words, and what the kernel has made of them.

pub mod kernel;
pub mod series;
pub mod table;
pub mod words;
