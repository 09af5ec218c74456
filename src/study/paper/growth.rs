//! Figure 7: both accelerations while a vibration grows on the ramp, and the phase between them.

use num_complex::Complex64;

use crate::model::contact::ContactState;
use crate::model::equilibrium::Units;
use crate::model::instance::Instance;
use crate::model::linear::analyse;
use crate::model::status::Status;
use crate::model::{Param, Params};
use crate::study::error::{Error, Result};
use crate::study::paper::LIMITS;
use crate::study::paper::accelerations::disturbance;
use crate::study::paper::sweeps::{FIGURE_7A, FIGURE_7B};
use crate::study::trace::run::{TraceRow, trace};
use crate::sweep::spec::Spec;

/// Samples per period.
const SAMPLES: u32 = 40;
/// Cycles of a window. The transform of a Hann window of so many has its first zeros two lines off: what the negative
/// frequency adds is nothing, and growth within the window is the same for both signals.
const CYCLES: usize = 4;
/// Periods that are shown of a ramp on which nothing has grown.
const SHOWN_PERIODS: f64 = 60.0;

/// A friction case of the paper's study of the phase.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PhaseCase {
    /// Figure 7a.
    NegativeSlope,
    /// Figure 7b.
    ModeCoupling,
}

impl PhaseCase {
    /// Both, in the order of the figure.
    pub const ALL: [PhaseCase; 2] = [PhaseCase::NegativeSlope, PhaseCase::ModeCoupling];

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            PhaseCase::NegativeSlope => "negative slope",
            PhaseCase::ModeCoupling => "mode coupling",
        }
    }

    /// The sweep as shipped.
    #[must_use]
    pub fn sweep(self) -> Spec {
        match self {
            PhaseCase::NegativeSlope => FIGURE_7A.spec(),
            PhaseCase::ModeCoupling => FIGURE_7B.spec(),
        }
    }
}

/// A few cycles of the growing vibration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Its begin and end, s.
    pub time: [f64; 2],
    /// The belt velocity in its middle, m/s.
    pub velocity: f64,
    /// Size of `ẍ2` at the frequency of the cycles, m/s².
    pub amplitude: f64,
    /// Phase of `ÿ1` against `ẍ2` at that frequency, degrees in (−180, 180].
    pub measured: f64,
    /// Phase of `ÿ1` against `ẍ2` in the most unstable eigenvector for this belt velocity, degrees in (−180, 180]; `None`
    /// where there is no such eigenvector.
    pub eigenvector: Option<f64>,
}

/// A vibration that grows on a ramp.
#[derive(Clone, Debug)]
pub struct Growth {
    /// The friction case.
    pub case: PhaseCase,
    /// The instance at the begin of the ramp.
    pub instance: Instance,
    /// The windows, each a cycle after the one before, from where the vibration has grown to where the first event of the
    /// contact ends it; empty where it does not come so far.
    pub windows: Vec<Window>,
    /// Time (s), belt velocity (m/s), `ẍ2` and `ÿ1` (m/s²) of what the windows cover, else of the last periods.
    pub samples: Vec<[f64; 4]>,
}

impl Growth {
    /// Computes a case from its sweep, a ramp.
    ///
    /// # Errors
    /// When the integration ends before the ramp does.
    pub fn compute(case: PhaseCase, spec: &Spec) -> Result<Growth> {
        let instance = spec.instance(0);
        let computed = trace(spec, &instance, SAMPLES);
        if computed.outcome.status != Status::Ok {
            let [duration, kick] =
                [Param::RampDuration, Param::StartDisplacement].map(|param| instance.params.require(param));
            let status = computed.outcome.status.name();
            return Err(Error::PaperRamp { case: case.words(), duration, kick, status });
        }
        // Crossings of the knee are a part of the growth; stick, reversed slip and flight end it.
        let slides = |row: &TraceRow| row.state == ContactState::Slip;
        let end = computed.rows.iter().position(|row| !slides(row)).unwrap_or(computed.rows.len());
        let rows = &computed.rows[..end];
        let grown = LIMITS.growth * disturbance(&instance.params);
        let windows: Vec<Window> = windows(rows, &instance).collect();
        let begin = windows.iter().rposition(|window| window.amplitude < grown).map_or(0, |last| last + 1);
        let windows = windows[begin..].to_vec();
        let last = rows.last().map_or(0.0, |row| row.t);
        let shown = SHOWN_PERIODS * Units::new(&instance.params).period();
        let from = windows.first().map_or(last - shown, |window| window.time[0]);
        let sample =
            |row: &TraceRow| [row.t, belt(&instance.params, row.t), row.acceleration[0], row.acceleration[2]];
        let samples = rows.iter().filter(|row| row.t >= from).map(sample).collect();
        Ok(Growth { case, instance, windows, samples })
    }

    /// `μ_s` and `μ_d`.
    #[must_use]
    pub fn friction(&self) -> [f64; 2] {
        [Param::MuS, Param::MuD].map(|param| self.instance.params.require(param))
    }
}

/// The belt velocity at a time of a ramp, m/s.
fn belt(params: &Params, t: f64) -> f64 {
    let [from, to, duration] =
        [Param::BeltVelocity, Param::BeltVelocityEnd, Param::RampDuration].map(|param| params.require(param));
    from + (to - from) * (t / duration).min(1.0)
}

/// Every window of [`CYCLES`] cycles, from one upward zero crossing of `ẋ2` to another.
fn windows<'a>(rows: &'a [TraceRow], instance: &'a Instance) -> impl Iterator<Item = Window> + 'a {
    let upward = |k: &usize| rows[*k - 1].velocity[0] <= 0.0 && rows[*k].velocity[0] > 0.0;
    let crossings: Vec<usize> = (1..rows.len()).filter(upward).collect();
    let ends: Vec<[usize; 2]> = crossings.windows(CYCLES + 1).map(|span| [span[0], span[CYCLES]]).collect();
    ends.into_iter().map(move |[first, last]| {
        let inside = &rows[first..=last];
        let time = [rows[first].t, rows[last].t];
        let [tangential, normal] = [0, 2].map(|k| line(inside, time, |row| row.acceleration[k]));
        let velocity = belt(&instance.params, 0.5 * (time[0] + time[1]));
        let mut frozen = instance.clone();
        frozen.params.set(Param::BeltVelocity, velocity);
        Window {
            time,
            velocity,
            amplitude: tangential.norm(),
            measured: (normal / tangential).arg().to_degrees(),
            eigenvector: analyse(&frozen).1.and_then(|linear| linear.phase),
        }
    })
}

/// The component of a signal at the frequency of the cycles, under a Hann window; its mean is off.
fn line(rows: &[TraceRow], [from, to]: [f64; 2], signal: impl Fn(&TraceRow) -> f64) -> Complex64 {
    let hann = |row: &TraceRow| 1.0 - (std::f64::consts::TAU * (row.t - from) / (to - from)).cos();
    // Samples are not equidistant: events have some of their own.
    let integral = |value: &dyn Fn(&TraceRow) -> Complex64| {
        let trapeze = |pair: &[TraceRow]| 0.5 * (pair[1].t - pair[0].t) * (value(&pair[0]) + value(&pair[1]));
        rows.windows(2).map(trapeze).sum::<Complex64>() / (to - from)
    };
    let mean = integral(&|row| (hann(row) * signal(row)).into()).re;
    let omega = std::f64::consts::TAU * CYCLES as f64 / (to - from);
    let turned = |row: &TraceRow| Complex64::from_polar(1.0, -omega * (row.t - from));
    2.0 * integral(&|row| hann(row) * (signal(row) - mean) * turned(row))
}
