//! Complex eigenvalue analysis and attribution: independent of method, observe and classify.
//!
//! With `μ0 = μ(V)` the characteristic polynomial of the sliding equilibrium is
//!
//! ```text
//! A(λ) B(λ) + s (μ0 c − s) (c2 λ + k2)²
//! A = (m2 + m1 c² + μ0 m1 c s) λ² + [C11 + μ'(V) N0] λ + K11     B = m1 λ² + c2 λ + k2
//! C11, K11 = (c1, k1) c (c + μ0 s) + (c2, k2) s (s − μ0 c)
//! ```
//!
//! (the paper's matrices (4), its normal degree of freedom eliminated). Attribution removes one mechanism
//! at a time at the same equilibrium: the slope (`μ' = 0`), or the feedback of the normal force (`μ0 = 0`
//! in the matrices, the slope kept at the frozen `N0`).

use std::f64::consts::TAU;

use num_complex::Complex64;

use crate::model::equilibrium::Equilibrium;
use crate::model::instance::Instance;
use crate::model::kind::{InstabilityType, UNSTABLE_ABOVE};
use crate::model::modal::{At, Modal};
use crate::model::status::Status;
use crate::model::{Param, quartic};

/// Eigenvalue analysis of one sliding equilibrium.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Linear {
    /// Largest real part of the eigenvalues, both mechanisms present, 1/s.
    pub growth_rate: f64,
    /// Its imaginary part over 2π, Hz; `None` where nothing damps and nothing grows: no mode is then less stable than the
    /// others.
    pub frequency: Option<f64>,
    /// Phase of `ÿ1` against `ẍ2` in that mode, degrees in (−180, 180]; `None` at θ = 0, for real eigenvalues and without a
    /// frequency.
    pub phase: Option<f64>,
    /// Growth rate with the slope set to 0 (mode coupling alone), 1/s.
    pub growth_rate_flat: f64,
    /// Growth rate with the normal force frozen (negative slope alone), 1/s.
    pub growth_rate_frozen: f64,
}

/// The coefficients of the characteristic polynomial; SI units.
struct Sliding {
    m1: f64,
    m2: f64,
    k1: f64,
    k2: f64,
    c1: f64,
    c2: f64,
    s: f64,
    c: f64,
}

impl Sliding {
    fn new(instance: &Instance) -> Sliding {
        let value = |param| instance.params.require(param);
        let (s, c) = value(Param::Theta).sin_cos();
        Sliding {
            m1: value(Param::M1),
            m2: value(Param::M2),
            k1: value(Param::K1),
            k2: value(Param::K2),
            c1: value(Param::C1),
            c2: value(Param::C2),
            s,
            c,
        }
    }

    /// Powers 0 to 4 for the friction coefficient `mu` in the matrices and the damping `slope_damping = μ' N0`.
    fn polynomial(&self, mu: f64, slope_damping: f64) -> [f64; 5] {
        let Sliding { m1, m2, k1, k2, c1, c2, s, c } = *self;
        let (along, across) = (c * (c + mu * s), s * (s - mu * c));
        let stiffness = k1 * along + k2 * across;
        let (damping, own) = (c1 * along + slope_damping, c2 * across);
        let mass = m2 + m1 * c * c + mu * m1 * c * s;
        // What of A B the square of `c2 λ + k2` takes away is left out: differences of it would have no digits left.
        [
            k1 * along * k2,
            k1 * along * c2 + damping * k2,
            stiffness * m1 + damping * c2 + mass * k2,
            (damping + own) * m1 + mass * c2,
            mass * m1,
        ]
    }

    /// `k2, c2, m1`: the polynomial of the normal mode, powers 0 to 2.
    fn normal(&self) -> [f64; 3] {
        [self.k2, self.c2, self.m1]
    }
}

