//! The inclination at which the modes coalesce where squeal began, and with it the whole model.

use std::f64::consts::TAU;

use crate::model::friction::FrictionLaw;
use crate::model::instance::Instance;
use crate::model::motion::Motion;
use crate::model::{Param, Params, linear};
use crate::study::calibrate::fault::Fault;
use crate::study::calibrate::system::{Structure, Wanted};

/// What was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The frequencies of the two modes without friction, Hz, rising.
    pub frequencies: [f64; 2],
    /// Their damping ratios.
    pub damping_ratios: [f64; 2],
    /// The friction coefficient at which squeal began, where friction does not fall with the velocity.
    pub critical_friction: f64,
    /// The moving mass `m1 + m2`, kg.
    pub mass: f64,
    /// `m2/m1`.
    pub mass_ratio: f64,
    /// The load, N.
    pub load: f64,
    /// Whether the upper mode is rather the normal one, as in Table 1.
    pub normal_above: bool,
}

/// A model that has all of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calibrated {
    /// Masses, stiffnesses, dampers, inclination and load.
    pub params: Params,
    /// The frequencies that its eigenvalues have without friction, Hz.
    pub frequencies: [f64; 2],
    /// Their damping ratios.
    pub damping_ratios: [f64; 2],
    /// The friction coefficient from which on it is unstable, the slope set to 0.
    pub critical_friction: f64,
}

/// Inclinations are looked for down to this part of the largest one …
const LEAST: f64 = 1e-5;
/// … in so many steps of equal factors, and as many equal ones in the upper half, where modes that are damped differently change fast.
const INCLINATIONS: u32 = 80;
/// What a model has of what is wanted is off by this part at most.
const EXACT: f64 = 1e-6;
/// Friction coefficients beyond this are no friction.
pub(crate) const MOST: f64 = 5.0;

/// The model that has what was measured.
///
/// The inclination is what remains when the modes are given: the flatter the contact, the more friction it takes to couple
/// them. It is found among some, then by bisection; all else has the characteristic polynomial that is wanted. Of several the flattest is taken.
///
/// # Errors
/// When no model has it.
pub fn calibrate(measured: &Measured) -> Result<Calibrated, Fault> {
    let [first, second] = measured.frequencies;
    if first.partial_cmp(&second) != Some(std::cmp::Ordering::Less) {
        return Err(Fault::NotRising { first, second });
    }
    let m1 = measured.mass / (1.0 + measured.mass_ratio);
    let wanted = Wanted {
        masses: [m1, measured.mass - m1],
        frequencies: measured.frequencies,
        damping_ratios: measured.damping_ratios,
        normal_above: measured.normal_above,
    };
    let steepest = wanted.steepest();
    let mut inclinations: Vec<f64> = (0..INCLINATIONS)
        .flat_map(|k| {
            let part = f64::from(k) / f64::from(INCLINATIONS);
            [LEAST.powf(1.0 - part), 0.5 + 0.5 * part]
        })
        .chain([0.9999])
        .map(|part| part * steepest)
        .collect();
    inclinations.sort_by(f64::total_cmp);
    let tried = |theta: f64| -> Vec<Tried> {
        let all = wanted.structures(theta).into_iter().enumerate().map(|(number, structure)| {
            let made = instance(&structure, &wanted, theta, measured.load);
            Tried { number, theta, critical: coalescence(&made), made }
        });
        all.filter(|one| one.has(&wanted)).collect()
    };
    let all: Vec<Vec<Tried>> = inclinations.iter().map(|theta| tried(*theta)).collect();
    let asked = measured.critical_friction;
    let mut found = all.windows(2).flat_map(|two| {
        let pairs = two[0]
            .iter()
            .filter_map(|one| Some((one, two[1].iter().find(|next| next.number == one.number)?)));
        pairs.filter_map(|(one, next)| between(&tried, one, next, asked)).collect::<Vec<_>>()
    });
    if let Some(Tried { made, critical, .. }) = found.next() {
        let (frequencies, damping_ratios) = modes(&made);
        return Ok(Calibrated {
            params: made.params,
            frequencies,
            damping_ratios,
            critical_friction: critical,
        });
    }
    let possible = all.iter().flatten().map(|one| one.critical);
    let [low, high] = possible.fold([f64::INFINITY, 0.0], |[low, high], one| [one.min(low), one.max(high)]);
    Err(if low.is_infinite() {
        Fault::NoCoalescence { first, second, most: MOST }
    } else {
        Fault::Coalescence { first, second, wanted: asked, low, high, most: MOST }
    })
}

