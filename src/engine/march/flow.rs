//! Instances that pass through the lanes of a device: those that are over make room for the next.

use std::sync::atomic::AtomicBool;

use rayon::prelude::*;

use crate::engine::error::{Error, Result};
use crate::engine::instances::Instances;
use crate::engine::judged::{kind_of, take_response};
use crate::engine::kernel::source::SETTING_WORDS;
use crate::engine::lanes::Lanes;
use crate::engine::lanes::job::{Job, Part};
use crate::engine::lanes::march::{Settings, Terms};
use crate::engine::march::marching::{Marching, Way};
use crate::engine::march::round::Lane;
use crate::engine::march::table::flag;
use crate::engine::outcome::Outcome;
use crate::engine::record::Record;
use crate::model::instance::Instance;
use crate::model::piece::LawForm;
use crate::model::status::Status;

/// Instances that are begun at a time.
const BEGUN: usize = 4096;

/// Jobs that a task finishes: some to every lane of a vector register.
const FINISHED: usize = 64;

/// Rounds without a step after which a lane does not come to its end.
const MOST_IDLE: u32 = 64;

/// An instance on a device, and how many rounds it has taken no step in.
#[derive(Clone, Debug)]
pub struct Going<R> {
    marching: Marching<R>,
    idle: u32,
    is_over: bool,
}

/// An instance with its words, in a place of its own, which others take after it.
pub type Place<R> = Box<Lane<R, Going<R>>>;

/// What an instance begins with.
#[derive(Debug)]
enum Begun<R> {
    Lane(Place<R>),
    Over(Place<R>),
    /// It cannot start; with the place that it did not need.
    Dead(usize, Record, Option<Place<R>>),
}

/// The instances of a sweep that are computed, and their records.
pub struct Asked<'a> {
    /// The sweep.
    pub spec: &'a dyn Instances,
    /// The number of the first in the sweep.
    pub first: usize,
    /// A record for each, as it is before any response.
    pub records: &'a mut [Record],
}

/// Instances on their way through lanes.
#[derive(Debug)]
pub struct Flow<R> {
    way: Way,
    settings: [u32; SETTING_WORDS],
    /// The first that has not begun.
    next: usize,
    done: usize,
    /// How many of them were told as progress.
    told: usize,
    /// Instances whose last window is over.
    over: Vec<Place<R>>,
    /// Places without an instance.
    free: Vec<Place<R>>,
    made: Vec<(usize, Record)>,
    begun: Vec<Begun<R>>,
}

impl<R: Lanes> Flow<R> {
    /// Before the first instance of a sweep.
    #[must_use]
    pub fn new(spec: &dyn Instances) -> Flow<R> {
        let way = Way::new::<R>(spec.plan());
        let mut settings = [0; SETTING_WORDS];
        settings[0] = way.tolerance.to_bits();
        let (over, free, made, begun) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Flow { way, settings, next: 0, done: 0, told: 0, over, free, made, begun }
    }

    /// The words of the kernel's own settings.
    #[must_use]
    pub fn settings(&self) -> [u32; SETTING_WORDS] {
        self.settings
    }

    /// Instances that have a record.
    #[must_use]
    pub fn done(&self) -> usize {
        self.done
    }

    /// Whether one of those asked for has not begun.
    #[must_use]
    pub fn has_more(&self, asked: &Asked) -> bool {
        self.next < asked.records.len()
    }

    /// Takes those out of the lanes that are over, fills up to `most` lanes, and sorts them by their kernels.
    pub fn turn_over(&mut self, asked: &mut Asked, lanes: &mut Vec<Place<R>>, most: usize) {
        let over = lanes.extract_if(.., |lane| lane.memory.is_over);
        self.over.extend(over);
        self.fill_up(asked, lanes, most);
        // Those that took as many steps in their last stretch are alike, and then neighbours of the sweep.
        lanes.sort_by_cached_key(|lane| (lane.form, lane.before(), lane.memory.marching.index));
    }

    /// Takes what a round has made of a lane.
    ///
    /// # Errors
    /// When the kernel cannot have made it, or does not come to an end.
    pub fn take(&self, lane: &mut Lane<R, Going<R>>, steps: u32) -> Result<()> {
        take(lane, steps, &self.way)
    }

