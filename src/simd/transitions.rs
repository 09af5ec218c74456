//! What most events do, in all lanes at once: rest, stick, slip, kinks and lift-off.
//!
//! The rules are those of [`crate::kernel::lane`]; impacts and what is rare are left to it, lane by lane.

use std::ops::Not;

use pulp::Simd;

use super::block::{Block, FIRST, LOWER, SECOND, THIRD, UPPER};
use super::constants::{CONE, KAPPA, MU_STICK, N0, R, T0, W};
use super::vector::{Mask, Scalar, Vector};
use crate::kernel::scene::EVENTS_AT_ONCE;
use crate::kernel::series::{FREE, REVERSE, SLIP, STICK};

/// Most events of a stretch.
pub const MOST_EVENTS: f64 = 80_000.0;

/// A linear form of the state.
#[inline(always)]
fn form<S: Simd, T: Scalar<S>, const K: usize>(b: &Block<S, T, K>, at: usize) -> Vector<S, T, K> {
    let mut sum = b.scene[at].fma(b.p[0], b.scene[at + 2] * b.p[2]);
    sum = b.scene[at + 3].fma(b.v[0], sum);
    b.scene[at + 5].fma(b.v[2], sum)
}

/// A code in every lane.
#[inline(always)]
fn code<S: Simd, T: Scalar<S>, const K: usize>(like: Vector<S, T, K>, code: u32) -> Vector<S, T, K> {
    like.like(f64::from(code))
}

/// Carries out the events of lanes with a closed contact, `at` their places in the step; returns the lanes
/// that are left to be looked at.
#[inline(always)]
pub fn transitions<S: Simd, T: Scalar<S>, const K: usize>(
    b: &mut Block<S, T, K>,
    event: Vector<S, T, K>,
    at: Vector<S, T, K>,
) -> Mask<S, T, K> {
    let (zero, one) = (event.like(0.0), event.like(1.0));
    let happened = zero.less(event);
    b.at_once = happened.select((b.at_once + one).only(at.not_positive()), b.at_once);
    b.counted += one.only(happened);
    let limit = event.like(f64::from(EVENTS_AT_ONCE)).less(b.at_once);
    let limit = limit.or(event.like(MOST_EVENTS).less(b.counted));

    let (slip, free) = (b.slip(), b.free());
    let first = happened.and(event.at_most(event.like(f64::from(FIRST))));
    let third = event.like(f64::from(THIRD)).at_most(event);
    let second = happened.and(first.or(third).not());
    let lift_off = first.and(free.not());
    let inner = slip.and(second).and(b.piece[LOWER].not_positive());
    let kink = slip.and(second.or(third)).and(inner.not());
    let cone = slip.or(free).not().and(second.or(third));
    let stops = inner.or(cone);

    // At v = 0: stick inside the cone, else slip in the direction of the force.
    b.v[0] = stops.select(b.belt, b.v[0]);
    let (r, w) = (form(b, R), form(b, W));
    let tangential = r + b.drive;
    let normal = b.scene[KAPPA].fnma(b.drive, w);
    let held = b.scene[MU_STICK] * normal;
    let forward = held - tangential + b.scene[CONE];
    let backward = held + tangential + b.scene[CONE + 1];
    let sticks = inner.and(zero.at_most(forward)).and(zero.at_most(backward));
    let ahead = cone.and(second).or(inner.and(zero.at_most(tangential + b.scene[T0])));
    let q = ahead.select(b.scene[MU_STICK], -b.scene[MU_STICK]);
    let slides = stops.and(sticks.not());
    let ill_posed = slides.and(b.scene[KAPPA].fma(q, one).not_positive());
    let pressed = zero.less(b.scene[KAPPA].fma(r + b.scene[T0], w + b.scene[N0]));
    let rare = kink.and(zero.less(b.many)).or(ill_posed).or(happened.and(free)).or(limit);
    let done = happened.and(rare.not());

    let slipping = ahead.select(code(event, SLIP), code(event, REVERSE));
    let mut contact = sticks.select(code(event, STICK), b.contact);
    contact = slides.select(pressed.select(slipping, code(event, FREE)), contact);
    contact = lift_off.select(code(event, FREE), contact);
    let mut disarmed = slides.select(pressed.select(code(event, SECOND), code(event, FIRST)), zero);
    disarmed = lift_off.select(code(event, FIRST), disarmed);
    disarmed = kink.select(third.select(code(event, SECOND), code(event, THIRD)), disarmed);
    b.contact = done.select(contact, b.contact);
    b.disarmed = done.select(disarmed, b.disarmed);
    let swap = kink.and(done);
    if swap.any() {
        for word in 0..=UPPER {
            let (here, there) = (b.piece[word], b.other[word]);
            b.piece[word] = swap.select(there, here);
            b.other[word] = swap.select(here, there);
        }
    }
    rare
}
