//! The largest accelerations of the three ramps for other durations and kicks than the default.

use rayon::prelude::*;

use crate::engine::reference::records::record;
use crate::model::equilibrium::Units;
use crate::model::{Param, Params};
use crate::study::paper::sweeps::{ACCELERATIONS, Case};
use crate::sweep::grid::{AxisKey, Value};

/// The three ramps of one duration and kick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// Duration of the ramps, s.
    pub duration: f64,
    /// Displacement at their start, m.
    pub kick: f64,
    /// The disturbance of the equilibrium, m/s²: the acceleration of the belt or that of a free oscillation with the
    /// displacement of the kick, `ω0² x`, whichever is larger.
    pub disturbance: f64,
    /// Largest `|ẍ2|` and `|ÿ1|` of each case, in the order of [`Case::ALL`], m/s²; `None` for a ramp that failed.
    pub peaks: [Option<[f64; 2]>; 3],
}

impl Trial {
    /// The peaks of all cases, when each was computed.
    #[must_use]
    pub fn complete(&self) -> Option<[[f64; 2]; 3]> {
        let [a, b, c] = self.peaks;
        Some([a?, b?, c?])
    }

    /// Coexistence over the larger of the single mechanisms: of the largest `|ẍ2|` and of the largest `|ÿ1|`.
    #[must_use]
    pub fn coexistence(&self) -> Option<[f64; 2]> {
        let [slope, coupling, both] = self.complete()?;
        Some([0, 1].map(|k| both[k] / slope[k].max(coupling[k])))
    }

    /// The largest `|ẍ2|` under a negative slope over that under mode coupling.
    #[must_use]
    pub fn slope_over_coupling(&self) -> Option<f64> {
        let [slope, coupling, _] = self.complete()?;
        Some(slope[0] / coupling[0])
    }
}

/// All trials: the durations vary slowest.
pub(super) fn trials() -> Vec<Trial> {
    let spec = ACCELERATIONS.spec();
    let friction = Case::ALL.map(|case| friction(&case.ramp().base));
    let keys = spec.grid.keys();
    // What the product of the axes has beside the three cases is not computed.
    let wanted: Vec<(usize, usize, Params)> = (0..spec.grid.len())
        .filter_map(|index| {
            let mut params = spec.base;
            for (key, value) in keys.iter().zip(spec.grid.coordinates(index)) {
                if let (AxisKey::Param(param), Value::Number(number)) = (key, value) {
                    params.set(*param, *number);
                }
            }
            let case = friction.iter().position(|case| *case == self::friction(&params))?;
            Some((index, case, params))
        })
        .collect();
    let computed: Vec<Option<[f64; 2]>> = wanted
        .par_iter()
        .map(|(index, ..)| {
            let outcome = record(&spec, *index).outcome?;
            Some([outcome.ax_peak?, outcome.ay_peak?])
        })
        .collect();
    let mut trials: Vec<Trial> = Vec::new();
    for ((_, case, params), peaks) in wanted.into_iter().zip(computed) {
        let [duration, kick] =
            [Param::RampDuration, Param::StartDisplacement].map(|param| params.require(param));
        let bits = |pair: [f64; 2]| pair.map(f64::to_bits);
        let same = |trial: &Trial| bits([trial.duration, trial.kick]) == bits([duration, kick]);
        if !trials.last().is_some_and(same) {
            let disturbance = disturbance(&params);
            trials.push(Trial { duration, kick, disturbance, peaks: [None; 3] });
        }
        if let Some(trial) = trials.last_mut() {
            trial.peaks[case] = peaks;
        }
    }
    trials
}

/// The disturbance of the equilibrium by a ramp with these parameters, see [`Trial::disturbance`].
pub(super) fn disturbance(params: &Params) -> f64 {
    let value = |param| params.require(param);
    let kick = value(Param::StartDisplacement) / Units::new(params).time.powi(2);
    let belt = (value(Param::BeltVelocity) - value(Param::BeltVelocityEnd)) / value(Param::RampDuration);
    kick.max(belt.abs())
}

/// The friction coefficients, which tell the cases apart.
fn friction(params: &Params) -> [Option<f64>; 2] {
    [Param::MuS, Param::MuD].map(|param| params.get(param))
}
