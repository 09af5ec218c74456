//! An instance on its way through the kernels, leg by leg.

use crate::engine::fields::words;
use crate::engine::kernel::places::Column;
use crate::engine::kernel::source::{Constant, Kernel};
use crate::engine::lanes::ORDER;
use crate::engine::lanes::job::{Job, Part};
use crate::engine::lanes::{Lanes, tolerance};
use crate::engine::march::kernel::{choices, kernel_for};
use crate::engine::march::leg::Leg;
use crate::engine::march::words::{put, take};
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

/// The parts of a run that have a kernel, in the order of a leg.
pub const PARTS: [Part; 3] = [Part::Growth, Part::Settle, Part::Window];

/// What selects the kernels of a leg.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Form {
    /// The form of the law.
    pub law: LawForm,
    /// How many pieces the kernels hold.
    pub pieces: usize,
    /// Whether the belt has a ramp.
    pub ramp: bool,
}

impl Form {
    /// The kernel of a part, and what is chosen in it; `None` when there is none for so many pieces.
    #[must_use]
    pub fn kernel(&self, part: Part) -> Option<(&'static Kernel, Vec<(&'static str, Constant)>)> {
        let (kernel, _) = kernel_for(self.pieces)?;
        Some((kernel, choices(part, self.law, self.ramp)))
    }

    /// Input words of one instance.
    #[must_use]
    pub fn inputs(&self) -> usize {
        kernel_for(self.pieces).map_or(0, |(kernel, _)| words(kernel.inputs))
    }
}

/// An instance on its way.
#[derive(Clone, Debug)]
pub struct Marching<R> {
    /// Its number among those of the run.
    pub index: usize,
    /// What it has come to.
    pub job: Job<R>,
    leg: Leg,
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
        let (_, pieces) = kernel_for(scene.most_pieces()).ok_or(Status::Unwritten)?;
        let job = Job::new(instance, scene, &way.plan, &way.turns);
        Ok(Marching { index, job, leg: Leg::default(), pieces })
    }

    /// Goes on to its next leg, and says which kernels that needs; `None` when nothing is left but a second pass over the window.
    pub fn next(&mut self, way: &Way) -> Option<Form> {
        loop {
            self.job.heat(f64::from(way.tolerance));
            let is_running = self.job.state.status == Status::Unwritten;
            if is_running && let Some(leg) = Leg::next(&self.job, way.plan.steps_per_period) {
                self.job.until = self.job.time + leg.length;
                self.leg = leg;
                let belt = self.job.warmth.seen(self.job.scene.belt(self.job.time));
                let ramp = R::from_f64(belt.acceleration) != R::ZERO;
                return Some(Form { law: self.job.law(), pieces: self.pieces, ramp });
            }
            if !self.job.goes_on(&way.plan) {
                return None;
            }
        }
    }

    /// Puts what its leg begins from into the words of the kernels' inputs.
    ///
    /// # Panics
    /// When there are not as many as [`Form::inputs`] says.
    pub fn put(&self, inputs: &mut [R]) {
        put(&self.job, &self.leg, inputs);
    }

    /// Stretches that its leg has in the window.
    #[must_use]
    pub fn stretches(&self) -> usize {
        self.leg.stretches
    }

    /// Takes what has come of its leg; `None` when the kernels cannot have made it.
    pub fn take(&mut self, words: Column<R>, flags: Column<u32>) -> Option<()> {
        take(&mut self.job, &self.leg, words, flags)
    }
}