    /// Begins instances until there are `most` lanes, or none is left.
    fn fill_up(&mut self, asked: &mut Asked, lanes: &mut Vec<Place<R>>, most: usize) {
        while lanes.len() < most && self.next < asked.records.len() {
            let some = (most - lanes.len()).min(BEGUN).min(asked.records.len() - self.next);
            let range = self.next..self.next + some;
            self.next = range.end;
            let kept = self.free.len().saturating_sub(some);
            let mut places: Vec<Option<Place<R>>> = self.free.drain(kept..).map(Some).collect();
            places.resize_with(some, || None);
            let mut begun = std::mem::take(&mut self.begun);
            let begin = |(index, place)| self.begin(asked, index, place);
            range.into_par_iter().zip(places).map(begin).collect_into_vec(&mut begun);
            for one in begun.drain(..) {
                match one {
                    Begun::Lane(lane) => lanes.push(lane),
                    Begun::Over(lane) => self.over.push(lane),
                    Begun::Dead(index, record, place) => {
                        self.free.extend(place);
                        self.put(asked, index, record);
                    }
                }
            }
            self.begun = begun;
        }
    }

    /// An instance at its start, in a place that it may have.
    fn begin(&self, asked: &Asked, index: usize, place: Option<Place<R>>) -> Begun<R> {
        let instance = asked.spec.instance(asked.first + index);
        let mut marching = match Marching::new(index, &instance, &self.way) {
            Ok(marching) => marching,
            Err(status) => {
                let outcome = Outcome { status, ..Outcome::default() };
                return Begun::Dead(index, asked.record(index, &instance, &outcome), place);
            }
        };
        let mut lane = if let Some(mut lane) = place {
            marching.job.stretches = std::mem::take(&mut lane.memory.marching.job.stretches).cleared();
            lane.memory = Going { marching, idle: 0, is_over: false };
            lane
        } else {
            Box::new(Lane::new(Going { marching, idle: 0, is_over: false }))
        };
        lane.go_on(&self.way);
        if lane.memory.is_over { Begun::Over(lane) } else { Begun::Lane(lane) }
    }

    /// Puts the record of an instance that is done.
    fn put(&mut self, asked: &mut Asked, index: usize, record: Record) {
        asked.records[index] = record;
        self.done += 1;
    }

    /// Makes the records of what is over, and says how many were not told before. What the Fourier sums of the one pass do not
    /// tell, a second pass does, on the CPU.
    pub fn finish(&mut self, asked: &mut Asked) -> usize {
        let mut over = std::mem::take(&mut self.over);
        let tolerance = f64::from(self.way.tolerance);
        let told: Vec<bool> =
            over.par_iter_mut().map(|lane| lane.memory.marching.job.tells_phase(tolerance)).collect();
        self.pass_again(&mut over, &told);
        let mut made = std::mem::take(&mut self.made);
        let record = |lane: &Place<R>| {
            let Marching { index, job, .. } = &lane.memory.marching;
            let instance = asked.spec.instance(asked.first + index);
            (*index, asked.record(*index, &instance, &job.outcome(&self.way.plan)))
        };
        over.par_iter().map(record).collect_into_vec(&mut made);
        for (index, record) in made.drain(..) {
            self.put(asked, index, record);
        }
        self.free.append(&mut over);
        (self.made, self.over) = (made, over);
        let before = std::mem::replace(&mut self.told, self.done);
        self.done - before
    }

    /// Passes the windows once more of those that are not `told`.
    fn pass_again(&self, over: &mut [Place<R>], told: &[bool]) {
        // What is over is finished, whatever else is stopped.
        let never = AtomicBool::new(false);
        let plan = &self.way.plan;
        let tolerance = f64::from(self.way.tolerance);
        let settings = Settings { plan, tolerance, terms: Terms::default(), cancel: &never };
        for law in LawForm::ALL {
            let here =
                |(place, told): &(&mut Place<R>, &bool)| !**told && place.memory.marching.job.law() == law;
            let places =
                over.iter_mut().zip(told).filter(here).map(|(place, _)| &mut place.memory.marching.job);
            let (places, mut jobs): (Vec<&mut Job<R>>, Vec<Job<R>>) = places
                .map(|job| {
                    let copy = job.clone();
                    (job, copy)
                })
                .unzip();
            jobs.par_chunks_mut(FINISHED).for_each(|jobs| R::run(jobs, &[Part::Phase], false, settings));
            for (place, job) in places.into_iter().zip(jobs) {
                *place = job;
            }
        }
    }
}

impl Asked<'_> {
    /// The record of an instance with what it did.
    fn record(&self, index: usize, instance: &Instance, outcome: &Outcome) -> Record {
        let mut record = self.records[index].clone();
        let kind = kind_of(self.spec, instance, &record);
        take_response(&mut record, instance, kind, outcome);
        record
    }
}

impl<R: Lanes> Lane<R, Going<R>> {
    /// On to the next stretch, if there is one.
    fn go_on(&mut self, way: &Way) {
        match self.memory.marching.next_in(way, &mut self.words) {
            Some(form) => self.begin(form),
            None => self.memory.is_over = true,
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
