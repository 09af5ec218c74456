//! A round of lanes: their words in the buffers of a device, lane by lane of every group that shares a kernel, and back.

use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};

use rayon::prelude::*;

use crate::engine::error::Result;
use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::source::{FLAG_STATUS, FLAG_STEPS, SETTING_WORDS, Settings};
use crate::engine::lanes::job::Part;
use crate::engine::march::columns::{fill, length, row};
use crate::engine::march::marching::Form;
use crate::engine::march::table::{flag, state};
use crate::engine::march::words::Words;
use crate::model::piece::LawForm;
use crate::model::status::Status;

/// What the places of bindings in a buffer are multiples of, bytes: the most that an adapter may ask for.
pub const ALIGNED: usize = 256;

/// Lanes that a GPU steps together.
pub const WARP: usize = 32;

/// Words of a lane, and where it is in the present round.
#[derive(Clone, Debug)]
pub struct Lane<R, T> {
    /// What selects its kernel.
    pub form: Form,
    /// Its words: what is sent, then what has come back.
    pub words: Words<R>,
    /// Something to remember with it.
    pub memory: T,
    /// Steps of the stretch before the present round.
    steps: u32,
    before: u32,
    /// Its group, and its place in that.
    at: [usize; 2],
}

impl<R: Real, T> Lane<R, T> {
    /// A lane whose words are still to be filled, for [`Lane::begin`].
    pub fn new(memory: T) -> Lane<R, T> {
        let form = Form { part: Part::Growth, law: LawForm::Pieces, pieces: 1, ramp: false };
        Lane { form, words: Words::blank(), memory, steps: 0, before: 0, at: [0; 2] }
    }

    /// Begins the stretch that its words are.
    pub fn begin(&mut self, form: Form) {
        self.before = if form.part == self.form.part { self.steps } else { 0 };
        (self.form, self.steps) = (form, 0);
    }

    /// Steps of the stretch before, where it was of the same part.
    pub fn before(&self) -> u32 {
        self.before
    }
}

/// Lanes that share a kernel: where their words begin in each buffer, in words of that.
#[derive(Clone, Debug)]
pub struct Group {
    /// What selects the kernel.
    pub form: Form,
    /// How many there are.
    pub lanes: usize,
    /// Where their words of inputs, state and flags begin.
    pub first: [usize; 3],
    /// The number of its first warp.
    warp: usize,
    /// Words of a lane in each buffer.
    each: [usize; 3],
}

impl Group {
    /// The length of its columns.
    #[must_use]
    pub fn length(&self) -> usize {
        length(self.lanes)
    }

    /// Its words of each buffer.
    #[must_use]
    pub fn words(&self) -> [usize; 3] {
        self.each.map(|words| words * self.length())
    }

    /// The settings of its dispatch of so many steps, with what lies between them and the next.
    #[must_use]
    pub fn head(&self, steps: u32, settings: [u32; SETTING_WORDS]) -> Vec<u8> {
        #[expect(clippy::cast_possible_truncation, reason = "a round has less than 2^32 lanes")]
        let head = Settings::new(self.length() as u32, steps, 0, settings);
        let mut bytes = bytemuck::bytes_of(&head).to_vec();
        bytes.resize(ALIGNED, 0);
        bytes
    }

    /// Where the next group begins.
    fn end<R>(&self) -> [usize; 3] {
        let [inputs, state, flags] = self.words();
        let [first_input, first_state, first_flag] = self.first;
        [
            aligned::<R>(first_input + inputs),
            aligned::<R>(first_state + state),
            aligned::<u32>(first_flag + flags),
        ]
    }
}

/// The next multiple of [`ALIGNED`] bytes.
fn aligned<T>(count: usize) -> usize {
    count.next_multiple_of(ALIGNED / size_of::<T>())
}

/// Steps that lanes have taken in a round.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Taken {
    /// By the lanes.
    pub steps: u64,
    /// If every lane of a warp of [`WARP`] took as many as the one that took most.
    pub of_warps: u64,
}

/// The words of all lanes of a round.
#[derive(Clone, Debug)]
pub struct Round<R> {
    /// The groups.
    pub groups: Vec<Group>,
    /// What goes to the device.
    pub inputs: Vec<R>,
    /// What goes there and comes back.
    pub state: Vec<R>,
    /// This, too.
    pub flags: Vec<u32>,
}

