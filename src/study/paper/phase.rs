//! The phase method on trial: does a threshold on the phase tell mode coupling from a negative slope?

use crate::engine::backend::Backend;
use crate::engine::options::Options;
use crate::engine::precision::Precision;
use crate::engine::record::Record;
use crate::engine::regime::Regime;
use crate::model::Param;
use crate::model::kind::InstabilityType;
use crate::study::error::Result;
use crate::study::paper::sweeps::PHASE;
use crate::sweep::run;

/// Where a phase is taken from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The eigenvector of the most unstable mode.
    Eigenvector,
    /// The growing vibration, up to its first event.
    Growth,
    /// The settled limit cycle, at its response frequency.
    Cycle,
}

impl Source {
    /// In the order of [`Witness::phases`].
    pub const ALL: [Source; 3] = [Source::Eigenvector, Source::Growth, Source::Cycle];

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Source::Eigenvector => "eigenvector",
            Source::Growth => "growing vibration",
            Source::Cycle => "limit cycle",
        }
    }
}

/// One instance of the trial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Witness {
    /// Belt velocity, m/s.
    pub velocity: f64,
    /// Friction coefficients at rest and from the knee on.
    pub friction: [f64; 2],
    /// The type of instability by the eigenvalues; `None` where nothing was computed.
    pub kind: Option<InstabilityType>,
    /// `|phase|` of `ÿ1` against `ẍ2` by every source, degrees; `None` where it is undefined, and for the limit cycle
    /// also where nothing vibrates or the vibration has not settled.
    pub phases: [Option<f64>; 3],
}

impl Witness {
    /// Whether the instability is mode coupling; `None` unless one mechanism alone makes it.
    #[must_use]
    pub fn couples(&self) -> Option<bool> {
        match self.kind? {
            InstabilityType::ModeCoupling => Some(true),
            InstabilityType::NegativeSlope => Some(false),
            _ => None,
        }
    }
}

/// How a threshold does, on the instances that one mechanism alone makes unstable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Score {
    /// Degrees; a larger phase is called mode coupling.
    pub threshold: f64,
    /// Share of mode coupling that is called so.
    pub coupling: f64,
    /// Share of negative slopes that are called so.
    pub slope: f64,
}

impl Score {
    /// The mean of both shares: one half for a verdict by chance, whatever the map holds most of.
    #[must_use]
    pub fn balanced(&self) -> f64 {
        0.5 * (self.coupling + self.slope)
    }
}

/// The trial.
#[derive(Clone, Debug, PartialEq)]
pub struct PhaseTrial {
    /// All instances, in the order of the shipped sweep.
    pub witnesses: Vec<Witness>,
}

/// The threshold between in phase and in quadrature that suggests itself, degrees.
pub const CUSTOMARY: f64 = 45.0;

/// Steps of the threshold, degrees.
const STEP: f64 = 0.5;
/// The largest threshold, degrees.
const LARGEST: f64 = 90.0;

impl PhaseTrial {
    /// Computes the shipped sweep.
    ///
    /// # Errors
    /// When it cannot be computed at all.
    pub fn compute() -> Result<PhaseTrial> {
        let options =
            Options { backend: Backend::Cpu, precision: Some(Precision::F64), ..Options::default() };
        let mut spec = PHASE.spec();
        spec.analysis.checked = false;
        let map = run::run(spec, &options, &|_| ())?;
        let witness = |(index, record): (usize, &Record)| {
            let params = map.spec.instance(index).params;
            let value = |param| params.require(param);
            Witness {
                velocity: value(Param::BeltVelocity),
                friction: [Param::MuS, Param::MuD].map(value),
                kind: record.kind,
                phases: phases(record),
            }
        };
        Ok(PhaseTrial { witnesses: map.records.iter().enumerate().map(witness).collect() })
    }

    /// The instances that the paper considers: friction does not rise with the velocity, `μ_s ≥ μ_d`.
    #[must_use]
    pub fn falling(&self) -> PhaseTrial {
        let falls = |witness: &&Witness| witness.friction[0] >= witness.friction[1];
        PhaseTrial { witnesses: self.witnesses.iter().filter(falls).copied().collect() }
    }

    /// How a threshold does; `None` when the trial lacks one of the mechanisms.
    #[must_use]
    pub fn score(&self, source: Source, threshold: f64) -> Option<Score> {
        let mut counts = [[0_u32; 2]; 2];
        for witness in &self.witnesses {
            if let (Some(couples), Some(phase)) = (witness.couples(), witness.phases[source as usize]) {
                counts[usize::from(couples)][usize::from((phase >= threshold) == couples)] += 1;
            }
        }
        let share = |[wrong, right]: [u32; 2]| {
            (wrong + right > 0).then(|| f64::from(right) / f64::from(wrong + right))
        };
        Some(Score { threshold, coupling: share(counts[1])?, slope: share(counts[0])? })
    }

    /// Thresholds from 0° to 90°.
    #[must_use]
    pub fn scores(&self, source: Source) -> Vec<Score> {
        let steps = (0..).map(|k| f64::from(k) * STEP).take_while(|threshold| *threshold <= LARGEST);
        steps.filter_map(|threshold| self.score(source, threshold)).collect()
    }

    /// The threshold with the best balanced share, the middle of several that are equally good.
    #[must_use]
    pub fn best(&self, source: Source) -> Option<Score> {
        let scores = self.scores(source);
        let most = scores.iter().map(Score::balanced).fold(0.0, f64::max);
        let best: Vec<&Score> = scores.iter().filter(|score| score.balanced() >= most).collect();
        best.get(best.len() / 2).map(|score| **score)
    }

    /// The 5th, 50th and 95th percentile of a source's phase over the instances of a type, and their number.
    #[must_use]
    pub fn spread(&self, source: Source, kind: InstabilityType) -> Option<([f64; 3], usize)> {
        let of_kind = self.witnesses.iter().filter(|witness| witness.kind == Some(kind));
        let mut phases: Vec<f64> = of_kind.filter_map(|witness| witness.phases[source as usize]).collect();
        phases.sort_by(f64::total_cmp);
        let last = phases.len().checked_sub(1)?;
        let at = |percent: usize| phases[(last * percent + 50) / 100];
        Some(([at(5), at(50), at(95)], phases.len()))
    }
}

/// The magnitudes of a record's phases.
fn phases(record: &Record) -> [Option<f64>; 3] {
    let of_mode = record.linear.and_then(|linear| linear.phase);
    let outcome = record.outcome.as_ref();
    let vibrates = !matches!(record.regime, None | Some(Regime::Equilibrium | Regime::Stuck));
    let settled = vibrates && record.settled == Some(true);
    let growth = outcome.and_then(|outcome| outcome.phase_measured);
    let cycle = outcome.filter(|_| settled).and_then(|outcome| outcome.phase_cycle);
    [of_mode, growth, cycle].map(|phase| phase.map(f64::abs))
}
