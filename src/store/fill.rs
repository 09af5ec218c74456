//! Computes the tiles that a directory lacks.

use std::collections::VecDeque;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use crate::engine::computation::Stopped;
use crate::engine::record::Record;
use crate::model::status::Status;
use crate::store::claim::Claim;
use crate::store::directory::{Note, Store};
use crate::store::error::Result;
use crate::store::finish::{Filled, Finish, Finishing, Made};
use crate::store::reuse::Reuse;
use crate::sweep::solver::Solver;
use crate::sweep::spec::Starts;

/// Groups of so many tiles together are not added to: each is an open file.
const MOST_AHEAD: usize = 256;

/// Between two looks at a tile that another process computes.
const WAIT: Duration = Duration::from_millis(50);

/// Who asks for tiles, and hears of them.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    /// Set to stop early.
    pub cancel: &'a AtomicBool,
    /// Gets the number of newly finished instances.
    pub progress: &'a (dyn Fn(usize) + Sync),
    /// Gets a sentence about every bad tile, and about anything that is waited for.
    pub note: Note<'a>,
}

/// Computes those of the tiles `wanted` that are not there, as far as neither a stopped run nor `reuse` has their instances;
/// tiles that other processes are computing are waited for. Tiles are computed, as many together as keep the engine busy, while
/// those before are checked and written. The records of three such groups are in memory, and of those that the engine begins ahead.
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
    let finishing = Finishing::new(store, solver.checker(), solver.busy_with(store.description.tiling.tile));
    let mut filling = Filling { store, solver, reuse, watch };
    let ended = finishing.run(|finish| filling.all(wanted, finish));
    ended.map(|filled| Filled { elapsed: began.elapsed(), ..filled })
}

/// Tiles that are computed together.
struct Group {
    tiles: Vec<(usize, Claim)>,
    /// Their instances.
    range: Range<usize>,
    /// The records that are known of these; empty where none is.
    known: Vec<Option<Record>>,
    /// How many of these are another sweep's.
    reused: usize,
}

/// How many instances follow those of a group without a gap, of which nothing is known.
fn ahead<'a>(first: &Group, next: impl Iterator<Item = &'a Group>) -> usize {
    let mut end = first.range.end;
    for group in next.take_while(|group| group.known.is_empty()) {
        if group.range.start != end {
            break;
        }
        end = group.range.end;
    }
    end - first.range.end
}

/// A directory that is being filled.
struct Filling<'a, 'b> {
    store: &'a Store,
    solver: &'a mut Solver<'b>,
    reuse: Option<&'a Reuse>,
    watch: Watch<'a>,
}

impl Filling<'_, '_> {
    /// Computes all, and gives them to `finish`; why it stopped, if it did.
    fn all(&mut self, wanted: &[usize], finish: &mut Finish) -> Result<Option<Stopped>> {
        let mut open = wanted.to_vec();
        let mut told = false;
        while !open.is_empty() {
            let mut busy = Vec::new();
            let mut rest = open.as_slice();
            let mut next = VecDeque::new();
            let mut before: Option<Made> = None;
            while !self.is_cancelled() {
                if let Err(why) = self.claim_ahead(&mut next, &mut rest, &mut busy) {
                    before.map_or(Ok(()), &mut *finish)?;
                    return Err(why);
                }
                let Some(group) = next.pop_front() else { break };
                let ahead = ahead(&group, next.iter());
                let Group { tiles, range, known, reused } = group;
                let known_before = known.iter().flatten().count();
                let (solver, progress) = (&mut *self.solver, self.watch.progress);
                // On the threads of the pool that this is called in, of which there may be but one.
                let (computed, finished) = rayon::join(
                    || solver.records_beside(range.clone(), &known, ahead, progress),
                    || before.take().map_or(Ok(()), &mut *finish),
                );
                finished?;
                match computed {
                    Ok(computed) => {
                        let is_stopped = computed.stopped.is_some();
                        let made = Made { tiles, range, computed, known: known_before, reused };
                        if is_stopped {
                            finish(made)?;
                            return Ok(None);
                        }
                        before = Some(made);
                    }
                    Err(why) => return Ok(Some(Stopped::try_from(why)?)),
                }
            }
            before.map_or(Ok(()), &mut *finish)?;
            if self.is_cancelled() {
                return Ok(Some(Stopped::Cancelled));
            }
            open = busy;
            if !open.is_empty() {
                if !std::mem::replace(&mut told, true) {
                    let count = open.len();
                    (self.watch.note)(&format!("waiting for {count} tile(s) that other processes compute"));
                }
                thread::sleep(WAIT);
            }
        }
        Ok(None)
    }

