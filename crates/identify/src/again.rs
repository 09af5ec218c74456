//! A record that is gone through again: a short one is kept from the first reading, a long one read anew.

use crate::channel::{Channel, PerChannel};
use crate::fault::Fault;
use crate::read::Table;

/// The most numbers that are kept, 96 MiB: two million samples of six channels.
const MOST: usize = 12 * (1 << 20);

/// The samples of a record, as long as they are few enough.
#[derive(Debug, Default)]
pub(super) struct Kept {
    channels: Vec<usize>,
    values: Vec<f64>,
    too_many: bool,
}

impl Kept {
    /// Nothing yet of a record with these channels.
    pub(super) fn new(has: PerChannel<bool>) -> Kept {
        Kept { channels: (0..has.len()).filter(|channel| has[*channel]).collect(), ..Kept::default() }
    }

    /// Takes the next sample.
    pub(super) fn take(&mut self, values: &PerChannel<f64>) {
        self.too_many |= self.values.len() + self.channels.len() > MOST;
        if self.too_many {
            self.values = Vec::new();
        } else {
            self.values.extend(self.channels.iter().map(|channel| values[*channel]));
        }
    }

    /// The samples from the first on, or those of the record that `open` reads; the signs along the contact are turned where
    /// the stroke goes the other way.
    pub(super) fn again(
        &self,
        turned: bool,
        open: impl FnOnce() -> Result<Table, Fault>,
    ) -> Result<Again<'_>, Fault> {
        let sign = if turned { -1.0 } else { 1.0 };
        if self.too_many {
            return Ok(Again::Read(open()?, sign));
        }
        Ok(Again::Kept(self, 0, sign))
    }
}

/// Goes through a record once more.
pub(super) enum Again<'a> {
    /// What was kept, the sample that comes next, and the sign.
    Kept(&'a Kept, usize, f64),
    /// The file, and the sign.
    Read(Table, f64),
}

impl Again<'_> {
    /// The next sample; `None` at the end.
    pub(super) fn next(&mut self) -> Result<Option<PerChannel<f64>>, Fault> {
        let mut values = PerChannel::default();
        let sign = match self {
            Again::Kept(kept, at, sign) => {
                let own = kept.values.get(*at..*at + kept.channels.len());
                let Some(own) = own.filter(|own| !own.is_empty()) else { return Ok(None) };
                for (channel, value) in kept.channels.iter().zip(own) {
                    values[*channel] = *value;
                }
                *at += kept.channels.len();
                *sign
            }
            Again::Read(table, sign) => {
                let Some(row) = table.next()? else { return Ok(None) };
                values = row.values;
                *sign
            }
        };
        for channel in [Channel::TangentialAcceleration, Channel::TangentialForce, Channel::Velocity] {
            values[channel as usize] *= sign;
        }
        Ok(Some(values))
    }
}
