//! Where a transient starts, scaled: a kick of the sliding equilibrium, or its leading mode.

use num_complex::Complex64;

use crate::engine::method::taylor::State;
use crate::model::equilibrium::Units;
use crate::model::instance::Instance;
use crate::model::scaled::Scaled;
use crate::model::{Param, Params, linear};

/// The sliding equilibrium plus `start_velocity` and `start_displacement`.
pub(crate) fn kick(params: &Params, units: &Units) -> State {
    let mut state = State::default();
    state.position[0] = params.require(Param::StartDisplacement) / units.length;
    state.velocity[0] = params.require(Param::StartVelocity) / units.velocity;
    state
}

/// The most unstable mode where `ẋ2` is largest. Its amplitude in `ẋ2` is `start_event_fraction` of that at
/// which the mode first meets an event, else `start_fraction` of the belt velocity.
pub(crate) fn mode(instance: &Instance, units: &Units, model: &Scaled) -> State {
    let params = &instance.params;
    let mut state = State::default();
    let Some((lambda, ratio)) = linear::leading_mode(instance) else { return state };
    let belt = params.require(Param::BeltVelocity) / units.velocity;
    let lambda = lambda * units.time;
    let velocity = match params.get(Param::StartEventFraction) {
        Some(fraction) => fraction * first_event(model, belt, lambda, ratio),
        None => params.require(Param::StartFraction) * belt,
    };
    let position = velocity / lambda;
    state.position = [position.re, 0.0, (position * ratio).re];
    state.velocity = [velocity, 0.0, (velocity * ratio).re];
    state
}

/// The amplitude of `ẋ2` at which a motion on a mode first meets an event: the belt velocity, a kink of the friction law, or
/// the normal force of the equilibrium. The growth within a period is left out.
pub(crate) fn first_event(model: &Scaled, belt: f64, lambda: Complex64, ratio: Complex64) -> f64 {
    // Of the mode with a velocity of 1: x2 = 1/λ, y1 = r/λ, ẍ2 = λ.
    let (x, y, v, w) = (1.0 / lambda, ratio / lambda, Complex64::ONE, ratio);
    let normal_spring = model.k2 * (x * model.s - y) + model.c2 * (v * model.s - w);
    let tangential_spring = (model.k1 * x + model.c1 * v) * model.c;
    let force = model.c * normal_spring - model.s * tangential_spring - model.kappa * lambda;
    let to_kinks = model.law.kinks.iter().map(|kink| (belt - kink).abs()).filter(|distance| *distance > 0.0);
    to_kinks.fold(belt.min(model.n0 / force.norm()), f64::min)
}