    fn is_cancelled(&self) -> bool {
        self.watch.cancel.load(Ordering::Relaxed)
    }

    /// Claims groups, as long as there are more, for one to be computed and as many instances behind it as the engine begins ahead.
    fn claim_ahead(
        &self,
        next: &mut VecDeque<Group>,
        rest: &mut &[usize],
        busy: &mut Vec<usize>,
    ) -> Result<()> {
        let is_enough = |next: &VecDeque<Group>| {
            let Some(first) = next.front() else { return false };
            let behind = || next.iter().skip(1);
            let tiles: usize = next.iter().map(|group| group.tiles.len()).sum();
            let all = behind().map(|group| group.range.len()).sum::<usize>();
            ahead(first, behind()) < all || all >= self.solver.ahead() || tiles >= MOST_AHEAD
        };
        while !is_enough(next) {
            let tiles = self.next_group(rest, busy)?;
            if tiles.is_empty() {
                break;
            }
            next.push_back(self.group(tiles)?);
        }
        Ok(())
    }

    /// Tiles that follow one another as a group.
    fn group(&self, tiles: Vec<(usize, Claim)>) -> Result<Group> {
        let bounds = |number: usize| self.store.description.tiling.bounds(number);
        let (first, last) = (tiles[0].0, tiles[tiles.len() - 1].0);
        let range = bounds(first).start..bounds(last).end;
        let (mut known, mut reused) = (Vec::new(), 0);
        for (number, _) in &tiles {
            let [of_tile, taken] = self.known(*number, &mut known)?;
            debug_assert_eq!(of_tile, bounds(*number).len());
            reused += taken;
        }
        if known.iter().all(Option::is_none) {
            known = Vec::new();
        }
        Ok(Group { tiles, range, known, reused })
    }

    /// Claims the next tiles of `rest` that nobody has and that follow one another, as many as keep the engine busy; those
    /// that other processes have go to `busy`. Empty at the end.
    fn next_group(&self, rest: &mut &[usize], busy: &mut Vec<usize>) -> Result<Vec<(usize, Claim)>> {
        let tile = self.store.description.tiling.tile;
        let enough = self.solver.busy_with(tile);
        let mut group: Vec<(usize, Claim)> = Vec::new();
        while let Some((number, others)) = rest.split_first() {
            let follows = group.last().is_none_or(|(last, _)| last + 1 == *number);
            if !follows || group.len() * tile >= enough {
                break;
            }
            *rest = others;
            match self.store.claim(*number)? {
                // Another process may have finished it in the meantime.
                Some(_) if self.store.path(*number).exists() => {}
                Some(claim) => group.push((*number, claim)),
                None => busy.push(*number),
            }
        }
        Ok(group)
    }

    /// Adds the records of a tile's instances that are known from a stopped run or another sweep. Gives how many instances
    /// the tile has, and how many records are another sweep's.
    fn known(&self, number: usize, known: &mut Vec<Option<Record>>) -> Result<[usize; 2]> {
        let description = &self.store.description;
        let bounds = description.tiling.bounds(number);
        let one_start = description.analysis.starts == Starts::One;
        let as_known = |record: &Record| match record.status {
            Status::NotComputed => None,
            _ if one_start => record.as_made(),
            _ => Some(record.clone()),
        };
        let first = known.len();
        match self.store.kept(number, self.watch.note)? {
            Some(kept) => known.extend(kept.iter().map(as_known)),
            None => known.resize(first + bounds.len(), None),
        }
        let mut reused = 0;
        if let Some(reuse) = self.reuse {
            for (place, found) in known[first..].iter_mut().zip(reuse.known(bounds.clone(), self.watch.note))
            {
                if place.is_none() && found.is_some() {
                    *place = found;
                    reused += 1;
                }
            }
        }
        Ok([bounds.len(), reused])
    }
}
