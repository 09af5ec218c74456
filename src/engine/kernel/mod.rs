//! What runs once per instance in a compute kernel: the twins of the files in `shaders/`.
//!
//! A kernel is a generated header followed by a listed concatenation of plain WGSL files. Each function of
//! a WGSL file has a twin here, generic over the scalar: same names, same order, same arithmetic, so that
//! f32 on the CPU and f32 on a GPU can be compared function by function.
//!
//! - [`source`]: the contract between host and kernels: bindings, words, settings, constants.
//! - [`scalar`]: f32 and f64 under one trait.
//! - [`linear`]: eigenvalues and attribution of one instance.
//! - [`scene`], [`series`], [`crossing`], [`observe`], [`contact`], [`lane`]: the transient of one instance.
//! - [`record`]: the result of one lane as it stands in the kernel's buffers.
//! - [`steps`]: how many terms the series of a step has, and how exact it is.
//! - [`segments`]: a run cut into the segments of a kernel.
//! - [`response`]: an instance as words of the response kernel, and its outcome (f64, host only).
//! - [`windows`]: a run until it is settled, window by window (host only).
//! - [`spirv`]: a kernel as SPIR-V in which every operation on floats is rounded by itself.
//! - [`words`]: an instance as words of the linear kernel, and back (f64, host only).

pub mod contact;
pub mod crossing;
pub mod lane;
pub mod linear;
pub mod observe;
pub mod record;
pub mod response;
pub mod scalar;
pub mod scene;
pub mod segments;
pub mod series;
pub mod source;
#[cfg(feature = "gpu")]
pub mod spirv;
pub mod steps;
pub mod table;
pub mod windows;
pub mod words;
