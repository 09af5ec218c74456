//! How long a start takes to meet its first event: linear theory, before anything is integrated.
//!
//! A motion about an unstable equilibrium grows as its most unstable mode does. With the amplitude `a0` of that mode in the
//! start, the amplitude `a1` at which the mode meets its first event, and the growth rate `σ`:
//!
//! ```text
//! t = ln(a1 / a0) / σ
//! ```

use nalgebra::{Matrix4, Vector4};
use num_complex::Complex64;

use crate::engine::method::taylor::State;
use crate::engine::plan::{Duration, StartKind};
use crate::engine::scene::Scene;
use crate::engine::start::first_event;
use crate::model::instance::Instance;
use crate::model::{Param, linear};
use crate::sweep::estimate::sample;
use crate::sweep::spec::Spec;

/// Most instances of a sweep that are looked at: some tens of milliseconds.
const LOOKED_AT: usize = 4096;

/// How long the unstable instances of a sweep take to show what they do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Onsets {
    /// Instances that were looked at, spread over the grid.
    pub looked_at: usize,
    /// Looked-at instances that are unstable and do not start at rest.
    pub growing: usize,
    /// Growing instances whose run ends before their first event.
    pub late: usize,
    /// Looked-at instances that are unstable but start at rest, so that nothing grows.
    pub at_rest: usize,
    /// The time (s) that 99 % of the growing ones need.
    pub most: f64,
    /// The time (s) of the slowest.
    pub longest: f64,
}

/// The onsets of a sweep with a response, from the start of [`Spec::start`]. `None` where the belt changes its velocity, as the equilibrium moves.
#[must_use]
pub fn onsets(spec: &Spec) -> Option<Onsets> {
    let instances = spec.grid.len();
    let looked_at = instances.min(LOOKED_AT);
    let (mut times, mut late, mut at_rest) = (Vec::new(), 0, 0);
    for part in 0..looked_at {
        let instance = spec.instance(sample(part, looked_at, instances));
        if !instance.motion.is_steady(&instance.params) {
            return None;
        }
        match time_to_first_event(&instance, spec.start) {
            None => {}
            Some(time) if time.is_infinite() => at_rest += 1,
            Some(time) => {
                late += usize::from(lasts(spec, &instance).is_some_and(|lasts| lasts < time));
                times.push(time);
            }
        }
    }
    times.sort_by(f64::total_cmp);
    let growing = times.len();
    let at = |percent: usize| times.get((growing * percent).div_ceil(100).saturating_sub(1)).copied();
    let (most, longest) = (at(99).unwrap_or(0.0), at(100).unwrap_or(0.0));
    Some(Onsets { looked_at, growing, late, at_rest, most, longest })
}

/// How long (s) the run of an instance lasts at most.
fn lasts(spec: &Spec, instance: &Instance) -> Option<f64> {
    let scene = Scene::new(instance, spec.start).ok()?;
    let scaled = |duration: Duration| scene.scaled(duration);
    let end = spec.settle_limit.map_or_else(|| scaled(spec.settle) + scaled(spec.measure), scaled);
    Some(end * scene.units.time)
}

/// The time (s) after which an instance meets its first event by linear theory. It is infinite from rest, and 0 where the
/// start is beyond an event. `None` where the instance is stable, has no equilibrium, or has a mode that is not finite.
#[must_use]
pub fn time_to_first_event(instance: &Instance, start: StartKind) -> Option<f64> {
    linear::analyse(instance).0.filter(|kind| kind.is_unstable())?;
    let scene = Scene::new(instance, start).ok()?;
    let (lambda, ratio) = linear::leading_mode(instance)?;
    let unit = scene.units.time;
    let belt = instance.params.require(Param::BeltVelocity) / scene.units.velocity;
    let lambda = lambda * unit;
    let begun = amplitude(instance, unit, &scene.start(), lambda)?;
    let time = (first_event(&scene.model, belt, lambda, ratio) / begun).ln() / lambda.re * unit;
    (!time.is_nan()).then(|| time.max(0.0))
}

/// The amplitude of `ẋ2` that a state has in the mode of the eigenvalue `leading`; all scaled.
fn amplitude(instance: &Instance, unit: f64, state: &State, leading: Complex64) -> Option<f64> {
    let [x, _, y] = state.position;
    let [v, _, w] = state.velocity;
    // An oscillation is a mode and its conjugate.
    let pair = if leading.im == 0.0 { 1.0 } else { 2.0 };
    let share = if instance.params.require(Param::Theta) == 0.0 {
        // x2 = a exp(λ t) + b exp(λ' t), nothing of it in y1.
        let other = linear::single_mass(instance)?.map(|z| z * unit)[1];
        (v - other * x) / (leading - other)
    } else {
        let modes = linear::modes(instance)?.map(|(lambda, ratio)| (lambda * unit, ratio));
        // (x2, y1, ẋ2, ẏ1) = Σ a (1, r, λ, r λ)
        let columns = modes.map(|(lambda, ratio)| Vector4::new(1.0.into(), ratio, lambda, ratio * lambda));
        let start = Vector4::from([x, y, v, w].map(Complex64::from));
        let shares = Matrix4::from_columns(&columns).lu().solve(&start)?;
        let nearest = |k: &usize| (modes[*k].0 - leading).norm();
        shares[(0..4).min_by(|a, b| nearest(a).total_cmp(&nearest(b)))?]
    };
    Some(pair * (share * leading).norm())
}
