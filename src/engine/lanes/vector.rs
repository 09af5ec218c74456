//! Vectors of lanes: one register of the machine.
//!
//! Every operation is inlined into the code that `pulp` compiles for the instruction set found at run
//! time.

use crate::engine::lanes::scalar::Scalar;
use crate::engine::precision::Precision;
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Not, Sub};

use pulp::Simd;

macro_rules! scalar {
    ($scalar:ty, $register:ident, $mask:ident, $lanes:ident, $splat:ident, $add:ident, $sub:ident, $mul:ident,
     $div:ident, $fma:ident, $fnma:ident, $abs:ident, $sqrt:ident, $min:ident, $max:ident, $less:ident,
     $at_most:ident, $select:ident, $and:ident, $or:ident, $not:ident, $first:ident) => {
        impl<S: Simd> Scalar<S> for $scalar {
            type Register = S::$register;
            type Bits = S::$mask;
            const LANES: usize = S::$lanes;

            #[inline(always)]
            fn splat(simd: S, value: Self) -> Self::Register {
                simd.$splat(value)
            }
            #[inline(always)]
            fn add(simd: S, a: Self::Register, b: Self::Register) -> Self::Register {
                simd.$add(a, b)
            }
            #[inline(always)]
            fn sub(simd: S, a: Self::Register, b: Self::Register) -> Self::Register {
                simd.$sub(a, b)
            }
            #[inline(always)]
            fn mul(simd: S, a: Self::Register, b: Self::Register) -> Self::Register {
                simd.$mul(a, b)
            }
            #[inline(always)]
            fn div(simd: S, a: Self::Register, b: Self::Register) -> Self::Register {
                simd.$div(a, b)
            }
            #[inline(always)]
            fn fma(simd: S, a: Self::Register, b: Self::Register, c: Self::Register) -> Self::Register {
                simd.$fma(a, b, c)
            }
            #[inline(always)]
            fn fnma(simd: S, a: Self::Register, b: Self::Register, c: Self::Register) -> Self::Register {
                simd.$fnma(a, b, c)
            }
            #[inline(always)]
            fn neg(simd: S, a: Self::Register) -> Self::Register {
                // The same bits as by `pulp`'s own, which is not always inlined.
                simd.$mul(a, simd.$splat(-1.0))
            }
            #[inline(always)]
            fn abs(simd: S, a: Self::Register) -> Self::Register {
                simd.$abs(a)
            }
            #[inline(always)]
            fn sqrt(simd: S, a: Self::Register) -> Self::Register {
                simd.$sqrt(a)
            }
            #[inline(always)]
            fn min(simd: S, a: Self::Register, b: Self::Register) -> Self::Register {
                simd.$min(a, b)
            }
            #[inline(always)]
            fn max(simd: S, a: Self::Register, b: Self::Register) -> Self::Register {
                simd.$max(a, b)
            }
            #[inline(always)]
            fn less(simd: S, a: Self::Register, b: Self::Register) -> Self::Bits {
                simd.$less(a, b)
            }
            #[inline(always)]
            fn at_most(simd: S, a: Self::Register, b: Self::Register) -> Self::Bits {
                simd.$at_most(a, b)
            }
            #[inline(always)]
            fn select(simd: S, mask: Self::Bits, yes: Self::Register, no: Self::Register) -> Self::Register {
                simd.$select(mask, yes, no)
            }
            #[inline(always)]
            fn and(simd: S, a: Self::Bits, b: Self::Bits) -> Self::Bits {
                simd.$and(a, b)
            }
            #[inline(always)]
            fn or(simd: S, a: Self::Bits, b: Self::Bits) -> Self::Bits {
                simd.$or(a, b)
            }
            #[inline(always)]
            fn not(simd: S, a: Self::Bits) -> Self::Bits {
                simd.$not(a)
            }
            #[inline(always)]
            fn any(simd: S, a: Self::Bits) -> bool {
                simd.$first(a) < <Self as Scalar<S>>::LANES
            }
        }
    };
}

