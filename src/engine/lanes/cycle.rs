//! The state of the sums at the last end of stick, so that whole cycles can be added to it.

use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::{Mask, Vector};
use crate::engine::sums::sum;
use pulp::Simd;

/// The value of [`Cycle::since`] before the first end of stick.
pub const NEVER: f64 = -1.0;

/// The sums of the lanes at the last end of stick in their stretches.
#[derive(Clone, Copy, Debug)]
pub struct Cycle<S: Simd, T: Scalar<S>> {
    /// Time since the stretch began; negative before the first.
    pub since: Vector<S, T>,
    /// The sums of the window.
    pub(super) window: [Vector<S, T>; sum::WORDS],
    /// Upward crossings of `ẋ2`.
    pub(super) crossings: Vector<S, T>,
}

impl<S: Simd, T: Scalar<S>> Cycle<S, T> {
    /// Nothing yet.
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        let zero = Vector::constant(simd, 0.0);
        Cycle { since: zero.like(NEVER), window: [zero; sum::WORDS], crossings: zero }
    }

    /// Forgets the cycles of lanes that slip back.
    #[inline(always)]
    pub fn slips_back(&mut self, reverse: Mask<S, T>) {
        if reverse.any() {
            self.since = reverse.select(self.since.like(NEVER), self.since);
        }
    }
}
