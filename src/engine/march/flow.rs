//! Instances that pass through the lanes of a device: those that are over make room for the next.

use std::slice;
use std::sync::atomic::AtomicBool;

use rayon::prelude::*;

use crate::engine::error::{Error, Result};
use crate::engine::instances::Instances;
use crate::engine::kernel::source::SETTING_WORDS;
use crate::engine::lanes::Lanes;
use crate::engine::lanes::job::{Job, Part};
use crate::engine::lanes::linear::examined_many;
use crate::engine::lanes::march::{Settings, Terms};
use crate::engine::march::asked::Asked;
use crate::engine::march::lane::{Back, Lane, Stage};
use crate::engine::march::marching::{Marching, Way};
use crate::engine::march::table::flag;
use crate::engine::outcome::Outcome;
use crate::model::instance::Instance;
use crate::model::piece::LawForm;
use crate::model::status::Status;

/// Jobs that a task finishes: some to every lane of a vector register.
const FINISHED: usize = 64;

/// Rounds without a step after which a lane does not come to its end.
const MOST_IDLE: u32 = 64;

/// Instances on their way through lanes, one round after the other.
#[derive(Debug)]
pub struct Flow<R> {
    way: Way,
    settings: [u32; SETTING_WORDS],
    /// Places without an instance.
    free: Vec<Lane<R>>,
}

impl<R: Lanes> Flow<R> {
    /// Before the first instance of a sweep, with places of another flow.
    #[must_use]
    pub fn new(spec: &dyn Instances, free: Vec<Lane<R>>) -> Flow<R> {
        let way = Way::new::<R>(spec.plan());
        let mut settings = [0; SETTING_WORDS];
        settings[0] = way.tolerance.to_bits();
        Flow { way, settings, free }
    }

    /// The places that it has not given away.
    #[must_use]
    pub fn into_places(self) -> Vec<Lane<R>> {
        self.free
    }

    /// The words of the kernel's own settings.
    #[must_use]
    pub fn settings(&self) -> [u32; SETTING_WORDS] {
        self.settings
    }

    /// Takes what a round has made of a lane, on to its next leg or to its end.
    ///
    /// # Errors
    /// When the kernels cannot have made it, or do not come to an end.
    pub fn take(&self, lane: &mut Lane<R>, back: Back<R>) -> Result<()> {
        if back.flags.at(flag::STATUS) == Status::Unwritten as u32 {
            lane.keep(&back);
            lane.idle = if back.steps == 0 { lane.idle + 1 } else { 0 };
            if lane.idle > MOST_IDLE {
                let dispatches = u64::from(lane.idle);
                return Err(Error::Endless { kernel: "march", finished: 0, count: 1, dispatches });
            }
            return Ok(());
        }
        let taken = lane.marching.take(back.state, back.flags);
        taken.ok_or(Error::Unwritten { instance: lane.marching.index })?;
        lane.go_on(&self.way);
        Ok(())
    }

    /// Completes the records of those lanes that are over, where nothing is left to do for them.
    pub fn close(&self, asked: &Asked, lanes: &mut [Lane<R>]) {
        let tolerance = f64::from(self.way.tolerance);
        let mut over: Vec<&mut Lane<R>> = lanes.iter_mut().filter(|lane| lane.stage == Stage::Over).collect();
        over.retain_mut(|lane| lane.marching.job.tells_phase(tolerance));
        self.complete(asked, &mut over);
    }

    /// Begins other instances in the places of those that are done, up to `most`, and sorts the lanes by their kernels: neighbours of
    /// the sweep, which are alike, stay neighbours.
    pub fn turn_over(&mut self, asked: &Asked, lanes: &mut Vec<Lane<R>>, most: usize) {
        loop {
            // Those that go on come first.
            let mut going = 0;
            for place in 0..lanes.len() {
                if lanes[place].stage == Stage::Runs {
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
            let begin = |(lane, index): (&mut Lane<R>, usize)| self.begin(asked, index, lane);
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
            for examined in examined_many(slice::from_ref(&instance), asked.spec().linear()) {
                asked.complete(index, &instance, examined, &Outcome { status, ..Outcome::default() });
            }
        }
        marching.ok()
    }

    /// Begins an instance in the place of another.
    fn begin(&self, asked: &Asked, index: usize, lane: &mut Lane<R>) {
        let Some(mut marching) = self.start(asked, index) else {
            lane.stage = Stage::Done;
            return;
        };
        marching.job.stretches = std::mem::take(&mut lane.marching.job.stretches).cleared();
        *lane.marching = marching;
        lane.go_on(&self.way);
        self.close(asked, slice::from_mut(lane));
    }

    /// Begins an instance in a new place.
    fn begin_anew(&self, asked: &Asked, index: usize) -> Option<Lane<R>> {
        let mut lane = Lane::new(Box::new(self.start(asked, index)?), &self.way);
        self.close(asked, slice::from_mut(&mut lane));
        Some(lane)
    }

    /// Completes the records of instances that are over.
    fn complete(&self, asked: &Asked, over: &mut [&mut Lane<R>]) {
        let instances: Vec<Instance> = over.iter().map(|lane| asked.instance(lane.marching.index)).collect();
        let examined = examined_many(&instances, asked.spec().linear());
        for ((lane, instance), examined) in over.iter_mut().zip(&instances).zip(examined) {
            let Marching { index, job, .. } = &*lane.marching;
            asked.complete(*index, instance, examined, &job.outcome(&self.way.plan));
            lane.stage = Stage::Done;
        }
    }

    /// Completes the records of those lanes whose windows are passed once more, on the CPU, as their Fourier sums did not tell a phase.
    pub fn finish(&self, asked: &Asked, lanes: &mut [Lane<R>]) {
        // What is over is finished, whatever else is stopped.
        let never = AtomicBool::new(false);
        let plan = &self.way.plan;
        let tolerance = f64::from(self.way.tolerance);
        let settings = Settings { plan, tolerance, terms: Terms::default(), cancel: &never };
        let mut over: Vec<&mut Lane<R>> = lanes.iter_mut().filter(|lane| lane.stage == Stage::Over).collect();
        for law in LawForm::ALL {
            let here: Vec<usize> =
                (0..over.len()).filter(|place| over[*place].marching.job.law() == law).collect();
            let mut jobs: Vec<Job<R>> = here.iter().map(|place| over[*place].marching.job.clone()).collect();
            jobs.par_chunks_mut(FINISHED).for_each(|jobs| R::run(jobs, &[Part::Phase], false, settings));
            for (place, job) in here.into_iter().zip(jobs) {
                over[place].marching.job = job;
            }
        }
        over.par_chunks_mut(FINISHED).for_each(|over| self.complete(asked, over));
    }
}
