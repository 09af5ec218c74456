//! Twin: `shaders/response_main.wgsl`
//!
//! A lane as the words of the kernel's buffers, and back.

use crate::engine::kernel::lane::Lane;
use crate::engine::kernel::observe::{Moment, SUMS};
use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::source::{first_word, words};
use crate::model::status::Status;

/// The words of a lane in the order of the fields of the response kernel.
#[must_use]
pub fn write<S: Real>(lane: &Lane<S>) -> (Vec<S>, Vec<u32>) {
    let sums = &lane.sums;
    let mut state = Vec::new();
    state.extend(lane.state.body.p);
    state.extend(lane.state.body.v);
    state.push(lane.rest);
    state.extend(sums.block);
    state.extend(sums.total.concat());
    state.extend(sums.peaks);
    state.extend([sums.previous, sums.first.fraction, sums.last.fraction]);
    state.extend(sums.growth);
    state.push(lane.phase.omega);
    state.extend([lane.phase.carrier, lane.phase.x, lane.phase.y].concat());
    state.extend(lane.snapshot.body.p);
    state.extend(lane.snapshot.body.v);
    let mut flags = vec![
        lane.state.status as u32,
        lane.iterations,
        1,
        lane.segment,
        lane.index,
        lane.state.contact,
        lane.state.piece,
        lane.state.disarmed,
        lane.state.at_once,
        lane.counted,
        lane.parts,
        u32::from(lane.second_pass),
        sums.half,
        u32::from(sums.has_previous),
        sums.impacts,
        sums.crossings,
        u32::from(sums.growth_closed),
    ];
    flags.extend([sums.first.segment, sums.first.index, sums.last.segment, sums.last.index]);
    flags.extend([lane.snapshot.contact, lane.snapshot.piece, lane.snapshot.disarmed]);
    (state, flags)
}

/// A finished lane from its words; `None` when they are too few or the status is unknown.
#[must_use]
pub fn read<S: Real>(state: &[S], flags: &[u32]) -> Option<Lane<S>> {
    let kernel = &crate::engine::kernel::response::KERNEL;
    if state.len() != words(kernel.state) || flags.len() != words(kernel.flags) {
        return None;
    }
    let real = |name: &str, word: usize| state[first_word(kernel.state, name) + word];
    let flag = |name: &str, word: usize| flags[first_word(kernel.flags, name) + word];
    let three = |name: &str, word: usize| std::array::from_fn(|i| real(name, word + i));
    let moment =
        |name: &str| Moment { segment: flag(name, 0), index: flag(name, 1), fraction: real(name, 0) };
    let mut lane = Lane::blank();
    lane.state.status = Status::from_code(flag("status", 0))?;
    lane.iterations = flag("steps", 0);
    lane.segment = flag("segment", 0);
    lane.index = flag("index", 0);
    lane.state.contact = flag("contact", 0);
    lane.state.piece = flag("piece", 0);
    lane.state.disarmed = flag("disarmed", 0);
    lane.state.at_once = flag("at_once", 0);
    lane.counted = flag("counted", 0);
    lane.parts = flag("parts", 0);
    lane.second_pass = flag("second_pass", 0) == 1;
    lane.state.body.p = three("body", 0);
    lane.state.body.v = three("body", 3);
    lane.rest = real("rest", 0);
    let sums = &mut lane.sums;
    for i in 0..SUMS {
        sums.block[i] = real("block", i);
        sums.total[0][i] = real("total", i);
        sums.total[1][i] = real("total", SUMS + i);
    }
    sums.peaks = three("peaks", 0);
    sums.half = flag("half", 0);
    sums.previous = real("previous", 0);
    sums.has_previous = flag("has_previous", 0) == 1;
    sums.growth_closed = flag("growth_closed", 0) == 1;
    sums.growth = std::array::from_fn(|i| real("growth", i));
    sums.impacts = flag("impacts", 0);
    sums.crossings = flag("crossings", 0);
    sums.first = moment("first");
    sums.last = moment("last");
    lane.phase.omega = real("phase", 0);
    lane.phase.carrier = [real("phase", 1), real("phase", 2)];
    lane.phase.x = [real("phase", 3), real("phase", 4)];
    lane.phase.y = [real("phase", 5), real("phase", 6)];
    lane.snapshot.body.p = three("snapshot", 0);
    lane.snapshot.body.v = three("snapshot", 3);
    [lane.snapshot.contact, lane.snapshot.piece, lane.snapshot.disarmed] =
        std::array::from_fn(|i| flag("snapshot", i));
    Some(lane)
}
