//! A signal reduced to what a picture can show: lowest and highest value per column.

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

    pub(super) fn take(&mut self, value: f64) {
        let column = self.taken.saturating_mul(COLUMNS.min(self.samples)) / self.samples;
        let column = usize::try_from(column).unwrap_or(usize::MAX);
        match self.columns.get_mut(column) {
            Some([low, high]) => (*low, *high) = (low.min(value), high.max(value)),
            None => self.columns.push([value; 2]),
        }
        self.taken += 1;
    }
}
