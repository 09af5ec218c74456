//! The scalar of a kernel twin: f32 or f64, with only the operations that every GPU computes exactly or
//! nearly so (`+ − * / sqrt abs min max`).

use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// The scalar of a kernel twin.
pub trait Real:
    Copy
    + std::fmt::Debug
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + Send
    + Sync
    + 'static
{
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// What may be left of a step before it counts as done, as a fraction of what was left.
    const LEAST_REST: Self;
    /// The nearest value.
    fn from_f64(value: f64) -> Self;
    /// The value itself.
    fn to_f64(self) -> f64;
    /// Magnitude.
    #[must_use]
    fn abs(self) -> Self;
    /// The larger of two.
    #[must_use]
    fn max(self, other: Self) -> Self;
    /// The smaller of two.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// Square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// Whether it is a finite number in f32 (what a kernel can test by bits).
    fn is_finite(self) -> bool;
}

macro_rules! real {
    ($type:ty) => {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_lossless,
            reason = "narrowing is the purpose"
        )]
        impl Real for $type {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const LEAST_REST: Self = 8.0 * <$type>::EPSILON;
            fn from_f64(value: f64) -> Self {
                value as $type
            }
            fn to_f64(self) -> f64 {
                self as f64
            }
            fn abs(self) -> Self {
                <$type>::abs(self)
            }
            fn max(self, other: Self) -> Self {
                <$type>::max(self, other)
            }
            fn min(self, other: Self) -> Self {
                <$type>::min(self, other)
            }
            fn sqrt(self) -> Self {
                <$type>::sqrt(self)
            }
            fn is_finite(self) -> bool {
                (self as f32).is_finite()
            }
        }
    };
}

real!(f32);
real!(f64);
