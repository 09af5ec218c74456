//! The reference method: the Taylor series of the motion on one contact state.
//!
//! On one contact state and one piece of the friction law the motion is analytic. Its series follows
//! from the equations by recurrence: every force is linear in the state, and the only products are
//! those of the friction coefficient with forces and inertia,
//!
//! ```text
//! a (1 + κ q) = q W − R   ⇒   a_k = (Σ_j q_j W_{k−j} − R_k − κ Σ_{j≥1} q_j a_{k−j}) / (1 + κ q_0).
//! ```
//!
//! The series is the step, its dense output, its error estimate and the event functions at once
//! (J. Guckenheimer, B. Meloon, SIAM J. Sci. Comput. 22, 951 (2000); Á. Jorba, M. Zou, Exp. Math. 14, 99 (2005)).

use crate::model::contact::Contact;
use crate::model::equilibrium::Scaled;
use crate::model::friction::Piece;

/// The largest order of the position series.
pub const MAX_ORDER: usize = 16;

/// Order of the position series of the reference: with 12 steps per `2π/ω0` its truncation is below
/// 1e-13 in contact and 1e-10 in flight with the paper's parameters.
pub const REFERENCE_ORDER: usize = 14;

/// The coefficients of a polynomial in local time.
pub type Series = [f64; MAX_ORDER + 1];

/// Position, velocity: `(x2, y2, y1)` as deviations from the equilibrium.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    /// Positions.
    pub position: [f64; 3],
    /// Velocities.
    pub velocity: [f64; 3],
}

impl State {
    /// Whether every component is a finite number.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.position.iter().chain(&self.velocity).all(|value| value.is_finite())
    }
}

/// Velocity and acceleration of the belt at the start of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeltMotion {
    /// Velocity.
    pub velocity: f64,
    /// Acceleration, constant over the step.
    pub acceleration: f64,
}

/// The series of the motion from one instant on.
#[derive(Clone, Debug)]
pub struct Expansion {
    /// Order of the position series.
    pub order: usize,
    /// The contact state on which the series holds.
    pub contact: Contact,
    /// Positions `(x2, y2, y1)`, degrees `0..=order`.
    pub position: [Series; 3],
    /// Tangential contact force `T`, degrees `0..=order − 2`.
    pub tangential: Series,
    /// Normal contact force `N`, degrees `0..=order − 2`.
    pub normal: Series,
    /// Relative velocity `v = V − ẋ2`, degrees `0..=order − 1`.
    pub relative: Series,
}

impl Expansion {
    /// Expands the motion from `state` on `contact`.
    #[must_use]
    pub fn new(model: &Scaled, order: usize, state: &State, contact: Contact, belt: BeltMotion) -> Self {
        let mut series = Expansion {
            order,
            contact,
            position: [[0.0; MAX_ORDER + 1]; 3],
            tangential: [0.0; MAX_ORDER + 1],
            normal: [0.0; MAX_ORDER + 1],
            relative: [0.0; MAX_ORDER + 1],
        };
        for (axis, coefficients) in series.position.iter_mut().enumerate() {
            coefficients[0] = state.position[axis];
            coefficients[1] = state.velocity[axis];
        }
        series.relative[0] = belt.velocity - state.velocity[0];
        match contact {
            Contact::Slip { sigma, piece } => series.slip(model, sigma, model.law.pieces[piece], belt),
            Contact::Stick => series.stick(model, belt),
            Contact::Free => series.free(model, belt),
        }
        series
    }

    /// Sets the coefficients of degree `k + 2` of the positions from accelerations of degree `k`.
    fn push(&mut self, k: usize, acceleration: [f64; 3]) {
        let divisor = ((k + 1) * (k + 2)) as f64;
        for (series, value) in self.position.iter_mut().zip(acceleration) {
            series[k + 2] = value / divisor;
        }
    }

    /// Position and velocity coefficients of degree `k`.
    fn coefficient(&self, k: usize) -> ([f64; 3], [f64; 3]) {
        let next = (k + 1) as f64;
        (self.position.map(|series| series[k]), self.position.map(|series| next * series[k + 1]))
    }

    fn slip(&mut self, model: &Scaled, sigma: f64, piece: Piece, belt: BeltMotion) {
        let mut friction = FrictionSeries::new(piece, sigma, self.relative[0]);
        let mut a: Series = [0.0; MAX_ORDER + 1];
        let mut w: Series = [0.0; MAX_ORDER + 1];
        let inertia = model.slip_inertia(friction.q[0]);
        for k in 0..=self.order - 2 {
            let (position, velocity) = self.coefficient(k);
            let springs = model.springs(position, velocity);
            let mut force = if k == 0 {
                // q W − R with the equilibrium's μ0 N0 cancelled by hand: no loss for small motions.
                w[0] = springs.w + model.n0;
                (friction.q[0] - model.mu0) * model.n0 + friction.q[0] * springs.w - springs.r
            } else {
                w[k] = springs.w;
                friction.q[0] * springs.w - springs.r
            };
            // q_j multiplies W − κ a = N of lower degree, and W of degree 0 is known.
            for j in 1..=k.min(friction.degree) {
                force += friction.q[j] * self.normal[k - j];
            }
            a[k] = force / inertia;
            self.normal[k] = w[k] - model.kappa * a[k];
            self.tangential[k] = a[k] + springs.r + if k == 0 { model.mu0 * model.n0 } else { 0.0 };
            self.push(k, [a[k], 0.0, springs.h / model.m1]);
            self.relative[k + 1] = (if k == 0 { belt.acceleration } else { 0.0 } - a[k]) / (k + 1) as f64;
            friction.extend(&self.relative, k + 1);
        }
    }

