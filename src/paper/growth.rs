//! Figure 7: both accelerations while one mode grows, up to its first event.

use crate::error::{Error, Result};
use crate::linear::{Linear, analyse};
use crate::model::Param;
use crate::paper::sweeps::{FIGURE_7A, FIGURE_7B};
use crate::spec::{Instance, Spec};
use crate::trace::trace;

/// Samples per period.
const SAMPLES: u32 = 40;

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

/// Phase of `ÿ1` against `ẍ2` and growth rate, once from the eigenvector and once from the signals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    /// From the eigenvector, degrees.
    pub eigenvector: f64,
    /// From the signals before the first event, degrees.
    pub measured: f64,
    /// Largest real part of the eigenvalues, 1/s.
    pub growth_rate: f64,
    /// The growth rate of the signals before the first event, 1/s.
    pub growth_rate_measured: f64,
}

/// One growing oscillation.
#[derive(Clone, Debug)]
pub struct Growth {
    /// The friction case.
    pub case: PhaseCase,
    /// The instance.
    pub instance: Instance,
    /// Its eigenvalue analysis.
    pub linear: Linear,
    /// The phases.
    pub phase: Phase,
    /// Time (s), `ẍ2` and `ÿ1` (m/s²) up to the first event.
    pub samples: Vec<[f64; 3]>,
}

impl Growth {
    /// Computes a case.
    ///
    /// # Errors
    /// When nothing grows, which the shipped sweeps exclude.
    pub fn compute(case: PhaseCase) -> Result<Growth> {
        let spec = case.sweep();
        let instance = spec.instance(0);
        let computed = trace(&spec, &instance, SAMPLES);
        let (outcome, rows) = (&computed.outcome, &computed.rows);
        let linear = analyse(&instance).1;
        let phase = linear.and_then(|linear| {
            Some(Phase {
                eigenvector: linear.phase?,
                measured: outcome.phase_measured?,
                growth_rate: linear.growth_rate,
                growth_rate_measured: outcome.growth_rate_measured?,
            })
        });
        let (Some(linear), Some(phase)) = (linear, phase) else {
            return Err(Error::PaperGrowth { case: case.words(), status: outcome.status.name() });
        };
        // At an event there are two samples of one instant.
        let event = rows.windows(2).position(|pair| pair[0].t >= pair[1].t);
        let samples = rows[..event.map_or(rows.len(), |event| event + 1)]
            .iter()
            .map(|row| [row.t, row.acceleration[0], row.acceleration[2]])
            .collect();
        Ok(Growth { case, instance, linear, phase, samples })
    }

    /// `μ_s` and `μ_d`.
    #[must_use]
    pub fn friction(&self) -> [f64; 2] {
        [Param::MuS, Param::MuD].map(|param| self.instance.params.require(param))
    }
}
