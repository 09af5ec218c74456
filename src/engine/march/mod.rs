//! The method of the engine of the CPU as a compute kernel: every invocation takes one stretch of one instance, and the host
//! keeps the instance as that engine does, as a [`Job`](crate::engine::lanes::job::Job).
//!
//! - [`kernel`]: the kernel for each part of a run.
//! - [`marching`]: an instance on its way, stretch by stretch.
//! - [`series`]: the series of a step, written out in WGSL.
//! - `rows.rs`, `curved.rs`: what they are made of, and slip on a curved law.
//! - [`table`]: what stands where in its buffers.
//! - [`words`]: the next stretch of a job as words, and what the kernel has made of them.

mod curved;
pub mod kernel;
pub mod marching;
mod rows;
pub mod series;
pub mod table;
pub mod words;
