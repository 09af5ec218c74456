//! An instance in a lane of a device.

use crate::engine::kernel::places::{Column, TOGETHER};
use crate::engine::kernel::source::FLAG_STEPS;
use crate::engine::lanes::Lanes;
use crate::engine::lanes::job::Part;
use crate::engine::march::marching::{Form, Marching, PARTS, Way};
use crate::engine::march::table::{flag, state};
use crate::model::piece::LawForm;

/// Lanes that a GPU steps together.
pub const WARP: usize = TOGETHER;

/// How far an instance is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// It has another leg.
    Runs,
    /// It has none, but perhaps a second pass over its window.
    Over,
    /// It has its record.
    Done,
}

/// An instance on a device, in memory that others take after it.
#[derive(Clone, Debug)]
pub struct Lane<R> {
    /// The instance.
    pub marching: Box<Marching<R>>,
    /// How far it is.
    pub stage: Stage,
    /// Rounds in which it has taken no step, up to now.
    pub idle: u32,
    /// What a round has left of its leg; none where that has not begun.
    kept: Option<Box<Kept<R>>>,
    /// What selects its kernels.
    form: Form,
    /// Steps of its leg in every part, before the present round.
    gone: [u32; PARTS.len()],
    /// Its group in the present round, and its place in that.
    pub(super) at: [usize; 2],
}

/// State and flags of a leg that is not over.
#[derive(Clone, Debug)]
struct Kept<R> {
    state: [R; state::WORDS],
    flags: [u32; flag::WORDS],
}

/// What has come back of a lane.
#[derive(Clone, Copy, Debug)]
pub struct Back<'a, R> {
    /// The words of its state, as many as its kernels may have written.
    pub state: Column<'a, R>,
    /// Its flags.
    pub flags: Column<'a, u32>,
    /// The steps that it has gone.
    pub steps: u32,
}

impl<R: Lanes> Lane<R> {
    /// With an instance at its start.
    #[must_use]
    pub fn new(marching: Box<Marching<R>>, way: &Way) -> Lane<R> {
        let form = Form { law: LawForm::Pieces, pieces: 1, ramp: false };
        let gone = [0; PARTS.len()];
        let mut lane = Lane { marching, stage: Stage::Runs, idle: 0, kept: None, form, gone, at: [0; 2] };
        lane.go_on(way);
        lane
    }

    /// On to the next leg, if there is one.
    pub fn go_on(&mut self, way: &Way) {
        (self.kept, self.idle, self.gone) = (None, 0, [0; PARTS.len()]);
        match self.marching.next(way) {
            Some(form) => (self.form, self.stage) = (form, Stage::Runs),
            None => self.stage = Stage::Over,
        }
    }

    /// Keeps what a round has left of its leg.
    pub fn keep(&mut self, back: &Back<R>) {
        let blank = || Box::new(Kept { state: [R::ZERO; state::WORDS], flags: [0; flag::WORDS] });
        let kept = self.kept.get_or_insert_with(blank);
        kept.state.iter_mut().zip(back.state.iter()).for_each(|(word, came)| *word = came);
        kept.flags.iter_mut().zip(back.flags.iter()).for_each(|(word, came)| *word = came);
    }

    /// Puts the first words of the state that was kept into a row, where there is one.
    pub(super) fn put_state(&self, row: &mut [R]) {
        if let Some(kept) = &self.kept {
            row.copy_from_slice(&kept.state[..row.len()]);
        }
    }

    /// Puts the flags that were kept into a row, where there are any.
    pub(super) fn put_flags(&self, row: &mut [u32]) {
        if let Some(kept) = &self.kept {
            row.copy_from_slice(&kept.flags);
        }
    }

    /// What selects its kernels.
    #[must_use]
    pub fn form(&self) -> Form {
        self.form
    }

    /// Whether its leg has begun.
    pub(super) fn has_begun(&self) -> bool {
        self.kept.is_some()
    }

    /// Its group, and the number of its warp there.
    pub(super) fn warp(&self) -> [usize; 2] {
        [self.at[0], self.at[1] / WARP]
    }

    /// What lanes are sorted by: those whose legs have begun come first, of every form.
    #[must_use]
    pub fn order(&self) -> (Form, bool) {
        (self.form, !self.has_begun())
    }

    /// Takes the steps that its flags tell; how many each part has come to in the present round.
    pub(super) fn count(&mut self, flags: Column<u32>) -> [u32; PARTS.len()] {
        let steps = flags.at(FLAG_STEPS);
        let part = flags.at(flag::PART);
        let before = if part == Part::Growth as u32 {
            [steps, steps]
        } else if part == Part::Settle as u32 {
            [flags.at(flag::GROWN), steps]
        } else {
            [flags.at(flag::GROWN), flags.at(flag::SETTLED)]
        };
        let all = [before[0], before[1].wrapping_sub(before[0]), steps.wrapping_sub(before[1])];
        let gone = std::mem::replace(&mut self.gone, all);
        std::array::from_fn(|part| all[part].saturating_sub(gone[part]))
    }
}
