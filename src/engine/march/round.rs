//! A round of lanes: their words in the buffers of a device, lane by lane of every group that shares a kernel, and back.

use std::sync::atomic::{AtomicU64, Ordering};

use rayon::prelude::*;

use crate::engine::error::Result;
use crate::engine::kernel::places::{Column, fill, room};
use crate::engine::kernel::source::{SETTING_WORDS, Settings};
use crate::engine::lanes::Lanes;
use crate::engine::march::lane::{Back, Lane, WARP};
use crate::engine::march::marching::{Form, PARTS};
use crate::engine::march::table::{SETTING_FRESH, flag, state};

/// What the places of bindings in a buffer are multiples of, bytes: the most that an adapter may ask for.
pub const ALIGNED: usize = 256;

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

/// Steps that lanes have taken in a round.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Steps {
    /// By the lanes.
    pub gone: u64,
    /// If every lane of a warp of [`WARP`] took as many as the one that took most.
    pub of_warps: u64,
}

/// The words of all lanes of a round.
#[derive(Clone, Debug)]
pub struct Round<R> {
    /// The groups.
    pub groups: Vec<Group>,
    /// What goes to the buffer of inputs.
    pub inputs: Vec<R>,
    /// What goes to that of the state, most of which comes back.
    pub state: Vec<R>,
    /// What goes to that of the flags, which come back.
    pub flags: Vec<u32>,
    /// Whether all places of the buffers are sent, also those that the kernels fill.
    whole: bool,
}

impl<R: Lanes> Round<R> {
    /// Of no lane; `whole` says whether all places of the buffers are sent, also those that the kernels fill.
    #[must_use]
    pub fn new(whole: bool) -> Round<R> {
        Round { groups: Vec::new(), inputs: Vec::new(), state: Vec::new(), flags: Vec::new(), whole }
    }

    /// The words of each buffer.
    #[must_use]
    pub fn words(&self) -> [usize; 3] {
        self.groups.last().map_or([0; 3], Group::end::<R>)
    }

    /// Puts the words of lanes, which are sorted by [`Lane::order`], into what is sent.
    pub fn stage(&mut self, lanes: &mut [Lane<R>]) {
        self.place(lanes);
        let last = self.groups.last();
        let [inputs, state, flags] =
            if self.whole { self.words() } else { last.map_or([0; 3], Group::end_sent) };
        self.inputs.resize(inputs, R::ZERO);
        self.state.resize(state, R::ZERO);
        self.flags.resize(flags, 0);
        let mut first = 0;
        for group in &self.groups {
            let ([inputs, state, flags], words) = (group.words_sent(), group.of_lane());
            let lanes = &lanes[first..][..group.lanes];
            let sent = &mut self.inputs[group.sent[0]..][..inputs];
            fill(sent, words[0], lanes.len(), |index, row| lanes[index].marching.put(row));
            if group.begun {
                let sent = &mut self.state[group.sent[1]..][..state];
                fill(sent, words[1], lanes.len(), |index, row| lanes[index].put_state(row));
                let sent = &mut self.flags[group.sent[2]..][..flags];
                fill(sent, words[2], lanes.len(), |index, row| lanes[index].put_flags(row));
            }
            first += lanes.len();
        }
    }

    /// Gives every lane its place.
    fn place(&mut self, lanes: &mut [Lane<R>]) {
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

    /// Gives what has come back to the lanes that were staged, and every lane to `take` with the steps that it has gone.
    ///
    /// # Errors
    /// The first of `take`.
    ///
    /// # Panics
    /// When there are not as many words as there are in the buffers.
    pub fn collect(
        &self,
        lanes: &mut [Lane<R>],
        (state, flags): (&[R], &[u32]),
        take: impl Fn(&mut Lane<R>, Back<R>) -> Result<()> + Sync,
    ) -> (Steps, Result<()>) {
        let (gone, of_warps) = (AtomicU64::new(0), AtomicU64::new(0));
        let is_warp = |a: &Lane<R>, b: &Lane<R>| a.warp() == b.warp();
        let warp = |lanes: &mut [Lane<R>]| {
            let mut most = [0; PARTS.len()];
            for lane in lanes {
                let group = &self.groups[lane.at[0]];
                let ([_, first_state, first_flag], [_, words, counts]) = (group.first, group.of_lane());
                let state = Column::of_buffer(&state[first_state..], words, lane.at[1]);
                let flags = Column::of_buffer(&flags[first_flag..], counts, lane.at[1]);
                let steps = lane.count(flags);
                most = std::array::from_fn(|part| most[part].max(steps[part]));
                let steps = steps.iter().sum();
                gone.fetch_add(u64::from(steps), Ordering::Relaxed);
                take(lane, Back { state, flags, steps })?;
            }
            of_warps.fetch_add(most.iter().map(|steps| u64::from(*steps)).sum(), Ordering::Relaxed);
            Ok(())
        };
        let ended = lanes.par_chunk_by_mut(is_warp).try_for_each(warp);
        (Steps { gone: gone.into_inner(), of_warps: WARP as u64 * of_warps.into_inner() }, ended)
    }
}