/// `y1/x2` of the mode with the eigenvalue `lambda`. Besides that it depends on [`Sliding::normal`] and `sin θ` only.
fn mode_ratio([k2, c2, m1]: [f64; 3], s: f64, lambda: Complex64) -> Complex64 {
    let spring = c2 * lambda + k2;
    spring * s / (m1 * lambda * lambda + spring)
}

/// The eigenvalue of largest real part; of a pair the one with positive imaginary part. There is at least one.
fn rightmost(eigenvalues: &[Complex64]) -> Complex64 {
    let key = |z: &Complex64| (z.re, z.im);
    let first = eigenvalues[0];
    eigenvalues[1..].iter().fold(first, |best, z| if key(z) > key(&best) { *z } else { best })
}

/// Whether a mode with this eigenvalue grows by more than rounding.
#[must_use]
pub fn is_unstable(lambda: Complex64) -> bool {
    lambda.re > 0.0 && lambda.re * lambda.re > UNSTABLE_ABOVE * UNSTABLE_ABOVE * lambda.norm_sqr()
}

/// The type by the eigenvalues of largest real part with both mechanisms, with the slope set to 0, with the normal force
/// frozen.
fn kind_of(leading: [Complex64; 3]) -> InstabilityType {
    match leading.map(is_unstable) {
        [false, _, _] => InstabilityType::Stable,
        [true, false, true] => InstabilityType::NegativeSlope,
        [true, true, false] => InstabilityType::ModeCoupling,
        [true, true, true] => InstabilityType::Coexistence,
        [true, false, false] => InstabilityType::Interaction,
    }
}

/// The four eigenvalues of the sliding equilibrium of two masses, 1/s; `None` where there is no belt motion or no equilibrium.
#[must_use]
pub fn eigenvalues(instance: &Instance) -> Option<[Complex64; 4]> {
    let equilibrium = sliding(instance)?;
    let slope_damping = equilibrium.slope * equilibrium.normal_force;
    Some(quartic::roots(Sliding::new(instance).polynomial(equilibrium.mu, slope_damping)))
}

/// The equilibrium of two masses on a belt that moves.
fn sliding(instance: &Instance) -> Option<Equilibrium> {
    let moves = instance.modal.is_none() && instance.params.require(Param::BeltVelocity) > 0.0;
    moves.then(|| Equilibrium::new(instance).ok()).flatten()
}

/// The most unstable mode with a tangential part: its eigenvalue (1/s) and `y1/x2`.
///
/// At θ = 0 the normal mode is decoupled and cannot be excited by the belt.
#[must_use]
pub fn leading_mode(instance: &Instance) -> Option<(Complex64, Complex64)> {
    let system = Sliding::new(instance);
    let equilibrium = sliding(instance)?;
    let slope_damping = equilibrium.slope * equilibrium.normal_force;
    if system.s == 0.0 {
        return Some((single_mass(instance)?[0], Complex64::ZERO));
    }
    let lambda = rightmost(&quartic::roots(system.polynomial(equilibrium.mu, slope_damping)));
    Some((lambda, mode_ratio(system.normal(), system.s, lambda)))
}

/// The two eigenvalues (1/s) of the tangential motion alone, at θ = 0; the one of larger imaginary part first.
#[must_use]
pub fn single_mass(instance: &Instance) -> Option<[Complex64; 2]> {
    let system = Sliding::new(instance);
    let equilibrium = sliding(instance)?;
    let (mass, damping) = (system.m1 + system.m2, system.c1 + equilibrium.slope * equilibrium.normal_force);
    let half = Complex64::new(-0.5 * damping / mass, 0.0);
    let root = (half * half - system.k1 / mass).sqrt();
    Some([half + root, half - root])
}

/// The four eigenvalues (1/s), each with the `y1/x2` of its mode; of use where θ is not 0.
#[must_use]
pub fn modes(instance: &Instance) -> Option<[(Complex64, Complex64); 4]> {
    let system = Sliding::new(instance);
    Some(eigenvalues(instance)?.map(|lambda| (lambda, mode_ratio(system.normal(), system.s, lambda))))
}

