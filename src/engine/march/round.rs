//! A round of lanes: their words in the buffers of a device, lane by lane of every group that shares a kernel, and back.

use std::marker::PhantomData;
use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use crate::engine::error::Result;
use crate::engine::kernel::places::{Column, fill, room};
use crate::engine::kernel::source::{SETTING_WORDS, Settings};
use crate::engine::lanes::Lanes;
use crate::engine::march::asked::Asked;
use crate::engine::march::flow::Flow;
use crate::engine::march::lane::{Back, Lane, WARP};
use crate::engine::march::marching::{Form, PARTS};
use crate::engine::march::table::{SETTING_FRESH, flag, state};

/// What the places of bindings in a buffer are multiples of, bytes: the most that an adapter may ask for.
pub const ALIGNED: usize = 256;

/// Lanes whose words are made and handed on together: some for every thread, and no more than stay in a cache.
const AT_A_TIME: usize = 8192;

/// Lanes that share their kernels: where their words of inputs, state and flags are.
#[derive(Clone, Debug)]
pub struct Group {
    /// What selects the kernels.
    pub form: Form,
    /// How many there are.
    pub lanes: usize,
    /// Where they begin in each buffer, in words of that.
    pub first: [usize; 3],
    /// Where what is sent of them begins among what is sent to each buffer.
    pub sent: [usize; 3],
    /// Whether their legs have begun, so that all words are sent.
    begun: bool,
    /// Stretches in the window, of the leg that has most.
    stretches: usize,
}

impl Group {
    /// Words of a lane in each buffer.
    fn of_lane(&self) -> [usize; 3] {
        [self.form.inputs(), state::words_of(self.stretches), flag::WORDS]
    }

    /// Its words in each buffer.
    #[must_use]
    pub fn words(&self) -> [usize; 3] {
        self.of_lane().map(|words| words * room(self.lanes))
    }

    /// Its words that are sent to each buffer: of legs that have not begun only the inputs, from which the kernels make the rest.
    #[must_use]
    pub fn words_sent(&self) -> [usize; 3] {
        let [inputs, state, flags] = self.words();
        if self.begun { [inputs, state, flags] } else { [inputs, 0, 0] }
    }

    /// The settings of its dispatch of so many steps, with what lies between them and the next.
    #[must_use]
    pub fn head(&self, steps: u32, mut settings: [u32; SETTING_WORDS]) -> Vec<u8> {
        settings[SETTING_FRESH] = u32::from(!self.begun);
        let head = Settings::new([self.lanes, self.of_lane()[1]], steps, 0, settings);
        let mut bytes = bytemuck::bytes_of(&head).to_vec();
        bytes.resize(ALIGNED, 0);
        bytes
    }

    /// Where the next group begins in each buffer.
    fn end<R>(&self) -> [usize; 3] {
        let [inputs, state, flags] = std::array::from_fn(|k| self.first[k] + self.words()[k]);
        [aligned::<R>(inputs), aligned::<R>(state), aligned::<u32>(flags)]
    }

    /// Where what is sent of the next group begins.
    fn end_sent(&self) -> [usize; 3] {
        std::array::from_fn(|k| self.sent[k] + self.words_sent()[k])
    }
}

/// The next multiple of [`ALIGNED`] bytes.
fn aligned<T>(count: usize) -> usize {
    count.next_multiple_of(ALIGNED / size_of::<T>())
}

/// Makes the words of some lanes, each a row of so many that `row` writes, and hands them to `put`: part by part, each with its
/// place among their bytes.
fn rows<R: Lanes, T: bytemuck::Pod + Send + Sync>(
    lanes: &[Lane<R>],
    words: usize,
    made: &mut Vec<T>,
    row: impl Fn(&Lane<R>, &mut [T]) + Sync,
    mut put: impl FnMut(usize, &[u8]),
) {
    for (number, lanes) in lanes.chunks(AT_A_TIME).enumerate() {
        made.resize(words * room(lanes.len()), T::zeroed());
        fill(made, words, lanes.len(), |index, words| row(&lanes[index], words));
        put(number * AT_A_TIME * words * size_of::<T>(), bytemuck::cast_slice(made));
    }
}

/// Steps that lanes have taken in a round.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Steps {
    /// By the lanes.
    pub gone: u64,
    /// If every lane of a warp of [`WARP`] took as many as the one that took most.
    pub of_warps: u64,
}

/// The places of all lanes of a round.
#[derive(Clone, Debug)]
pub struct Round<R> {
    /// The groups.
    pub groups: Vec<Group>,
    /// Whether all places of the buffers are sent, also those that the kernels fill.
    whole: bool,
    scalar: PhantomData<R>,
}

