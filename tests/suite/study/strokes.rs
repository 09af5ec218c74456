//! Synthetic strokes: instances of the model as sensors record them, with noise and skew, all from one seed.
//!
//! Table 1 of the paper with time compressed so that it squeals at 8 to 15 kHz (masses divided, stiffnesses multiplied
//! by the same factor: every dimensionless group and every velocity stays). Type and phase are known from the
//! eigenvalues; the analysis sees the file only.

use std::f64::consts::TAU;
use std::io::{Cursor, Read};

use crate::common::{bilinear, instance, plan};
use squealmap::model::instance::Instance;
use squealmap::model::kind::InstabilityType;
use squealmap::model::linear::Linear;
use squealmap::model::status::Status;
use squealmap::model::{Param, linear};
use squealmap::study::signals::sensors::{Recording, Sample, record};
use squealmap::study::signals::table::signals_csv;
use squealmap_identify::{CAUSE, Identification, Settings, Unfit, identify};

/// Frequency of Table 1 between its uncoupled modes, Hz.
const TABLE_1: f64 = 33.6;

/// `SplitMix64` (Steele, Lea, Flood 2014) with normal numbers by Box and Muller.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Random {
        Random(seed)
    }

    /// In [0, 1).
    pub(crate) fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.uniform()
    }

    /// Even in the logarithm.
    pub(crate) fn decades(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    /// Mean 0, standard deviation 1.
    pub(crate) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (TAU * self.uniform()).cos()
    }
}

/// What a stroke is drawn to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// Stable.
    Stable,
    /// The slope alone destabilises, mode coupling alone does not.
    Slope,
    /// Mode coupling alone destabilises, the slope alone does not.
    Coupling,
    /// Each alone destabilises and would give at least [`CAUSE`] of the growth.
    Both,
    /// Each alone destabilises, but one of them would give less than that.
    BothOneWeak,
    /// Neither alone destabilises.
    Interaction,
}

impl Wanted {
    /// The truth, from the eigenvalues.
    fn of(kind: InstabilityType, linear: &Linear) -> Option<Wanted> {
        let weaker = linear.growth_rate_flat.min(linear.growth_rate_frozen);
        match kind {
            InstabilityType::Stable => Some(Wanted::Stable),
            InstabilityType::NegativeSlope => Some(Wanted::Slope),
            InstabilityType::ModeCoupling => Some(Wanted::Coupling),
            InstabilityType::Coexistence if weaker < CAUSE * linear.growth_rate => Some(Wanted::BothOneWeak),
            InstabilityType::Coexistence => Some(Wanted::Both),
            InstabilityType::Interaction => Some(Wanted::Interaction),
            InstabilityType::Sticking | InstabilityType::Divergence => None,
        }
    }
}

/// One synthetic stroke.
pub(crate) struct Stroke {
    pub(crate) instance: Instance,
    pub(crate) linear: Linear,
    pub(crate) samples: Vec<Sample>,
}

/// An instance of the wanted type with its eigenvalue analysis, drawn until there is one.
pub(crate) fn draw(wanted: Wanted, random: &mut Random) -> (Instance, Linear) {
    loop {
        let compression = random.between(8e3, 15e3) / TABLE_1;
        let belt_velocity = random.between(1.0, 4.0);
        let mu = random.between(0.05, 0.6);
        let slope = if random.uniform() < 0.5 { 0.0 } else { -random.decades(1e-3, 3e-2) };
        // c/(2m) = ζω for each direction.
        // Only damping keeps each mechanism alone stable: an interaction needs more of it, and grows slowly.
        let (most, slowest) = if wanted == Wanted::Interaction { (3e-3, 1e-3) } else { (1e-3, 8e-3) };
        let mut damping = |mass: f64| 2.0 * random.decades(1e-4, most) * mass * TAU * TABLE_1;
        let (c1, c2) = (damping(2.3), damping(2.12));
        let values = [
            (Param::M1, 2.12 / compression),
            (Param::M2, 0.18 / compression),
            (Param::K1, 1e5 * compression),
            (Param::K2, random.between(0.99e5, 1.04e5) * compression),
            (Param::C1, c1),
            (Param::C2, c2),
            (Param::Theta, random.between(0.006, 0.02)),
            (Param::BeltVelocity, belt_velocity),
        ];
        // Straight through (V, mu), down to the knee at 5 m/s.
        let law = bilinear(mu - slope * belt_velocity, mu + slope * (5.0 - belt_velocity));
        if mu + slope * (5.0 - belt_velocity) < 0.01 {
            continue;
        }
        let instance = instance(law, &values);
        if let (Some(kind), Some(linear)) = linear::analyse(&instance) {
            let Some(frequency) = linear.frequency else { continue };
            let relative = linear.growth_rate / (TAU * frequency);
            if Wanted::of(kind, &linear) == Some(wanted)
                && (wanted == Wanted::Stable || (slowest..3e-2).contains(&relative))
            {
                return (instance, linear);
            }
        }
    }
}

