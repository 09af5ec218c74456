//! The numbers on which the claims are decided, and nothing else.

use std::f64::consts::TAU;

use crate::model::instance::Instance;
use crate::model::{Param, linear};
use crate::study::error::Result;
use crate::study::modes::follow::modes_of;
use crate::study::paper::accelerations::disturbance;
use crate::study::paper::{Case, LIMITS, PhaseCase, PhaseTrial, Stretch, Study, Trial, Window};
use crate::sweep::grid::{Axis, AxisKey, Grid, Value};
use crate::sweep::spec::Spec;

/// Belt velocity, m/s, below which the size of the limit cycle is no longer in proportion to it: the belt comes to rest.
pub(super) const SLOWEST: f64 = 1.0;

/// The numbers of a ramp that claims are decided by.
#[derive(Clone, Debug, PartialEq)]
pub struct RampFacts {
    /// Duration, s.
    pub duration: f64,
    /// Displacement at the start, m.
    pub kick: f64,
    /// The disturbance of the equilibrium, m/s², see [`Trial::disturbance`].
    pub disturbance: f64,
    /// Root mean square of `ẍ2` over the ramp, m/s².
    pub ax_rms: f64,
    /// The ramp in stretches of 0.25 m/s, from the fastest on.
    pub parts: Vec<Stretch>,
}

impl RampFacts {
    /// The largest `|ẍ2|` and `|ÿ1|`, m/s².
    #[must_use]
    pub fn peaks(&self) -> [f64; 2] {
        let of = |k: usize| self.parts.iter().map(|part| part.peaks()[k]).fold(0.0, f64::max);
        [of(0), of(1)]
    }

    /// Whether the vibration has grown: see [`Limits::growth`](crate::study::paper::Limits::growth).
    #[must_use]
    pub fn grown(&self) -> bool {
        self.largest().1 >= LIMITS.growth * self.disturbance
    }

    /// The position and value of the largest `|ẍ2|` among the parts.
    #[must_use]
    pub fn largest(&self) -> (usize, f64) {
        let peaks = self.parts.iter().map(|part| part.peaks()[0]).enumerate();
        peaks.fold((0, 0.0), |best, one| if one.1 > best.1 { one } else { best })
    }
}

/// The results that speak for or against the paper's claims.
#[derive(Clone, Debug, PartialEq)]
pub struct Evidence {
    /// Where the growth rate of the constant law changes sign.
    pub critical_friction: Option<f64>,
    /// The frequency of the less stable mode there, Hz.
    pub coalescence_frequency: Option<f64>,
    /// The belt velocity below which the sliding equilibrium of Figure 4 is unstable, m/s.
    pub critical_velocity: Option<f64>,
    /// The knee of its friction law, m/s.
    pub knee_velocity: f64,
    /// The ramps of Figures 4, 5 and 6.
    pub ramps: [RampFacts; 3],
    /// By how much `|ÿ1|` swells and fades in the limit cycle of Figure 4. The peak of each cycle is divided by the belt
    /// velocity, with which the limit cycle shrinks; this is half the range of these numbers over the mean of their two
    /// ends.
    pub swell: Option<f64>,
    /// The windows of Figures 7a and 7b.
    pub phases: [Vec<Window>; 2],
    /// Other ramps and kicks.
    pub trials: Vec<Trial>,
    /// The phase method on trial.
    pub phase_trial: PhaseTrial,
}

/// The frequency (Hz) at which both modes of an instance are one.
fn coalesced(at: &Instance) -> Option<f64> {
    let all = linear::eigenvalues(at)?;
    Some(all.iter().map(|lambda| lambda.im.abs()).sum::<f64>() / all.len() as f64 / TAU)
}

impl Evidence {
    /// Computes everything that is not there yet.
    ///
    /// # Errors
    /// When a ramp ends early.
    pub fn gather(study: &Study) -> Result<Evidence> {
        let (spec, modes) = study.modes()?;
        let critical_friction = modes.branches.first().and_then(|branch| branch.critical.first().copied());
        let at = critical_friction.map(|mu| spec.instance_at(&format!("mu_d={mu}"))).transpose()?;
        let coalescence_frequency = at.and_then(|at| coalesced(&at));
        let falling = study.sweep(Case::NegativeSlope);
        let critical_velocity = critical_velocity(&falling)?;
        let [slope, coupling, both] = Case::ALL.map(|case| facts(study, case));
        let [first, second] =
            PhaseCase::ALL.map(|case| study.growth(case).map(|growth| growth.windows.clone()));
        let slope = slope?;
        let swell = swell(&slope, &study.ramp(Case::NegativeSlope)?.cycles);
        Ok(Evidence {
            critical_friction,
            coalescence_frequency,
            critical_velocity,
            knee_velocity: falling.base.require(Param::KneeVelocity),
            ramps: [slope, coupling?, both?],
            swell,
            phases: [first?, second?],
            trials: study.trials().to_vec(),
            phase_trial: study.phase_trial()?.clone(),
        })
    }
}

fn facts(study: &Study, case: Case) -> Result<RampFacts> {
    let ramp = study.ramp(case)?;
    Ok(RampFacts {
        duration: ramp.duration,
        kick: ramp.kick,
        disturbance: disturbance(&study.sweep(case).base),
        ax_rms: ramp.outcome.ax_rms.unwrap_or(f64::NAN),
        parts: ramp.parts.clone(),
    })
}

/// The largest belt velocity at which the growth rate of a sweep's law changes sign.
fn critical_velocity(spec: &Spec) -> Result<Option<f64>> {
    /// Velocities in which a change of sign is looked for, m/s: every 0.05 up to that of the ramp.
    const STEPS: u32 = 140;
    let fastest = spec.base.require(Param::BeltVelocity);
    let values = (1..=STEPS).map(|k| Value::Number(fastest * f64::from(k) / f64::from(STEPS))).collect();
    let axis = Axis { key: AxisKey::Param(Param::BeltVelocity), values, log: false };
    let spec = Spec { grid: Grid::Axes(vec![axis]), ..spec.clone() };
    let modes = modes_of(&spec)?;
    Ok(modes.branches.first().and_then(|branch| branch.critical.last().copied()))
}

/// Half the range of the cycles' peaks over the belt velocity, over the mean of its ends; in the limit cycle, which
/// lasts from the largest `|ẍ2|` on.
fn swell(ramp: &RampFacts, cycles: &[(f64, f64)]) -> Option<f64> {
    let (top, _) = ramp.largest();
    let begin = ramp.parts.get(top)?.velocity[1];
    let inside = cycles.iter().filter(|(_, velocity)| (SLOWEST..=begin).contains(velocity));
    let relative = inside.map(|(peak, velocity)| peak / velocity);
    let (low, high) = relative.fold((f64::MAX, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
    (high > 0.0).then(|| (high - low) / (high + low))
}
