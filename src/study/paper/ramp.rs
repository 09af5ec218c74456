//! A ramp of the belt down to rest: accelerations and contact states, reduced to what a picture shows.

use crate::engine::outcome::Outcome;
use crate::model::Param;
use crate::model::contact::ContactState;
use crate::model::equilibrium::Units;
use crate::model::status::Status;
use crate::study::error::{Error, Result};
use crate::study::paper::Case;
use crate::study::trace::run::{TraceRow, trace};
use crate::sweep::spec::Spec;

/// Samples per period: the largest of them misses the crest of a sine by 0.05 %.
const SAMPLES: u32 = 100;
/// Columns of a picture of a short ramp: finer than a printed line over two columns of a journal.
const COLUMNS: f64 = 1200.0;
/// A ramp of more periods than this is shown as the envelope of its periods: single ones would not be seen.
const SHOWN_PERIODS: f64 = 60.0;
/// The ramp in parts of this much belt velocity, m/s: twelve periods each on a ramp of 10 s.
const PART: f64 = 0.25;

/// A stretch of the ramp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Its begin and end, s.
    pub time: [f64; 2],
    /// The belt velocity at both, m/s.
    pub velocity: [f64; 2],
    /// Lowest and highest tangential acceleration `ẍ2`, m/s².
    pub tangential: [f64; 2],
    /// Lowest and highest normal acceleration `ÿ1`, m/s².
    pub normal: [f64; 2],
    /// Fraction of its time in stick.
    pub stick: f64,
    /// Fraction of its time in free flight.
    pub free: f64,
}

impl Stretch {
    /// Time and belt velocity at both ends of stretch `k` of `count` equal ones of a ramp.
    pub(crate) fn place(duration: f64, velocity: [f64; 2], [k, count]: [usize; 2]) -> ([f64; 2], [f64; 2]) {
        let at = |k: usize| duration * k as f64 / count as f64;
        let belt = |t: f64| velocity[0] + (velocity[1] - velocity[0]) * t / duration;
        let time = [at(k), at(k + 1)];
        (time, time.map(belt))
    }

    /// The largest `|ẍ2|` and `|ÿ1|`, m/s².
    #[must_use]
    pub fn peaks(&self) -> [f64; 2] {
        [self.tangential, self.normal].map(|[low, high]| high.max(-low))
    }
}

/// One ramp, computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Ramp {
    /// The friction case.
    pub case: Case,
    /// Its duration, s.
    pub duration: f64,
    /// The displacement at its start, m.
    pub kick: f64,
    /// The observables of the whole ramp.
    pub outcome: Outcome,
    /// The ramp in stretches for pictures: of a period each, narrower where a ramp has few periods.
    pub columns: Vec<Stretch>,
    /// The ramp in stretches of 0.25 m/s.
    pub parts: Vec<Stretch>,
    /// The largest `|ÿ1|` of every cycle and the belt velocity at its end, m/s² and m/s.
    pub cycles: Vec<(f64, f64)>,
}

impl Ramp {
    /// Integrates the one instance of a sweep.
    ///
    /// # Errors
    /// When the integration ends before the ramp does.
    pub fn compute(case: Case, spec: &Spec) -> Result<Ramp> {
        let instance = spec.instance(0);
        let value = |param| instance.params.require(param);
        let [duration, kick] = [Param::RampDuration, Param::StartDisplacement].map(value);
        let velocity = [Param::BeltVelocity, Param::BeltVelocityEnd].map(value);
        let computed = trace(spec, &instance, SAMPLES);
        if computed.outcome.status != Status::Ok {
            let status = computed.outcome.status.name();
            return Err(Error::PaperRamp { case: case.words(), duration, kick, status });
        }
        let rows = &computed.rows;
        let periods = duration / Units::new(&instance.params).period();
        let columns = if periods > SHOWN_PERIODS { periods } else { COLUMNS };
        let parts = (velocity[0] - velocity[1]).abs() / PART;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive count")]
        let cut = |count: f64| {
            let count = count.round().max(1.0) as usize;
            let stretch = |k| {
                let (time, velocity) = Stretch::place(duration, velocity, [k, count]);
                Stretch { time, velocity, ..reduce(rows, time) }
            };
            (0..count).map(stretch).collect::<Vec<_>>()
        };
        let cycles = cycles(rows)
            .map(|(t, peak)| (peak, velocity[0] + (velocity[1] - velocity[0]) * t / duration))
            .collect();
        Ok(Ramp {
            case,
            duration,
            kick,
            outcome: computed.outcome,
            columns: cut(columns),
            parts: cut(parts),
            cycles,
        })
    }
}

/// The samples between two instants, with the last one before them, reduced to one stretch of the picture.
fn reduce(rows: &[TraceRow], [from, to]: [f64; 2]) -> Stretch {
    let first = rows.partition_point(|row| row.t <= from).saturating_sub(1);
    let last = rows.partition_point(|row| row.t <= to);
    let inside = &rows[first..last];
    let spread = |value: fn(&TraceRow) -> f64| {
        let values = inside.iter().map(value);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
    };
    // A sample stands for the time up to the next one.
    let share = |state: ContactState| {
        let time = |k: usize| {
            let end = rows.get(first + k + 1).map_or(to, |next| next.t.min(to));
            (end - inside[k].t.max(from)).max(0.0)
        };
        // Not a sum: that of nothing is −0.
        let all = (0..inside.len()).filter(|k| inside[*k].state == state).map(time).fold(0.0, |a, b| a + b);
        (all / (to - from)).clamp(0.0, 1.0)
    };
    Stretch {
        time: [from, to],
        velocity: [0.0; 2],
        tangential: spread(|row| row.acceleration[0]),
        normal: spread(|row| row.acceleration[2]),
        stick: share(ContactState::Stick),
        free: share(ContactState::Free),
    }
}

/// End and largest `|ÿ1|` of every cycle, between upward zero crossings of `ẋ2`.
fn cycles(rows: &[TraceRow]) -> impl Iterator<Item = (f64, f64)> {
    let upward = |k: &usize| rows[k - 1].velocity[0] <= 0.0 && rows[*k].velocity[0] > 0.0;
    let crossings: Vec<usize> = (1..rows.len()).filter(upward).collect();
    let peak = |part: &[TraceRow]| part.iter().map(|row| row.acceleration[2].abs()).fold(0.0, f64::max);
    let cycles: Vec<(f64, f64)> =
        crossings.windows(2).map(|pair| (rows[pair[1]].t, peak(&rows[pair[0]..pair[1]]))).collect();
    cycles.into_iter()
}
