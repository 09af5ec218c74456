//! The transients of a sweep as a stream: while a device computes some instances the host goes on with others.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;

use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::engine::error::{Error, Result};
use crate::engine::gpu::arena::Arena;
use crate::engine::gpu::chunks::Session;
use crate::engine::lanes::Lanes;
use crate::engine::march::asked::Asked;
use crate::engine::march::flow::Flow;
use crate::engine::march::lane::Lane;

/// Crews of a device: one's instances are computed while the host goes on with those of the others.
const OF_DEVICE: usize = 3;

/// What the threads of a crew are called.
const CREW: &str = "crew";

/// Lanes of a device, whose instances go round by round, and what is kept of them from run to run.
#[derive(Debug)]
pub(super) struct Crew<R> {
    session: usize,
    /// How many times the device of the arena had been opened again.
    opened_again: u32,
    arena: Arena<R>,
    /// Instances on their way that come behind those of the run.
    lanes: Vec<Lane<R>>,
    places: Vec<Lane<R>>,
    /// Threads of its own, `None` where there are none: in a pool that crews share, the work of one waits for pieces of another's.
    threads: Option<Arc<ThreadPool>>,
}

impl<R: Lanes> Crew<R> {
    /// The crews of some devices, each with as many threads as there are here.
    pub(super) fn of(sessions: &[Session]) -> Vec<Crew<R>> {
        let threads = rayon::current_num_threads();
        let crew = |number: usize| {
            let session = &sessions[number / OF_DEVICE];
            Crew {
                session: number / OF_DEVICE,
                opened_again: session.opened_again(),
                arena: Arena::new(session.device()),
                lanes: Vec::new(),
                places: Vec::new(),
                threads: pool(threads),
            }
        };
        (0..OF_DEVICE * sessions.len()).map(crew).collect()
    }

    /// Whether it has any.
    pub(super) fn has_instances(&self) -> bool {
        !self.lanes.is_empty()
    }

    /// Counts its instances from one that comes so many later.
    pub(super) fn count_from(&mut self, later: usize) {
        for lane in &mut self.lanes {
            lane.marching.index -= later;
        }
    }
}

/// Threads of a crew, with its name.
fn pool(threads: usize) -> Option<Arc<ThreadPool>> {
    let builder =
        ThreadPoolBuilder::new().num_threads(threads).thread_name(|number| format!("{CREW} {number}"));
    builder.build().ok().map(Arc::new)
}

/// A crew with its instances.
struct AtWork<'a, R> {
    crew: &'a mut Crew<R>,
    flow: Flow<R>,
    lanes: Vec<Lane<R>>,
}

/// The instances of a sweep that are computed, by whom.
pub(super) struct Stream<'a> {
    asked: Asked<'a>,
    sessions: Vec<Mutex<&'a mut Session>>,
    /// Most instances of a crew.
    most: usize,
    cancel: &'a AtomicBool,
    progress: &'a (dyn Fn(usize) + Sync),
    /// Whether one of the crews has failed.
    failed: AtomicBool,
}

impl<'a> Stream<'a> {
    /// Instances of a sweep on some devices, at most so many at a time in each of their buffers.
    pub(super) fn new(
        asked: Asked<'a>,
        (sessions, most): (&'a mut [Session], usize),
        cancel: &'a AtomicBool,
        progress: &'a (dyn Fn(usize) + Sync),
    ) -> Stream<'a> {
        let most = asked.total().div_ceil(OF_DEVICE * sessions.len()).clamp(1, most.max(1));
        let sessions = sessions.iter_mut().map(Mutex::new).collect();
        Stream { asked, sessions, most, cancel, progress, failed: AtomicBool::new(false) }
    }

    /// Runs all of them that are wanted. The crews have none of these then, and are gone where that fails.
    ///
    /// # Errors
    /// When a device fails or is lost for the second time, the run is cancelled, or a result is in doubt.
    pub(super) fn run<R: Lanes>(&self, crews: &mut Vec<Crew<R>>) -> Result<()> {
        let ended = thread::scope(|scope| {
            let mut crews = crews.iter_mut();
            let first = crews.next();
            let others: Vec<_> = crews
                .filter_map(|crew| {
                    thread::Builder::new().name(CREW.to_owned()).spawn_scoped(scope, || self.work(crew)).ok()
                })
                .collect();
            let ended = first.map_or(Ok(()), |crew| self.work(crew));
            others.into_iter().fold(ended, |ended, other| {
                let other = other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
                ended.and(other)
            })
        });
        // Where no thread could be started for a crew, its instances wait for this one.
        let mut left = crews.iter_mut().take_while(|_| ended.is_ok() && !self.asked.is_done());
        let ended = left.try_for_each(|crew| self.work(crew)).and(ended);
        if ended.is_err() {
            crews.clear();
        }
        ended
    }

    /// What a crew does, as long as there are instances that are wanted. It leaves others to its device.
    fn work<R: Lanes>(&self, crew: &mut Crew<R>) -> Result<()> {
        let flow = Flow::new(self.asked.spec(), std::mem::take(&mut crew.places));
        let (threads, lanes) = (crew.threads.clone(), std::mem::take(&mut crew.lanes));
        let mut at_work = AtWork { crew, flow, lanes };
        loop {
            let went = match &threads {
                Some(threads) => threads.install(|| self.go_on(&mut at_work)),
                None => self.go_on(&mut at_work),
            };
            match went {
                // Another one says why.
                _ if self.failed.load(Ordering::Relaxed) => return Ok(()),
                Ok(true) if !self.asked.is_done() => at_work.crew.arena.wait(),
                Ok(_) => break,
                Err(why) => {
                    self.failed.store(true, Ordering::Relaxed);
                    return Err(why);
                }
            }
        }
        (at_work.crew.places, at_work.crew.lanes) = (at_work.flow.into_places(), at_work.lanes);
        Ok(())
    }

    fn session(&self, number: usize) -> MutexGuard<'_, &'a mut Session> {
        self.sessions[number].lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What the host does for a crew between two rounds; whether there is another.
    fn go_on<R: Lanes>(&self, at_work: &mut AtWork<'_, R>) -> Result<bool> {
        loop {
            let why = match self.round(at_work) {
                Err(Error::DeviceLost { why }) => why,
                other => return other,
            };
            // Its instances are on the host as they were before the round. Perhaps another crew has opened the device again.
            let crew = &mut *at_work.crew;
            let mut session = self.session(crew.session);
            if session.opened_again() == crew.opened_again {
                session.reopen(why, self.asked.count())?;
            }
            (crew.arena, crew.opened_again) = (Arena::new(session.device()), session.opened_again());
        }
    }

    /// Takes what has come of the round of a crew, fills it up and begins its next round, if there is one.
    fn round<R: Lanes>(&self, AtWork { crew, flow, lanes }: &mut AtWork<'_, R>) -> Result<bool> {
        crew.arena.collect(lanes, flow, &self.asked)?;
        let is_cancelled = self.cancel.load(Ordering::Relaxed);
        flow.finish(&self.asked, lanes);
        flow.turn_over(&self.asked, lanes, if is_cancelled { 0 } else { self.most });
        let done = self.asked.told();
        if done > 0 {
            (self.progress)(done);
        }
        if is_cancelled {
            let [done, total] = self.asked.count();
            return Err(Error::Cancelled { done, total });
        }
        if lanes.is_empty() {
            return Ok(false);
        }
        let session = &self.sessions[crew.session];
        self.session(crew.session).device().meter.hold(lanes.len(), self.most.max(lanes.len()));
        crew.arena.submit(session, lanes, flow.settings())?;
        Ok(true)
    }
}
