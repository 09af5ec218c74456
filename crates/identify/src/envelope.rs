//! A signal reduced to what a picture can show: lowest and highest value per column.

use crate::lanes::{highest, lowest};

/// Columns of a picture: finer than a printed line over two columns of a journal.
const COLUMNS: u64 = 2000;

/// Lowest and highest value per column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Envelope {
    /// Lowest and highest value of each column, in order of time; the columns share the record evenly.
    pub columns: Vec<[f64; 2]>,
    samples: u64,
    taken: u64,
}

impl Envelope {
    /// For a record of this many samples.
    pub(super) fn new(samples: u64) -> Envelope {
        Envelope { columns: Vec::new(), samples: samples.max(1), taken: 0 }
    }

    /// Takes the next samples.
    pub(super) fn take(&mut self, mut values: &[f64]) {
        let columns = COLUMNS.min(self.samples);
        while !values.is_empty() {
            let column = self.taken.saturating_mul(columns) / self.samples;
            let end = ((column + 1) * self.samples).div_ceil(columns);
            let count = usize::try_from(end - self.taken).unwrap_or(usize::MAX).min(values.len());
            let (own, rest) = values.split_at(count);
            if usize::try_from(column).is_ok_and(|column| column == self.columns.len()) {
                self.columns.push([own[0]; 2]);
            }
            if let Some([low, high]) = self.columns.last_mut() {
                *low = low.min(lowest(own));
                *high = high.max(highest(own));
            }
            self.taken += count as u64;
            values = rest;
        }
    }
}
