//! The transients of a sweep as a stream: instances that are over make room for the next, and while a device computes some of
//! them the host goes on with others.

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use crate::engine::error::{Error, Result};
use crate::engine::gpu::arena::{Arena, Lane};
use crate::engine::gpu::chunks::Session;
use crate::engine::instances::Instances;
use crate::engine::judged::{kind_of, take_response};
use crate::engine::kernel::source::SETTING_WORDS;
use crate::engine::lanes::Lanes;
use crate::engine::lanes::job::{Job, Part};
use crate::engine::lanes::march::{Settings, Terms};
use crate::engine::march::marching::{Marching, Way};
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
struct Going<R> {
    marching: Marching<R>,
    idle: u32,
    is_over: bool,
}

/// An instance with its words, in a place of its own, which others take after it.
type Place<R> = Box<Lane<R, Going<R>>>;

/// Instances of a device that go round by round.
struct Crew<R> {
    session: usize,
    arena: Arena<R>,
    lanes: Vec<Place<R>>,
}

/// What an instance begins with.
enum Begun<R> {
    Lane(Place<R>),
    Over(Place<R>),
    /// It cannot start; with the place that it did not need.
    Dead(usize, Record, Option<Place<R>>),
}

/// The instances of a sweep that are computed.
pub(super) struct Stream<'a, R> {
    spec: &'a dyn Instances,
    /// The number of the first in the sweep.
    first: usize,
    way: Way,
    settings: [u32; SETTING_WORDS],
    records: &'a mut [Record],
    progress: &'a (dyn Fn(usize) + Sync),
    cancel: &'a AtomicBool,
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

