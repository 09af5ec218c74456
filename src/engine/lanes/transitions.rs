//! The effects of most events in all lanes at once: rest, stick, slip, kinks, lift-off and impacts.
//!
//! The rules are those of [`crate::engine::lanes::contact`]. Rare events are left to it, lane by lane.

use std::ops::Not;

use pulp::Simd;

use crate::engine::lanes::block::{AT_ZERO, Block, FIRST, LOWER, ONE_PIECE, SECOND, THIRD, UPPER};
use crate::engine::lanes::constants::{CONE, KAPPA, MU_STICK, N0, R, T0, W};
use crate::engine::lanes::contact::HELD_FROM;
use crate::engine::lanes::contact::{FREE, REVERSE, SLIP, STICK};
use crate::engine::lanes::impacts::{at_speed, impact};
use crate::engine::lanes::motion::{FLIGHT, PIECES};
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::vector::{Mask, Vector};
use crate::engine::lanes::words::EVENTS_AT_ONCE;

/// A linear form of the state.
#[inline(always)]
fn form<S: Simd, T: Scalar<S>>(b: &Block<S, T>, at: usize) -> Vector<S, T> {
    let mut sum = b.scene[at].fma(b.p[0], b.scene[at + 2] * b.p[2]);
    sum = b.scene[at + 3].fma(b.v[0], sum);
    b.scene[at + 5].fma(b.v[2], sum)
}

/// A code in every lane.
#[inline(always)]
fn code<S: Simd, T: Scalar<S>>(like: Vector<S, T>, code: u32) -> Vector<S, T> {
    like.like(f64::from(code))
}

/// Carries out the events of all lanes, `at` their places in the step; returns the lanes that are left to be looked at.
#[inline(always)]
pub fn transitions<S: Simd, T: Scalar<S>, const LAW: bool, const MOTION: u8>(
    b: &mut Block<S, T>,
    event: Vector<S, T>,
    at: Vector<S, T>,
) -> Mask<S, T> {
    let (zero, one) = (event.like(0.0), event.like(1.0));
    let happened = zero.less(event);
    let at_once = happened.select((b.at_once + one).only(at.not_positive()), b.at_once);
    b.at_once.put(at_once);
    b.counted += one.only(happened);
    let limit = event.like(f64::from(EVENTS_AT_ONCE)).less(b.at_once);
    let limit = limit.or(b.most_events.less(b.counted));

    let (slip, free) = (b.slip(), b.free());
    let first = happened.and(event.at_most(event.like(f64::from(FIRST))));
    let third = event.like(f64::from(THIRD)).at_most(event);
    let second = happened.and(first.or(third).not());
    let lift_off = first.and(free.not());
    let inner = slip.and(second).and(b.piece[LOWER].not_positive());
    let kink = slip.and(second.or(third)).and(inner.not());
    let cone = slip.or(free).not().and(second.or(third));
    let mut rare = kink.and(zero.less(b.many)).or(limit);
    // Slip at rest whose inertia is not positive has passed the place where that vanishes.
    let at_zero = if LAW == PIECES { b.piece[AT_ZERO] } else { b.scene[MU_STICK] };
    let at_zero = b.reverse().select(-at_zero, at_zero);
    rare = rare.or(inner.and(b.scene[KAPPA].fma(at_zero, one).not_positive()));
    let mut lands = Landing::nowhere(event);
    if MOTION == FLIGHT {
        let hits = happened.and(free);
        if LAW == PIECES && hits.any() {
            rare = rare.or(hits.and(event.like(ONE_PIECE).less(b.many)));
            lands = land(b, hits, &mut rare);
        } else {
            rare = rare.or(hits);
        }
    }
    let at_rest = inner.or(lands.at_rest);
    let stops = at_rest.or(cone);

    // At v = 0: stick inside the cone, else slip in the direction of the force.
    let velocity = stops.select(b.belt, b.v[0]);
    b.v[0].put(velocity);
    let (r, w) = (form(b, R), form(b, W));
    let tangential = r + b.drive;
    let normal = b.scene[KAPPA].fnma(b.drive, w);
    let held = b.scene[MU_STICK] * normal;
    let forward = held - tangential + b.scene[CONE];
    let backward = held + tangential + b.scene[CONE + 1];
    let sticks = at_rest.and(zero.at_most(forward)).and(zero.at_most(backward));
    let ahead = cone.and(second).or(at_rest.and(zero.at_most(tangential + b.scene[T0])));
    let q = ahead.select(b.scene[MU_STICK], -b.scene[MU_STICK]);
    let slides = stops.and(sticks.not());
    let ill_posed = slides.and(b.scene[KAPPA].fma(q, one).not_positive());
    let pressed = zero.less(b.scene[KAPPA].fma(r + b.scene[T0], w + b.scene[N0])).or(lands.held);
    let rare = rare.or(ill_posed);
    let done = happened.and(rare.not());

    let slipping = ahead.or(lands.forward).select(code(event, SLIP), code(event, REVERSE));
    let mut contact = sticks.select(code(event, STICK), b.contact);
    let moves = slides.or(lands.moving);
    contact = moves.select(pressed.select(slipping, code(event, FREE)), contact);
    contact = lift_off.select(code(event, FREE), contact);
    let mut disarmed = slides.select(code(event, SECOND), zero);
    disarmed = moves.and(pressed.not()).or(lift_off).or(lands.rebounds).select(code(event, FIRST), disarmed);
    disarmed = kink.select(third.select(code(event, SECOND), code(event, THIRD)), disarmed);
    let (contact, disarmed) = (done.select(contact, b.contact), done.select(disarmed, b.disarmed));
    b.contact.put(contact);
    b.disarmed.put(disarmed);
    let swap = kink.or(lands.elsewhere).and(done);
    if swap.any() {
        for word in 0..=UPPER {
            let (here, there) = (b.piece[word], b.other[word]);
            b.piece[word].put(swap.select(there, here));
            b.other[word].put(swap.select(here, there));
        }
    }
    rare
}

