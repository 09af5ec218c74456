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

use crate::model::belt::Springs;
use crate::model::contact::Contact;
use crate::model::piece::Piece;
use crate::model::scaled::Scaled;

/// The largest order of the position series.
pub const MAX_ORDER: usize = 16;

/// Order of the position series of the reference: with 12 steps per `2π/ω0` its truncation is below
/// 1e-13 in contact and 1e-10 in flight with the paper's parameters.
pub const REFERENCE_ORDER: usize = 16;

/// Coefficients of one polynomial in local time, by degree.
pub type Series = [f64; MAX_ORDER + 1];

/// Coefficients of all components by degree.
pub type Coefficients = [[f64; 4]; MAX_ORDER + 1];

/// Components of the positions, velocities and accelerations.
pub const X2: usize = 0;
/// See [`X2`].
pub const Y2: usize = 1;
/// See [`X2`].
pub const Y1: usize = 2;

/// Components of the contact polynomials: the tangential force `T`.
pub const TANGENTIAL: usize = 0;
/// The normal force `N`.
pub const NORMAL: usize = 1;
/// The relative velocity `v = V − ẋ2`.
pub const RELATIVE: usize = 2;

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

/// A state with its accelerations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Position and velocity.
    pub state: State,
    /// Accelerations of `(x2, y2, y1)`.
    pub acceleration: [f64; 3],
}

/// Velocity and acceleration of the belt at the start of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeltMotion {
    /// Velocity.
    pub velocity: f64,
    /// Acceleration, constant over the step.
    pub acceleration: f64,
}

/// The series of the motion from one instant on; all components of one degree stand together.
#[derive(Clone, Debug)]
pub struct Expansion {
    /// Order of the position series.
    pub order: usize,
    /// The contact state on which the series holds.
    pub contact: Contact,
    /// Positions by degree `0..=order`; components [`X2`], [`Y2`], [`Y1`].
    position: Coefficients,
    /// Contact by degree; [`TANGENTIAL`] and [`NORMAL`] to `order − 2`, [`RELATIVE`] to `order − 1`.
    contact_series: Coefficients,
}

impl Expansion {
    /// Expands the motion from `state` on `contact`.
    #[must_use]
    pub fn new(model: &Scaled, order: usize, state: &State, contact: Contact, belt: BeltMotion) -> Self {
        let mut series = Expansion {
            order,
            contact,
            position: [[0.0; 4]; MAX_ORDER + 1],
            contact_series: [[0.0; 4]; MAX_ORDER + 1],
        };
        for axis in [X2, Y2, Y1] {
            series.position[0][axis] = state.position[axis];
            series.position[1][axis] = state.velocity[axis];
        }
        series.contact_series[0][RELATIVE] = belt.velocity - state.velocity[X2];
        match contact {
            Contact::Slip { sigma, piece } => series.slip(model, sigma, piece, belt),
            Contact::Stick => series.stick(model, belt),
            Contact::Free => series.free(model, belt),
        }
        series
    }

    /// The motion of another method: positions by degree, 0 above `order − 2`. The forces on the way are those that such
    /// a motion takes, `T = ẍ2 + R` and `N = W − κ ẍ2`; none in flight.
    #[must_use]
    pub fn from_positions(
        model: &Scaled,
        order: usize,
        position: Coefficients,
        contact: Contact,
        belt: BeltMotion,
    ) -> Self {
        let mut series = Expansion { order, contact, position, contact_series: [[0.0; 4]; MAX_ORDER + 1] };
        for k in 0..order {
            let velocity = (k + 1) as f64 * position[k + 1][X2];
            let drive = [belt.velocity, belt.acceleration].get(k).copied().unwrap_or_default();
            series.contact_series[k][RELATIVE] = drive - velocity;
        }
        if contact == Contact::Stick {
            series.contact_series.iter_mut().for_each(|of_degree| of_degree[RELATIVE] = 0.0);
        }
        if contact != Contact::Free {
            for k in 0..=order - 2 {
                let springs = series.springs(model, k);
                let (r, w) = if k == 0 { model.contact_loads(springs) } else { (springs.r, springs.w) };
                let a = ((k + 1) * (k + 2)) as f64 * position[k + 2][X2];
                series.contact_series[k][TANGENTIAL] = a + r;
                series.contact_series[k][NORMAL] = w - model.kappa * a;
            }
        }
        series
    }

    /// Springs of degree `k`.
    fn springs(&self, model: &Scaled, k: usize) -> Springs {
        let next = (k + 1) as f64;
        let [x2, y2, y1, _] = self.position[k];
        let [vx, vy, vw, _] = self.position[k + 1];
        model.springs([x2, y2, y1], [next * vx, next * vy, next * vw])
    }

