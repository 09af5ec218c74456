//! The method of the engine of the CPU as a compute kernel: every invocation takes one stretch of one instance, and the host
//! keeps the instance as that engine does, as a [`Job`](crate::engine::lanes::job::Job).
//!
//! - [`kernel`]: the kernel for each part of a run.
//! - [`marching`]: an instance on its way, stretch by stretch.
//! - [`series`]: the series of a step, written out in WGSL.
//! - `rows.rs`, `curved.rs`: what they are made of, and slip on a curved law.
//! - [`table`]: what stands where in its buffers.
//! - [`flow`]: instances that pass through the lanes of a device.
//! - [`round`]: the words of all lanes in the buffers of a device; `columns.rs` turns rows into columns.
//! - [`words`]: the next stretch of a job as words, and what the kernel has made of them.

mod columns;
mod curved;
pub mod flow;
pub mod kernel;
pub mod marching;
pub mod round;
mod rows;
pub mod series;
pub mod table;
pub mod words;
