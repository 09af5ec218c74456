//! Twin: shaders/series.wgsl
//!
//! The Taylor series of the motion on one contact state.
//!
//! The recurrence of [`crate::engine::method::taylor`] at a fixed order, written so that a lane of a GPU runs it:
//! deviations from the equilibrium with every constant that cancels formed on the host in f64.

#![expect(clippy::needless_range_loop, reason = "the loops are those of the WGSL twin")]

use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::scene::{Piece, Scene};
use crate::engine::kernel::steps::ORDER;
use crate::model::piece::LawForm;

/// Coefficients by degree.
pub type Series<S> = [S; ORDER + 1];

/// Slip with `v > 0`.
pub const SLIP: u32 = 0;
/// Slip with `v < 0`.
pub const REVERSE: u32 = 1;
/// Stick.
pub const STICK: u32 = 2;
/// Free flight.
pub const FREE: u32 = 3;

/// Position and velocity, deviations from the equilibrium: `x2 y2 y1`.
#[derive(Clone, Copy, Debug)]
pub struct Body<S> {
    /// Positions.
    pub p: [S; 3],
    /// Velocities.
    pub v: [S; 3],
}

/// The series of one step.
#[derive(Clone, Copy, Debug)]
pub struct Expansion<S> {
    /// `x2`.
    pub x: Series<S>,
    /// `y2`.
    pub y: Series<S>,
    /// `y1`.
    pub w: Series<S>,
    /// Tangential force less `μ0 N0`.
    pub t: Series<S>,
    /// Normal force `N`.
    pub n: Series<S>,
    /// Relative velocity `v`.
    pub v: Series<S>,
}

/// `h − F`, `R − μ0 N0`, `W − N0` of degree `k`.
fn springs<S: Real>(scene: &Scene<S>, e: &Expansion<S>, k: usize) -> [S; 3] {
    let next = S::from_f64((k + 1) as f64);
    let (x, y, w) = (e.x[k], e.y[k], e.w[k]);
    let (vx, vy, vw) = (next * e.x[k + 1], next * e.y[k + 1], next * e.w[k + 1]);
    let h = scene.k2 * (x * scene.s + y * scene.c - w) + scene.c2 * (vx * scene.s + vy * scene.c - vw);
    let g = scene.k1 * (x * scene.c - y * scene.s) + scene.c1 * (vx * scene.c - vy * scene.s);
    [h, scene.c * g + scene.s * h, scene.c * h - scene.s * g]
}

/// Sets the positions of degree `k + 2` from the accelerations of degree `k`.
fn push<S: Real>(e: &mut Expansion<S>, k: usize, ax: S, ay: S, aw: S) {
    let twice = S::ONE / S::from_f64(((k + 1) * (k + 2)) as f64);
    e.x[k + 2] = ax * twice;
    e.y[k + 2] = ay * twice;
    e.w[k + 2] = aw * twice;
}

/// Expands the motion from `body` on `contact`; `lag = ẋ2 − (V − V0)` replaces the velocity in the law.
pub fn expand<S: Real>(
    scene: &Scene<S>,
    body: &Body<S>,
    contact: u32,
    piece: &Piece<S>,
    belt_velocity: S,
    belt_acceleration: S,
) -> Expansion<S> {
    let zero = [S::ZERO; ORDER + 1];
    let mut e = Expansion { x: zero, y: zero, w: zero, t: zero, n: zero, v: zero };
    e.x[0] = body.p[0];
    e.y[0] = body.p[1];
    e.w[0] = body.p[2];
    e.x[1] = body.v[0];
    e.y[1] = body.v[1];
    e.w[1] = body.v[2];
    e.v[0] = belt_velocity - body.v[0];
    if contact == STICK {
        e.x[1] = belt_velocity;
        e.v[0] = S::ZERO;
        expand_stick(scene, &mut e, belt_acceleration);
    } else if contact == FREE {
        expand_free(scene, &mut e, belt_acceleration);
    } else {
        let sigma = if contact == SLIP { S::ONE } else { -S::ONE };
        expand_slip(scene, &mut e, sigma, piece, belt_velocity, belt_acceleration);
    }
    e
}