/// The three characteristic polynomials of one sliding equilibrium (powers 0 to 4) and what the mode ratio needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared {
    /// Both mechanisms.
    pub full: [f64; 5],
    /// The slope set to 0.
    pub flat: [f64; 5],
    /// The normal force frozen.
    pub frozen: [f64; 5],
    /// `k2, c2, m1`: the polynomial of the normal mode, powers 0 to 2.
    pub normal: [f64; 3],
    /// `sin θ`.
    pub s: f64,
}

impl Prepared {
    /// Whether anything damps, or a slope drives, by more than rounding; otherwise no mode has a real part unless two have
    /// coalesced.
    #[must_use]
    pub fn is_damped(&self) -> bool {
        let [constant, one, _, three, leading] = self.full;
        let square = (constant / leading).sqrt();
        let mean = square.sqrt() * leading;
        three.abs() > UNSTABLE_ABOVE * mean || one.abs() > UNSTABLE_ABOVE * mean * square
    }
}

/// The smallest leading coefficient of a polynomial: it is divided by.
const LEAST: f64 = 1e-290;

/// The largest coefficient in units of the mean root: products of seven are finite, and beyond it the roots are too far
/// apart for the closed form.
const LARGEST: f64 = 1e40;

/// Whether the roots of a polynomial can be told in numbers.
fn is_solvable(polynomial: &[f64; 5]) -> bool {
    let [constant, .., leading] = *polynomial;
    let scale = (constant / leading).abs().sqrt().sqrt();
    let mut power = leading.abs();
    let coefficients = polynomial.iter().rev().all(|coefficient| {
        let in_range = coefficient.is_finite() && coefficient.abs() <= LARGEST * power;
        power *= scale;
        in_range
    });
    leading.abs() >= LEAST && scale.is_finite() && power.is_finite() && coefficients
}

/// The polynomials to solve, or why there are none: the type of an instance that is at rest or diverges. It is `None` where
/// the friction law is ill-posed or a coefficient is beyond the range of numbers.
pub type Preparation = Result<Prepared, Option<InstabilityType>>;

/// The polynomials of an instance; a modal structure has none.
///
/// # Errors
/// The type of an instance without polynomials, see [`Preparation`].
pub fn prepare(instance: &Instance) -> Preparation {
    if instance.modal.is_some() || !instance.law.is_valid() {
        return Err(None);
    }
    if instance.params.require(Param::BeltVelocity) == 0.0 {
        return Err(Some(InstabilityType::Sticking));
    }
    let equilibrium = sliding(instance).ok_or(Some(InstabilityType::Divergence))?;
    let system = Sliding::new(instance);
    let slope_damping = equilibrium.slope * equilibrium.normal_force;
    let prepared = Prepared {
        full: system.polynomial(equilibrium.mu, slope_damping),
        flat: system.polynomial(equilibrium.mu, 0.0),
        frozen: system.polynomial(0.0, slope_damping),
        normal: system.normal(),
        s: system.s,
    };
    let solvable = [&prepared.full, &prepared.flat, &prepared.frozen].into_iter().all(is_solvable);
    solvable.then_some(prepared).ok_or(None)
}

/// Type of instability and the eigenvalue analysis behind it (`None` at rest and under divergence); both
/// `None` for an ill-posed friction law.
#[must_use]
pub fn analyse(instance: &Instance) -> (Option<InstabilityType>, Option<Linear>) {
    if let Some(modal) = &instance.modal {
        let (kind, linear, _) = of_modal(instance, modal);
        return (kind, linear);
    }
    solve(&prepare(instance))
}

