//! A record that is gone through again: a short one is kept from the first reading, a long one read anew.

use crate::block::{Block, ROWS};
use crate::channel::{Channel, PerChannel};
use crate::fault::Fault;
use crate::read::Table;

/// The most numbers that are kept, 96 MiB: two million samples of six channels.
const MOST: usize = 12 * (1 << 20);

/// The samples of a record, as long as they are few enough.
#[derive(Debug)]
pub(super) struct Kept {
    has: PerChannel<bool>,
    columns: PerChannel<Vec<f64>>,
    samples: usize,
    too_many: bool,
}

impl Kept {
    /// Nothing yet of a record with these channels.
    pub(super) fn new(has: PerChannel<bool>) -> Kept {
        Kept { has, columns: PerChannel::default(), samples: 0, too_many: false }
    }

    /// Takes the next samples.
    pub(super) fn take(&mut self, block: &Block) {
        self.samples += block.len();
        self.too_many |= self.samples * self.has.iter().filter(|has| **has).count() > MOST;
        if self.too_many {
            self.columns = PerChannel::default();
            return;
        }
        for ((column, values), _) in
            self.columns.iter_mut().zip(block.columns()).zip(self.has).filter(|(_, has)| *has)
        {
            column.extend_from_slice(values);
        }
    }

    /// The samples from the first on, or those of the record that `open` reads; the signs along the contact are turned where
    /// the stroke goes the other way.
    pub(super) fn again(
        &self,
        turned: bool,
        open: impl FnOnce() -> Result<Table, Fault>,
    ) -> Result<Again<'_>, Fault> {
        let source = if self.too_many { Source::Read(Box::new(open()?)) } else { Source::Kept(self, 0) };
        Ok(Again { source, turned })
    }
}

/// Goes through a record once more.
pub(super) struct Again<'a> {
    source: Source<'a>,
    turned: bool,
}

enum Source<'a> {
    /// What was kept, and the sample that comes next.
    Kept(&'a Kept, usize),
    Read(Box<Table>),
}

impl Again<'_> {
    /// Fills a block with the next samples; whether there are any.
    pub(super) fn next(&mut self, block: &mut Block) -> Result<bool, Fault> {
        block.clear();
        match &mut self.source {
            Source::Kept(kept, at) => {
                let end = (*at + ROWS).min(kept.samples);
                for ((column, kept), has) in block.columns_mut().iter_mut().zip(&kept.columns).zip(kept.has) {
                    if has {
                        column.extend_from_slice(&kept[*at..end]);
                    } else {
                        column.resize(end - *at, 0.0);
                    }
                }
                *at = end;
            }
            Source::Read(table) => {
                while !block.is_full()
                    && let Some(row) = table.next()?
                {
                    block.push(&row.values);
                }
            }
        }
        if self.turned {
            for channel in [Channel::TangentialAcceleration, Channel::TangentialForce, Channel::Velocity] {
                block.columns_mut()[channel as usize].iter_mut().for_each(|value| *value = -*value);
            }
        }
        Ok(block.len() > 0)
    }
}
