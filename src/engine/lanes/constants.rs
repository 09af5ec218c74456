//! The numbers of a scene that a step needs in every lane.

use crate::engine::kernel::scalar::Real;
use crate::engine::lanes::words::NO_KINK;
use crate::engine::method::pace::Turns;
use crate::model::scaled::Scaled;

/// The largest decay rate of a mass that swings, in units of its angular frequency.
const MOST_DECAY: f64 = 0.3;

/// `R`, the tangential spring force: coefficients of `x2 y2 y1` and of their velocities, as in the forms below.
pub const R: usize = 0;
/// `W`, the normal spring force.
pub const W: usize = 6;
/// The acceleration of `m1`.
pub const H: usize = 12;
/// The tangential acceleration of `m2` in free flight.
pub const FLIGHT_X: usize = 18;
/// The normal acceleration of `m2` in free flight.
pub const FLIGHT_Y: usize = 24;
/// Both in free flight at the equilibrium.
pub const FALL: usize = 30;
/// `κ = m1 s c`.
pub const KAPPA: usize = 32;
/// Normal force of the equilibrium.
pub const N0: usize = 33;
/// Tangential force of the equilibrium.
pub const T0: usize = 34;
/// μ of the equilibrium.
pub const MU0: usize = 35;
/// Belt velocity of the equilibrium.
pub const V0: usize = 36;
/// Limit of stick.
pub const MU_STICK: usize = 37;
/// Margins of the stick cone at the equilibrium, forwards and backwards.
pub const CONE: usize = 38;
/// `k1 + k2`: a bound on what a change of position does to a force.
pub const STIFFNESS: usize = 40;
/// `1/det` of the mass matrix of `(x2, y2)`.
pub const INV_DET: usize = 41;
/// The longest step of slip, of reversed slip, of free flight, of stick.
pub const LONGEST: usize = 42;
/// `m2 + m1 s²`.
pub const NORMAL_MASS: usize = 46;
/// Newton restitution.
pub const RESTITUTION: usize = 47;
/// 1 with a Coulomb impulse, else 0.
pub const IMPACT_FRICTION: usize = 48;
/// Of the free oscillation of the single mass: decay rate, angular frequency and its inverse, the inverse of the stiffness,
/// and by how much of a turn a velocity is less than a quarter ahead of its position. All 0 where it does not swing.
pub const SWING: usize = 49;
/// How far a step of a curved law may go, see [`crate::engine::method::pace::Layer::inverses`].
pub const LAYER: usize = 54;
/// The number of constants of an instance.
pub const CONSTANTS: usize = 56;

/// The constants that steps in closed form need.
pub const SWING_WORDS: [usize; 12] =
    [R, R + 3, N0, T0, MU0, CONE, CONE + 1, SWING, SWING + 1, SWING + 2, SWING + 3, SWING + 4];

/// The constants of a scene whose steps may `turn` that far.
#[must_use]
pub fn constants<T: Real>(model: &Scaled, turns: &Turns) -> [T; CONSTANTS] {
    let rows = model.rows();
    let (n0, t0) = (model.n0, model.mu0 * model.n0);
    let mut all = [T::ZERO; CONSTANTS];
    let mut put = |at: usize, values: &[f64]| {
        for (word, value) in all[at..].iter_mut().zip(values) {
            *word = T::from_f64(*value);
        }
    };
    let [along, away] = &rows.flight;
    for (at, form) in
        [(R, &rows.tangential), (W, &rows.normal), (H, &rows.beyond), (FLIGHT_X, along), (FLIGHT_Y, away)]
    {
        put(at, &form.positions);
        put(at + form.positions.len(), &form.velocities);
    }
    put(FALL, &rows.fall);
    put(KAPPA, &[model.kappa]);
    put(N0, &[n0]);
    put(T0, &[t0]);
    put(MU0, &[model.mu0]);
    put(MU_STICK, &[model.law.mu_stick]);
    put(CONE, &[(model.law.mu_stick - model.mu0) * n0, (model.law.mu_stick + model.mu0) * n0]);
    put(STIFFNESS, &[model.k1 + model.k2]);
    put(INV_DET, &[1.0 / model.det]);
    let [slip, reverse, stick, free] = turns.longest_steps(&model.fastest);
    put(LONGEST, &[slip, reverse, free, stick].map(|step| step.min(NO_KINK)));
    put(NORMAL_MASS, &[model.normal_mass]);
    put(RESTITUTION, &[model.restitution]);
    put(IMPACT_FRICTION, &[f64::from(u8::from(model.impact_friction))]);
    put(SWING, &swing(rows.tangential.positions[0], rows.tangential.velocities[0]));
    put(LAYER, &turns.layer().inverses(model.law.form()));
    all
}

/// The constants at [`SWING`] for a mass of 1 with this stiffness and this damper.
fn swing(stiffness: f64, damper: f64) -> [f64; 5] {
    let decay = 0.5 * damper;
    let square = stiffness - decay * decay;
    if !(decay >= 0.0 && square > 0.0 && decay * decay <= MOST_DECAY * MOST_DECAY * square) {
        return [0.0; 5];
    }
    let omega = square.sqrt();
    // So little that nothing is lost, and that f32 may not be able to divide by.
    let decay = if decay < 1e-18 * omega { 0.0 } else { decay };
    [decay, omega, 1.0 / omega, 1.0 / stiffness, decay.atan2(omega)]
}