/// Lanes that fall onto the belt.
struct Landing<S: Simd, T: Scalar<S>> {
    /// Lanes that come to rest on it.
    at_rest: Mask<S, T>,
    /// Lanes that slide.
    moving: Mask<S, T>,
    /// Lanes that slide and that the belt overtakes.
    forward: Mask<S, T>,
    /// Lanes that fly on.
    rebounds: Mask<S, T>,
    /// A body that lands again and again without time between is held: the force is zero within rounding.
    held: Mask<S, T>,
    /// They slide on the other piece of their law.
    elsewhere: Mask<S, T>,
}

impl<S: Simd, T: Scalar<S>> Landing<S, T> {
    /// No lane lands.
    #[inline(always)]
    fn nowhere(like: Vector<S, T>) -> Self {
        let none = like.like(0.0).less(like.like(0.0));
        Landing { at_rest: none, moving: none, forward: none, rebounds: none, held: none, elsewhere: none }
    }
}

/// Carries out the impacts of the lanes `hits` but for those that are `rare`.
#[inline(always)]
fn land<S: Simd, T: Scalar<S>>(
    b: &mut Block<S, T>,
    hits: Mask<S, T>,
    rare: &mut Mask<S, T>,
) -> Landing<S, T> {
    let zero = b.left.like(0.0);
    let after = impact(b);
    let relative = b.belt - after.tangential;
    let speed = relative.abs();
    let landed = at_speed(b, speed);
    let rebounds = zero.less(after.rebound);
    let forward = zero.less(relative);
    let moving = zero.less(speed);
    let q = forward.select(landed.mu, -landed.mu);
    let inertia = b.scene[KAPPA].fma(q, zero.like(1.0));
    let ill_posed = after.ill_posed.or(rebounds.not().and(moving).and(inertia.not_positive()));
    // What is not a number is for the scalar code, which ends the lane.
    let known = moving.or(speed.not_positive());
    *rare = rare.or(hits.and(ill_posed.or(known.not())));
    let hits = hits.and(rare.not());
    let gap = hits.select(zero, b.p[1]);
    b.p[1].put(gap);
    let (tangential, rebound) = (hits.select(after.tangential, b.v[0]), hits.select(after.rebound, b.v[1]));
    b.v[0].put(tangential);
    b.v[1].put(rebound);
    // Another contact state has other modes.
    let pace = hits.select(b.step, b.pace);
    b.pace.put(pace);
    let closes = hits.and(rebounds.not());
    let held = closes.and(zero.like(f64::from(HELD_FROM)).at_most(b.at_once));
    let moving = closes.and(moving);
    Landing {
        at_rest: closes.and(moving.not()),
        moving,
        forward: moving.and(forward),
        rebounds: hits.and(rebounds),
        held,
        elsewhere: hits.and(landed.elsewhere),
    }
}
