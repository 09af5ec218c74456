//! The settings of an analysis.

use crate::channel::{Channel, PerChannel};
use crate::cross::Measured;
use crate::rig::Rig;
use crate::unit::TimeUnit;

/// Window of the spectrogram, s: that of the source paper.
pub const WINDOW: f64 = 0.01;

/// Overlap of the windows of the spectrogram: that of the source paper.
pub const OVERLAP: f64 = 0.98;

/// Largest damping ratio that the structure may have when nothing is known about it. Whether the slope, or
/// mode coupling, *alone* would destabilise depends on the damping, which a growing oscillation does not show. Lightly
/// damped discs ring with less (Table 1 of the source paper: 0.01 %); assemblies may have more, which an impact test
/// shows.
pub const DAMPING_RATIO: f64 = 0.002;

/// Largest inclination of the structure to the contact when nothing is known about it, rad: twice that of Table 1 of the source
/// paper. It couples the two directions beside friction, without any power, by `tan θ/μ` of what friction does.
pub const INCLINATION: f64 = 0.02;

/// Friction coefficients above this do not occur in brakes: the force columns are swapped.
pub const LARGEST_FRICTION: f64 = 1.0;

/// The choices of an analysis.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The column of time; `None` for `t` or `time`, with a unit or without, where the file has it.
    pub time: Option<String>,
    /// The unit of time; `None` for that of the header, or else seconds. Where no sensor is so slow or so fast, seconds are
    /// asked about.
    pub time_unit: Option<TimeUnit>,
    /// Samples per second (Hz); where the file has a column of time, that must not contradict it.
    pub rate: Option<f64>,
    /// The columns in the order of [`Channel::ALL`]; `None` for the default name, if the file has it.
    pub columns: [Option<String>; Channel::ALL.len()],
    /// The rows that are analysed: how many before them are left out, and how many they are; `None` for all. See
    /// [`crate::strokes`].
    pub rows: Option<[u64; 2]>,
    /// Whether they are a stroke that goes the other way; a recorded velocity says that by itself.
    pub back: bool,
    /// Delay of the normal acceleration behind the tangential one, s, which is taken out; at most one period.
    pub skew: f64,
    /// Delay of the forces behind the tangential acceleration, s, which is taken out; at most one period.
    pub force_skew: f64,
    /// Largest damping ratio of the structure without friction; of a rig, its own, or more where that is possible.
    pub damping_ratio: f64,
    /// Largest inclination of the structure to the contact, rad.
    pub inclination: f64,
    /// Frequencies in which to look for the oscillation, Hz; `None` for all.
    pub band: Option<[f64; 2]>,
    /// Window of the spectrogram, s.
    pub window: f64,
    /// Overlap of its windows, below 1.
    pub overlap: f64,
    /// Largest friction coefficient that is believed.
    pub largest_friction: f64,
    /// Instants at which the figure looks close, s; without any, in the middles of the longest segments that vibrate.
    pub zooms: Vec<f64>,
    /// The friction coefficient at which the modes of the structure coalesce, and its standard error.
    pub critical_friction: Option<Measured>,
    /// The structure, where it is known: forces at the frequency of the vibration are then those that move it, in place of what slow
    /// sensors show; and its coalescence counts where [`Settings::critical_friction`] is none.
    pub rig: Option<Rig>,
}

impl Settings {
    /// The rates (1/s) with which both directions of the structure may die out without friction: those of a known rig, or all up to the
    /// bound, also where that is above the damping ratio of the rig.
    pub(super) fn decays(&self, omega: f64) -> [[f64; 3]; 2] {
        match self.rig.filter(|rig| self.damping_ratio <= rig.damping_ratio()) {
            Some(rig) => rig.decays(),
            None => [[0.0, 0.5, 1.0].map(|part| part * self.damping_ratio * omega); 2],
        }
    }

    /// What holds for a stroke that goes forwards, or the other way (`turned`).
    pub(super) fn directed(&self, turned: bool) -> Settings {
        let rig = self.rig.map(|rig| if turned { rig.turned() } else { rig });
        Settings {
            critical_friction: self.critical_friction.or(rig.map(|rig| rig.critical[0])),
            // What is restored from the accelerations is not late.
            force_skew: if rig.is_some() { 0.0 } else { self.force_skew },
            rig,
            ..self.clone()
        }
    }
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            time: None,
            time_unit: None,
            rate: None,
            columns: PerChannel::default(),
            rows: None,
            back: false,
            skew: 0.0,
            force_skew: 0.0,
            damping_ratio: DAMPING_RATIO,
            inclination: INCLINATION,
            band: None,
            window: WINDOW,
            overlap: OVERLAP,
            largest_friction: LARGEST_FRICTION,
            zooms: Vec::new(),
            critical_friction: None,
            rig: None,
        }
    }
}