    fn stick(&mut self, model: &Scaled, belt: BeltMotion) {
        self.position[0][1] = belt.velocity;
        self.relative[0] = 0.0;
        for k in 0..=self.order - 2 {
            let acceleration = if k == 0 { belt.acceleration } else { 0.0 };
            let (position, velocity) = self.coefficient(k);
            let springs = model.springs(position, velocity);
            let (r, w) = if k == 0 { model.contact_loads(springs) } else { (springs.r, springs.w) };
            self.tangential[k] = acceleration + r;
            self.normal[k] = w - model.kappa * acceleration;
            self.push(k, [acceleration, 0.0, springs.h / model.m1]);
        }
    }

    fn free(&mut self, model: &Scaled, belt: BeltMotion) {
        self.relative[1] = belt.acceleration;
        for k in 0..=self.order - 2 {
            let (position, velocity) = self.coefficient(k);
            let springs = model.springs(position, velocity);
            let (r, w) = if k == 0 { model.contact_loads(springs) } else { (springs.r, springs.w) };
            // The inverse of the mass matrix is [m2 + m1 s², κ; κ, 1]/det.
            let ax = -(model.normal_mass * r + model.kappa * w) / model.det;
            let ay = -(model.kappa * r + w) / model.det;
            self.push(k, [ax, ay, springs.h / model.m1]);
            self.relative[k + 1] -= ax / (k + 1) as f64;
        }
    }

    /// The state a time `tau` after the start.
    #[must_use]
    pub fn state(&self, tau: f64) -> State {
        State {
            position: self.position.map(|series| horner(&series[..=self.order], tau)),
            velocity: self.position.map(|series| horner_derivative(&series[..=self.order], tau)),
        }
    }

    /// The accelerations a time `tau` after the start.
    #[must_use]
    pub fn acceleration(&self, tau: f64) -> [f64; 3] {
        self.position.map(|series| horner_second_derivative(&series[..=self.order], tau))
    }

    /// The contact forces `(T, N)` a time `tau` after the start.
    #[must_use]
    pub fn forces(&self, tau: f64) -> (f64, f64) {
        let last = self.order - 2;
        (horner(&self.tangential[..=last], tau), horner(&self.normal[..=last], tau))
    }

    /// The largest step, `nominal` halved as often as needed (at most `halvings` times), whose two last
    /// retained terms stay below `tolerance` relative to the terms of degree 0 to 2; `None` when none does.
    #[must_use]
    pub fn step(&self, nominal: f64, tolerance: f64, halvings: u32) -> Option<f64> {
        let mut step = nominal;
        for _ in 0..=halvings {
            let power = step.powi(i32::try_from(self.order - 1).unwrap_or(i32::MAX));
            let mut size = 0.0_f64;
            let mut rest = 0.0_f64;
            for series in &self.position {
                size = size.max(series[0].abs()).max((series[1] * step).abs());
                size = size.max((series[2] * step * step).abs());
                rest = rest.max(series[self.order - 1].abs().max((series[self.order] * step).abs()) * power);
            }
            if rest <= tolerance * size {
                return Some(step);
            }
            step *= 0.5;
        }
        None
    }
}

/// The series of the signed friction coefficient `q = σ μ(σ v)` along that of `v`.
struct FrictionSeries {
    piece: Piece,
    sigma: f64,
    /// Coefficients of `q`.
    q: Series,
    /// The highest degree that can differ from 0.
    degree: usize,
    /// Coefficients of the exponential.
    decay: Series,
}

impl FrictionSeries {
    fn new(piece: Piece, sigma: f64, relative: f64) -> Self {
        let speed = sigma * relative;
        let mut series = FrictionSeries {
            piece,
            sigma,
            q: [0.0; MAX_ORDER + 1],
            degree: MAX_ORDER,
            decay: [0.0; MAX_ORDER + 1],
        };
        series.q[0] = sigma * piece.mu(speed);
        match piece {
            Piece::Linear { slope, .. } if slope == 0.0 => series.degree = 0,
            Piece::Exponential { rate, .. } => series.decay[0] = (-rate * speed).exp(),
            _ => {}
        }
        series
    }

    /// Computes the coefficient of degree `k` from those of `v` up to `k`.
    fn extend(&mut self, relative: &Series, k: usize) {
        if k > self.degree {
            return;
        }
        self.q[k] = match self.piece {
            Piece::Linear { slope, .. } => slope * relative[k],
            Piece::Exponential { height, rate, .. } => {
                let sum: f64 = (1..=k).map(|j| j as f64 * relative[j] * self.decay[k - j]).sum();
                self.decay[k] = -self.sigma * rate * sum / k as f64;
                self.sigma * height * self.decay[k]
            }
            Piece::Rational { decay, .. } => {
                let sum: f64 = (1..=k).map(|j| relative[j] * self.q[k - j]).sum();
                -decay * self.sigma * sum / (1.0 + decay * self.sigma * relative[0])
            }
        };
    }
}

/// `Σ c_k τ^k`.
#[must_use]
pub fn horner(coefficients: &[f64], tau: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * tau + c)
}

/// `d/dτ Σ c_k τ^k`.
#[must_use]
pub fn horner_derivative(coefficients: &[f64], tau: f64) -> f64 {
    let terms = coefficients.iter().enumerate().skip(1).rev();
    terms.fold(0.0, |sum, (k, c)| sum * tau + k as f64 * c)
}

/// `d²/dτ² Σ c_k τ^k`.
#[must_use]
pub fn horner_second_derivative(coefficients: &[f64], tau: f64) -> f64 {
    let terms = coefficients.iter().enumerate().skip(2).rev();
    terms.fold(0.0, |sum, (k, c)| sum * tau + (k * (k - 1)) as f64 * c)
}
