//! The pace of the samples: rising time, even steps, no gaps.

use crate::fault::Fault;
use crate::place::Place;

/// Steps from which the usual one is taken (their median).
const FIRST_STEPS: usize = 200;
/// A step this many times the usual one lacks a sample: half-way to two steps, so that times printed with
/// few digits pass.
const GAP: f64 = 1.5;
/// A step this fraction of the usual one is no rounding of a printed time.
const SHORT: f64 = 0.5;

/// Watches the column of time.
#[derive(Debug, Default)]
pub(super) struct Pace {
    column: String,
    first: Option<f64>,
    last: f64,
    rows: u64,
    usual: Option<f64>,
    /// The first steps, kept until the usual one is known: place, time and step.
    early: Vec<(Place, f64, f64)>,
}

impl Pace {
    pub(super) fn new(column: String) -> Pace {
        Pace { column, ..Pace::default() }
    }

    /// Takes the time of the next row.
    pub(super) fn row(&mut self, place: Place, time: f64) -> Result<(), Fault> {
        self.rows += 1;
        if self.first.is_none() {
            (self.first, self.last) = (Some(time), time);
            return Ok(());
        }
        let previous = std::mem::replace(&mut self.last, time);
        let step = time - previous;
        if step <= 0.0 {
            return Err(Fault::NotRising { place, column: self.column.clone(), time, previous });
        }
        if self.usual.is_some() {
            return self.check(place, time, step);
        }
        self.early.push((place, time, step));
        if self.early.len() >= FIRST_STEPS { self.settle() } else { Ok(()) }
    }

    /// Fixes the usual step and judges the first ones by it.
    fn settle(&mut self) -> Result<(), Fault> {
        let early = std::mem::take(&mut self.early);
        let mut steps: Vec<f64> = early.iter().map(|(_, _, step)| *step).collect();
        steps.sort_by(f64::total_cmp);
        self.usual = steps.get(steps.len() / 2).copied();
        early.into_iter().try_for_each(|(place, time, step)| self.check(place, time, step))
    }

    fn check(&self, place: Place, time: f64, step: f64) -> Result<(), Fault> {
        let usual = self.usual.unwrap_or(step);
        if step > GAP * usual {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a positive count")]
            let missing = (step / usual).round().max(2.0) as u64 - 1;
            return Err(Fault::Gap { place, column: self.column.clone(), missing, time });
        }
        if step < SHORT * usual {
            return Err(Fault::Uneven { place, column: self.column.clone(), step, usual });
        }
        Ok(())
    }

    /// The time of the first row (s) and the sampling rate (Hz), from the first and the last row.
    pub(super) fn finish(mut self) -> Result<(f64, f64), Fault> {
        self.settle()?;
        let first = self.first.unwrap_or(0.0);
        let rate = self.rows.saturating_sub(1) as f64 / (self.last - first);
        if rate.is_finite() && rate > 0.0 { Ok((first, rate)) } else { Err(Fault::NoRate { rate }) }
    }
}