impl<R: Lanes> Round<R> {
    /// Of no lane; `whole` says whether all places of the buffers are sent, also those that the kernels fill.
    #[must_use]
    pub fn new(whole: bool) -> Round<R> {
        Round { groups: Vec::new(), whole, scalar: PhantomData }
    }

    /// The words of each buffer.
    #[must_use]
    pub fn words(&self) -> [usize; 3] {
        self.groups.last().map_or([0; 3], Group::end::<R>)
    }

    /// Where what is sent to each buffer begins, bytes, one after the other, and where all of it ends.
    #[must_use]
    pub fn begins_sent(&self) -> [usize; 4] {
        let [inputs, state, flags] =
            if self.whole { self.words() } else { self.groups.last().map_or([0; 3], Group::end_sent) };
        let of_state = inputs * size_of::<R>();
        let of_flags = of_state + state * size_of::<R>();
        [0, of_state, of_flags, of_flags + flags * size_of::<u32>()]
    }

    /// Hands the words of the lanes, which have their places, to `put`: part by part, each with its place among all bytes that are
    /// sent.
    pub fn send(&self, lanes: &[Lane<R>], mut put: impl FnMut(usize, &[u8])) {
        let (mut scalars, mut counts) = (Vec::new(), Vec::new());
        let [of_inputs, of_state, of_flags, _] = self.begins_sent();
        let mut first = 0;
        for group in &self.groups {
            let (lanes, words) = (&lanes[first..][..group.lanes], group.of_lane());
            let [inputs, state, flags] = group.sent;
            let row = |lane: &Lane<R>, row: &mut [R]| lane.marching.put(row);
            rows(lanes, words[0], &mut scalars, row, |at, part| {
                put(of_inputs + inputs * size_of::<R>() + at, part);
            });
            if group.begun {
                rows(lanes, words[1], &mut scalars, Lane::put_state, |at, part| {
                    put(of_state + state * size_of::<R>() + at, part);
                });
                rows(lanes, words[2], &mut counts, Lane::put_flags, |at, part| {
                    put(of_flags + flags * size_of::<u32>() + at, part);
                });
            }
            first += lanes.len();
        }
    }

    /// Gives lanes, which are sorted by [`Lane::order`], their places.
    pub fn place(&mut self, lanes: &mut [Lane<R>]) {
        self.groups.clear();
        for lane in lanes {
            let begun = lane.has_begun();
            let is_same = |group: &Group| group.form == lane.form() && group.begun == begun;
            if !self.groups.last().is_some_and(is_same) {
                let last = self.groups.last();
                let first = last.map_or([0; 3], Group::end::<R>);
                let sent = if self.whole { first } else { last.map_or([0; 3], Group::end_sent) };
                let form = lane.form();
                self.groups.push(Group { form, lanes: 0, first, sent, begun, stretches: 0 });
            }
            let number = self.groups.len() - 1;
            let group = &mut self.groups[number];
            lane.at = [number, group.lanes];
            group.lanes += 1;
            group.stretches = group.stretches.max(lane.marching.stretches());
        }
    }

    /// Gives what has come back to the lanes that were sent; the records of those that are over are completed, of a warp together.
    ///
    /// # Errors
    /// The first of [`Flow::take`].
    ///
    /// # Panics
    /// When there are not as many words as there are in the buffers.
    pub fn collect(
        &self,
        lanes: &mut [Lane<R>],
        (state, flags): (&[R], &[u32]),
        flow: &Flow<R>,
        asked: &Asked,
    ) -> (Steps, Result<()>) {
        let (gone, of_warps) = (AtomicU64::new(0), AtomicU64::new(0));
        let is_warp = |a: &Lane<R>, b: &Lane<R>| a.warp() == b.warp();
        let warp = |lanes: &mut [Lane<R>]| {
            let mut most = [0; PARTS.len()];
            let taken = lanes.iter_mut().try_for_each(|lane| {
                let group = &self.groups[lane.at[0]];
                let ([_, first_state, first_flag], [_, words, counts]) = (group.first, group.of_lane());
                let state = Column::of_buffer(&state[first_state..], words, lane.at[1]);
                let flags = Column::of_buffer(&flags[first_flag..], counts, lane.at[1]);
                let steps = lane.count(flags);
                most = std::array::from_fn(|part| most[part].max(steps[part]));
                let steps = steps.iter().sum();
                gone.fetch_add(u64::from(steps), Ordering::Relaxed);
                flow.take(lane, Back { state, flags, steps })
            });
            of_warps.fetch_add(most.iter().map(|steps| u64::from(*steps)).sum(), Ordering::Relaxed);
            // Also where one of them fails.
            flow.close(asked, lanes);
            taken
        };
        let ended = lanes.par_chunk_by_mut(is_warp).try_for_each(warp);
        (Steps { gone: gone.into_inner(), of_warps: WARP as u64 * of_warps.into_inner() }, ended)
    }
}
