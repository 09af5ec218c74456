//! Polynomials in every lane: values and derivatives of the series of a step, whose time runs from 0 to 1.

use pulp::Simd;

use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::Vector;

/// `Σ b_k t^(k − first)` over all degrees from `first` on. Even and odd ones are summed side by side, which takes less time
/// than one chain of all.
#[inline(always)]
pub fn value_soon<S: Simd, T: Scalar<S>, const N: usize>(
    b: &[Vector<S, T>; N],
    first: usize,
    t: Vector<S, T>,
) -> Vector<S, T> {
    soon_to(b, first, N - 1, t)
}

/// `Σ b_k t^(k − first)` over the degrees from `first` to `degree`, which is above it; see [`value_soon`].
#[inline(always)]
pub fn soon_to<S: Simd, T: Scalar<S>, const N: usize>(
    b: &[Vector<S, T>; N],
    first: usize,
    degree: usize,
    t: Vector<S, T>,
) -> Vector<S, T> {
    let square = t * t;
    let [mut lower, mut upper] = [b[degree - 1], b[degree]];
    let mut k = degree - 1;
    while k >= first + 3 {
        k -= 2;
        lower = lower.fma(square, b[k]);
        upper = upper.fma(square, b[k + 1]);
    }
    // What the first term, the largest, is added to is rounded once.
    let mut sum = upper.fma(t, lower);
    while k > first {
        k -= 1;
        sum = sum.fma(t, b[k]);
    }
    sum
}

/// `Σ b_k` and `Σ k b_k`: value and slope at 1.
#[inline(always)]
pub fn at_one<S: Simd, T: Scalar<S>, const N: usize>(b: &[Vector<S, T>; N]) -> [Vector<S, T>; 2] {
    // Four sums at a time, which do not wait for each other.
    let mut sums = [b[0], b[1], b[2], b[3]];
    let mut slopes = [b[0].like(0.0), b[1], b[2] + b[2], b[3] * b[3].like(3.0)];
    for k in 4..N {
        sums[k % 4] += b[k];
        slopes[k % 4] = b[k].fma(b[k].like(k as f64), slopes[k % 4]);
    }
    [(sums[0] + sums[1]) + (sums[2] + sums[3]), (slopes[0] + slopes[1]) + (slopes[2] + slopes[3])]
}

/// `Σ b_k t^k` and its derivative.
#[inline(always)]
pub fn value_and_slope<S: Simd, T: Scalar<S>, const N: usize>(
    b: &[Vector<S, T>; N],
    t: Vector<S, T>,
) -> [Vector<S, T>; 2] {
    let mut sum = b[N - 1];
    let mut slope = sum.like(0.0);
    for k in (0..N - 1).rev() {
        slope = slope.fma(t, sum);
        sum = sum.fma(t, b[k]);
    }
    [sum, slope]
}

/// `Σ b_k t^k` and its first two derivatives, even and odd degrees at a time: sooner there than by a chain.
#[inline(always)]
pub fn value_slope_and_bend<S: Simd, T: Scalar<S>, const N: usize>(
    b: &[Vector<S, T>; N],
    t: Vector<S, T>,
) -> [Vector<S, T>; 3] {
    // E(s) + t O(s) with s = t², each with its derivatives by s.
    let square = t * t;
    let zero = t.like(0.0);
    let top = [b[(N - 1) / 2 * 2], b[(N - 2) / 2 * 2 + 1]];
    let mut parts = [[top[0], zero, zero], [top[1], zero, zero]];
    for odd in 0..2 {
        let mut k = (N - 1 - odd) / 2 * 2 + odd;
        while k >= 2 {
            k -= 2;
            let [value, slope, half_bend] = parts[odd];
            parts[odd] = [value.fma(square, b[k]), slope.fma(square, value), half_bend.fma(square, slope)];
        }
    }
    let [[even, even_slope, even_half], [odd, odd_slope, odd_half]] = parts;
    let twice = t + t;
    // P″ = 2 E′ + 4 s E″ + t (6 O′ + 4 s O″).
    let four = square * t.like(8.0);
    let of_even = four.fma(even_half, even_slope + even_slope);
    let of_odd = four.fma(odd_half, odd_slope * t.like(6.0));
    [odd.fma(t, even), twice.fma(odd_slope.fma(t, even_slope), odd), of_odd.fma(t, of_even)]
}
