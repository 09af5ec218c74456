//! Several starts of one instance: where they are, and what they come to.
//!
//! The small start is the kick of every sweep. The large one of `kind = "both"` is by default the mass moving with the
//! belt, `ẋ2 = V` at the sliding equilibrium: stick, the state of every brake before it slips. Of the single mass every
//! cycle with stick contains that state's release, so that the large start finds the cycle wherever there is one. The starts of `kind = "box"` are drawn by a hash of the index of the
//! instance and the number of the start alone.

use serde_json::Value as Json;

use crate::accuracy::draw::mixed;
use crate::classify::{InstabilityType, Regime, THRESHOLDS};
use crate::map::Record;
use crate::model::{Param, Params};
use crate::outcome::{Outcome, Status};
use crate::spec::{Pass, Starts};

/// Seed of the starts that are drawn from a box.
const BOX_SEED: u64 = 0x5153_424f;

/// What an instance did from other starts than the small one.
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
pub(crate) fn apart(a: f64, b: f64) -> bool {
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

/// Gives the parameters of an instance the start of a pass, as the kick that engines read.
pub(crate) fn place(pass: Pass, params: &mut Params) {
    if pass == Pass::Large {
        let velocity = params.get(Param::LargeVelocity);
        params.set(Param::StartVelocity, velocity.unwrap_or_else(|| params.require(Param::BeltVelocity)));
        params.set(Param::StartDisplacement, params.require(Param::LargeDisplacement));
    }
}

/// Start `number` from the box of instance `index`: displacement (m) and velocity (m/s), uniform between their bounds.
pub(crate) fn drawn(params: &Params, index: usize, number: u32) -> [f64; 2] {
    let bounds = [
        [Param::BoxDisplacementFrom, Param::BoxDisplacementTo],
        [Param::BoxVelocityFrom, Param::BoxVelocityTo],
    ];
    let of_instance = mixed(BOX_SEED, index as u64);
    std::array::from_fn(|side| {
        // The upper 53 bits: all that a number below 1 holds.
        let bits = mixed(of_instance, 2 * u64::from(number) + side as u64) >> 11;
        let fraction = bits as f64 / (1_u64 << 53) as f64;
        let [from, to] = bounds[side].map(|bound| params.require(bound));
        from + (to - from) * fraction
    })
}

/// The starts of a resolved sweep's `[start]`.
#[must_use]
pub(crate) fn from_json(start: &Json) -> Starts {
    match start["kind"].as_str() {
        Some("both") => Starts::Both,
        Some("box") => {
            let samples = start["box_samples"].as_u64().and_then(|samples| u32::try_from(samples).ok());
            Starts::Box(samples.unwrap_or(1))
        }
        _ => Starts::One,
    }
}
