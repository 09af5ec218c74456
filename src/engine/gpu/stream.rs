//! The transients of a sweep as a stream: while a device computes some instances the host goes on with others.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::engine::error::{Error, Result};
use crate::engine::gpu::arena::Arena;
use crate::engine::gpu::chunks::Session;
use crate::engine::lanes::Lanes;
use crate::engine::march::flow::{Asked, Flow, Place};

/// Between two looks at several devices.
const PAUSE: std::time::Duration = std::time::Duration::from_micros(100);

/// Instances of a device that go round by round.
struct Crew<R> {
    session: usize,
    arena: Arena<R>,
    lanes: Vec<Place<R>>,
}

/// The instances of a sweep that are computed.
pub(super) struct Stream<'a, R> {
    asked: Asked<'a>,
    flow: Flow<R>,
    progress: &'a (dyn Fn(usize) + Sync),
    cancel: &'a AtomicBool,
}

impl<'a, R: Lanes> Stream<'a, R> {
    /// Instances of a sweep.
    pub(super) fn new(
        asked: Asked<'a>,
        cancel: &'a AtomicBool,
        progress: &'a (dyn Fn(usize) + Sync),
    ) -> Stream<'a, R> {
        let flow = Flow::new(asked.spec);
        Stream { asked, flow, progress, cancel }
    }

    /// Runs all of them on some devices, `most` at a time in each of their buffers.
    ///
    /// # Errors
    /// When a device fails or is lost for the second time, the run is cancelled, or a result is in doubt.
    pub(super) fn run(&mut self, sessions: &mut [Session], most: usize) -> Result<()> {
        // Two for each device: one computes while the host goes on with the other.
        let share = self.asked.records.len().div_ceil(2 * sessions.len()).clamp(1, most);
        let mut crews = Vec::new();
        for session in (0..sessions.len()).flat_map(|session| [session; 2]) {
            let arena = Arena::new(sessions[session].device());
            crews.push(Crew { session, arena, lanes: Vec::new() });
        }
        let mut turn = 0;
        loop {
            let done = self.flow.finish(&mut self.asked);
            if done > 0 {
                (self.progress)(done);
            }
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
        [self.flow.done(), self.asked.records.len()]
    }

    /// The next crew that has something to do: one whose round is over or that has not begun any, else the one that began first;
    /// `None` when nothing is left.
    fn next_crew(&self, crews: &[Crew<R>], sessions: &[Session], share: usize, turn: usize) -> Option<usize> {
        let in_turn = || (0..crews.len()).map(|k| (turn + k) % crews.len());
        let waits = |number: &usize| {
            let crew = &crews[*number];
            !crew.arena.is_busy() && (!crew.lanes.is_empty() || self.flow.has_more(&self.asked) && share > 0)
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
        let flow = &self.flow;
        crew.arena.collect(&mut crew.lanes, |lane, steps| flow.take(lane, steps))?;
        self.flow.turn_over(&mut self.asked, &mut crew.lanes, most);
        if crew.lanes.is_empty() {
            return Ok(());
        }
        session.device().meter.hold(crew.lanes.len(), most);
        crew.arena.submit(session, &mut crew.lanes, self.flow.settings())
    }
}
