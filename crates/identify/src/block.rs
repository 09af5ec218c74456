//! Samples of a record, some thousand at a time: what is told of each is told in a loop over one channel.

use std::ops::Range;

use crate::channel::{Channel, PerChannel};

/// Samples of a block.
pub(super) const ROWS: usize = 1 << 12;

/// Samples in a row, channel by channel; 0 where the record has none of a channel.
#[derive(Debug, Default)]
pub(super) struct Block {
    columns: PerChannel<Vec<f64>>,
}

impl Block {
    /// How many samples.
    pub(super) fn len(&self) -> usize {
        self.columns[0].len()
    }

    pub(super) fn is_full(&self) -> bool {
        self.len() >= ROWS
    }

    pub(super) fn clear(&mut self) {
        self.columns.iter_mut().for_each(Vec::clear);
    }

    /// Adds one sample.
    pub(super) fn push(&mut self, values: &PerChannel<f64>) {
        self.columns.iter_mut().zip(values).for_each(|(column, value)| column.push(*value));
    }

    /// Adds some of those of another block.
    pub(super) fn append(&mut self, other: &Block, some: Range<usize>) {
        let columns = self.columns.iter_mut().zip(&other.columns);
        columns.for_each(|(column, other)| column.extend_from_slice(&other[some.clone()]));
    }

    /// Leaves out the first `count`.
    pub(super) fn leave(&mut self, count: usize) {
        self.columns.iter_mut().for_each(|column| drop(column.drain(..count)));
    }

    pub(super) fn of(&self, channel: Channel) -> &[f64] {
        &self.columns[channel as usize]
    }

    pub(super) fn columns(&self) -> &PerChannel<Vec<f64>> {
        &self.columns
    }

    pub(super) fn columns_mut(&mut self) -> &mut PerChannel<Vec<f64>> {
        &mut self.columns
    }

    /// The part of a channel that lies within the samples `from` to `to` of the record; `first` is that of the block.
    pub(super) fn within(&self, channel: Channel, [from, to]: [u64; 2], first: u64) -> &[f64] {
        let column = self.of(channel);
        let at = |sample: u64| {
            usize::try_from(sample.saturating_sub(first)).unwrap_or(usize::MAX).min(column.len())
        };
        &column[at(from)..at(to).max(at(from))]
    }
}
