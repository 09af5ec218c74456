//! What comes after computing: records are checked and written as tiles, while others are computed.

use std::ops::Range;
use std::sync::mpsc::{Receiver, sync_channel};
use std::thread;
use std::time::Duration;

use crate::engine;
use crate::engine::computation::Stopped;
use crate::engine::computed::Computed;
use crate::engine::record::Record;
use crate::model::status::Status;
use crate::store::claim::Claim;
use crate::store::direct::Room;
use crate::store::directory::Store;
use crate::store::error::{Error, Result};
use crate::sweep::solver::Checker;

/// The result of filling a directory.
#[derive(Debug, Default)]
pub struct Filled {
    /// Instances that were computed here, those of tiles that were stopped on their way included.
    pub computed: usize,
    /// Instances that were taken over from another sweep.
    pub reused: usize,
    /// The wall time it took.
    pub elapsed: Duration,
    /// Why not all is there.
    pub stopped: Option<Stopped>,
}

/// Tiles that were computed together.
#[derive(Debug)]
pub(super) struct Made {
    /// Their numbers.
    pub(super) tiles: Vec<(usize, Claim)>,
    /// Their instances.
    pub(super) range: Range<usize>,
    /// The records of these.
    pub(super) computed: Computed,
    /// How many of these were known before.
    pub(super) known: usize,
    /// How many of these are another sweep's.
    pub(super) reused: usize,
}

/// What becomes of tiles that were computed.
pub(super) type Finish<'a> = dyn FnMut(Made) -> Result<()> + Send + 'a;

/// A tile to be written.
type Finished = (Claim, usize, Vec<Record>);

/// Checks and writes what is computed.
#[derive(Debug)]
pub(super) struct Finishing<'a> {
    store: &'a Store,
    checker: Checker<'a>,
    /// Most tiles that wait to be written.
    waiting: usize,
}

impl<'a> Finishing<'a> {
    /// Of a directory; as many instances are computed at a time as keep an engine busy.
    pub(super) fn new(store: &'a Store, checker: Checker<'a>, busy: usize) -> Finishing<'a> {
        // All but one of those that are computed together wait for the writer while the next are.
        let waiting = busy.div_ceil(store.description.tiling.tile.max(1)).saturating_sub(1);
        Finishing { store, checker, waiting }
    }

    /// Checks and writes what `compute` gives away, which says why it stopped, if it did. Tiles are written by a thread of their own, and
    /// by this one where none can be started.
    ///
    /// # Errors
    /// When a tile cannot be written, or a result is in doubt; that of `compute`.
    pub(super) fn run(&self, compute: impl FnOnce(&mut Finish) -> Result<Option<Stopped>>) -> Result<Filled> {
        let (checked, to_write) = sync_channel(self.waiting);
        thread::scope(|scope| {
            let writer = thread::Builder::new().spawn_scoped(scope, || self.write_all(to_write));
            let Ok(writer) = writer else { return self.run_alone(compute) };
            let mut filled = Filled::default();
            let mut send = |tile| checked.send(tile).map_err(|_| no_more());
            let stopped = compute(&mut |made| self.take(&mut filled, made, &mut send));
            drop(checked);
            // An error of the writer is the cause of one of the computation.
            writer.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))?;
            let stopped = stopped?;
            Ok(Filled { stopped: filled.stopped.take().or(stopped), ..filled })
        })
    }

    /// As [`Finishing::run`], one after the other.
    fn run_alone(&self, compute: impl FnOnce(&mut Finish) -> Result<Option<Stopped>>) -> Result<Filled> {
        let (mut filled, mut room) = (Filled::default(), Room::default());
        let mut write = |(claim, number, records)| self.store.write(claim, number, records, &mut room);
        let stopped = compute(&mut |made| self.take(&mut filled, made, &mut write))?;
        Ok(Filled { stopped: filled.stopped.take().or(stopped), ..filled })
    }

    /// Writes tiles until there is no more.
    fn write_all(&self, tiles: Receiver<Finished>) -> Result<()> {
        let mut room = Room::default();
        let mut write = |(claim, number, records)| self.store.write(claim, number, records, &mut room);
        tiles.into_iter().try_for_each(&mut write)
    }

    /// Checks what was computed and gives its tiles to `finish`. Where it was stopped, keeps the records that are done.
    fn take(
        &self,
        filled: &mut Filled,
        made: Made,
        finish: &mut dyn FnMut(Finished) -> Result<()>,
    ) -> Result<()> {
        let Made { tiles, range, mut computed, known, reused } = made;
        self.checker.check(range, &mut computed)?;
        let is_done = |record: &Record| record.status != Status::NotComputed;
        filled.computed += computed.records.iter().filter(|record| is_done(record)).count() - known;
        filled.reused += reused;
        let mut records = computed.records.into_iter();
        for (number, claim) in tiles {
            let count = self.store.description.tiling.bounds(number).len();
            let of_tile: Vec<Record> = records.by_ref().take(count).collect();
            if computed.stopped.is_none() {
                finish((claim, number, of_tile))?;
            } else if of_tile.iter().any(is_done) {
                self.store.keep(&claim, number, of_tile)?;
            }
        }
        filled.stopped = filled.stopped.take().or(computed.stopped);
        Ok(())
    }
}

/// The error of a tile that nobody writes any more: the writer has ended with an error, which is told in its place.
fn no_more() -> Error {
    engine::error::Error::Cancelled { done: 0, total: 0 }.into()
}
