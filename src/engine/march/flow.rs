//! Instances that pass through the lanes of a device: those that are over make room for the next.

use std::sync::atomic::AtomicBool;

use rayon::prelude::*;

use crate::engine::error::{Error, Result};
use crate::engine::instances::Instances;
use crate::engine::kernel::source::SETTING_WORDS;
use crate::engine::lanes::Lanes;
use crate::engine::lanes::job::{Job, Part};
use crate::engine::lanes::march::{Settings, Terms};
use crate::engine::march::asked::Asked;
use crate::engine::march::marching::{Marching, Way};
use crate::engine::march::round::Lane;
use crate::engine::march::table::flag;
use crate::engine::outcome::Outcome;
use crate::model::piece::LawForm;
use crate::model::status::Status;

/// Jobs that a task finishes: some to every lane of a vector register.
const FINISHED: usize = 64;

/// Rounds without a step after which a lane does not come to its end.
const MOST_IDLE: u32 = 64;

/// An instance on a device, and how many rounds it has taken no step in.
#[derive(Clone, Debug)]
pub struct Going<R> {
    marching: Box<Marching<R>>,
    idle: u32,
    stage: Stage,
}

/// How far an instance is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// It has another leg.
    Runs,
    /// It has none, but perhaps a second pass over its window.
    Over,
    /// It has its record.
    Done,
}

/// An instance with its words, in memory that others take after it.
pub type Place<R> = Lane<R, Going<R>>;

/// Instances on their way through lanes, one round after the other.
#[derive(Debug)]
pub struct Flow<R> {
    way: Way,
    settings: [u32; SETTING_WORDS],
    /// Places without an instance.
    free: Vec<Place<R>>,
}

impl<R: Lanes> Flow<R> {
    /// Before the first instance of a sweep, with places of another flow.
    #[must_use]
    pub fn new(spec: &dyn Instances, free: Vec<Place<R>>) -> Flow<R> {
        let way = Way::new::<R>(spec.plan());
        let mut settings = [0; SETTING_WORDS];
        settings[0] = way.tolerance.to_bits();
        Flow { way, settings, free }
    }

    /// The places that it has not given away.
    #[must_use]
    pub fn into_places(self) -> Vec<Place<R>> {
        self.free
    }

    /// The words of the kernel's own settings.
    #[must_use]
    pub fn settings(&self) -> [u32; SETTING_WORDS] {
        self.settings
    }

    /// Takes what a round has made of a lane, on to its next leg or to its record.
    ///
    /// # Errors
    /// When the kernels cannot have made it, or do not come to an end.
    pub fn take(&self, asked: &Asked, lane: &mut Place<R>, steps: u32) -> Result<()> {
        take(lane, steps, &self.way)?;
        self.end(asked, &mut lane.memory);
        Ok(())
    }

    /// Begins other instances in the places of those that are done, up to `most`, and sorts the lanes by their kernels: neighbours of
    /// the sweep, which are alike, stay neighbours.
    pub fn turn_over(&mut self, asked: &Asked, lanes: &mut Vec<Place<R>>, most: usize) {
        loop {
            // Those that go on come first.
            let mut going = 0;
            for place in 0..lanes.len() {
                if lanes[place].memory.stage == Stage::Runs {
                    lanes.swap(going, place);
                    going += 1;
                }
            }
            if going >= most || !asked.has_more() {
                self.free.extend(lanes.drain(going..));
                break;
            }
            let mut range = asked.take(most - going);
            let there = range.len().min(lanes.len() - going + self.free.len());
            let lacking = (going + there).saturating_sub(lanes.len());
            lanes.extend(self.free.drain(self.free.len() - lacking..));
            self.free.extend(lanes.drain(going + there..));
            let reused = range.start..range.start + there;
            range.start = reused.end;
            let begin = |(lane, index): (&mut Place<R>, usize)| self.begin(asked, index, lane);
            lanes[going..].par_iter_mut().zip(reused).for_each(begin);
            lanes.par_extend(range.into_par_iter().filter_map(|index| self.begin_anew(asked, index)));
        }
        if !lanes.is_sorted_by_key(Lane::order) {
            lanes.sort_by_key(Lane::order);
        }
    }

