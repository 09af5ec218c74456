//! What every format gives: named columns, and rows of numbers.

use crate::fault::Fault;
use crate::place::Place;
use crate::unread::Unread;

/// The time of the samples, where the format itself says it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Clock {
    /// Seconds of the first sample.
    pub(crate) start: f64,
    /// Samples per second, Hz.
    pub(crate) rate: f64,
    /// When `start` is counted from, s; of two columns of a file it tells which began first.
    pub(crate) origin: f64,
}

impl Clock {
    /// The clock of samples that are `step` seconds apart; `None` where that is no rate.
    pub(crate) fn of_step(step: f64, start: f64, origin: f64) -> Option<Clock> {
        /// What the rounding of a step leaves of a whole rate.
        const ROUNDING: f64 = 1e-12;
        let rate = 1.0 / step;
        let whole = rate.round();
        let rate = if (rate - whole).abs() <= ROUNDING * whole { whole } else { rate };
        let is_clock = [rate, start, origin].iter().all(|value| value.is_finite()) && rate > 0.0;
        is_clock.then_some(Clock { start, rate, origin })
    }
}

/// Rows of numbers.
pub(crate) trait Source {
    /// The names of the columns.
    fn header(&self) -> &[String];

    /// The time of the samples of a column, where the format says it.
    fn clock(&self, _column: usize) -> Option<Clock> {
        None
    }

    /// The unit that a file says a column has, beside its name.
    fn unit(&self, _column: usize) -> Option<&str> {
        None
    }

    /// Whether the row has nothing in a column.
    fn is_blank(&self, _column: usize) -> bool {
        false
    }

    /// Refuses a column that is not read, and two that were not recorded together.
    fn together(&self, _first: usize, _second: usize) -> Result<(), Unread> {
        Ok(())
    }

    /// Takes the columns that will be read.
    fn choose(&mut self, _columns: &[usize]) {}

    /// Goes to the next row; whether there is one.
    fn advance(&mut self) -> Result<bool, Fault>;

    /// Refuses a row that has more or fewer columns than the header.
    fn whole(&self) -> Result<(), Fault> {
        Ok(())
    }

    /// The finite number of the row in a chosen column.
    fn number(&mut self, column: usize) -> Result<f64, Fault>;

    /// Where the row stands.
    fn place(&self) -> Place;

    /// What has to be known of the numbers, once they are read.
    fn remark(&self) -> Option<String> {
        None
    }
}