    /// Sets the positions of degree `k + 2` from accelerations of degree `k`.
    fn push(&mut self, k: usize, [x2, y2, y1]: [f64; 3]) {
        let twice = 1.0 / ((k + 1) * (k + 2)) as f64;
        self.position[k + 2] = [x2 * twice, y2 * twice, y1 * twice, 0.0];
    }

    fn slip(&mut self, model: &Scaled, sigma: f64, piece: usize, belt: BeltMotion) {
        let (ahead, velocity) = (belt.velocity - model.v0, self.position[1][X2]);
        let beyond = model.friction_beyond_equilibrium(sigma, piece, ahead, velocity);
        let mut friction =
            FrictionSeries::new(model.law.pieces[piece], sigma, self.contact_series[0][RELATIVE]);
        let reciprocal_inertia = 1.0 / model.slip_inertia(friction.q[0]);
        let reciprocal_m1 = 1.0 / model.m1;
        for k in 0..=self.order - 2 {
            let springs = self.springs(model, k);
            let (mut force, mut tangential, mut normal) =
                (friction.q[0] * springs.w - springs.r, springs.r, springs.w);
            if k == 0 {
                // q W − R with the equilibrium's μ0 N0 cancelled by hand: no loss for small motions.
                force += beyond * model.n0;
                tangential += model.mu0 * model.n0;
                normal += model.n0;
            }
            // Σ q_j (W − κ a)_{k−j} with N = W − κ a of lower degree.
            for j in 1..=k.min(friction.degree) {
                force += friction.q[j] * self.contact_series[k - j][NORMAL];
            }
            let a = force * reciprocal_inertia;
            self.contact_series[k][NORMAL] = normal - model.kappa * a;
            self.contact_series[k][TANGENTIAL] = tangential + a;
            self.push(k, [a, 0.0, springs.h * reciprocal_m1]);
            let belt_acceleration = if k == 0 { belt.acceleration } else { 0.0 };
            self.contact_series[k + 1][RELATIVE] = (belt_acceleration - a) / (k + 1) as f64;
            friction.extend(&self.contact_series, k + 1);
        }
    }

    fn stick(&mut self, model: &Scaled, belt: BeltMotion) {
        self.position[1][X2] = belt.velocity;
        self.contact_series[0][RELATIVE] = 0.0;
        let reciprocal_m1 = 1.0 / model.m1;
        for k in 0..=self.order - 2 {
            let acceleration = if k == 0 { belt.acceleration } else { 0.0 };
            let springs = self.springs(model, k);
            let (r, w) = if k == 0 { model.contact_loads(springs) } else { (springs.r, springs.w) };
            self.contact_series[k][TANGENTIAL] = acceleration + r;
            self.contact_series[k][NORMAL] = w - model.kappa * acceleration;
            self.push(k, [acceleration, 0.0, springs.h * reciprocal_m1]);
        }
    }

    fn free(&mut self, model: &Scaled, belt: BeltMotion) {
        let (reciprocal_m1, reciprocal_det) = (1.0 / model.m1, 1.0 / model.det);
        for k in 0..=self.order - 2 {
            let springs = self.springs(model, k);
            let (r, w) = if k == 0 { model.contact_loads(springs) } else { (springs.r, springs.w) };
            // The inverse of the mass matrix is [m2 + m1 s², κ; κ, 1]/det.
            let ax = -(model.normal_mass * r + model.kappa * w) * reciprocal_det;
            let ay = -(model.kappa * r + w) * reciprocal_det;
            self.push(k, [ax, ay, springs.h * reciprocal_m1]);
            let belt_acceleration = if k == 0 { belt.acceleration } else { 0.0 };
            self.contact_series[k + 1][RELATIVE] = (belt_acceleration - ax) / (k + 1) as f64;
        }
    }

    /// The motion a time `tau` after the start.
    #[must_use]
    pub fn motion(&self, tau: f64) -> Motion {
        let (mut p, mut v, mut a) = ([0.0; 4], [0.0; 4], [0.0; 4]);
        for c in self.position[..=self.order].iter().rev() {
            for i in 0..4 {
                a[i] = a[i] * tau + v[i];
                v[i] = v[i] * tau + p[i];
                p[i] = p[i] * tau + c[i];
            }
        }
        Motion {
            state: State { position: [p[0], p[1], p[2]], velocity: [v[0], v[1], v[2]] },
            acceleration: [2.0 * a[0], 2.0 * a[1], 2.0 * a[2]],
        }
    }