/// The model between two neighbours that is critical where asked, if there is one.
fn between(tried: &impl Fn(f64) -> Vec<Tried>, one: &Tried, next: &Tried, asked: f64) -> Option<Tried> {
    let falls = one.critical >= asked && asked >= next.critical;
    if !(falls || one.critical <= asked && asked <= next.critical) {
        return None;
    }
    let at = |theta: f64| tried(theta).into_iter().find(|found| found.number == one.number);
    let (mut low, mut high) = (one.theta, next.theta);
    for _ in 0..BISECTIONS {
        let middle = (low * high).sqrt();
        if (at(middle)?.critical > asked) == falls { low = middle } else { high = middle }
    }
    at((low * high).sqrt()).filter(|found| (found.critical - asked).abs() <= EXACT * asked)
}

/// A model at an inclination.
struct Tried {
    /// Which of the models there.
    number: usize,
    /// The inclination, rad.
    theta: f64,
    made: Instance,
    /// The friction coefficient from which on it is unstable.
    critical: f64,
}

impl Tried {
    /// Whether its eigenvalues are what is wanted.
    fn has(&self, wanted: &Wanted) -> bool {
        let (frequencies, damping_ratios) = modes(&self.made);
        let near = |(a, b): (f64, f64), most: f64| (a - b).abs() <= EXACT * most;
        let most = wanted.damping_ratios[0].max(wanted.damping_ratios[1]);
        frequencies.into_iter().zip(wanted.frequencies).all(|pair| near(pair, pair.1))
            && damping_ratios.into_iter().zip(wanted.damping_ratios).all(|pair| near(pair, most))
    }
}

/// Halvings of an interval of inclinations, and of friction coefficients.
const BISECTIONS: usize = 48;

/// An instance without friction.
fn instance(structure: &Structure, wanted: &Wanted, theta: f64, load: f64) -> Instance {
    let mut params = Params::default();
    let Structure { stiffness, damping } = structure;
    for (param, value) in [
        (Param::M1, wanted.masses[0]),
        (Param::M2, wanted.masses[1]),
        (Param::K1, stiffness[0]),
        (Param::K2, stiffness[1]),
        (Param::C1, damping[0]),
        (Param::C2, damping[1]),
        (Param::Theta, theta),
        (Param::FExt, load),
        (Param::BeltVelocity, 1.0),
    ] {
        params.set(param, value);
    }
    Instance {
        params,
        law: flat(0.0),
        impact_friction: true,
        motion: Motion::Ramp,
        heating: None,
        modal: None,
    }
}

fn flat(mu: f64) -> FrictionLaw {
    FrictionLaw::Constant { mu_s: mu, mu_d: mu }
}

/// Frequencies (Hz) and damping ratios of the two modes of an instance, rising.
fn modes(instance: &Instance) -> ([f64; 2], [f64; 2]) {
    let mut above: Vec<_> =
        linear::eigenvalues(instance).into_iter().flatten().filter(|z| z.im > 0.0).collect();
    above.sort_by(|a, b| a.im.total_cmp(&b.im));
    let of = |mode: usize| above.get(mode).copied().unwrap_or_default();
    let both = [of(0), of(1)];
    (both.map(|z| z.im / TAU), both.map(|z| -z.re / z.norm()))
}

/// The least friction coefficient at which an instance is unstable with a flat law; infinite where none below `MOST` is.
pub(crate) fn coalescence(instance: &Instance) -> f64 {
    /// Steps in which the first unstable one is looked for.
    const STEPS: u32 = 250;
    let unstable = |mu: f64| {
        let at = Instance { law: flat(mu), ..instance.clone() };
        linear::eigenvalues(&at).is_some_and(|all| all.iter().any(|z| linear::is_unstable(*z)))
    };
    let step = MOST / f64::from(STEPS);
    let Some(first) = (0..=STEPS).map(|k| step * f64::from(k)).find(|mu| unstable(*mu)) else {
        return f64::INFINITY;
    };
    let (mut low, mut high) = ((first - step).max(0.0), first);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if unstable(middle) { high = middle } else { low = middle }
    }
    high
}
