//! The classical Runge–Kutta step of order 4, for comparison with the reference.
//!
//! Of second-order equations it is a step of Nyström's kind: with the accelerations `a1 … a4` of its stages
//!
//! ```text
//! p(h) = p + h v + h² (a1 + a2 + a3)/6          v(h) = v + h (a1 + 2 a2 + 2 a3 + a4)/6
//! ```
//!
//! Its dense output is the polynomial of degree 5 through positions, velocities and accelerations of both ends: positions
//! within a step are off by `h⁵`, velocities by `h⁴`, forces by `h³`, which keeps order 4 through located events, since
//! forces do not jump where a force decides. It stands in the place of a Taylor series, so that event location,
//! transitions and observables are those of the reference.

use crate::engine::method::taylor::{BeltMotion, Coefficients, Expansion, State, X2};
use crate::model::contact::Contact;
use crate::model::scaled::Scaled;

/// Order of the series that holds the dense output: its forces, which go to degree `order − 2`, depend on positions
/// of degree 5 without a rest.
const ORDER: usize = 7;

/// In free flight the step is this part of that in contact: flight is 3.7 times as fast as slip with the paper's
/// parameters.
pub const IN_FLIGHT: f64 = 0.5;

/// A step over more than this many radians of a mode, or this many of its time constants, makes the mode grow instead of
/// ring down. The exact bounds are 2.828 without damping, and 2.785 where the mode does not oscillate.
pub const STABLE: f64 = 2.78;

/// The accelerations of `(x2, y2, y1)` on a contact state.
#[must_use]
pub fn accelerations(model: &Scaled, state: &State, contact: Contact, belt: BeltMotion) -> [f64; 3] {
    let springs = model.springs(state.position, state.velocity);
    let y1 = springs.h / model.m1;
    match contact {
        Contact::Slip { sigma, piece } => {
            let relative = belt.velocity - state.velocity[X2];
            let q = sigma * model.law.pieces[piece].mu(sigma * relative);
            let ahead = belt.velocity - model.v0;
            let beyond = model.friction_beyond_equilibrium(sigma, piece, ahead, state.velocity[X2]);
            // q W − R with the equilibrium's μ0 N0 cancelled by hand.
            let force = q * springs.w - springs.r + beyond * model.n0;
            [force / model.slip_inertia(q), 0.0, y1]
        }
        Contact::Stick => [belt.acceleration, 0.0, y1],
        Contact::Free => {
            let (r, w) = model.contact_loads(springs);
            let x2 = -(model.normal_mass * r + model.kappa * w) / model.det;
            [x2, -(model.kappa * r + w) / model.det, y1]
        }
    }
}

/// The motion from `state` on `contact` as a step of length `step` (in units of `1/ω0`) has it.
#[must_use]
pub fn expand(model: &Scaled, state: &State, contact: Contact, belt: BeltMotion, step: f64) -> Expansion {
    let mut start = *state;
    if contact == Contact::Stick {
        start.velocity[X2] = belt.velocity;
    }
    let State { position, velocity } = start;
    // Position and velocity after `time`: p + time v + bend, v + time a.
    let stage = |time: f64, bend: [f64; 3], a: [f64; 3]| {
        let state = State {
            position: std::array::from_fn(|i| position[i] + time * velocity[i] + bend[i]),
            velocity: std::array::from_fn(|i| velocity[i] + time * a[i]),
        };
        let then = BeltMotion { velocity: belt.velocity + belt.acceleration * time, ..belt };
        accelerations(model, &state, contact, then)
    };
    let (half, square) = (0.5 * step, step * step);
    let a1 = accelerations(model, &start, contact, belt);
    let a2 = stage(half, [0.0; 3], a1);
    let a3 = stage(half, a1.map(|a| 0.25 * square * a), a2);
    let a4 = stage(step, a2.map(|a| 0.5 * square * a), a3);
    let bend: [f64; 3] = std::array::from_fn(|i| square * (a1[i] + a2[i] + a3[i]) / 6.0);
    let mean: [f64; 3] = std::array::from_fn(|i| (a1[i] + 2.0 * (a2[i] + a3[i]) + a4[i]) / 6.0);
    let end = stage(step, bend, mean);
    let mut series: Coefficients = [[0.0; 4]; _];
    for i in 0..3 {
        // What both ends are beyond p + τ v + τ² a1/2, in units in which the step is 1.
        let p = bend[i] - 0.5 * square * a1[i];
        let v = square * (mean[i] - a1[i]);
        let a = square * (end[i] - a1[i]);
        let scaled = [
            position[i],
            step * velocity[i],
            0.5 * square * a1[i],
            10.0 * p - 4.0 * v + 0.5 * a,
            -15.0 * p + 7.0 * v - a,
            6.0 * p - 3.0 * v + 0.5 * a,
        ];
        let mut power = 1.0;
        for (coefficients, value) in series.iter_mut().zip(scaled) {
            coefficients[i] = value * power;
            power /= step;
        }
    }
    Expansion::from_positions(model, ORDER, series, contact, belt)
}
