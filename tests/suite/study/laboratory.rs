//! Strokes as a laboratory records them: a load of 17 N, squeal near 14.5 kHz, forces of 50 Hz or fast ones, both directions;
//! cause by the eigenvalues at every instant.

use std::f64::consts::TAU;
use std::sync::LazyLock;

use crate::common::{bilinear, constant, instance, plan};
use crate::study::strokes::{FIELDS, Random};
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::kind::InstabilityType;
use squealmap::model::status::Status;
use squealmap::model::{Param, linear};
use squealmap::study::signals::filter::recorded;
use squealmap::study::signals::sensors::{Recording, Sample};
use squealmap_identify::{CAUSE, Kind, Measured, Rig, Settings};

/// Mean frequency of the squeal, Hz.
const SQUEAL: f64 = 14.5e3;
/// Both masses together, kg: those of Table 1 where its frequency is that of the squeal.
const MASS: f64 = 2.3 * 34.0 / SQUEAL;
/// Load of the laboratory, N.
const LOAD: f64 = 17.0;
/// Corner of slow force sensors, Hz.
const SLOW: f64 = 50.0;
/// Damping ratios of the structures; a laboratory knows on which side of the middle one its own lies.
const DAMPING: [f64; 3] = [2e-4, squealmap_identify::DAMPING_RATIO, 2e-2];
/// Samples per second, Hz; the benchmark may be asked for others.
pub(crate) static RATE: LazyLock<f64> = LazyLock::new(|| {
    std::env::var("SQUEALMAP_RATE").ok().and_then(|text| text.parse().ok()).unwrap_or(102.4e3)
});
/// How often a second a rig records whose forces come from its accelerations, over [`struct@RATE`]: they take more samples.
const FINER: f64 = 3.0;
/// Length of a stroke of sustained squeal, s.
const LENGTH: f64 = 0.2;
/// Kick at the start, over the belt velocity.
const KICK: f64 = 3e-3;

/// How the forces are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sensors {
    /// By sensors that do not follow the vibration.
    Slow,
    /// By sensors that follow it.
    Fast,
    /// By slow sensors, and by a model of the rig, which is off by some per cent.
    Model,
}

impl Sensors {
    #[allow(dead_code, reason = "the benchmark shows them")]
    pub(crate) const ALL: [Sensors; 3] = [Sensors::Slow, Sensors::Fast, Sensors::Model];

    /// The samples per second that a record with them has, Hz.
    pub(crate) fn rate(self) -> f64 {
        *RATE * if self == Sensors::Model { FINER } else { 1.0 }
    }

    #[allow(dead_code, reason = "the benchmark shows it")]
    pub(crate) fn words(self) -> &'static str {
        match self {
            Sensors::Slow => "slow",
            Sensors::Fast => "fast",
            Sensors::Model => "model",
        }
    }
}

/// What a stroke is drawn to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Drawn {
    /// Squeal is there from the first sample on.
    Sustained,
    /// The record ends when the growth does.
    Growing,
    /// Mode coupling first, both from some velocity on.
    Late,
    /// Stable, with a vibration that something else drives.
    Driven,
    /// Stable.
    Stable,
}

impl Drawn {
    pub(crate) const ALL: [Drawn; 5] =
        [Drawn::Sustained, Drawn::Growing, Drawn::Late, Drawn::Driven, Drawn::Stable];

    #[allow(dead_code, reason = "the benchmark shows it")]
    pub(crate) fn words(self) -> &'static str {
        match self {
            Drawn::Sustained => "sustained",
            Drawn::Growing => "growing",
            Drawn::Late => "late coexistence",
            Drawn::Driven => "driven",
            Drawn::Stable => "stable",
        }
    }
}

/// One stroke as it is recorded.
pub(crate) struct Stroke {
    pub(crate) instance: Instance,
    /// The friction coefficient of the coalescence.
    pub(crate) critical: f64,
    pub(crate) samples: Vec<Sample>,
    /// The largest damping ratio that it may have, as a laboratory knows it.
    pub(crate) damping_ratio: f64,
    /// Length of the motion, s; the record may begin later, with the time of the motion.
    pub(crate) duration: f64,
}

/// The model of the laboratory with drawn structure and law, the belt going from one velocity to another within `duration` (s): modes by themselves
/// 0.3 to 8 % apart, the normal one above in three of four; a tangential mass of a twentieth to a half of the normal one; both damped alike within a
/// factor of two.
fn structure(random: &mut Random, law: FrictionLaw, [first, last]: [f64; 2], duration: f64) -> Instance {
    let omega = TAU * SQUEAL * random.between(0.7, 1.1);
    let mass = MASS / random.between(0.7, 1.1);
    let ratio = random.decades(0.05, 0.5);
    let above = if random.uniform() < 0.75 { 1.0 } else { -1.0 };
    let apart = 1.0 + above * random.decades(0.003, 0.08);
    let [along, across] = [0, 1].map(|_| random.decades(DAMPING[0], DAMPING[2]));
    let across = across.clamp(0.5 * along, 2.0 * along).min(DAMPING[2]);
    let normal = mass / (1.0 + ratio);
    let lean = if random.uniform() < 0.5 { 1.0 } else { -1.0 };
    let values = [
        (Param::M1, normal),
        (Param::M2, mass - normal),
        (Param::K1, mass * omega * omega),
        (Param::K2, normal * (apart * omega).powi(2)),
        (Param::C1, 2.0 * along * mass * omega),
        (Param::C2, 2.0 * across * normal * apart * omega),
        (Param::Theta, lean * random.between(0.006, 0.03)),
        (Param::FExt, LOAD),
        (Param::BeltVelocity, first),
        (Param::BeltVelocityEnd, last),
        (Param::RampDuration, duration),
        (Param::StartVelocity, KICK * first),
    ];
    instance(law, &values)
}

