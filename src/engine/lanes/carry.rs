//! The end of a step: its events carried out, and the lanes that need more looked after.

use crate::engine::lanes::job::Part;
use crate::engine::lanes::march::{Lanes, visit};
use crate::engine::lanes::motion::FLIGHT;
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::transitions::transitions;
use crate::engine::lanes::vector::Vector;
use pulp::Simd;
use std::ops::Not;

/// Carries out the events at the end of a step, `at` behind its beginning, and looks after the lanes that need it.
#[inline(always)]
pub fn carry_out<S: Simd, T: Scalar<S>, const LAW: bool, const MOTION: u8>(
    all: &mut Lanes<S, T>,
    event: Vector<S, T>,
    at: Vector<S, T>,
) {
    let (b, sums) = (&mut all.block, &mut all.sums);
    let (zero, one) = (at.like(0.0), at.like(1.0));
    let mut look = b.left.not_positive();
    let happened = zero.less(event);
    let mut pending = zero;
    if all.part == Part::Return {
        look = look.or(zero.less(sums.section));
        sums.follow_order(b.contact, event);
    }
    if happened.any() {
        let (growing, quiet) = (happened.select(zero, sums.growing), happened.select(zero, sums.quiet));
        sums.growing.put(growing);
        sums.quiet.put(quiet);
        // What comes down to the velocity of the belt has not gone below it, which matters where that is 0.
        let previous = happened.and(b.reverse()).select(sums.previous.max(b.belt), sums.previous);
        sums.previous.put(previous);
        let hits = b.free().and(happened);
        let rare =
            if all.part == Part::Growth { happened } else { transitions::<S, T, LAW, MOTION>(b, event, at) };
        if MOTION == FLIGHT && all.part == Part::Window {
            sums.impacts += one.only(hits.and(rare.not()));
        }
        pending = rare.select(event, zero);
        look = look.or(rare);
    }
    if look.any() {
        visit::<S, T>(all, &look.select(one, zero), &pending);
    }
}
