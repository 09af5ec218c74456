//! Many instances on a GPU through wgpu: Vulkan, Metal or DX12, never GL.
//!
//! - [`adapter`]: which adapters there are, what they can do, which one is taken.
//! - [`arithmetic`]: the scalar of a device, and how it rounds.
//! - [`device`]: an open device: error scopes, waiting with a limit, device lost.
//! - [`kernel`]: a kernel compiled for a device and a scalar.
//! - `open.rs`: the one that a sweep is to be computed on, as an engine.
//! - [`strict`]: a kernel in which every operation is rounded by itself.
//! - [`run`]: one chunk of instances through a kernel, dispatch by dispatch.
//! - [`chunks`]: a whole sweep chunk by chunk; a lost device is opened again once.
//! - [`linear`]: the eigenvalue analysis of a sweep.
//! - [`response`]: the time integration of a sweep.
//! - `columns.rs`: words of instances in buffers.
//! - [`records`]: a GPU as an engine: both of them, one after the other.

pub mod adapter;
pub mod arithmetic;
pub mod chunks;
mod columns;
pub mod device;
pub mod kernel;
pub mod linear;
pub(crate) mod open;
pub mod records;
pub mod response;
pub mod run;
pub mod strict;