/// The friction coefficient from which on a flat law is unstable.
pub(crate) fn coalescence(instance: &Instance) -> f64 {
    let (mut low, mut high) = (0.0, 2.0);
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        let flat = Instance { law: constant(middle), ..instance.clone() };
        let unstable = linear::analyse(&flat).1.is_some_and(|linear| linear.growth_rate > 0.0);
        if unstable { high = middle } else { low = middle }
    }
    high
}

/// The causes that are right at an instant of the motion (s); none where nothing may be said.
pub(crate) fn right(instance: &Instance, time: f64) -> Vec<Kind> {
    let mut at = instance.clone();
    at.params.set(Param::BeltVelocity, instance.motion.velocity(&instance.params, time).max(1e-9));
    let (kind, found) = linear::analyse(&at);
    let weaker = found.map(|found| found.growth_rate_flat.min(found.growth_rate_frozen) / found.growth_rate);
    match kind {
        Some(InstabilityType::Stable) => vec![Kind::NoInstability],
        Some(InstabilityType::NegativeSlope) => vec![Kind::NegativeSlope],
        Some(InstabilityType::ModeCoupling) => vec![Kind::ModeCoupling],
        Some(InstabilityType::Coexistence) if weaker.is_some_and(|weaker| weaker < CAUSE) => {
            vec![Kind::NegativeSlope, Kind::ModeCoupling, Kind::Both]
        }
        Some(InstabilityType::Coexistence) => vec![Kind::Both],
        _ => Vec::new(),
    }
}

/// A bilinear law with its knee at `knee` (m/s).
fn law(mu_s: f64, mu_d: f64, knee: f64) -> FrictionLaw {
    match bilinear(mu_s, mu_d) {
        FrictionLaw::Bilinear { mu_s, mu_d, .. } => FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity: knee },
        other => other,
    }
}

/// Draws an instance of this kind, until there is one: it and the length of its motion, s.
fn draw(drawn: Drawn, random: &mut Random) -> (Instance, f64) {
    // Each cause alike.
    let wanted = match 3.0 * random.uniform() {
        part if part < 1.0 => Kind::NegativeSlope,
        part if part < 2.0 => Kind::ModeCoupling,
        _ => Kind::Both,
    };
    loop {
        let first = random.between(0.01, 0.12);
        let steady = random.uniform() < 0.3;
        let last = if steady && drawn != Drawn::Late { first } else { first * random.between(0.05, 0.8) };
        let mu_d = random.between(0.05, 0.5);
        let flat = random.uniform() < 0.35 && drawn != Drawn::Late;
        let mu_s = mu_d + if flat { 0.0 } else { random.decades(0.01, 0.4) };
        let knee = first * random.between(0.2, 1.2);
        let instance = structure(random, law(mu_s, mu_d, knee), [first, last], LENGTH);
        let (_, Some(found)) = linear::analyse(&instance) else { continue };
        let kinds = [0.0, LENGTH].map(|time| right(&instance, time));
        let fits = match drawn {
            Drawn::Sustained => found.growth_rate > 100.0 && kinds[0] == [wanted],
            Drawn::Growing => {
                let slow = found.growth_rate < 0.04 * TAU * found.frequency.unwrap_or(0.0);
                found.growth_rate > 100.0 && slow && kinds[0] == [wanted]
            }
            Drawn::Late => found.growth_rate > 100.0 && kinds == [vec![Kind::ModeCoupling], vec![Kind::Both]],
            Drawn::Driven | Drawn::Stable => kinds.iter().all(|kinds| kinds[..] == [Kind::NoInstability]),
        };
        if fits {
            let growing = 1.1 * (1.0 / KICK).ln() / found.growth_rate;
            return (instance, if drawn == Drawn::Growing { growing } else { LENGTH });
        }
    }
}

