//! The record of one instance: the results of one start or several, and of its check.

use crate::engine::outcome::Outcome;
use crate::engine::regime::{Regime, THRESHOLDS};
use crate::model::kind::InstabilityType;
use crate::model::linear::Linear;
use crate::model::status::Status;

/// The results of one instance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// How it ended.
    pub status: Status,
    /// Type of instability; `None` when not asked for or not defined (Painlevé, invalid law).
    pub kind: Option<InstabilityType>,
    /// Eigenvalue analysis, when asked for and defined.
    pub linear: Option<Linear>,
    /// Regime of the measuring window, when asked for and defined.
    pub regime: Option<Regime>,
    /// Whether the regime is settled.
    pub settled: Option<bool>,
    /// The response, when asked for; apart, as a record without one is a quarter as large.
    pub outcome: Option<Box<Outcome>>,
    /// The result of its check, where the instance was checked.
    pub check: Option<Check>,
    /// Whether several starts ended differently; `None` where there is one, or some have not settled.
    pub bistable: Option<bool>,
    /// The results of its other starts, where there are any.
    pub others: Option<Others>,
}

impl Record {
    /// An instance that a stopped run did not come to.
    pub const NOT_COMPUTED: Record = Record {
        status: Status::NotComputed,
        kind: None,
        linear: None,
        regime: None,
        settled: None,
        outcome: None,
        check: None,
        bistable: None,
        others: None,
    };

    /// The record before any check; `None` where that is not known, or nothing was computed.
    #[must_use]
    pub fn as_made(&self) -> Option<Record> {
        let made = self.status != Status::NotComputed && self.check.is_none_or(|check| !check.taken);
        made.then(|| Record { check: None, ..self.clone() })
    }

    /// The record of the large start, where there is one.
    #[must_use]
    pub fn large(&self) -> Option<&Record> {
        match &self.others {
            Some(Others::Large(record)) => Some(record),
            _ => None,
        }
    }

    /// The results of its starts from a box, where there are any.
    #[must_use]
    pub fn basin(&self) -> Option<Basin> {
        match &self.others {
            Some(Others::Basin(basin)) => Some(*basin),
            _ => None,
        }
    }
}

/// The judge that checked an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum By {
    /// The CPU engine in f64 with fine steps.
    Fine,
    /// The reference.
    Reference,
}

/// The result of checking an instance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Check {
    /// The judge.
    pub by: By,
    /// Whether it is near a border between two labels: its record is then the finer one.
    pub taken: bool,
    /// Whether type, regime or status changed.
    pub changed: bool,
    /// The worst relative error of `x2_std`, `ax_rms`, `ay_rms` and `response_frequency`; `None` where the motion is no
    /// settled oscillation.
    pub error: Option<f64>,
}

/// The results of an instance from other starts than the small one.
#[derive(Clone, Debug, PartialEq)]
pub enum Others {
    /// From the large start; eigenvalues and type stand in the record of the small one.
    Large(Box<Record>),
    /// From the starts of a box.
    Basin(Basin),
}

/// How many starts of a box ended where.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Basin {
    /// In steady sliding: at, or decaying towards, a stable equilibrium.
    pub equilibrium: u32,
    /// In a settled oscillation of any kind.
    pub oscillation: u32,
    /// Elsewhere: stuck, or not settled.
    pub other: u32,
    /// Nowhere: the response failed.
    pub failed: u32,
}

/// Where a response has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Attractor {
    /// Steady sliding.
    Equilibrium,
    /// A settled oscillation.
    Oscillation,
    /// Stick for ever.
    Stuck,
}

impl Attractor {
    /// Where a record has ended, its equilibrium being of the type `kind`. Nothing where it has not settled: a decay
    /// towards an equilibrium that is not stable is on its way to something else.
    #[must_use]
    pub fn of(record: &Record, kind: Option<InstabilityType>) -> Option<Attractor> {
        if record.status != Status::Ok || record.settled != Some(true) {
            return None;
        }
        match record.regime? {
            Regime::Equilibrium => (kind == Some(InstabilityType::Stable)).then_some(Attractor::Equilibrium),
            Regime::Stuck => Some(Attractor::Stuck),
            Regime::NotYetGrown => None,
            _ => Some(Attractor::Oscillation),
        }
    }
}

/// Whether two starts have ended differently; `None` where one of them has not settled.
///
/// Two oscillations differ by their amplitudes ([`THRESHOLDS`]): their regimes may differ for one and the same cycle,
/// where it fills a contact state for about the share of the time that counts.
#[must_use]
pub fn differ(small: &Record, large: &Record, kind: Option<InstabilityType>) -> Option<bool> {
    let ends = (Attractor::of(small, kind)?, Attractor::of(large, kind)?);
    let (Some(small), Some(large)) = (&small.outcome, &large.outcome) else { return None };
    Some(match ends {
        (Attractor::Oscillation, Attractor::Oscillation) => {
            let of =
                |get: fn(&Outcome) -> Option<f64>| (get(small).unwrap_or(0.0), get(large).unwrap_or(0.0));
            [of(|one| one.x2_std), of(|one| one.ay_rms)].into_iter().any(|(a, b)| apart(a, b))
        }
        (small, large) => small != large,
    })
}

/// Whether two amplitudes are those of two cycles.
#[must_use]
pub fn apart(a: f64, b: f64) -> bool {
    (a - b).abs() > THRESHOLDS.apart * a.max(b)
}

impl Basin {
    /// Counts the record of one more start, its equilibrium being of the type `kind`.
    pub fn add(&mut self, record: &Record, kind: Option<InstabilityType>) {
        match Attractor::of(record, kind) {
            None if record.status != Status::Ok => self.failed += 1,
            Some(Attractor::Equilibrium) => self.equilibrium += 1,
            Some(Attractor::Oscillation) => self.oscillation += 1,
            Some(Attractor::Stuck) | None => self.other += 1,
        }
    }

    /// How many starts there were.
    #[must_use]
    pub fn total(self) -> u32 {
        self.equilibrium + self.oscillation + self.other + self.failed
    }

    /// The fraction of so many of them; undefined of none.
    #[must_use]
    pub fn fraction(self, count: u32) -> Option<f64> {
        (self.total() > 0).then(|| f64::from(count) / f64::from(self.total()))
    }

    /// The standard error of such a fraction, `sqrt(p (1 − p)/n)`; undefined of none.
    #[must_use]
    pub fn standard_error(self, count: u32) -> Option<f64> {
        self.fraction(count).map(|part| (part * (1.0 - part) / f64::from(self.total())).sqrt())
    }

    /// Whether both sliding and oscillation were met; `None` where only one was and some starts ended elsewhere or failed.
    #[must_use]
    pub fn is_bistable(self) -> Option<bool> {
        let both = self.equilibrium > 0 && self.oscillation > 0;
        (both || self.other + self.failed == 0).then_some(both)
    }
}
