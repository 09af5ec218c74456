//! How the velocity of the belt goes over a run: straight between corners.

use std::f64::consts::PI;
use std::ops::Deref;
use std::sync::Arc;

use smallvec::{SmallVec, smallvec};

use crate::model::{Param, Params};

/// Straight parts of half a sine wave: off by at most 3e-4 of the largest velocity.
const SINE_PARTS: usize = 64;

/// How the velocity of the belt goes over a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Motion {
    /// From `belt_velocity` to `belt_velocity_end` within `ramp_duration`; without them constant.
    #[default]
    Ramp,
    /// From rest to `belt_velocity` and back to rest within `ramp_duration`, as half a sine wave: the stroke of a crank.
    Sine,
    /// From rest to `belt_velocity` within `rise_duration`, back to rest within another at the end of `ramp_duration`.
    Trapeze,
    /// As a table has it.
    Table(Arc<MotionTable>),
}

/// The velocity of the belt over time as a file has it, perhaps with the temperature; after its last row they stay.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionTable {
    /// Its file, as the sweep names it.
    pub name: String,
    /// Corners: time (s), rising from 0, and velocity (m/s), not below 0.
    pub corners: Arc<[[f64; 2]]>,
    /// The same with temperatures of a material (°C), where the file has them.
    pub temperature: Option<Arc<[[f64; 2]]>>,
}

/// Corners of a motion: time (s) and velocity (m/s).
#[derive(Clone, Debug)]
pub enum Corners {
    /// Those of one instance.
    Own(SmallVec<[[f64; 2]; 2]>),
    /// Those of a table, the same for all.
    Shared(Arc<[[f64; 2]]>),
}

impl Deref for Corners {
    type Target = [[f64; 2]];

    fn deref(&self) -> &[[f64; 2]] {
        match self {
            Corners::Own(corners) => corners,
            Corners::Shared(corners) => corners,
        }
    }
}

impl MotionTable {
    /// The largest velocity, m/s.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.corners.iter().map(|corner| corner[1]).fold(0.0, f64::max)
    }
}

impl Motion {
    /// The name of a ramp.
    pub const RAMP: &'static str = "ramp";

    /// The names of all motions.
    pub const NAMES: [&'static str; 4] = [Motion::RAMP, "sine", "trapeze", "table"];

    /// The motion of a name; a table is that table, or where there is none the default.
    #[must_use]
    pub fn named(name: &str, table: Option<Arc<MotionTable>>) -> Motion {
        match name {
            "sine" => Motion::Sine,
            "trapeze" => Motion::Trapeze,
            "table" => table.map_or(Motion::Ramp, Motion::Table),
            _ => Motion::Ramp,
        }
    }

    /// Its name in a sweep file.
    #[must_use]
    pub fn name(&self) -> &'static str {
        let index = match self {
            Motion::Ramp => 0,
            Motion::Sine => 1,
            Motion::Trapeze => 2,
            Motion::Table(_) => 3,
        };
        Motion::NAMES[index]
    }

    /// What changes the velocity of the belt of these parameters within a run, in words; `None` where it is of one velocity.
    #[must_use]
    pub fn moves(&self, params: &Params) -> Option<String> {
        match self {
            Motion::Ramp => params
                .get(Param::RampDuration)
                .map(|seconds| format!("a ramp, `ramp_duration` = {seconds} s")),
            other => Some(format!("the motion `{}`", other.name())),
        }
    }

    /// Whether the belt of these parameters is of one velocity.
    #[must_use]
    pub fn is_steady(&self, params: &Params) -> bool {
        *self == Motion::Ramp && params.get(Param::RampDuration).is_none()
    }

    /// Its corners. After the last the velocity is constant.
    #[must_use]
    pub fn corners(&self, params: &Params) -> Corners {
        let velocity = params.require(Param::BeltVelocity);
        let duration = params.get(Param::RampDuration);
        Corners::Own(match (self, duration) {
            (Motion::Table(table), _) => return Corners::Shared(table.corners.clone()),
            (_, None) => smallvec![[0.0, velocity]],
            (Motion::Ramp, Some(duration)) => {
                let end = params.get(Param::BeltVelocityEnd).unwrap_or(velocity);
                smallvec![[0.0, velocity], [duration, end]]
            }
            (Motion::Sine, Some(duration)) => (0..=SINE_PARTS)
                .map(|part| {
                    let share = part as f64 / SINE_PARTS as f64;
                    // The sine of π is not 0 in f64.
                    let height = if part == SINE_PARTS { 0.0 } else { (PI * share).sin() };
                    [share * duration, height * velocity]
                })
                .collect(),
            (Motion::Trapeze, Some(duration)) => {
                let rise = params.get(Param::RiseDuration).unwrap_or(0.0).min(0.5 * duration);
                let all = [[0.0, 0.0], [rise, velocity], [duration - rise, velocity], [duration, 0.0]];
                // A triangle has no plateau.
                let is_apart = |at: &usize| *at == 0 || all[*at][0] > all[at - 1][0];
                (0..all.len()).filter(is_apart).map(|at| all[at]).collect()
            }
        })
    }

    /// The temperature (°C) over time that comes with it, if any.
    #[must_use]
    pub fn temperature(&self) -> Option<&Arc<[[f64; 2]]>> {
        let Motion::Table(table) = self else { return None };
        table.temperature.as_ref()
    }

    /// The velocity of the belt at the time `time` (s), m/s.
    #[must_use]
    pub fn velocity(&self, params: &Params, time: f64) -> f64 {
        straight(&self.corners(params), time)
    }
}

/// The value at the time `time` of what is straight between corners of time and value, and stays after the last.
pub(super) fn straight(corners: &[[f64; 2]], time: f64) -> f64 {
    let after = corners.partition_point(|corner| corner[0] <= time);
    match (after.checked_sub(1), corners.get(after)) {
        (Some(before), Some([end, last])) => {
            let [start, first] = corners[before];
            first + (last - first) * ((time - start) / (end - start))
        }
        (before, _) => corners[before.unwrap_or(0)][1],
    }
}