    /// An instance at its start; a record where it cannot start.
    fn start(&self, asked: &Asked, index: usize) -> Option<Marching<R>> {
        let instance = asked.instance(index);
        let marching = Marching::new(index, &instance, &self.way);
        if let Err(status) = marching {
            asked.complete(index, &instance, &Outcome { status, ..Outcome::default() });
        }
        marching.ok()
    }

    /// Begins an instance in the place of another.
    fn begin(&self, asked: &Asked, index: usize, lane: &mut Place<R>) {
        let Going { marching: before, idle, stage } = &mut lane.memory;
        let Some(mut marching) = self.start(asked, index) else {
            *stage = Stage::Done;
            return;
        };
        marching.job.stretches = std::mem::take(&mut before.job.stretches).cleared();
        (**before, *idle, *stage) = (marching, 0, Stage::Runs);
        lane.go_on(&self.way);
        self.end(asked, &mut lane.memory);
    }

    /// Begins an instance in a new place.
    fn begin_anew(&self, asked: &Asked, index: usize) -> Option<Place<R>> {
        let marching = Box::new(self.start(asked, index)?);
        let mut lane = Lane::new(Going { marching, idle: 0, stage: Stage::Runs });
        lane.go_on(&self.way);
        self.end(asked, &mut lane.memory);
        Some(lane)
    }

    /// Completes the record of an instance that is over, where nothing is left to do for it.
    fn end(&self, asked: &Asked, going: &mut Going<R>) {
        let tolerance = f64::from(self.way.tolerance);
        if going.stage == Stage::Over && going.marching.job.tells_phase(tolerance) {
            self.complete(asked, &going.marching);
            going.stage = Stage::Done;
        }
    }

    /// Completes the record of an instance that is over.
    fn complete(&self, asked: &Asked, marching: &Marching<R>) {
        let instance = asked.instance(marching.index);
        asked.complete(marching.index, &instance, &marching.job.outcome(&self.way.plan));
    }

    /// Completes the records of those lanes whose windows are passed once more, on the CPU, as their Fourier sums did not tell a phase.
    pub fn finish(&self, asked: &Asked, lanes: &mut [Place<R>]) {
        // What is over is finished, whatever else is stopped.
        let never = AtomicBool::new(false);
        let plan = &self.way.plan;
        let tolerance = f64::from(self.way.tolerance);
        let settings = Settings { plan, tolerance, terms: Terms::default(), cancel: &never };
        let going = lanes.iter_mut().map(|lane| &mut lane.memory);
        let mut over: Vec<&mut Going<R>> = going.filter(|going| going.stage == Stage::Over).collect();
        for law in LawForm::ALL {
            let here: Vec<usize> =
                (0..over.len()).filter(|place| over[*place].marching.job.law() == law).collect();
            let mut jobs: Vec<Job<R>> = here.iter().map(|place| over[*place].marching.job.clone()).collect();
            jobs.par_chunks_mut(FINISHED).for_each(|jobs| R::run(jobs, &[Part::Phase], false, settings));
            for (place, job) in here.into_iter().zip(jobs) {
                over[place].marching.job = job;
            }
        }
        over.par_iter_mut().for_each(|going| {
            self.complete(asked, &going.marching);
            going.stage = Stage::Done;
        });
    }
}

impl<R: Lanes> Lane<R, Going<R>> {
    /// Counts its instance from one that comes so many later.
    pub fn count_from(&mut self, later: usize) {
        self.memory.marching.index -= later;
    }

    /// On to the next leg, if there is one.
    fn go_on(&mut self, way: &Way) {
        match self.memory.marching.next(way, &mut self.words) {
            Some(form) => self.begin(form, self.memory.marching.stretches()),
            None => self.memory.stage = Stage::Over,
        }
    }
}

/// Takes what a round has made of an instance.
fn take<R: Lanes>(lane: &mut Lane<R, Going<R>>, steps: u32, way: &Way) -> Result<()> {
    let (words, Going { marching, idle, .. }) = (&lane.words, &mut lane.memory);
    if words.flags[flag::STATUS] == Status::Unwritten as u32 {
        *idle = if steps == 0 { *idle + 1 } else { 0 };
        if *idle > MOST_IDLE {
            return Err(Error::Endless {
                kernel: "march",
                finished: 0,
                count: 1,
                dispatches: u64::from(*idle),
            });
        }
        return Ok(());
    }
    marching.take(&words.state, &words.flags).ok_or(Error::Unwritten { instance: marching.index })?;
    *idle = 0;
    lane.go_on(way);
    Ok(())
}
