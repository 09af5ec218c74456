//! Forces at the frequency of a vibration, which slow sensors do not follow, from the accelerations and a known rig.
//!
//! What the sensors show that is slower than the vibration stays; what is faster is replaced by what the motion of the masses takes.

use crate::again::Again;
use crate::block::Block;
use crate::channel::Channel;
use crate::fault::Fault;
use crate::motion::{drift, integral, period, reach};
use crate::rig::Rig;

/// Samples that are restored at once.
const CHUNK: usize = 1 << 15;
/// What is restored.
const FORCES: [Channel; 2] = [Channel::TangentialForce, Channel::NormalForce];
/// Swing of the measured tangential force, over the restored one, from which on the sensors follow the vibration.
const FOLLOWS: f64 = 0.5;

/// How to restore.
#[derive(Clone, Copy, Debug)]
pub(super) struct Restoring {
    pub(super) rig: Rig,
    /// Samples per second, Hz.
    pub(super) rate: f64,
    /// The strongest oscillation, Hz.
    pub(super) frequency: f64,
    /// Delay of the normal acceleration, s.
    pub(super) skew: f64,
}

impl Restoring {
    fn period(&self) -> usize {
        period(self.rate / self.frequency)
    }
}

/// Goes through a record once more, with its forces as they are or restored.
pub(super) enum Samples<'a> {
    Measured(Box<Again<'a>>),
    Restored(Box<Restored<'a>>),
}

impl<'a> Samples<'a> {
    /// With forces that follow the vibration, where it is said how.
    pub(super) fn new(again: Again<'a>, by: Option<Restoring>) -> Samples<'a> {
        match by {
            Some(by) => Samples::Restored(Box::new(Restored::new(again, by))),
            None => Samples::Measured(Box::new(again)),
        }
    }

    /// Fills a block with the next samples; whether there are any.
    pub(super) fn next(&mut self, block: &mut Block) -> Result<bool, Fault> {
        match self {
            Samples::Measured(again) => again.next(block),
            Samples::Restored(restored) => restored.next(block),
        }
    }

    /// The frequency at which forces are restored, Hz, where they are.
    pub(super) fn restored_from(&self) -> Option<f64> {
        match self {
            Samples::Measured(_) => None,
            Samples::Restored(restored) => Some(restored.by.frequency),
        }
    }

    /// Whether forces were restored that the sensors show as well, once all samples are read.
    pub(super) fn needless(&self) -> bool {
        matches!(self, Samples::Restored(restored) if restored.follow())
    }
}

/// A record whose forces are restored.
pub(super) struct Restored<'a> {
    again: Again<'a>,
    by: Restoring,
    /// Samples before and after, which those of a chunk need.
    around: usize,
    /// Samples as they were measured; the first that is not restored yet.
    raw: Block,
    from: usize,
    at_end: bool,
    /// Samples that were read last.
    read: Block,
    /// Squared deviations of `T`, measured and restored.
    swing: [f64; 2],
}

impl<'a> Restored<'a> {
    fn new(again: Again<'a>, by: Restoring) -> Restored<'a> {
        let period = by.period();
        let around = 2 * reach(period) + 3 * period + 8;
        Restored {
            again,
            by,
            around,
            raw: Block::default(),
            from: 0,
            at_end: false,
            read: Block::default(),
            swing: [0.0; 2],
        }
    }

    /// Whether the force sensors follow the vibration, so that nothing had to be restored.
    fn follow(&self) -> bool {
        let [measured, restored] = self.swing;
        measured > FOLLOWS * FOLLOWS * restored
    }

    /// Restores the next samples.
    fn next(&mut self, block: &mut Block) -> Result<bool, Fault> {
        let done = self.from.saturating_sub(self.around);
        self.raw.leave(done);
        self.from -= done;
        while !self.at_end && self.raw.len() < self.from + CHUNK + self.around {
            self.at_end = !self.again.next(&mut self.read)?;
            self.raw.append(&self.read, 0..self.read.len());
        }
        let end = if self.at_end { self.raw.len() } else { self.from + CHUNK };
        let [measured, restored] = self.forces();
        let own = self.from..end;
        block.clear();
        block.append(&self.raw, own.clone());
        let tangential = &self.raw.of(Channel::TangentialForce)[own.clone()];
        for ((raw, slow), fast) in
            tangential.iter().zip(&measured[0][own.clone()]).zip(&restored[0][own.clone()])
        {
            self.swing[0] += (raw - slow).powi(2);
            self.swing[1] += fast.powi(2);
        }
        for (channel, (slow, fast)) in FORCES.into_iter().zip(measured.iter().zip(&restored)) {
            let column = &mut block.columns_mut()[channel as usize];
            for ((force, slow), fast) in column.iter_mut().zip(&slow[own.clone()]).zip(&fast[own.clone()]) {
                *force = slow + fast;
            }
        }
        self.from = end;
        Ok(block.len() > 0)
    }

    /// `T` and `N` of all samples: what the sensors show, and what the rig adds to it.
    fn forces(&self) -> [[Vec<f64>; 2]; 2] {
        let (step, period) = (1.0 / self.by.rate, self.by.period());
        let of = |channel: Channel| self.raw.of(channel);
        let fast = |values: &[f64]| -> Vec<f64> {
            values.iter().zip(drift(values, period)).map(|(value, slow)| value - slow).collect()
        };
        let a = fast(of(Channel::TangentialAcceleration));
        let normal = fast(&earlier(of(Channel::NormalAcceleration), self.by.skew * self.by.rate));
        let mut sums = Vec::new();
        integral(&a, step, &mut sums);
        let v = fast(&sums);
        integral(&v, step, &mut sums);
        let x = fast(&sums);
        let mut restored = [Vec::with_capacity(a.len()), Vec::with_capacity(a.len())];
        for k in 0..a.len() {
            let forces = self.by.rig.forces([x[k], v[k], a[k]], normal[k]);
            restored.iter_mut().zip(forces).for_each(|(all, force)| all.push(force));
        }
        let measured = FORCES.map(|channel| drift(of(channel), period));
        [measured, restored]
    }
}

/// Values that are late by a number of samples, in time: by a cubic through four of them.
fn earlier(values: &[f64], late: f64) -> Vec<f64> {
    if late == 0.0 {
        return values.to_vec();
    }
    let last = values.len() as f64 - 1.0;
    let at = |k: f64| {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a sample of the record")]
        let place = k.clamp(0.0, last) as usize;
        values[place]
    };
    let whole = late.floor();
    let part = late - whole;
    let weights = [
        -part * (part - 1.0) * (part - 2.0) / 6.0,
        (part + 1.0) * (part - 1.0) * (part - 2.0) / 2.0,
        -(part + 1.0) * part * (part - 2.0) / 2.0,
        (part + 1.0) * part * (part - 1.0) / 6.0,
    ];
    let value = |k: usize| {
        let before = k as f64 + whole - 1.0;
        weights.iter().zip(0..).map(|(weight, n)| weight * at(before + f64::from(n))).sum()
    };
    (0..values.len()).map(value).collect()
}
