//! Many instances on a GPU through wgpu: Vulkan, Metal or DX12, never GL.
//!
//! - [`adapter`]: which adapters there are, what they can do, which one is taken.
//! - [`arithmetic`]: the scalar of a device, and how it rounds.
//! - [`device`]: an open device: error scopes, waiting with a limit, device lost.
//! - [`kernel`]: a kernel compiled for a device and a scalar.
//! - `open.rs`: the one that a sweep is to be computed on, as an engine.
//! - [`strict`]: a kernel in which every operation is rounded by itself.
//! - [`run`]: one chunk of instances through a kernel, dispatch by dispatch.
//! - [`chunks`]: eigenvalues chunk by chunk; a lost device is opened again once.
//! - [`linear`]: the eigenvalue analysis of a sweep.
//! - [`response`]: the time integration of a sweep.
//! - `stream.rs`: the instances of a sweep that pass through the lanes of one device or several.
//! - `arena.rs`, `buffers.rs`: lanes of a device, rounds of dispatches; their buffers.
//! - [`meter`], `clock.rs`: what a device was given to do, and how long it took.
//! - [`records`]: a GPU as an engine: both of them, one after the other.

pub mod adapter;
mod arena;
pub mod arithmetic;
mod buffers;
pub mod chunks;
mod clock;
pub mod device;
pub mod kernel;
pub mod linear;
pub mod meter;
pub(crate) mod open;
pub mod records;
pub mod response;
pub mod run;
mod stream;
pub mod strict;
