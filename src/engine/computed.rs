//! The records of a sweep: all of them, or what was done when it stopped.

use crate::engine::computation::Stopped;
use crate::engine::error::Result;
use crate::engine::record::Record;
use crate::model::status::Status;

/// The records of a sweep as an engine made them: one per instance, in the order of the grid.
#[derive(Debug)]
pub struct Computed {
    /// The records; those that were not done are [`Record::NOT_COMPUTED`].
    pub records: Vec<Record>,
    /// Why not all are done.
    pub stopped: Option<Stopped>,
}

impl Computed {
    /// The first records of `total`, and how computing them ended; those behind them are not computed.
    ///
    /// # Errors
    /// That of `ended` when nothing is done, or when it puts in doubt what is.
    pub fn new(mut records: Vec<Record>, total: usize, ended: Result<()>) -> Result<Computed> {
        let Err(why) = ended else { return Ok(Computed { records, stopped: None }) };
        if records.iter().all(|record| record.status == Status::NotComputed) {
            return Err(why);
        }
        let stopped = Stopped::try_from(why)?;
        records.resize(total, Record::NOT_COMPUTED);
        Ok(Computed { records, stopped: Some(stopped) })
    }
}
