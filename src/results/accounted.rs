//! Whether a map is whole.

use crate::engine::record::Record;
use crate::model::status::Status;
use crate::results::error::{Error, Result};
use crate::sweep::map::Map;

/// A map with a missing or an unwritten record is an error, never a row or a picture; so is one that lacks
/// instances without having been stopped.
pub(crate) fn accounted(map: &Map) -> Result<()> {
    let expected = map.spec.grid.len();
    if map.records.len() != expected {
        return Err(Error::Incomplete { records: map.records.len(), instances: expected });
    }
    all_written(0, &map.records, map.stopped.is_some())
}

/// The same of the records from instance `first` on.
pub(crate) fn all_written(first: usize, records: &[Record], stopped: bool) -> Result<()> {
    let unaccounted = |record: &Record| match record.status {
        Status::Unwritten => true,
        Status::NotComputed => !stopped,
        _ => false,
    };
    match records.iter().position(unaccounted) {
        Some(at) => Err(crate::engine::error::Error::Unwritten { instance: first + at }.into()),
        None => Ok(()),
    }
}
