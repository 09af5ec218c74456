//! The state of the sums at the last end of stick, so that whole cycles can be added to it.

use crate::engine::kernel::observe::SUMS;
use crate::engine::lanes::vector::{Mask, Scalar, Vector};
use pulp::Simd;

/// The value of [`Cycle::since`] before the first end of stick.
pub const NEVER: f64 = -1.0;

/// The sums of the lanes at the last end of stick in their stretches.
#[derive(Clone, Copy, Debug)]
pub struct Cycle<S: Simd, T: Scalar<S>, const K: usize> {
    /// Time since the stretch began; negative before the first.
    pub since: Vector<S, T, K>,
    /// The sums of the window.
    pub(super) window: [Vector<S, T, K>; SUMS],
    /// Upward crossings of `ẋ2`.
    pub(super) crossings: Vector<S, T, K>,
}

impl<S: Simd, T: Scalar<S>, const K: usize> Cycle<S, T, K> {
    /// Nothing yet.
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        let zero = Vector::constant(simd, 0.0);
        Cycle { since: zero.like(NEVER), window: [zero; SUMS], crossings: zero }
    }

    /// Forgets the cycles of lanes that slip back.
    #[inline(always)]
    pub fn slips_back(&mut self, reverse: Mask<S, T, K>) {
        if reverse.any() {
            self.since = reverse.select(self.since.like(NEVER), self.since);
        }
    }
}
