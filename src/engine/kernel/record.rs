//! Twin: `shaders/response_main.wgsl`
//!
//! A lane as the words of the kernel's buffers, and back.

use crate::engine::kernel::lane::Lane;
use crate::engine::kernel::observe::Moment;
use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::table::{flag, state};
use crate::engine::sums::{phase, sum};
use crate::model::status::Status;

/// The words of a lane in the order of the fields of the response kernel.
#[must_use]
pub fn write<S: Real>(lane: &Lane<S>) -> (Vec<S>, Vec<u32>) {
    let sums = &lane.sums;
    let (mut words, mut flags) = (vec![S::ZERO; state::WORDS], vec![0; flag::WORDS]);
    let mut put = |first: usize, values: &[S]| words[first..first + values.len()].copy_from_slice(values);
    put(state::BODY, &lane.state.body.p);
    put(state::BODY + 3, &lane.state.body.v);
    put(state::REST, &[lane.rest]);
    put(state::BLOCK, &sums.block);
    put(state::TOTAL, sums.total.as_flattened());
    put(state::PEAKS, &sums.peaks);
    put(state::PREVIOUS, &[sums.previous]);
    put(state::FIRST, &[sums.first.fraction]);
    put(state::LAST, &[sums.last.fraction]);
    put(state::GROWTH, &sums.growth);
    put(state::PHASE + phase::OMEGA, &[lane.phase.omega]);
    put(state::PHASE + phase::CARRIER, &lane.phase.carrier);
    put(state::PHASE + phase::X, &lane.phase.x);
    put(state::PHASE + phase::Y, &lane.phase.y);
    put(state::SNAPSHOT, &lane.snapshot.body.p);
    put(state::SNAPSHOT + 3, &lane.snapshot.body.v);
    let mut set = |first: usize, values: &[u32]| flags[first..first + values.len()].copy_from_slice(values);
    set(flag::STATUS, &[lane.state.status as u32]);
    set(flag::STEPS, &[lane.iterations]);
    set(flag::STARTED, &[1]);
    set(flag::SEGMENT, &[lane.segment]);
    set(flag::INDEX, &[lane.index]);
    set(flag::CONTACT, &[lane.state.contact]);
    set(flag::PIECE, &[lane.state.piece]);
    set(flag::DISARMED, &[lane.state.disarmed]);
    set(flag::AT_ONCE, &[lane.state.at_once]);
    set(flag::COUNTED, &[lane.counted]);
    set(flag::PARTS, &[lane.parts]);
    set(flag::SECOND_PASS, &[u32::from(lane.second_pass)]);
    set(flag::HALF, &[sums.half]);
    set(flag::HAS_PREVIOUS, &[u32::from(sums.has_previous)]);
    set(flag::IMPACTS, &[sums.impacts]);
    set(flag::CROSSINGS, &[sums.crossings]);
    set(flag::GROWTH_CLOSED, &[u32::from(sums.growth_closed)]);
    set(flag::FIRST, &[sums.first.segment, sums.first.index]);
    set(flag::LAST, &[sums.last.segment, sums.last.index]);
    set(flag::SNAPSHOT, &[lane.snapshot.contact, lane.snapshot.piece, lane.snapshot.disarmed]);
    (words, flags)
}

/// A finished lane from its words; `None` when they are too few or the status is unknown.
#[must_use]
pub fn read<S: Real>(words: &[S], flags: &[u32]) -> Option<Lane<S>> {
    if words.len() != state::WORDS || flags.len() != flag::WORDS {
        return None;
    }
    let three = |first: usize| std::array::from_fn(|i| words[first + i]);
    let two = |first: usize| [words[first], words[first + 1]];
    let moment = |first: usize, fraction: usize| Moment {
        segment: flags[first],
        index: flags[first + 1],
        fraction: words[fraction],
    };
    let mut lane = Lane::blank();
    lane.state.status = Status::from_code(flags[flag::STATUS])?;
    lane.iterations = flags[flag::STEPS];
    lane.segment = flags[flag::SEGMENT];
    lane.index = flags[flag::INDEX];
    lane.state.contact = flags[flag::CONTACT];
    lane.state.piece = flags[flag::PIECE];
    lane.state.disarmed = flags[flag::DISARMED];
    lane.state.at_once = flags[flag::AT_ONCE];
    lane.counted = flags[flag::COUNTED];
    lane.parts = flags[flag::PARTS];
    lane.second_pass = flags[flag::SECOND_PASS] == 1;
    lane.state.body.p = three(state::BODY);
    lane.state.body.v = three(state::BODY + 3);
    lane.rest = words[state::REST];
    let sums = &mut lane.sums;
    for i in 0..sum::WORDS {
        sums.block[i] = words[state::BLOCK + i];
        sums.total[0][i] = words[state::TOTAL + i];
        sums.total[1][i] = words[state::TOTAL + sum::WORDS + i];
    }
    sums.peaks = three(state::PEAKS);
    sums.half = flags[flag::HALF];
    sums.previous = words[state::PREVIOUS];
    sums.has_previous = flags[flag::HAS_PREVIOUS] == 1;
    sums.growth_closed = flags[flag::GROWTH_CLOSED] == 1;
    sums.growth = std::array::from_fn(|i| words[state::GROWTH + i]);
    sums.impacts = flags[flag::IMPACTS];
    sums.crossings = flags[flag::CROSSINGS];
    sums.first = moment(flag::FIRST, state::FIRST);
    sums.last = moment(flag::LAST, state::LAST);
    lane.phase.omega = words[state::PHASE + phase::OMEGA];
    lane.phase.carrier = two(state::PHASE + phase::CARRIER);
    lane.phase.x = two(state::PHASE + phase::X);
    lane.phase.y = two(state::PHASE + phase::Y);
    lane.snapshot.body.p = three(state::SNAPSHOT);
    lane.snapshot.body.v = three(state::SNAPSHOT + 3);
    [lane.snapshot.contact, lane.snapshot.piece, lane.snapshot.disarmed] =
        std::array::from_fn(|i| flags[flag::SNAPSHOT + i]);
    Some(lane)
}
