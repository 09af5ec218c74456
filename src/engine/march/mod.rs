//! The method of the engine of the CPU as compute kernels: every invocation takes one leg of one instance, which is all of its run
//! where its belt is steady and its window not long, and the host keeps the instance as that engine does, as a
//! [`Job`](crate::engine::lanes::job::Job).
//!
//! - [`kernel`]: the kernel for each part of a run.
//! - [`leg`]: what a device goes through without the host.
//! - [`lane`]: an instance in a lane of a device.
//! - [`marching`]: an instance on its way, leg by leg.
//! - [`series`]: the series of a step, written out in WGSL.
//! - `rows.rs`, `curved.rs`: what they are made of, and slip on a curved law.
//! - [`table`]: what stands where in its buffers.
//! - [`asked`]: the instances of a sweep, and their records.
//! - [`flow`]: instances that pass through the lanes of a device.
//! - [`round`]: the words of all lanes in the buffers of a device.
//! - `words.rs`: what a leg of a job begins from as words, and what the kernels have made of them.

pub mod asked;
mod curved;
pub mod flow;
pub mod kernel;
pub mod lane;
pub mod leg;
pub mod marching;
pub mod round;
mod rows;
pub mod series;
pub mod table;
mod words;
