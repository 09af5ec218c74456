//! An instance on its way through the kernel, stretch by stretch.

use crate::engine::fields::words;
use crate::engine::kernel::source::{Constant, Kernel};
use crate::engine::lanes::ORDER;
use crate::engine::lanes::job::{Job, Part};
use crate::engine::lanes::{Lanes, tolerance};
use crate::engine::march::kernel::{choices, kernel_for};
use crate::engine::march::table::head;
use crate::engine::march::words::{Words, begin, take};
use crate::engine::method::pace::Turns;
use crate::engine::plan::Plan;
use crate::engine::scene::Scene;
use crate::model::instance::Instance;
use crate::model::piece::LawForm;
use crate::model::status::Status;

/// What all instances of a run share.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    /// How long they run, and in which steps.
    pub plan: Plan,
    /// Bound on the truncation of a step, as the kernel has it: in f32.
    pub tolerance: f32,
    turns: Turns,
}

impl Way {
    /// The way of instances whose kernel computes in `R`.
    #[must_use]
    pub fn new<R: Lanes>(plan: Plan) -> Way {
        #[expect(clippy::cast_possible_truncation, reason = "the narrowing of a tolerance")]
        let narrow = tolerance(R::PRECISION, plan.steps_per_period) as f32;
        Way { plan, tolerance: narrow, turns: Turns::new(ORDER, f64::from(narrow)) }
    }
}

/// What selects the kernel of a stretch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Form {
    /// The part of the run.
    pub part: Part,
    /// The form of the law.
    pub law: LawForm,
    /// How many pieces the kernel holds.
    pub pieces: usize,
    /// Whether the belt has a ramp.
    pub ramp: bool,
}

impl Form {
    /// The kernel, and what is chosen in it; `None` when there is none for so many pieces.
    #[must_use]
    pub fn kernel(&self) -> Option<(&'static Kernel, Vec<(&'static str, Constant)>)> {
        let (kernel, _) = kernel_for(self.pieces)?;
        Some((kernel, choices(self.part, self.law, self.ramp)))
    }

    /// Its input words of one instance.
    #[must_use]
    pub fn inputs(&self) -> usize {
        kernel_for(self.pieces).map_or(0, |(kernel, _)| words(kernel.inputs))
    }
}

/// A stretch that is to be run: its kernel and its words.
pub type Stretch<R> = (Form, Words<R>);

/// An instance on its way.
#[derive(Clone, Debug)]
pub struct Marching<R> {
    /// Its number among those of the run.
    pub index: usize,
    /// What it has come to.
    pub job: Job<R>,
    /// The part of its run that it has come to; `None` before the first.
    part: Option<Part>,
    /// Whether that part may have another stretch.
    open: bool,
    /// How many pieces its kernel holds.
    pieces: usize,
}

impl<R: Lanes> Marching<R> {
    /// At the start.
    ///
    /// # Errors
    /// The status of an instance that cannot start.
    pub fn new(index: usize, instance: &Instance, way: &Way) -> Result<Marching<R>, Status> {
        let scene = Scene::planned(instance, &way.plan)?;
        let (_, pieces) = kernel_for(scene.model.law.pieces.len()).ok_or(Status::Unwritten)?;
        let job = Job::new(instance, scene, &way.plan, &way.turns);
        Ok(Marching { index, job, part: None, open: false, pieces })
    }

    /// Its next stretch and the kernel for it; `None` when nothing is left but a second pass over the window.
    pub fn next(&mut self, way: &Way) -> Option<Stretch<R>> {
        let mut words = Words::blank();
        self.next_in(way, &mut words).map(|form| (form, words))
    }

    /// As [`Marching::next`], in the place of the stretch before.
    pub fn next_in(&mut self, way: &Way, words: &mut Words<R>) -> Option<Form> {
        loop {
            if let Some(part) = self.part.filter(|_| self.open)
                && begin(&mut self.job, part, &way.plan, self.pieces, words).is_some()
            {
                let ramp = words.inputs[head::DRIVE] != R::ZERO;
                return Some(Form { part, law: self.job.law(), pieces: self.pieces, ramp });
            }
            let part = match self.part {
                None => Part::Growth,
                Some(Part::Growth) => Part::Settle,
                Some(Part::Settle) => Part::Window,
                Some(_) if self.job.goes_on(&way.plan) => Part::Growth,
                Some(_) => return None,
            };
            self.part = Some(part);
            self.open = self.job.enter(part, f64::from(way.tolerance), false);
        }
    }

    /// Takes what has come of its stretch; `None` when the kernel cannot have made it.
    pub fn take(&mut self, words: &[R], flags: &[u32]) -> Option<()> {
        let part = self.part?;
        take(&mut self.job, part, words, flags)?;
        let ended = part == Part::Growth && !self.job.growing;
        self.open = self.job.state.status == Status::Unwritten && !ended;
        Some(())
    }
}
