//! Computes the tiles that a directory lacks.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

use super::claim::Claim;
use super::direct::Room;
use super::directory::{Note, Store};
use super::reuse::Reuse;
use crate::backend::solver::Solver;
use crate::error::{Error, Result};
use crate::map::{Record, Stopped};

/// Between two looks at a tile that another process computes.
const WAIT: Duration = Duration::from_millis(50);

/// What came of filling a directory.
#[derive(Debug, Default)]
pub struct Filled {
    /// Instances of finished tiles that were computed here.
    pub computed: usize,
    /// Instances that were taken over from another sweep, those of a tile that was stopped included.
    pub reused: usize,
    /// The wall time it took.
    pub elapsed: Duration,
    /// Why not all is there.
    pub stopped: Option<Stopped>,
    /// The records of a tile that was stopped on its way; those not done are [`Record::NOT_COMPUTED`].
    pub partial: Option<(usize, Vec<Record>)>,
    /// How many of these were taken over.
    pub partial_reused: usize,
}

/// Who asks for tiles, and hears of them.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    /// Set to stop early.
    pub cancel: &'a AtomicBool,
    /// Gets the number of newly finished instances.
    pub progress: &'a (dyn Fn(usize) + Sync),
    /// Gets a sentence about every bad tile.
    pub note: Note<'a>,
}

/// A tile to be written.
type Finished = (Claim, usize, Vec<Record>);

/// Computes those of the tiles `wanted` that are not there, as far as `reuse` has none of their instances; tiles that other processes are computing are waited
/// for. One tile is computed while the one before is written: the records of two are in memory.
///
/// # Errors
/// When a tile cannot be written, or a result is in doubt; all finished tiles stay.
pub fn fill(
    store: &Store,
    solver: &mut Solver,
    wanted: &[usize],
    reuse: Option<&Reuse>,
    watch: Watch,
) -> Result<Filled> {
    let began = Instant::now();
    let (sender, receiver) = sync_channel(0);
    let mut filled = thread::scope(|scope| {
        let writer = thread::Builder::new().spawn_scoped(scope, || write_all(store, receiver));
        let Ok(writer) = writer else {
            // Where no thread can be started each tile is written before the next is computed.
            let mut room = Room::default();
            return compute(store, solver, wanted, reuse, watch, &mut |(claim, number, records)| {
                store.write(claim, number, records, &mut room)
            });
        };
        // The writer has ended with an error, which is reported in place of this.
        let ended = |_| Error::Cancelled { done: 0, total: 0 };
        let computed =
            compute(store, solver, wanted, reuse, watch, &mut |tile| sender.send(tile).map_err(ended));
        drop(sender);
        // An error of the writer is the cause of one of the computation.
        writer.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))?;
        computed
    })?;
    filled.elapsed = began.elapsed();
    Ok(filled)
}

/// Writes what it is sent until there is no more.
fn write_all(store: &Store, receiver: Receiver<Finished>) -> Result<()> {
    let mut room = Room::default();
    receiver
        .into_iter()
        .try_for_each(|(claim, number, records)| store.write(claim, number, records, &mut room))
}

fn compute(
    store: &Store,
    solver: &mut Solver,
    wanted: &[usize],
    reuse: Option<&Reuse>,
    watch: Watch,
    finish: &mut dyn FnMut(Finished) -> Result<()>,
) -> Result<Filled> {
    let mut filled = Filled::default();
    let mut open = wanted.to_vec();
    while !open.is_empty() {
        let mut busy = Vec::new();
        for number in std::mem::take(&mut open) {
            if watch.cancel.load(Ordering::Relaxed) {
                filled.stopped = Some(Stopped::Cancelled);
                return Ok(filled);
            }
            let Some(claim) = store.claim(number)? else {
                busy.push(number);
                continue;
            };
            // Another process may have finished it in the meantime.
            if store.path(number).exists() {
                continue;
            }
            let bounds = store.description.tiling.bounds(number);
            let count = bounds.len();
            let (made, reused) = match reuse {
                None => (solver.records(bounds, watch.progress), 0),
                Some(reuse) => {
                    let known = reuse.known(bounds.clone(), watch.note);
                    let reused = known.iter().flatten().count();
                    (solver.records_beside(bounds, &known, watch.progress), reused)
                }
            };
            match made {
                Ok(tile) if tile.stopped.is_none() => {
                    filled.computed += count - reused;
                    filled.reused += reused;
                    finish((claim, number, tile.records))?;
                }
                Ok(part) => {
                    filled.stopped = part.stopped;
                    filled.reused += reused;
                    filled.partial_reused = reused;
                    filled.partial = Some((number, part.records));
                    return Ok(filled);
                }
                Err(why) => {
                    filled.stopped = Some(Stopped::try_from(why)?);
                    return Ok(filled);
                }
            }
        }
        open = busy;
        if !open.is_empty() {
            thread::sleep(WAIT);
        }
    }
    Ok(filled)
}
