//! What runs once per instance in a compute kernel.
//!
//! A kernel is a generated header followed by a listed concatenation of WGSL files. Each function of the WGSL of the
//! eigenvalues has a twin here, generic over the scalar: same names, same order, same arithmetic, so that f32 on the CPU and
//! f32 on a GPU can be compared function by function.
//!
//! - [`source`]: the contract between host and kernels: bindings, words, settings, constants.
//! - [`scalar`]: f32 and f64 under one trait.
//! - [`linear`]: eigenvalues and attribution of one instance.
//! - [`batch`]: the instances of a sweep as words of the linear kernel, and back as records.
//! - [`places`]: where the words of instances stand in a buffer.
//! - [`spirv`]: a kernel as SPIR-V in which every operation on floats is rounded by itself.
//! - [`words`]: an instance as words of the linear kernel, and back (f64, host only).

#[cfg(feature = "kernels")]
pub mod batch;
pub mod linear;
pub mod places;
pub mod scalar;
pub mod source;
#[cfg(feature = "gpu")]
pub mod spirv;
pub mod words;
