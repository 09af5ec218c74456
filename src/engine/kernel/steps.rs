//! The steps of the kernels: how many terms a series has, and how exact it is.

/// Order of the position series.
pub const ORDER: usize = 8;

/// Bound on the truncation of a step, relative to the motion: with 12 steps per period the amplitudes are
/// those of the reference to 1.5e-4 at the 99th percentile.
pub const TOLERANCE: f32 = 2e-4;
