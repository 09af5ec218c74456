//! f32 and f64 under one trait: the arithmetic a kernel may use.
//!
//! Only what every GPU rounds well: `+ − * / sqrt abs min max select`. No `exp`, no angles: on a GPU those
//! may be off by 4096 ulp, and differ from driver to driver.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::engine::precision::Precision;

/// A scalar of the kernels, `real` in WGSL.
pub trait Real:
    bytemuck::Pod
    + Debug
    + PartialOrd
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// Its precision: f32 or f64.
    const PRECISION: Precision;
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// Distance of 1 to the next larger number.
    const EPSILON: Self;

    /// The nearest number: the only narrowing there is.
    fn from_f64(value: f64) -> Self;
    /// This number in f64, exactly.
    fn to_f64(self) -> f64;
    /// The square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// The magnitude.
    #[must_use]
    fn abs(self) -> Self;
    /// The bits of the number as f32, for tests that a compiler may not fold away.
    fn bits32(self) -> u32;

    /// Whether it is finite as f32, by its bits: twin of `is_finite` in `shaders/host.wgsl`.
    fn is_finite(self) -> bool {
        const EXPONENT: u32 = 0x7f80_0000;
        self.bits32() & EXPONENT != EXPONENT
    }

    /// The smaller of two numbers; `self` when they are unordered.
    #[must_use]
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    /// The larger of two numbers; `self` when they are unordered.
    #[must_use]
    fn max(self, other: Self) -> Self {
        if self < other { other } else { self }
    }

    /// WGSL's `select`: `yes` when the condition holds.
    #[must_use]
    fn select(no: Self, yes: Self, condition: bool) -> Self {
        if condition { yes } else { no }
    }
}

impl Real for f32 {
    const PRECISION: Precision = Precision::F32;
    const ZERO: f32 = 0.0;
    const ONE: f32 = 1.0;
    const EPSILON: f32 = f32::EPSILON;

    #[expect(clippy::cast_possible_truncation, reason = "the narrowing")]
    fn from_f64(value: f64) -> f32 {
        value as f32
    }

    fn to_f64(self) -> f64 {
        f64::from(self)
    }

    fn sqrt(self) -> f32 {
        self.sqrt()
    }

    fn abs(self) -> f32 {
        self.abs()
    }

    fn bits32(self) -> u32 {
        self.to_bits()
    }
}

impl Real for f64 {
    const PRECISION: Precision = Precision::F64;
    const ZERO: f64 = 0.0;
    const ONE: f64 = 1.0;
    const EPSILON: f64 = f64::EPSILON;

    fn from_f64(value: f64) -> f64 {
        value
    }

    fn to_f64(self) -> f64 {
        self
    }

    fn sqrt(self) -> f64 {
        self.sqrt()
    }

    fn abs(self) -> f64 {
        self.abs()
    }

    fn bits32(self) -> u32 {
        f32::from_f64(self).to_bits()
    }
}