    /// The contact forces `(T, N)` a time `tau` after the start.
    #[must_use]
    pub fn forces(&self, tau: f64) -> (f64, f64) {
        let (mut tangential, mut normal) = (0.0, 0.0);
        for c in self.contact_series[..=self.order - 2].iter().rev() {
            tangential = tangential * tau + c[TANGENTIAL];
            normal = normal * tau + c[NORMAL];
        }
        (tangential, normal)
    }

    /// The coefficients of `y2`, degrees `0..=order`.
    #[must_use]
    pub fn gap(&self) -> Series {
        std::array::from_fn(|k| self.position[k][Y2])
    }

    /// The coefficients of `ẋ2`, degrees `0..=order − 1`.
    #[must_use]
    pub fn tangential_velocity(&self) -> Series {
        std::array::from_fn(|k| if k < MAX_ORDER { (k + 1) as f64 * self.position[k + 1][X2] } else { 0.0 })
    }

    /// The coefficients of one acceleration, e.g. of [`X2`], degrees `0..=order − 2`.
    #[must_use]
    pub fn acceleration(&self, axis: usize) -> Series {
        let degree = |k: usize| ((k + 1) * (k + 2)) as f64;
        std::array::from_fn(|k| if k + 2 <= MAX_ORDER { degree(k) * self.position[k + 2][axis] } else { 0.0 })
    }

    /// The coefficients of one contact polynomial, e.g. [`NORMAL`].
    #[must_use]
    pub fn contact(&self, component: usize) -> Series {
        std::array::from_fn(|k| self.contact_series[k][component])
    }

    /// The relative velocity at the start, its first and its second rate of change.
    #[must_use]
    pub fn relative_motion(&self) -> [f64; 3] {
        let degree = |k: usize| self.contact_series[k][RELATIVE];
        [degree(0), degree(1), 2.0 * degree(2)]
    }

    /// The normal force at the start.
    #[must_use]
    pub fn normal_force(&self) -> f64 {
        self.contact_series[0][NORMAL]
    }

    /// The largest step, `nominal` halved as often as needed (at most `halvings` times), whose two last
    /// retained terms stay below `tolerance` relative to the terms of degree 0 to 2; `None` when none does.
    #[must_use]
    pub fn step(&self, nominal: f64, tolerance: f64, halvings: i32) -> Option<f64> {
        let largest = |degree: usize| self.position[degree].iter().fold(0.0_f64, |m, c| m.max(c.abs()));
        let leading = [largest(0), largest(1), largest(2)];
        let last = [largest(self.order - 1), largest(self.order)];
        let mut step = nominal;
        for _ in 0..=halvings {
            let power = (1..self.order).fold(1.0, |power, _| power * step);
            let size = leading[0].max(leading[1] * step).max(leading[2] * step * step);
            if last[0].max(last[1] * step) * power <= tolerance * size {
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
            Piece::Linear { slope, .. } => {
                if slope == 0.0 {
                    series.degree = 0;
                }
            }
            Piece::Exponential { rate, .. } => series.decay[0] = (-rate * speed).exp(),
            Piece::Rational { .. } => {}
        }
        series
    }

    /// Computes the coefficient of degree `k` from those of `v` up to `k`.
    fn extend(&mut self, contact: &Coefficients, k: usize) {
        if k > self.degree {
            return;
        }
        let relative = |j: usize| contact[j][RELATIVE];
        self.q[k] = match self.piece {
            Piece::Linear { slope, .. } => slope * relative(k),
            Piece::Exponential { height, rate, .. } => {
                let sum: f64 = (1..=k).map(|j| j as f64 * relative(j) * self.decay[k - j]).sum();
                self.decay[k] = -self.sigma * rate * sum / k as f64;
                self.sigma * height * self.decay[k]
            }
            Piece::Rational { decay, .. } => {
                let sum: f64 = (1..=k).map(|j| relative(j) * self.q[k - j]).sum();
                -decay * self.sigma * sum / (1.0 + decay * self.sigma * relative(0))
            }
        };
    }
}

/// `Σ c_k τ^k`.
#[must_use]
pub fn horner(coefficients: &[f64], tau: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * tau + c)
}

/// Value and derivative of `Σ c_k τ^k`.
#[must_use]
pub fn horner_with_derivative(coefficients: &[f64], tau: f64) -> (f64, f64) {
    coefficients.iter().rev().fold((0.0, 0.0), |(value, slope), c| (value * tau + c, slope * tau + value))
}

/// Value, first and second derivative of `Σ c_k τ^k`.
#[must_use]
pub fn horner_with_derivatives(coefficients: &[f64], tau: f64) -> [f64; 3] {
    let [value, slope, half] = coefficients
        .iter()
        .rev()
        .fold([0.0; 3], |[value, slope, half], c| [value * tau + c, slope * tau + value, half * tau + slope]);
    [value, slope, 2.0 * half]
}