scalar!(
    f32,
    f32s,
    m32s,
    F32_LANES,
    splat_f32s,
    add_f32s,
    sub_f32s,
    mul_f32s,
    div_f32s,
    mul_add_e_f32s,
    negate_mul_add_e_f32s,
    abs_f32s,
    sqrt_f32s,
    min_f32s,
    max_f32s,
    less_than_f32s,
    less_than_or_equal_f32s,
    select_f32s,
    and_m32s,
    or_m32s,
    not_m32s,
    first_true_m32s
);
scalar!(
    f64,
    f64s,
    m64s,
    F64_LANES,
    splat_f64s,
    add_f64s,
    sub_f64s,
    mul_f64s,
    div_f64s,
    mul_add_e_f64s,
    negate_mul_add_e_f64s,
    abs_f64s,
    sqrt_f64s,
    min_f64s,
    max_f64s,
    less_than_f64s,
    less_than_or_equal_f64s,
    select_f64s,
    and_m64s,
    or_m64s,
    not_m64s,
    first_true_m64s
);

/// A register; aligned to cache lines, which the registers of `pulp` are not.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Vector<S: Simd, T: Scalar<S>> {
    simd: S,
    register: T::Register,
}

/// A truth value per lane of a [`Vector`].
#[derive(Clone, Copy, Debug)]
pub struct Mask<S: Simd, T: Scalar<S>> {
    simd: S,
    bits: T::Bits,
}

impl<S: Simd, T: Scalar<S>> Vector<S, T> {
    /// Lanes.
    pub const LANES: usize = T::LANES;

    /// A vector with `value` in every lane.
    #[inline(always)]
    pub fn splat(simd: S, value: T) -> Self {
        Vector { simd, register: T::splat(simd, value) }
    }

    /// A vector with `value` in every lane, rounded to the scalar.
    #[inline(always)]
    pub fn constant(simd: S, value: f64) -> Self {
        Vector::splat(simd, T::from_f64(value))
    }

    /// A vector with `value` in every lane, for the instruction set that `self` is made for.
    #[inline(always)]
    #[must_use]
    pub fn like(self, value: f64) -> Self {
        Vector::constant(self.simd, value)
    }

    /// The instruction set.
    #[inline(always)]
    pub fn simd(&self) -> S {
        self.simd
    }

    /// The value of a lane.
    #[inline(always)]
    pub fn get(&self, lane: usize) -> T {
        self.as_slice()[lane]
    }