/// Type of instability and the eigenvalue analysis behind it, as [`analyse`] gives them, from polynomials that are there
/// already.
#[must_use]
pub fn solve(prepared: &Preparation) -> (Option<InstabilityType>, Option<Linear>) {
    let prepared = match prepared {
        Ok(prepared) => prepared,
        Err(kind) => return (*kind, None),
    };
    let leading = |polynomial| rightmost(&quartic::roots(polynomial));
    let full = leading(prepared.full);
    #[expect(clippy::float_cmp, reason = "the same polynomial, bit by bit")]
    let without = |polynomial| if polynomial == prepared.full { full } else { leading(polynomial) };
    let (flat, frozen) = (without(prepared.flat), without(prepared.frozen));
    let kind = kind_of([full, flat, frozen]);
    let leads = kind != InstabilityType::Stable || prepared.is_damped();
    let phase = (leads && full.im != 0.0 && prepared.s != 0.0)
        .then(|| mode_ratio(prepared.normal, prepared.s, full).arg().to_degrees())
        .filter(|phase| phase.is_finite());
    let linear = Linear {
        growth_rate: full.re,
        frequency: leads.then_some(full.im / TAU),
        phase,
        growth_rate_flat: flat.re,
        growth_rate_frozen: frozen.re,
    };
    (Some(kind), Some(linear))
}

/// Type of instability and the eigenvalue analysis of an instance of a structure, and how it ended.
#[must_use]
pub fn of_modal(instance: &Instance, modal: &Modal) -> (Option<InstabilityType>, Option<Linear>, Status) {
    match asked(instance, modal) {
        Err((kind, status)) => (kind, None, status),
        Ok(at) => match attributed(modal, at) {
            Some((kind, linear)) => (Some(kind), Some(linear), Status::Ok),
            None => (None, None, Status::NonFinite),
        },
    }
}

/// What the matrices of a structure are asked for by an instance, or its type and status where it does not slide.
fn asked(instance: &Instance, modal: &Modal) -> Result<At, (Option<InstabilityType>, Status)> {
    if !instance.law.is_valid() {
        return Err((None, Status::InvalidLaw));
    }
    let velocity = instance.params.require(Param::BeltVelocity);
    let mu = instance.law.mu(velocity);
    let pressed = modal.pressed(instance.params.require(Param::FExt), mu);
    if velocity == 0.0 {
        let status = pressed.map_or(Status::NoEquilibrium, |_| Status::Ok);
        return Err((Some(InstabilityType::Sticking), status));
    }
    let divergence = (Some(InstabilityType::Divergence), Status::NoEquilibrium);
    let slope = instance.law.slope(velocity) * pressed.ok_or(divergence)?;
    let ratio = |param| instance.params.get(param).unwrap_or(0.0);
    let each = Param::DAMPING_RATIOS.map(ratio);
    Ok(At { mu, slope, ratio: ratio(Param::DampingRatio), each, kn: instance.params.get(Param::Kn) })
}

/// The eigenvalues (1/s) of the sliding equilibrium of either model, two for each of its modes; `None` where there is none.
#[must_use]
pub fn spectrum(instance: &Instance) -> Option<Vec<Complex64>> {
    match &instance.modal {
        None => eigenvalues(instance).map(Vec::from),
        Some(modal) => modal.eigenvalues(asked(instance, modal).ok()?),
    }
}

/// The type of a structure's modes; `None` beyond the range of numbers.
fn attributed(modal: &Modal, at: At) -> Option<(InstabilityType, Linear)> {
    let leading = |mu, slope| Some(rightmost(&modal.eigenvalues(at.with(mu, slope))?));
    let At { mu, slope, .. } = at;
    let all = modal.eigenvalues(at)?;
    let full = rightmost(&all);
    // One mode alone leads, whatever it does.
    let leads = all.len() < 3 || all.iter().any(|lambda| is_unstable(*lambda) || is_unstable(-*lambda));
    let flat = if slope == 0.0 { full } else { leading(mu, 0.0)? };
    let frozen = if mu == 0.0 { full } else { leading(0.0, slope)? };
    let linear = Linear {
        growth_rate: full.re,
        frequency: leads.then_some(full.im / TAU),
        phase: None,
        growth_rate_flat: flat.re,
        growth_rate_frozen: frozen.re,
    };
    Some((kind_of([full, flat, frozen]), linear))
}