fn expand_slip<S: Real>(
    scene: &Scene<S>,
    e: &mut Expansion<S>,
    sigma: S,
    piece: &Piece<S>,
    belt_velocity: S,
    belt_acceleration: S,
) {
    let mut q = [S::ZERO; ORDER + 1];
    let mut decay = [S::ZERO; ORDER + 1];
    let lag = e.x[1] - (belt_velocity - scene.v0);
    let (q0, q0_less_mu0) = scene.friction(piece, sigma, e.v[0], lag);
    q[0] = q0;
    match scene.law {
        LawForm::Exponential => decay[0] = sigma * q0 - piece.at_zero,
        LawForm::Pieces | LawForm::Rational => {}
    }
    let reciprocal_inertia = S::ONE / (S::ONE + scene.kappa * q0);
    for k in 0..=ORDER - 2 {
        let [h, r, w] = springs(scene, e, k);
        let mut force = q0 * w - r;
        let mut normal = w;
        if k == 0 {
            force += q0_less_mu0 * scene.n0;
            normal += scene.n0;
        }
        for j in 1..=k {
            force += q[j] * e.n[k - j];
        }
        let a = force * reciprocal_inertia;
        e.n[k] = normal - scene.kappa * a;
        e.t[k] = r + a;
        push(e, k, a, S::ZERO, h * scene.inv_m1);
        let drive = if k == 0 { belt_acceleration } else { S::ZERO };
        e.v[k + 1] = (drive - a) / S::from_f64((k + 1) as f64);
        q[k + 1] = friction_term(scene, piece, sigma, &e.v, &q, &mut decay, k + 1);
    }
}

/// The coefficient of degree `k` of `q = σ μ(σ v)`.
fn friction_term<S: Real>(
    scene: &Scene<S>,
    piece: &Piece<S>,
    sigma: S,
    v: &Series<S>,
    q: &Series<S>,
    decay: &mut Series<S>,
    k: usize,
) -> S {
    match scene.law {
        LawForm::Pieces => piece.slope * v[k],
        LawForm::Exponential => {
            let mut sum = S::ZERO;
            for j in 1..=k {
                sum += S::from_f64(j as f64) * v[j] * decay[k - j];
            }
            decay[k] = -(sigma * piece.rate * sum) / S::from_f64(k as f64);
            sigma * decay[k]
        }
        LawForm::Rational => {
            let mut sum = S::ZERO;
            for j in 1..=k {
                sum += v[j] * q[k - j];
            }
            -(piece.rate * sigma * sum) / (S::ONE + piece.rate * sigma * v[0])
        }
    }
}

fn expand_stick<S: Real>(scene: &Scene<S>, e: &mut Expansion<S>, belt_acceleration: S) {
    for k in 0..=ORDER - 2 {
        let drive = if k == 0 { belt_acceleration } else { S::ZERO };
        let [h, r, w] = springs(scene, e, k);
        let normal = if k == 0 { w + scene.n0 } else { w };
        e.t[k] = r + drive;
        e.n[k] = normal - scene.kappa * drive;
        push(e, k, drive, S::ZERO, h * scene.inv_m1);
    }
}

fn expand_free<S: Real>(scene: &Scene<S>, e: &mut Expansion<S>, belt_acceleration: S) {
    for k in 0..=ORDER - 2 {
        let [h, dr, dw] = springs(scene, e, k);
        let mut r = dr;
        let mut w = dw;
        let mut drive = S::ZERO;
        if k == 0 {
            r += scene.t0;
            w += scene.n0;
            drive = belt_acceleration;
        }
        let ax = -(scene.normal_mass * r + scene.kappa * w) * scene.inv_det;
        let ay = -(scene.kappa * r + w) * scene.inv_det;
        push(e, k, ax, ay, h * scene.inv_m1);
        e.v[k + 1] = (drive - ax) / S::from_f64((k + 1) as f64);
    }
}

/// Value, derivative and second derivative of a series at `tau`.
pub fn evaluate<S: Real>(c: &Series<S>, tau: S) -> [S; 3] {
    let mut p = S::ZERO;
    let mut v = S::ZERO;
    let mut a = S::ZERO;
    for k in (0..=ORDER).rev() {
        a = a * tau + v;
        v = v * tau + p;
        p = p * tau + c[k];
    }
    [p, v, a + a]
}

/// Value of a series at `tau`.
pub fn value<S: Real>(c: &Series<S>, tau: S) -> S {
    let mut p = S::ZERO;
    for k in (0..=ORDER).rev() {
        p = p * tau + c[k];
    }
    p
}

/// The largest magnitude of the positions' terms of degree `k`.
pub fn largest<S: Real>(e: &Expansion<S>, k: usize) -> S {
    e.x[k].abs().max(e.y[k].abs()).max(e.w[k].abs())
}

/// The largest step from `longest` down by halves whose two last terms stay below `tolerance` relative to
/// the leading ones; 0 when none does.
pub fn step_length<S: Real>(e: &Expansion<S>, longest: S, tolerance: S) -> S {
    let (l0, l1, l2) = (largest(e, 0), largest(e, 1), largest(e, 2));
    let (f7, f8) = (largest(e, ORDER - 1), largest(e, ORDER));
    let mut step = longest;
    for _ in 0..MAX_HALVINGS {
        let square = step * step;
        let power = square * square * square * step;
        let size = l0.max(l1 * step).max(l2 * square);
        if f7.max(f8 * step) * power <= tolerance * size {
            return step;
        }
        step *= S::from_f64(0.5);
    }
    S::ZERO
}

/// Most halvings of a step.
pub const MAX_HALVINGS: usize = 24;