    /// Sets the value of a lane.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, value: T) {
        bytemuck::cast_slice_mut::<T::Register, T>(std::slice::from_mut(&mut self.register))[lane] = value;
    }

    /// The lanes.
    #[inline(always)]
    pub fn as_slice(&self) -> &[T] {
        bytemuck::cast_slice(std::slice::from_ref(&self.register))
    }

    /// `self b + c`.
    #[inline(always)]
    #[must_use]
    pub fn fma(self, b: Self, c: Self) -> Self {
        Vector { simd: self.simd, register: T::fma(self.simd, self.register, b.register, c.register) }
    }

    /// `c − self b`.
    #[inline(always)]
    #[must_use]
    pub fn fnma(self, b: Self, c: Self) -> Self {
        Vector { simd: self.simd, register: T::fnma(self.simd, self.register, b.register, c.register) }
    }

    /// The magnitude.
    #[inline(always)]
    #[must_use]
    pub fn abs(self) -> Self {
        Vector { simd: self.simd, register: <T as Scalar<S>>::abs(self.simd, self.register) }
    }

    /// The square root.
    #[inline(always)]
    #[must_use]
    pub fn sqrt(self) -> Self {
        Vector { simd: self.simd, register: <T as Scalar<S>>::sqrt(self.simd, self.register) }
    }

    /// The smaller of two.
    #[inline(always)]
    #[must_use]
    pub fn min(self, b: Self) -> Self {
        Vector { simd: self.simd, register: <T as Scalar<S>>::min(self.simd, self.register, b.register) }
    }

    /// The larger of two.
    #[inline(always)]
    #[must_use]
    pub fn max(self, b: Self) -> Self {
        Vector { simd: self.simd, register: <T as Scalar<S>>::max(self.simd, self.register, b.register) }
    }

    /// `self < b`.
    #[inline(always)]
    pub fn less(self, b: Self) -> Mask<S, T> {
        Mask { simd: self.simd, bits: T::less(self.simd, self.register, b.register) }
    }

    /// `self ≤ b`.
    #[inline(always)]
    pub fn at_most(self, b: Self) -> Mask<S, T> {
        Mask { simd: self.simd, bits: T::at_most(self.simd, self.register, b.register) }
    }

    /// `self ≤ 0`.
    #[inline(always)]
    pub fn not_positive(self) -> Mask<S, T> {
        self.at_most(self.like(0.0))
    }

    /// The largest whole number that is not above `self`, below 2^22.
    #[inline(always)]
    #[must_use]
    pub fn floor(self) -> Self {
        // Behind this one there are no digits for a fraction.
        let large = self.like(match T::PRECISION {
            Precision::F32 => 12_582_912.0,
            Precision::F64 => 6_755_399_441_055_744.0,
        });
        let whole = (self + large) - large;
        self.less(whole).select(whole - self.like(1.0), whole)
    }

    /// Stores a selection of what stands in this place and something else, as a whole. Of an assignment the compiler makes a
    /// masked store, which takes processors without masks in registers of their own a dozen cycles and more (AMD, AVX2).
    #[inline(always)]
    pub fn put(&mut self, selected: Self) {
        if const { size_of::<T::Bits>() < 16 } {
            *self = selected;
        } else {
            // A place that the compiler does not know to be that of the selection.
            *std::hint::black_box(self) = selected;
        }
    }

    /// `self` where the mask is set, else 0.
    #[inline(always)]
    #[must_use]
    pub fn only(self, mask: Mask<S, T>) -> Self {
        mask.select(self, self.like(0.0))
    }
}

impl<S: Simd, T: Scalar<S>> Mask<S, T> {
    /// `yes` where set.
    #[inline(always)]
    pub fn select(self, yes: Vector<S, T>, no: Vector<S, T>) -> Vector<S, T> {
        Vector {
            simd: self.simd,
            register: <T as Scalar<S>>::select(self.simd, self.bits, yes.register, no.register),
        }
    }

    /// Both.
    #[inline(always)]
    #[must_use]
    pub fn and(self, b: Self) -> Self {
        Mask { simd: self.simd, bits: T::and(self.simd, self.bits, b.bits) }
    }

    /// Either.
    #[inline(always)]
    #[must_use]
    pub fn or(self, b: Self) -> Self {
        Mask { simd: self.simd, bits: T::or(self.simd, self.bits, b.bits) }
    }

    /// Whether any lane is set.
    #[inline(always)]
    pub fn any(self) -> bool {
        T::any(self.simd, self.bits)
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident) => {
        impl<S: Simd, T: Scalar<S>> $trait for Vector<S, T> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, b: Self) -> Self {
                Vector {
                    simd: self.simd,
                    register: <T as Scalar<S>>::$method(self.simd, self.register, b.register),
                }
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl<S: Simd, T: Scalar<S>> Neg for Vector<S, T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Vector { simd: self.simd, register: <T as Scalar<S>>::neg(self.simd, self.register) }
    }
}

impl<S: Simd, T: Scalar<S>> AddAssign for Vector<S, T> {
    #[inline(always)]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

impl<S: Simd, T: Scalar<S>> Not for Mask<S, T> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Mask { simd: self.simd, bits: T::not(self.simd, self.bits) }
    }
}
