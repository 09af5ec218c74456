//! The instances of a sweep whose response is asked for, and their records, for several that compute them side by side.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use crate::engine::instances::Instances;
use crate::engine::judged::{Examined, take_response};
use crate::engine::outcome::Outcome;
use crate::engine::record::Record;
use crate::model::instance::Instance;

/// Records under one lock: neighbours, which one task makes mostly.
const TOGETHER: usize = 256;

/// How far the instances of a sweep are.
#[derive(Debug, Default)]
pub struct Tally {
    /// The first that nobody has taken.
    next: AtomicUsize,
    /// Those of the wanted that are done, and how many of them were not told of yet.
    done: AtomicUsize,
    untold: AtomicUsize,
}

impl Tally {
    /// Before a run in which some were taken before, of which so many wanted ones are done.
    #[must_use]
    pub fn begun(taken: usize, done: usize) -> Tally {
        Tally { next: taken.into(), done: done.into(), untold: done.into() }
    }

    /// How many were taken.
    #[must_use]
    pub fn taken(&self) -> usize {
        self.next.load(Ordering::Relaxed)
    }

    fn complete(&self) {
        self.done.fetch_add(1, Ordering::Relaxed);
        self.untold.fetch_add(1, Ordering::Relaxed);
    }
}

/// The instances of a sweep that are computed. The first of them are wanted; those behind them fill the room that the last of these
/// leave.
pub struct Asked<'a> {
    spec: &'a dyn Instances,
    first: usize,
    wanted: usize,
    total: usize,
    records: Vec<Mutex<&'a mut [Record]>>,
    tally: &'a Tally,
}

impl<'a> Asked<'a> {
    /// Those of a sweep from `first` on, each with room for its record.
    #[must_use]
    pub fn new(
        spec: &'a dyn Instances,
        [first, wanted]: [usize; 2],
        records: &'a mut [Record],
        tally: &'a Tally,
    ) -> Asked<'a> {
        let total = records.len();
        let records = records.chunks_mut(TOGETHER).map(Mutex::new).collect();
        Asked { spec, first, wanted, total, records, tally }
    }

    /// The sweep.
    #[must_use]
    pub fn spec(&self) -> &'a dyn Instances {
        self.spec
    }

    /// Those of the wanted that have a record with their response, and the wanted.
    #[must_use]
    pub fn count(&self) -> [usize; 2] {
        [self.tally.done.load(Ordering::Relaxed), self.wanted]
    }

    /// All, the wanted and those behind them.
    #[must_use]
    pub fn total(&self) -> usize {
        self.total
    }

    /// Whether the wanted are done.
    #[must_use]
    pub fn is_done(&self) -> bool {
        let [done, wanted] = self.count();
        done >= wanted
    }

    /// How many of the wanted are done that were not told of before.
    #[must_use]
    pub fn told(&self) -> usize {
        self.tally.untold.swap(0, Ordering::Relaxed)
    }

    /// Whether there is one that nobody has taken.
    #[must_use]
    pub fn has_more(&self) -> bool {
        self.tally.next.load(Ordering::Relaxed) < self.total
    }

    /// Takes the next ones, at most so many.
    #[must_use]
    pub fn take(&self, most: usize) -> Range<usize> {
        let first = self.tally.next.fetch_add(most, Ordering::Relaxed).min(self.total);
        first..(first + most).min(self.total)
    }

    /// One of them.
    #[must_use]
    pub fn instance(&self, index: usize) -> Instance {
        self.spec.instance(self.first + index)
    }

    /// Completes the record of one of them, which has its eigenvalues where they are asked for, with what it did.
    pub fn complete(
        &self,
        index: usize,
        instance: &Instance,
        (mut record, kind): Examined,
        outcome: &Outcome,
    ) {
        take_response(&mut record, instance, kind, outcome);
        let mut records = self.records[index / TOGETHER].lock().unwrap_or_else(PoisonError::into_inner);
        records[index % TOGETHER] = record;
        drop(records);
        if index < self.wanted {
            self.tally.complete();
        }
    }
}
