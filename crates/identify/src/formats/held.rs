//! Columns that a format stores one after the other: they are held in memory, those that are read.

use squealmap_input::quote::quoted;

use super::source::{Clock, Source};
use crate::fault::Fault;
use crate::place::Place;
use crate::unread::Unread;

/// Two columns begin together when the times differ by less than this part of a sample.
const TOGETHER: f64 = 0.5;
/// Rates are one when they differ by this part at most.
const SAME: f64 = 1e-6;

/// A column of a file.
#[derive(Debug, Default)]
pub(super) struct Column {
    pub(super) name: String,
    pub(super) values: Vec<f64>,
    pub(super) clock: Option<Clock>,
    /// Its unit, where the file says one.
    pub(super) unit: Option<String>,
    /// Why it is not read, and what to do.
    pub(super) refused: Option<&'static str>,
}

/// The columns of a file.
#[derive(Debug)]
pub(super) struct Held {
    header: Vec<String>,
    columns: Vec<Column>,
    /// Samples of the chosen columns, and how many of them were gone to.
    samples: usize,
    at: usize,
}

impl Held {
    pub(super) fn new(columns: Vec<Column>) -> Held {
        let header = columns.iter().map(|column| column.name.clone()).collect();
        Held { header, columns, samples: 0, at: 0 }
    }
}

impl Source for Held {
    fn header(&self) -> &[String] {
        &self.header
    }

    fn clock(&self, column: usize) -> Option<Clock> {
        self.columns[column].clock
    }

    fn unit(&self, column: usize) -> Option<&str> {
        self.columns[column].unit.as_deref()
    }

    fn together(&self, first: usize, second: usize) -> Result<(), Unread> {
        let [one, other] = [first, second].map(|column| &self.columns[column]);
        for column in [one, other] {
            if let Some(why) = column.refused {
                return Err(Unread::Column { column: quoted(&column.name), why });
            }
        }
        let [first, second] = [one, other].map(|column| quoted(&column.name));
        let counts = [one, other].map(|column| column.values.len() as u64);
        if counts[0] != counts[1] {
            return Err(Unread::Lengths { first, second, counts });
        }
        let Some((clock, later)) = one.clock.zip(other.clock) else { return Ok(()) };
        if (later.rate / clock.rate - 1.0).abs() > SAME {
            return Err(Unread::Rates { first, second, rates: [clock.rate, later.rate] });
        }
        let later = (later.origin - clock.origin) + (later.start - clock.start);
        if later.abs() * clock.rate > TOGETHER {
            return Err(Unread::Begins { first, second, later });
        }
        Ok(())
    }

    fn choose(&mut self, chosen: &[usize]) {
        for (number, column) in self.columns.iter_mut().enumerate() {
            if !chosen.contains(&number) {
                column.values = Vec::new();
            }
        }
        self.samples = chosen.first().map_or(0, |first| self.columns[*first].values.len());
    }

    fn advance(&mut self) -> Result<bool, Fault> {
        let more = self.at < self.samples;
        self.at += usize::from(more);
        Ok(more)
    }

    fn number(&mut self, column: usize) -> Result<f64, Fault> {
        let Column { name, values, .. } = &self.columns[column];
        let value = values[self.at - 1];
        if value.is_finite() {
            Ok(value)
        } else {
            Err(Unread::NotFinite { sample: self.at as u64, column: quoted(name), value }.into())
        }
    }

    fn place(&self) -> Place {
        Place::Sample(self.at as u64)
    }
}
