//! One step of single masses in closed form: up to the next event, or a whole swing.

use std::ops::Not;

use pulp::Simd;

use crate::engine::lanes::carry::carry_out;
use crate::engine::lanes::constants::R;
use crate::engine::lanes::job::Part;
use crate::engine::lanes::march::{Lanes, fail};
use crate::engine::lanes::motion::{PIECES, SINGLE};
use crate::engine::lanes::scalar::Scalar;
use crate::engine::lanes::swing::Swing;

/// One step of every lane.
#[inline(always)]
pub fn swing_step<S: Simd, T: Scalar<S>>(all: &mut Lanes<S, T>) {
    let (b, sums) = (&mut all.block, &mut all.sums);
    let (zero, one) = (b.left.like(0.0), b.left.like(1.0));
    let velocity = b.stick().select(b.belt, b.v[0]);
    b.v[0].put(velocity);
    b.reached = b.reached.max(b.contact);
    let failed = b.most_steps.less(b.steps);
    if failed.any() {
        fail::<S, T>(all, failed.select(one, zero), zero);
        return;
    }
    let motion = Swing::new(b);
    sums.cycle.slips_back(b.reverse());
    // What grows is sampled at the ends of the steps, which must not all be in one place of the swing.
    let grows = zero.less(sums.growing);
    let end = motion.reach(b, grows);
    let tau = end.tau;
    let jumped = sums.previous.less(zero).and(zero.at_most(b.v[0]));
    if jumped.any() {
        sums.note(jumped, zero);
    }
    let (crossed, when) = motion.rises(&end);
    if crossed.any() {
        sums.note(crossed, when);
    }
    sums.previous = end.state[1];
    if all.part == Part::Window {
        sums.observe_swing(b, &motion, &end);
    }
    let x = motion.sticks.select(b.belt.fma(tau, b.p[0]), motion.centre + end.state[0]);
    if grows.any() {
        let a = -(b.scene[R + 3].fma(end.state[1], b.scene[R] * end.state[0])).only(motion.sticks.not());
        sums.add_growth::<SINGLE>(tau, &[x, end.state[1], a, zero]);
    }
    sums.time += tau;
    b.p[0] = x;
    b.v[0] = end.state[1];
    let happened = zero.less(end.event);
    b.left = b.left.at_most(tau).and(happened.not()).select(zero, b.left - tau);
    let disarmed = zero.less(tau).select(zero, b.disarmed);
    b.disarmed.put(disarmed);
    b.steps += one;
    let slips = motion.sticks.and(happened);
    if slips.any() {
        sums.add_cycles(b, slips, all.part == Part::Window);
    }
    carry_out::<S, T, PIECES, SINGLE>(all, end.event, tau);
}
