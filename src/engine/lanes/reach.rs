//! How far a step may go: the truncation of its series.

use std::ops::Not;

use pulp::Simd;

use crate::engine::lanes::expand::Expansion;
use crate::engine::lanes::motion::{FLIGHT, SINGLE};
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::{Mask, Vector};

/// A step whose truncation leaves room for it lets the next be longer by this factor.
pub const LONGER: f64 = 1.4;
/// A step that is too long ends where the last terms, taken to fall with the eighth power, are within their
/// bound, and this much before: they fall faster, the motion they are measured by may fall too.
pub const MARGIN: f64 = 0.9;
/// One that would end before this part of it is expanded over less.
pub const FAR: f64 = 0.5;
/// One that would end before this part of it ends the run: the eighth power asks for far too little where the terms grow
/// with the fourteenth, and a step of a part in millions is asked for where friction changes as fast.
pub const SHORTEST: f64 = 1e-15;

/// The length that the last terms of a step's series allow.
pub struct Reach<S: Simd, T: Scalar<S>> {
    /// How far into the step its series can be trusted, 1 for all of it.
    pub end: Vector<S, T>,
    /// Lanes that would have to take steps too short to go on.
    pub failed: Mask<S, T>,
    /// Lanes that had room for a longer step.
    pub roomy: Mask<S, T>,
}

/// How far the series are within the tolerance. A step that is far too long is made shorter, so that what
/// looks for events has its samples where they count.
#[inline(always)]
pub fn reach<S: Simd, T: Scalar<S>, const N: usize, const MOTION: u8>(
    e: &mut Expansion<S, T, N>,
    tolerance: Vector<S, T>,
) -> Reach<S, T> {
    let one = e.step.like(1.0);
    let (l0, l1, l2) = (
        largest::<S, T, N, MOTION>(e, 0),
        largest::<S, T, N, MOTION>(e, 1),
        largest::<S, T, N, MOTION>(e, 2),
    );
    let (last_but_one, very_last) =
        (largest::<S, T, N, MOTION>(e, N - 2), largest::<S, T, N, MOTION>(e, N - 1));
    let bound = tolerance * l0.max(l1).max(l2);
    let growth = (2..N).fold(1.0, |power, _| power * LONGER);
    let roomy = (last_but_one.max(very_last * one.like(LONGER)) * one.like(growth)).at_most(bound);
    let last = last_but_one.max(very_last);
    let bad = last.at_most(bound).not();
    let mut end = one;
    if !bad.any() {
        return Reach { end, failed: bad, roomy };
    }
    end = bad.select((bound / last).sqrt().sqrt().sqrt() * one.like(MARGIN), one);
    let failed = one.like(SHORTEST).at_most(end).not();
    let far = end.less(one.like(FAR));
    if far.any() {
        let t = far.select(end, one);
        let mut power = one;
        let square = t * t;
        for k in 0..N {
            for i in 0..3 {
                e.p[i][k] = e.p[i][k] * power;
                e.v[i][k] = e.v[i][k] * power;
            }
            let power_of_force = power * square;
            e.a[0][k] = e.a[0][k] * power_of_force;
            e.a[1][k] = e.a[1][k] * power_of_force;
            e.n[k] = e.n[k] * power_of_force;
            power = power * t;
        }
        e.step = e.step * t;
        e.rate = e.rate / t;
        end = far.select(one, end);
    }
    Reach { end, failed, roomy }
}

/// The largest magnitude of the positions' coefficients of degree `k`.
#[inline(always)]
pub fn largest<S: Simd, T: Scalar<S>, const N: usize, const MOTION: u8>(
    e: &Expansion<S, T, N>,
    k: usize,
) -> Vector<S, T> {
    match MOTION {
        SINGLE => e.p[0][k].abs(),
        FLIGHT => e.p[0][k].abs().max(e.p[2][k].abs()).max(e.p[1][k].abs()),
        _ => e.p[0][k].abs().max(e.p[2][k].abs()),
    }
}
