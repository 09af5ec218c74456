//! The scalars of the lanes, and what vector registers do with them.

use crate::engine::kernel::scalar::Real;
use pulp::Simd;
use std::fmt::Debug;

/// A scalar with its register and comparison mask under an instruction set.
pub trait Scalar<S: Simd>: Real {
    /// A register.
    type Register: Copy + Debug + bytemuck::Pod;
    /// A truth value per lane.
    type Bits: Copy + Debug;
    /// Lanes of a register.
    const LANES: usize;

    /// A register with `value` in every lane.
    fn splat(simd: S, value: Self) -> Self::Register;
    /// `a + b`.
    fn add(simd: S, a: Self::Register, b: Self::Register) -> Self::Register;
    /// `a − b`.
    fn sub(simd: S, a: Self::Register, b: Self::Register) -> Self::Register;
    /// `a b`.
    fn mul(simd: S, a: Self::Register, b: Self::Register) -> Self::Register;
    /// `a / b`.
    fn div(simd: S, a: Self::Register, b: Self::Register) -> Self::Register;
    /// `a b + c`, rounded once where the machine can.
    fn fma(simd: S, a: Self::Register, b: Self::Register, c: Self::Register) -> Self::Register;
    /// `c − a b`, likewise.
    fn fnma(simd: S, a: Self::Register, b: Self::Register, c: Self::Register) -> Self::Register;
    /// `−a`.
    fn neg(simd: S, a: Self::Register) -> Self::Register;
    /// `|a|`.
    fn abs(simd: S, a: Self::Register) -> Self::Register;
    /// The square root.
    fn sqrt(simd: S, a: Self::Register) -> Self::Register;
    /// The smaller.
    fn min(simd: S, a: Self::Register, b: Self::Register) -> Self::Register;
    /// The larger.
    fn max(simd: S, a: Self::Register, b: Self::Register) -> Self::Register;
    /// `a < b`.
    fn less(simd: S, a: Self::Register, b: Self::Register) -> Self::Bits;
    /// `a ≤ b`.
    fn at_most(simd: S, a: Self::Register, b: Self::Register) -> Self::Bits;
    /// `yes` where the mask is set.
    fn select(simd: S, mask: Self::Bits, yes: Self::Register, no: Self::Register) -> Self::Register;
    /// Both.
    fn and(simd: S, a: Self::Bits, b: Self::Bits) -> Self::Bits;
    /// Either.
    fn or(simd: S, a: Self::Bits, b: Self::Bits) -> Self::Bits;
    /// Not.
    fn not(simd: S, a: Self::Bits) -> Self::Bits;
    /// Whether any lane is set.
    fn any(simd: S, a: Self::Bits) -> bool;
}