/// Draws a stroke and records it at a rate (Hz), free of noise and with fast sensors.
pub(crate) fn stroke(drawn: Drawn, rate: f64, random: &mut Random) -> Stroke {
    loop {
        let (instance, duration) = draw(drawn, random);
        let recording = Recording { rate, duration, skew: 0.0, force_skew: 0.0 };
        let mut signals = recorded(&instance, &plan(1.0, 1.0, 12), &recording);
        if signals.status != Status::Ok {
            continue;
        }
        let from = if drawn == Drawn::Sustained { 0.2 * LENGTH } else { 0.0 };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of samples")]
        signals.samples.drain(..(from * rate) as usize);
        if drawn == Drawn::Driven {
            drive(&mut signals.samples, random);
        }
        let rig = exact(&instance, false);
        let damping_ratio = if rig.damping_ratio() <= DAMPING[1] { DAMPING[1] } else { DAMPING[2] };
        let critical = rig.critical[0].value;
        return Stroke { critical, damping_ratio, instance, samples: signals.samples, duration };
    }
}

/// Samples per second, Hz.
fn rate_of(samples: &[Sample]) -> f64 {
    (samples.len() - 1) as f64 / (samples[samples.len() - 1].t - samples[0].t)
}

/// Adds a vibration that something drives: steady, or stronger with time, up to half of the sliding velocity.
fn drive(samples: &mut [Sample], random: &mut Random) {
    let omega = TAU * SQUEAL * random.between(0.5, 1.1);
    let reach = random.decades(0.01, 0.45);
    let rising = random.uniform() < 0.5;
    let parts = [1.0, random.between(0.1, 1.0), random.between(0.0, 0.3), random.between(0.0, 0.3)];
    let phases = [0.0; 4].map(|_| TAU * random.uniform());
    let count = samples.len() as f64;
    let rate = rate_of(samples);
    for (k, sample) in samples.iter_mut().enumerate() {
        let strength = if rising { k as f64 / count } else { 1.0 };
        let velocity = reach * sample.belt_velocity * strength;
        let scales = [velocity * omega, velocity * omega, sample.tangential_force, sample.normal_force];
        for (number, field) in FIELDS.into_iter().enumerate() {
            let size = if number < 2 { scales[number] } else { scales[number] * reach * strength };
            *field(sample) += parts[number] * size * (omega * k as f64 / rate + phases[number]).cos();
        }
    }
}

/// Makes the forces those of slow sensors, adds noise, and turns the stroke around.
pub(crate) fn sensed(samples: &mut [Sample], slow: bool, decibel: f64, backwards: bool, random: &mut Random) {
    let noise = 10_f64.powf(-decibel / 20.0);
    let share = 1.0 - (-TAU * SLOW / rate_of(samples)).exp();
    for (number, field) in FIELDS.into_iter().enumerate() {
        let force = number >= 2;
        let count = samples.len() as f64;
        let mean = samples.iter_mut().map(|sample| *field(sample)).sum::<f64>() / count;
        let power = samples.iter_mut().map(|sample| (*field(sample) - mean).powi(2)).sum::<f64>() / count;
        // A slow sensor is no noisier than its mean, a fast one than what it follows.
        let size = noise * if force && slow { mean.abs() } else { power.sqrt() };
        let mut state = *field(&mut samples[0]);
        for sample in samples.iter_mut() {
            if force && slow {
                state += share * (*field(sample) - state);
                *field(sample) = state;
            }
            *field(sample) += size * random.normal();
        }
    }
    if backwards {
        for sample in samples {
            sample.tangential_acceleration *= -1.0;
            sample.tangential_force *= -1.0;
            sample.belt_velocity *= -1.0;
        }
    }
}

/// The rig of a structure, its coalescence known to 3 %. A stroke that `sensed` has turned around was made by a rig with the inclination of one that
/// goes backwards.
pub(crate) fn exact(instance: &Instance, backwards: bool) -> Rig {
    let value = |param: Param| instance.params.require(param);
    let [m1, m2, k1, k2] = [Param::M1, Param::M2, Param::K1, Param::K2].map(value);
    let [c1, c2] = [Param::C1, Param::C2].map(value);
    let theta = if backwards { -1.0 } else { 1.0 } * value(Param::Theta);
    let critical = coalescence(instance);
    let critical = [Measured { value: critical, error: 0.03 * critical }; 2];
    Rig { m1, m2, k1, k2, c1, c2, theta, load: value(Param::FExt), critical }
}

/// What a laboratory knows of a structure: masses to a per cent, frequencies to a quarter of one, damping and inclination to a tenth.
pub(crate) fn known(instance: &Instance, backwards: bool, random: &mut Random) -> Rig {
    let [mass, square, damping, inclination] =
        [0.01, 0.005, 0.1, 0.1].map(|error| (error * random.normal()).exp());
    let rig = exact(instance, backwards);
    Rig {
        m1: mass * rig.m1,
        m2: mass * rig.m2,
        k1: mass * square * rig.k1,
        k2: mass / square * rig.k2,
        c1: damping * rig.c1,
        c2: damping * rig.c2,
        theta: inclination * rig.theta,
        ..rig
    }
}

/// The settings of an analysis that knows the coalescence within 3 %, and a bound of the damping ratio.
pub(crate) fn settings(critical: f64, damping_ratio: f64) -> Settings {
    Settings {
        damping_ratio,
        critical_friction: Some(Measured { value: critical, error: 0.03 * critical }),
        ..Settings::default()
    }
}