impl<R: Real> Round<R> {
    /// Of no lane.
    #[must_use]
    pub fn new() -> Round<R> {
        Round { groups: Vec::new(), inputs: Vec::new(), state: Vec::new(), flags: Vec::new() }
    }

    /// Puts the words of lanes, which are sorted by their kernels, into the buffers.
    pub fn stage<T: Sync>(&mut self, lanes: &mut [Box<Lane<R, T>>]) {
        let [inputs, state, flags] = self.place(lanes);
        self.inputs.resize(inputs, R::ZERO);
        self.state.resize(state, R::ZERO);
        self.flags.resize(flags, 0);
        let mut first = 0;
        for group in &self.groups {
            let of = |index: usize| &lanes[first + index].words;
            let ([inputs, state, flags], size) = (group.words(), [group.length(), group.lanes]);
            fill(&mut self.inputs[group.first[0]..][..inputs], size, |index| &of(index).inputs[..]);
            fill(&mut self.state[group.first[1]..][..state], size, |index| &of(index).state[..]);
            let flags = &mut self.flags[group.first[2]..][..flags];
            fill(flags, size, |index| &of(index).flags[..]);
            // What is no lane has ended.
            flags[FLAG_STATUS * size[0]..][..size[0]][size[1]..].fill(Status::Ok as u32);
            first += size[1];
        }
    }

    /// Gives every lane its place; how many words of each buffer there are.
    fn place<T>(&mut self, lanes: &mut [Box<Lane<R, T>>]) -> [usize; 3] {
        self.groups.clear();
        for lane in lanes {
            if self.groups.last().is_none_or(|group| group.form != lane.form) {
                let first = self.groups.last().map_or([0; 3], Group::end::<R>);
                let warp = self.groups.last().map_or(0, |last| last.warp + last.lanes.div_ceil(WARP));
                let (form, of_state) = (lane.form, state::words_of(lane.form.part));
                let each = [form.inputs(), of_state, flag::WORDS];
                self.groups.push(Group { form, lanes: 0, first, warp, each });
            }
            let number = self.groups.len() - 1;
            let group = &mut self.groups[number];
            lane.at = [number, group.lanes];
            group.lanes += 1;
        }
        self.groups.last().map_or([0; 3], Group::end::<R>)
    }

    /// Gives what has come back to the lanes that were staged, and every lane to `take` with the steps that it has gone.
    ///
    /// # Errors
    /// The first of `take`.
    ///
    /// # Panics
    /// When there are not as many words as were staged.
    pub fn collect<T: Send>(
        &self,
        lanes: &mut [Box<Lane<R, T>>],
        (all_state, all_flags): (&[R], &[u32]),
        take: impl Fn(&mut Lane<R, T>, u32) -> Result<()> + Sync,
    ) -> (Taken, Result<()>) {
        let most: Vec<AtomicU32> =
            (0..lanes.len() / WARP + self.groups.len()).map(|_| AtomicU32::new(0)).collect();
        let taken = AtomicU64::new(0);
        let ended = lanes.par_iter_mut().try_for_each(|lane| {
            let [group, at] = lane.at;
            let warp = &most[self.groups[group].warp + at / WARP];
            let group = &self.groups[group];
            let ([_, state, flags], [_, first_state, first_flag]) = (group.words(), group.first);
            let length = group.length();
            let used = state / length;
            row(&mut lane.words.state[..used], &all_state[first_state..][..state], length, at);
            row(&mut lane.words.flags, &all_flags[first_flag..][..flags], length, at);
            let steps = lane.words.flags[FLAG_STEPS].saturating_sub(lane.steps);
            warp.fetch_max(steps, Ordering::Relaxed);
            taken.fetch_add(u64::from(steps), Ordering::Relaxed);
            lane.steps += steps;
            take(lane, steps)
        });
        let of_warps = most.iter().map(|most| u64::from(most.load(Ordering::Relaxed))).sum::<u64>();
        (Taken { steps: taken.into_inner(), of_warps: WARP as u64 * of_warps }, ended)
    }
}

impl<R: Real> Default for Round<R> {
    fn default() -> Round<R> {
        Round::new()
    }
}
