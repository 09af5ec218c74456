//! One event function of every lane, put together from the two series of [`crate::engine::lanes::functions`], without its root at the
//! beginning of the step.

use std::ops::Not;

use pulp::Simd;

use crate::engine::lanes::block::Block;
use crate::engine::lanes::constants::{INV_DET, MU_STICK, N0, STIFFNESS};
use crate::engine::lanes::expand::Expansion;
use crate::engine::lanes::functions::Functions;
use crate::engine::lanes::motion::SINGLE;
use crate::engine::lanes::reach::largest;
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::{Mask, Vector};
use crate::engine::reference::bounds::ROUNDINGS;

/// Zeros of an event function at its start are at most of this order (the gap opens with t³).
pub const HIGHEST_ORDER: usize = 3;

/// The rounding errors of event functions and their derivatives at the beginning of a step.
pub struct Rounding<S: Simd, T: Scalar<S>> {
    /// A force.
    pub force: Vector<S, T>,
    /// A sliding speed.
    pub speed: Vector<S, T>,
    /// An acceleration that opens the gap.
    gap: Vector<S, T>,
}

impl<S: Simd, T: Scalar<S>> Rounding<S, T> {
    /// Forces are off by the truncation of the motion and the rounding of the static loads.
    #[inline(always)]
    pub fn new<const N: usize, const MOTION: u8>(
        b: &Block<S, T>,
        e: &Expansion<S, T, N>,
        tolerance: Vector<S, T>,
    ) -> Self {
        let one = e.step.like(1.0);
        let slower = largest::<S, T, N, MOTION>(e, 2).fma(e.rate, largest::<S, T, N, MOTION>(e, 1));
        let motion = slower.fma(e.rate, largest::<S, T, N, MOTION>(e, 0));
        let loads = (b.scene[MU_STICK] + one) * b.scene[N0] + e.n[0].abs() * (e.rate * e.rate);
        let rounding = Vector::splat(b.simd, T::EPSILON) * e.step.like(ROUNDINGS);
        let band = rounding.fma(loads, tolerance * b.scene[STIFFNESS] * motion);
        Rounding { force: band * e.step * e.step, speed: band * e.step, gap: band * b.scene[INV_DET] }
    }

    /// The event function of lanes that slide or fly, or that of a force.
    #[inline(always)]
    fn of(&self, b: &Block<S, T>, of_force: Mask<S, T>) -> Vector<S, T> {
        of_force.select(self.force, b.slip().select(self.speed, self.gap))
    }
}

/// An event function of every lane, without its root of some order at zero.
pub struct Function<S: Simd, T: Scalar<S>> {
    /// Its value at the beginning.
    pub start: Vector<S, T>,
    /// How much of the normal force is in it, see [`Functions`].
    pub share: Vector<S, T>,
    /// How much of the second series.
    pub sign: Vector<S, T>,
    /// The order of its root at zero, which does not count: coefficients below it are taken to be 0.
    pub order: Vector<S, T>,
}

impl<S: Simd, T: Scalar<S>> Function<S, T> {
    /// A coefficient above degree 0.
    #[inline(always)]
    pub fn coefficient<const N: usize, const MOTION: u8>(
        &self,
        e: &Expansion<S, T, N>,
        g: &Functions<S, T, N>,
        degree: usize,
    ) -> Vector<S, T> {
        let force = if MOTION == SINGLE { e.step.like(0.0) } else { self.share * e.n[degree] };
        if degree < N - 1 { self.sign.fma(g.second[degree], force) } else { force }
    }

    /// Takes the root at zero from functions that begin there, by construction (`begins`) or within rounding (some of
    /// `low`); returns the first coefficient that counts. Lanes with nothing but zeros are no longer `live`. `of_force` says
    /// which functions are forces.
    #[inline(always)]
    pub fn deflate<const N: usize, const MOTION: u8>(
        &mut self,
        b: &Block<S, T>,
        e: &Expansion<S, T, N>,
        g: &Functions<S, T, N>,
        rounding: &Rounding<S, T>,
        [begins, low, of_force]: [Mask<S, T>; 3],
        live: &mut Mask<S, T>,
    ) -> Vector<S, T> {
        let (zero, one) = (self.start.like(0.0), self.start.like(1.0));
        let mut deflate = begins.or(low.and((-rounding.force).at_most(self.start)));
        let mut lead = self.start;
        let mut bound = rounding.of(b, of_force);
        self.start = deflate.select(zero, self.start);
        for degree in 0..HIGHEST_ORDER {
            lead = deflate.select(self.coefficient::<N, MOTION>(e, g, degree + 1), lead);
            self.order += one.only(deflate);
            bound = bound * e.step;
            // A force that stays where it is does not fall.
            deflate = deflate.and(lead.not_positive()).and((-bound.only(begins)).at_most(lead));
            if !deflate.any() {
                return lead;
            }
        }
        *live = live.and(deflate.not());
        lead
    }

    /// All coefficients.
    #[inline(always)]
    pub fn series<const N: usize, const MOTION: u8>(
        &self,
        e: &Expansion<S, T, N>,
        g: &Functions<S, T, N>,
        c: &mut [Vector<S, T>; N],
    ) {
        c[0] = self.start;
        for degree in 1..N {
            c[degree] = self.coefficient::<N, MOTION>(e, g, degree);
        }
        let one = self.order.like(1.0);
        for degree in 1..HIGHEST_ORDER {
            let less = one.like(degree as f64).less(self.order);
            if !less.any() {
                break;
            }
            c[degree] = c[degree].only(less.not());
        }
    }
}