/// Records a stroke: from a small kick through its growth until it saturates (or, stable, from a larger kick on),
/// the belt slowing down by 3 %.
pub(crate) fn stroke(wanted: Wanted, rate: f64, skew: f64, random: &mut Random) -> Stroke {
    loop {
        let (mut instance, linear) = draw(wanted, random);
        let belt_velocity = instance.params.require(Param::BeltVelocity);
        let period = 1.0 / linear.frequency.expect("a mode that leads");
        let stable = wanted == Wanted::Stable;
        let kick: f64 = if stable { 0.1 } else { 3e-3 };
        // Up to 1.2 times the time in which the growth reaches the belt velocity; a decay to a tenth.
        let duration = if stable {
            2.3 / linear.growth_rate.abs()
        } else {
            1.2 * (1.0 / kick).ln() / linear.growth_rate
        };
        let duration = duration.min(1500.0 * period);
        instance.params.set(Param::StartVelocity, kick * belt_velocity);
        instance.params.set(Param::BeltVelocityEnd, 0.97 * belt_velocity);
        instance.params.set(Param::RampDuration, duration);
        let recording = Recording { rate, duration, skew, force_skew: 0.0 };
        let signals = record(&instance, &plan(1.0, 1.0, 12), &recording);
        if signals.status == Status::Ok {
            return Stroke { instance, linear, samples: signals.samples };
        }
    }
}

/// A vibrating channel of a sample.
pub(crate) type Field = fn(&mut Sample) -> &mut f64;

/// The vibrating channels.
pub(crate) const FIELDS: [Field; 4] = [
    |sample| &mut sample.tangential_acceleration,
    |sample| &mut sample.normal_acceleration,
    |sample| &mut sample.tangential_force,
    |sample| &mut sample.normal_force,
];

/// Adds white noise to every vibrating channel, `decibel` below what it does about its mean over the whole stroke; its
/// standard deviations in the order of [`FIELDS`].
pub(crate) fn add_noise(samples: &mut [Sample], decibel: f64, random: &mut Random) -> [f64; FIELDS.len()] {
    FIELDS.map(|field| {
        let values: Vec<f64> = samples.iter_mut().map(|sample| *field(sample)).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let power = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / values.len() as f64;
        let noise = power.sqrt() * 10_f64.powf(-decibel / 20.0);
        for sample in samples.iter_mut() {
            *field(sample) += noise * random.normal();
        }
        noise
    })
}

/// What `identify` finds in a file of signals.
pub(crate) fn run(bytes: &[u8], settings: &Settings) -> Result<Identification, Unfit> {
    let open = || Ok(Box::new(Cursor::new(bytes.to_vec())) as Box<dyn Read>);
    identify(open, "signals.csv", settings, &mut |_, _| ())
}

/// The samples as a file of signals.
pub(crate) fn csv(samples: &[Sample]) -> Vec<u8> {
    signals_csv(samples, None).expect("memory takes any table")
}
