//! The strokes of a record: where the body slides one way, between rests and turns.

use std::io::Read;

use crate::channel::{Channel, PerChannel};
use crate::fault::{Fault, Unfit};
use crate::read::Table;
use crate::settings::Settings;
use crate::unread::Unread;

/// The record is looked at in at most twice so many blocks.
const BLOCKS: usize = 2048;

/// What moves slower than this part of the fastest is at rest.
const RESTS: f64 = 0.05;

/// A stroke is no shorter than this part of the longest.
const SHORTEST: f64 = 0.05;

/// A stroke of a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Its rows: the number of those before it, and how many it has.
    pub rows: [u64; 2],
    /// Whether the body slides in the direction that has a positive velocity.
    pub forward: bool,
    /// Mean speeds over its quarters, m/s; `None` where the velocity was not recorded.
    pub quarters: Option<[f64; 4]>,
    /// Mean tangential over mean normal force, along the direction of sliding; `None` where one of them was not recorded.
    pub friction: Option<f64>,
    /// Mean temperature, °C.
    pub temperature: Option<f64>,
}

/// Some rows together.
#[derive(Clone, Copy, Debug, Default)]
struct Block {
    rows: u64,
    /// Of what tells the direction, of both forces, and of the temperature.
    sums: [f64; 4],
}

impl Block {
    fn mean(&self, of: usize) -> f64 {
        self.sums[of] / self.rows as f64
    }

    fn with(self, other: Block) -> Block {
        let sums = std::array::from_fn(|of| self.sums[of] + other.sums[of]);
        Block { rows: self.rows + other.rows, sums }
    }

    fn of(some: &[Block]) -> Block {
        some.iter().fold(Block::default(), |sum, block| sum.with(*block))
    }
}

/// What a record has.
#[derive(Clone, Copy, Debug)]
struct Has {
    velocity: bool,
    forces: bool,
    temperature: bool,
}

/// The strokes of the record that `open` reads, named `name` in messages: by the sign of its velocity, or of its tangential force where
/// it has no velocity. Where it has neither, or nothing in it moves, the whole record is one. A record is read once.
///
/// # Errors
/// When the file cannot be read, or a value is no number: which, where, what to do.
pub fn strokes(
    mut open: impl FnMut() -> std::io::Result<Box<dyn Read>>,
    name: &str,
    settings: &Settings,
) -> Result<Vec<Stroke>, Unfit> {
    let unfit = |fault| Unfit { name: name.to_owned(), fault: Box::new(fault) };
    let input = open().map_err(|why| unfit(Fault::Unreadable { why: why.to_string() }))?;
    Table::open(input, settings).and_then(found).map_err(unfit)
}

fn found(mut table: Table) -> Result<Vec<Stroke>, Fault> {
    let told = [Channel::Velocity, Channel::TangentialForce].into_iter().find(|channel| table.has(*channel));
    let has = Has {
        velocity: table.has(Channel::Velocity),
        forces: table.has(Channel::TangentialForce) && table.has(Channel::NormalForce),
        temperature: table.has(Channel::Temperature),
    };
    let (mut blocks, mut open, mut size) = (Vec::<Block>::new(), Block::default(), 1);
    let mut before = PerChannel::default();
    while let Some(values) = row(&mut table, before)? {
        before = values;
        let of = |channel: Channel| values[channel as usize];
        let forces = [Channel::TangentialForce, Channel::NormalForce].map(of);
        let sums = [told.map_or(1.0, of), forces[0], forces[1], of(Channel::Temperature)];
        open = open.with(Block { rows: 1, sums });
        if open.rows == size {
            blocks.push(std::mem::take(&mut open));
        }
        if blocks.len() == 2 * BLOCKS {
            blocks = blocks.chunks(2).map(Block::of).collect();
            size *= 2;
        }
    }
    if open.rows > 0 {
        blocks.push(open);
    }
    Ok(parted(&blocks, has))
}

/// The values of the next row. One that holds no numbers has those of the row before: it is the stroke that it lies in that is refused,
/// once it is looked at.
fn row(table: &mut Table, before: PerChannel<f64>) -> Result<Option<PerChannel<f64>>, Fault> {
    match table.next() {
        Ok(row) => Ok(row.map(|row| row.values)),
        Err(Fault::NotANumber { .. } | Fault::Ragged { .. } | Fault::Unread(Unread::NotFinite { .. })) => {
            Ok(Some(before))
        }
        Err(fault) => Err(fault),
    }
}

/// The strokes of a record in blocks.
fn parted(blocks: &[Block], has: Has) -> Vec<Stroke> {
    let fastest = blocks.iter().fold(0.0, |most: f64, block| most.max(block.mean(0).abs()));
    let sign = |block: &Block| match block.mean(0) {
        mean if mean.abs() <= RESTS * fastest => 0,
        mean if mean > 0.0 => 1,
        _ => -1,
    };
    let mut all = Vec::new();
    let (mut before, mut passed) = (0, 0);
    for run in blocks.chunk_by(|a, b| sign(a) == sign(b)) {
        passed += run.len();
        if sign(&run[0]) != 0 {
            // The block in which a stroke begins or ends holds some of the rest beside it.
            let first = usize::from(passed > run.len());
            let last = run.len() - usize::from(passed < blocks.len());
            let within = if first < last { first..last } else { 0..run.len() };
            all.push(stroke(&run[within.clone()], before + Block::of(&run[..within.start]).rows, has));
        }
        before += Block::of(run).rows;
    }
    let longest = all.iter().map(|stroke| stroke.rows[1]).max().unwrap_or(0);
    all.retain(|stroke| stroke.rows[1] as f64 >= SHORTEST * longest as f64);
    if all.is_empty() && before > 0 {
        all.push(stroke(blocks, 0, has));
    }
    all
}

/// The stroke of some blocks, before which there are so many rows.
fn stroke(run: &[Block], before: u64, has: Has) -> Stroke {
    let whole = Block::of(run);
    let quarter = |k: usize| {
        let from = (k * run.len() / 4).min(run.len() - 1);
        Block::of(&run[from..((k + 1) * run.len() / 4).max(from + 1)]).mean(0).abs()
    };
    let forward = whole.mean(0) >= 0.0;
    let along = if forward { 1.0 } else { -1.0 };
    let friction = along * whole.mean(1) / whole.mean(2);
    Stroke {
        rows: [before, whole.rows],
        forward,
        quarters: has.velocity.then(|| [0, 1, 2, 3].map(quarter)),
        friction: Some(friction).filter(|friction| has.forces && friction.is_finite()),
        temperature: has.temperature.then(|| whole.mean(3)),
    }
}
