//! Contact states, transitions and impact.

/// The state of the contact between `m2` and the belt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactState {
    /// Sliding, `v = V − ẋ2 > 0`.
    Slip,
    /// Sliding with `v < 0`: the mass overtakes the belt.
    Reverse,
    /// No relative velocity.
    Stick,
    /// Detached: `y2 > 0`, no contact forces.
    Free,
}

impl ContactState {
    /// All contact states.
    pub const ALL: [ContactState; 4] =
        [ContactState::Slip, ContactState::Reverse, ContactState::Stick, ContactState::Free];

    /// The name in a trace file.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            ContactState::Slip => "slip",
            ContactState::Reverse => "reverse",
            ContactState::Stick => "stick",
            ContactState::Free => "free",
        }
    }
}

use crate::model::belt::Springs;
use crate::model::scaled::Scaled;
use crate::model::status::Status;

/// A rebound slower than this, in units of `ω0 F_ext/k2`, closes the contact.
pub const SLOWEST_REBOUND: f64 = 1e-6;

/// Relative gain of kinetic energy from which an impact is counted as gaining energy; above rounding.
pub const ENERGY_GAIN_COUNTED: f64 = 1e-12;

/// A contact state with what the equations of motion need to know about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contact {
    /// Slip with `σ = sign v` on one smooth piece of the friction law.
    Slip {
        /// `σ`, ±1.
        sigma: f64,
        /// Index into the pieces of the law.
        piece: usize,
    },
    /// No relative velocity.
    Stick,
    /// Detached.
    Free,
}

impl Contact {
    /// The state without its details.
    #[must_use]
    pub fn state(self) -> ContactState {
        match self {
            Contact::Slip { sigma, .. } if sigma > 0.0 => ContactState::Slip,
            Contact::Slip { .. } => ContactState::Reverse,
            Contact::Stick => ContactState::Stick,
            Contact::Free => ContactState::Free,
        }
    }
}

/// The velocities of `m2` after an impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// `ẋ2` after the impact.
    pub vx: f64,
    /// `ẏ2` after the impact; 0 when the contact closes.
    pub vy: f64,
    /// Whether the impact gained energy in the frame of the belt.
    pub gained_energy: bool,
}

impl Scaled {
    /// Slip in direction `sigma` at the speed `|v|`, or flight when its normal force is not positive.
    ///
    /// With `M11 > 0` the normal force of slip has the sign of `W + κ R`, the normal force without friction.
    ///
    /// # Errors
    /// [`Status::Painleve`] when `M11 ≤ 0`.
    pub fn slip_or_free(&self, springs: Springs, sigma: f64, speed: f64) -> Result<Contact, Status> {
        let piece = self.law.index(speed);
        if self.slip_inertia(sigma * self.law.pieces[piece].mu(speed)) <= 0.0 {
            return Err(Status::Painleve);
        }
        let (r, w) = self.contact_loads(springs);
        Ok(if w + self.kappa * r > 0.0 { Contact::Slip { sigma, piece } } else { Contact::Free })
    }

    /// The contact state at `v = 0`: stick inside the cone `|T*| ≤ μ_s N*`, else slip along `T*`, or flight.
    ///
    /// # Errors
    /// [`Status::Painleve`] when the slip that follows has `M11 ≤ 0`.
    pub fn contact_at_rest(&self, springs: Springs, belt_acceleration: f64) -> Result<Contact, Status> {
        if self.cone_margins(springs, belt_acceleration).iter().all(|margin| *margin >= 0.0) {
            return Ok(Contact::Stick);
        }
        let (r, _) = self.contact_loads(springs);
        self.slip_or_free(springs, (r + belt_acceleration).signum(), 0.0)
    }

    /// `μ_s N* − T*` and `μ_s N* + T*`, how far the forces of stick are inside their cone. The margins of the equilibrium
    /// are formed by themselves: on a belt at rest it lies on the edge, where a rounding would decide.
    #[must_use]
    pub fn cone_margins(&self, springs: Springs, belt_acceleration: f64) -> [f64; 2] {
        let tangential = springs.r + belt_acceleration;
        let held = self.law.mu_stick * (springs.w - self.kappa * belt_acceleration);
        let edge = |sigma: f64| (self.law.mu_stick - sigma * self.mu0) * self.n0;
        [held - tangential + edge(1.0), held + tangential + edge(-1.0)]
    }

    /// Newton's impact at `y2 = 0` with the velocities `vx`, `vy < 0` and the belt velocity `belt`:
    ///
    /// ```text
    /// [1, −κ; −κ, m2 + m1 s²] (Δẋ2, Δẏ2) = (P_t, P_n)     ẏ2⁺ = −e ẏ2⁻     |P_t| ≤ μ(|v⁻|) P_n
    /// ```
    ///
    /// `P_t = σ μ P_n` unless that would reverse `v`; then the impulse that stops `v`, and where the inertia
    /// coupling `κ` reverses `v` against all friction, `P_t = −σ μ P_n`: friction never exceeds its cone.
    ///
    /// # Errors
    /// [`Status::Painleve`] when no positive normal impulse stops the approach.
    pub fn impact(&self, vx: f64, vy: f64, belt: f64) -> Result<Impact, Status> {
        let rebound = -self.restitution * vy;
        let rebound = if rebound < SLOWEST_REBOUND { 0.0 } else { rebound };
        let (relative, change) = (belt - vx, rebound - vy);
        let vx_after = if self.impact_friction {
            let limit = self.law.mu(relative.abs());
            let sliding_on = self.tangential_jump(relative.signum() * limit, change)?;
            // The impulses that stop the relative velocity.
            let (tangential, normal) =
                (relative - self.kappa * change, self.normal_mass * change - self.kappa * relative);
            if (relative - sliding_on) * relative > 0.0 {
                vx + sliding_on
            } else if tangential.abs() <= limit * normal {
                belt
            } else {
                vx + self.tangential_jump(-relative.signum() * limit, change)?
            }
        } else {
            vx + self.tangential_jump(0.0, change)?
        };
        let before = self.tangential_energy(vx - belt, vy);
        let after = self.tangential_energy(vx_after - belt, rebound);
        Ok(Impact { vx: vx_after, vy: rebound, gained_energy: after > before * (1.0 + ENERGY_GAIN_COUNTED) })
    }

    /// `Δẋ2` of an impact that changes `ẏ2` by `change` with `P_t = q P_n`.
    fn tangential_jump(&self, q: f64, change: f64) -> Result<f64, Status> {
        let inertia = self.slip_inertia(q);
        // The inverse of the mass matrix is [m2 + m1 s², κ; κ, 1]/det.
        if inertia > 0.0 {
            Ok((self.normal_mass * q + self.kappa) / inertia * change)
        } else {
            Err(Status::Painleve)
        }
    }
}