impl<'a, R: Lanes> Stream<'a, R> {
    /// The instances from `first` on of a sweep, one for each of `records`.
    pub(super) fn new(
        spec: &'a dyn Instances,
        first: usize,
        records: &'a mut [Record],
        cancel: &'a AtomicBool,
        progress: &'a (dyn Fn(usize) + Sync),
    ) -> Stream<'a, R> {
        let way = Way::new::<R>(spec.plan());
        let mut settings = [0; SETTING_WORDS];
        settings[0] = way.tolerance.to_bits();
        let (over, free, made, begun) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Stream {
            spec,
            first,
            way,
            settings,
            records,
            progress,
            cancel,
            next: 0,
            done: 0,
            told: 0,
            over,
            free,
            made,
            begun,
        }
    }

    /// Runs all of them on some devices, `most` at a time in each of their buffers.
    ///
    /// # Errors
    /// When a device fails or is lost for the second time, the run is cancelled, or a result is in doubt.
    pub(super) fn run(&mut self, sessions: &mut [Session], most: usize) -> Result<()> {
        // Two for each device: one computes while the host goes on with the other.
        let share = self.records.len().div_ceil(2 * sessions.len()).clamp(1, most);
        let mut crews = Vec::new();
        for session in (0..sessions.len()).flat_map(|session| [session; 2]) {
            let arena = Arena::new(sessions[session].device());
            crews.push(Crew { session, arena, lanes: Vec::new() });
        }
        let mut turn = 0;
        loop {
            self.finish();
            if self.cancel.load(Ordering::Relaxed) {
                let [done, total] = self.count();
                return Err(Error::Cancelled { done, total });
            }
            let Some(number) = self.next_crew(&crews, sessions, share, turn) else { break };
            turn = number + 1;
            let crew = &mut crews[number];
            let went = self.go_on(crew, &mut sessions[crew.session], share);
            if let Err(Error::DeviceLost { why }) = went {
                let lost = crew.session;
                sessions[lost].reopen(why, self.count())?;
                // Its instances are on the host as they were before the round; the others of the device, too.
                for crew in crews.iter_mut().filter(|crew| crew.session == lost) {
                    crew.arena = Arena::new(sessions[lost].device());
                }
            } else {
                went?;
            }
        }
        Ok(())
    }

    /// Instances that are done, and all.
    fn count(&self) -> [usize; 2] {
        [self.done, self.records.len()]
    }

    /// The next crew that has something to do: one whose round is over or that has not begun any, else the one that began first;
    /// `None` when nothing is left.
    fn next_crew(&self, crews: &[Crew<R>], sessions: &[Session], share: usize, turn: usize) -> Option<usize> {
        let in_turn = || (0..crews.len()).map(|k| (turn + k) % crews.len());
        let waits = |number: &usize| {
            let crew = &crews[*number];
            !crew.arena.is_busy() && (!crew.lanes.is_empty() || self.next < self.records.len() && share > 0)
        };
        if let Some(number) = in_turn().find(waits) {
            return Some(number);
        }
        if sessions.len() > 1 {
            // No device waits for a slower one.
            while crews.iter().any(|crew| crew.arena.is_busy()) && !self.cancel.load(Ordering::Relaxed) {
                for session in sessions {
                    session.device().listen();
                }
                if let Some(number) = in_turn().find(|number| crews[*number].arena.is_ready()) {
                    return Some(number);
                }
                std::thread::sleep(PAUSE);
            }
        }
        in_turn().find(|number| crews[*number].arena.is_busy())
    }

    /// Takes what has come of the round of a crew, fills it up and begins its next round.
    fn go_on(&mut self, crew: &mut Crew<R>, session: &mut Session, most: usize) -> Result<()> {
        let way = &self.way;
        crew.arena.collect(&mut crew.lanes, |lane, steps| take(lane, steps, way))?;
        let over = crew.lanes.extract_if(.., |lane| lane.memory.is_over);
        self.over.extend(over);
        self.fill_up(&mut crew.lanes, most);
        if crew.lanes.is_empty() {
            return Ok(());
        }
        // Those that took as many steps in their last stretch are alike, and then neighbours of the sweep.
        crew.lanes.sort_by_cached_key(|lane| (lane.form, lane.before(), lane.memory.marching.index));
        session.device().meter.hold(crew.lanes.len(), most);
        crew.arena.submit(session, &mut crew.lanes, self.settings)
    }

    /// Begins instances until there are `most` lanes, or none is left.
    fn fill_up(&mut self, lanes: &mut Vec<Place<R>>, most: usize) {
        while lanes.len() < most && self.next < self.records.len() {
            let some = (most - lanes.len()).min(BEGUN).min(self.records.len() - self.next);
            let range = self.next..self.next + some;
            self.next = range.end;
            let kept = self.free.len().saturating_sub(some);
            let mut places: Vec<Option<Place<R>>> = self.free.drain(kept..).map(Some).collect();
            places.resize_with(some, || None);
            let mut begun = std::mem::take(&mut self.begun);
            let begin = |(index, place)| self.begin(index, place);
            range.into_par_iter().zip(places).map(begin).collect_into_vec(&mut begun);
            for one in begun.drain(..) {
                match one {
                    Begun::Lane(lane) => lanes.push(lane),
                    Begun::Over(lane) => self.over.push(lane),
                    Begun::Dead(index, record, place) => {
                        self.free.extend(place);
                        self.put(index, record);
                    }
                }
            }
            self.begun = begun;
        }
    }

    /// An instance at its start, in a place that it may have.
    fn begin(&self, index: usize, place: Option<Place<R>>) -> Begun<R> {
        let instance = self.spec.instance(self.first + index);
        let mut marching = match Marching::new(index, &instance, &self.way) {
            Ok(marching) => marching,
            Err(status) => {
                let outcome = Outcome { status, ..Outcome::default() };
                return Begun::Dead(index, self.record(index, &instance, &outcome), place);
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

    /// The record of an instance with what it did.
    fn record(&self, index: usize, instance: &Instance, outcome: &Outcome) -> Record {
        let mut record = self.records[index].clone();
        let kind = kind_of(self.spec, instance, &record);
        take_response(&mut record, instance, kind, outcome);
        record
    }

    /// Puts the record of an instance that is done.
    fn put(&mut self, index: usize, record: Record) {
        self.records[index] = record;
        self.done += 1;
    }

    /// Makes the records of what is over. What the Fourier sums of the one pass do not tell, a second pass does, on the CPU.
    fn finish(&mut self) {
        let mut over = std::mem::take(&mut self.over);
        let tolerance = f64::from(self.way.tolerance);
        let told: Vec<bool> =
            over.par_iter_mut().map(|lane| lane.memory.marching.job.tells_phase(tolerance)).collect();
        self.pass_again(&mut over, &told);
        let mut made = std::mem::take(&mut self.made);
        let record = |lane: &Place<R>| {
            let Marching { index, job, .. } = &lane.memory.marching;
            let instance = self.spec.instance(self.first + index);
            (*index, self.record(*index, &instance, &job.outcome(&self.way.plan)))
        };
        over.par_iter().map(record).collect_into_vec(&mut made);
        for (index, record) in made.drain(..) {
            self.put(index, record);
        }
        self.free.append(&mut over);
        (self.made, self.over) = (made, over);
        if self.done > self.told {
            (self.progress)(self.done - self.told);
            self.told = self.done;
        }
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

impl<R: Lanes> Lane<R, Going<R>> {
    /// On to the next stretch, if there is one.
    fn go_on(&mut self, way: &Way) {
        match self.memory.marching.next_in(way, &mut self.words) {
            Some(form) => self.begin(form),
            None => self.memory.is_over = true,
        }
    }
}

/// Between two looks at several devices.
const PAUSE: std::time::Duration = std::time::Duration::from_micros(100);

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
