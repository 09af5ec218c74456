//! How fast the quickest mode of each contact state is. A step has to resolve it even where it is hardly excited.
//!
//! A bound on the truncation of the motion does not see such a mode, since it adds nothing to the motion's size. But a step
//! that is too long for the mode lets it grow from rounding errors up to that bound, and in an acceleration it counts with
//! the square of its frequency.

use crate::model::equilibrium::{Equilibrium, Units};
use crate::model::{Param, Params};

/// Magnitudes of the largest eigenvalue of slip, reversed slip, stick and free flight, scaled; infinite where the
/// dynamics is not unique, 0 where nothing moves.
pub type Fastest = [f64; 4];

/// Two coupled oscillators or one: accelerations per displacement and per velocity, rows of `x2` and `y1`.
struct Modes {
    stiffness: [[f64; 2]; 2],
    damping: [[f64; 2]; 2],
}

impl Modes {
    /// A bound on the magnitude of the eigenvalues, sharp for weak coupling: `λ² ≤ γ λ + Ω²`.
    fn fastest(&self) -> f64 {
        let (square, decay) = (radius(self.stiffness), radius(self.damping));
        0.5 * (decay + (decay * decay + 4.0 * square).sqrt())
    }
}

/// The spectral radius of a matrix, its coupling taken to add.
fn radius([[a, b], [c, d]]: [[f64; 2]; 2]) -> f64 {
    let (a, d) = (a.abs(), d.abs());
    0.5 * (a + d) + (0.25 * (a - d).powi(2) + (b * c).abs()).sqrt()
}

/// The fastest mode of each contact state around a sliding equilibrium.
///
/// Of the friction law only a rising slope at the equilibrium counts: it holds the motion where it is. A falling one
/// drives it away, and then it is the motion.
#[must_use]
pub fn fastest(params: &Params, units: &Units, equilibrium: &Equilibrium) -> Fastest {
    let value = |param| params.require(param);
    let (m1, m2) = (value(Param::M1), value(Param::M2));
    let (s, c) = value(Param::Theta).sin_cos();
    let (mass, time) = (m2 + m1 * c * c, units.time);
    let springs = [value(Param::K1), value(Param::K2)].map(|k| k / mass * time * time);
    let dampers = [value(Param::C1), value(Param::C2)].map(|d| d / mass * time);
    let (m1, m2) = (m1 / mass, m2 / mass);
    let rise = equilibrium.slope.max(0.0) * equilibrium.normal_force / mass * time;

    let slip = |q: f64| {
        let inertia = 1.0 + q * m1 * s * c;
        if inertia <= 0.0 {
            return f64::INFINITY;
        }
        // Without an inclination y1 rests.
        let moves = f64::from(u8::from(s != 0.0));
        let rows = |[along, across]: [f64; 2], rise: f64| {
            let x = (along * c * (c + q * s) + across * s * (s - q * c) + rise) / inertia;
            [[x, moves * across * (s - q * c) / inertia], [moves * across * s / m1, moves * across / m1]]
        };
        Modes { stiffness: rows(springs, 0.0), damping: rows(dampers, rise) }.fastest()
    };
    let single = |mass: f64, i: usize| {
        let one = |value: f64| [[value / mass, 0.0], [0.0, 0.0]];
        Modes { stiffness: one(springs[i]), damping: one(dampers[i]) }.fastest()
    };
    let stick = if s == 0.0 { 0.0 } else { single(m1, 1) };
    let free = single(m1 + m2, 0).max(single(m1 * m2 / (m1 + m2), 1));
    [slip(equilibrium.mu), slip(-equilibrium.mu), stick, free]
}
