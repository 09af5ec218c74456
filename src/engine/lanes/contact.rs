//! What an event does to the contact of one instance: rest, stick, slip, kinks, lift-off and impacts.

use crate::engine::kernel::scalar::Real;
use crate::engine::lanes::words::Words;
use crate::model::contact::SLOWEST_REBOUND;
use crate::model::status::Status;

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

impl<S: Real> Body<S> {
    /// Counts `x2` and `y1` from elsewhere.
    pub fn shift(&mut self, [x, w]: [S; 2]) {
        self.p[0] += x;
        self.p[2] += w;
    }
}

/// What an event function belongs to.
pub const NOTHING: u32 = 0;
/// `v` falls to 0.
pub const REST: u32 = 1;
/// `|v|` falls to the lower kink.
pub const LOWER_KINK: u32 = 2;
/// `|v|` rises to the upper kink.
pub const UPPER_KINK: u32 = 3;
/// `N` falls to 0.
pub const LIFT_OFF: u32 = 4;
/// `T` leaves the stick cone forwards.
pub const CONE_FORWARD: u32 = 5;
/// `T` leaves the stick cone backwards.
pub const CONE_BACKWARD: u32 = 6;
/// `y2` returns to 0.
pub const GAP: u32 = 7;

/// Events without time between them from which on a landing ends flight.
pub const HELD_FROM: u32 = 2;

/// The belt during one step part.
#[derive(Clone, Copy, Debug)]
pub struct Belt<S> {
    /// Velocity.
    pub velocity: S,
    /// Acceleration.
    pub acceleration: S,
}

/// A body and its contact.
#[derive(Clone, Copy, Debug)]
pub struct State<S> {
    /// Position and velocity.
    pub body: Body<S>,
    /// Contact state.
    pub contact: u32,
    /// Piece of the friction law.
    pub piece: u32,
    /// The event function that began at zero.
    pub disarmed: u32,
    /// Events without time between them.
    pub at_once: u32,
    /// Status; [`Status::Unwritten`] while running.
    pub status: Status,
}

impl<S: Real> State<S> {
    /// Nothing yet.
    #[must_use]
    pub fn blank() -> Self {
        State {
            body: Body { p: [S::ZERO; 3], v: [S::ZERO; 3] },
            contact: FREE,
            piece: 0,
            disarmed: NOTHING,
            at_once: 0,
            status: Status::Unwritten,
        }
    }

    /// The start of an instance.
    #[must_use]
    pub fn new(scene: &Words<S>, belt: Belt<S>) -> Self {
        let [x, w, vx, vw] = scene.start;
        let mut state = State::blank();
        state.body = Body { p: [x, S::ZERO, w], v: [vx, S::ZERO, vw] };
        state.enter_contact(scene, belt);
        state
    }

    /// Goes on in a scene whose law is another and whose equilibrium moves otherwise, so that velocities seen from it are larger by
    /// `faster` (`ẋ2` and `ẏ1`). What sticks may slip, what slides is on the piece of its speed.
    pub fn go_over(&mut self, scene: &Words<S>, belt: Belt<S>, faster: [S; 2]) {
        self.body.v[0] += faster[0];
        self.body.v[2] += faster[1];
        match self.contact {
            FREE => self.piece = 0,
            STICK => {
                self.piece = 0;
                self.at_rest(scene, belt);
            }
            contact => {
                let v = belt.velocity - self.body.v[0];
                let piece = scene.piece_at(if contact == SLIP { v } else { -v });
                #[expect(clippy::cast_possible_truncation, reason = "a table has fewer than 2^32 rows")]
                let piece = piece as u32;
                self.piece = piece;
                if self.disarmed != REST {
                    self.disarmed = NOTHING;
                }
            }
        }
    }

    /// Goes back to a state of before.
    pub fn return_to(&mut self, before: &State<S>) {
        (self.body, self.contact, self.piece, self.disarmed) =
            (before.body, before.contact, before.piece, before.disarmed);
    }

    /// Whether position and velocity are numbers.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.body.p.iter().chain(&self.body.v).all(|value| value.is_finite())
    }

    /// Carries out the transition of an event.
    pub fn transition(&mut self, scene: &Words<S>, event: u32, belt: Belt<S>) {
        match event {
            LOWER_KINK => {
                self.piece -= 1;
                self.disarmed = UPPER_KINK;
            }
            UPPER_KINK => {
                self.piece += 1;
                self.disarmed = LOWER_KINK;
            }
            REST if self.passes_singularity(scene) => self.status = Status::Painleve,
            REST => self.at_rest(scene, belt),
            CONE_FORWARD => self.slip_or_free(scene, S::ONE, S::ZERO, true),
            CONE_BACKWARD => self.slip_or_free(scene, -S::ONE, S::ZERO, true),
            LIFT_OFF => self.enter(FREE, false),
            _ => self.impact(scene, belt),
        }
    }

    /// Whether slip that has come to rest has passed the place where its inertia vanishes: at rest it is not positive.
    fn passes_singularity(&self, scene: &Words<S>) -> bool {
        let sigma = if self.contact == SLIP { S::ONE } else { -S::ONE };
        let q = scene.friction(&scene.pieces[0], sigma, S::ZERO, scene.v0).0;
        S::ONE + scene.kappa * q <= S::ZERO
    }

    /// `R − μ0 N0` and `W − N0` at the present state.
    fn loads(&self, scene: &Words<S>) -> [S; 2] {
        let [x, y, w] = self.body.p;
        let [vx, vy, vw] = self.body.v;
        let h = scene.k2 * (x * scene.s + y * scene.c - w) + scene.c2 * (vx * scene.s + vy * scene.c - vw);
        let g = scene.k1 * (x * scene.c - y * scene.s) + scene.c1 * (vx * scene.c - vy * scene.s);
        [scene.c * g + scene.s * h, scene.c * h - scene.s * g]
    }

    /// Slip in direction `sigma` at `speed`, or flight when its normal force is not positive.
    fn slip_or_free(&mut self, scene: &Words<S>, sigma: S, speed: S, at_rest: bool) {
        let piece = scene.piece_at(speed);
        let v = sigma * speed;
        let q = scene.friction(&scene.pieces[piece], sigma, v, scene.v0 - v).0;
        if S::ONE + scene.kappa * q <= S::ZERO {
            self.status = Status::Painleve;
            return;
        }
        let [r, w] = self.loads(scene);
        // A body that lands again and again without time between is held: the force is zero within rounding, and
        // flight does not open the gap.
        let held = self.contact == FREE && self.at_once >= HELD_FROM;
        if held || (w + scene.n0) + scene.kappa * (r + scene.t0) > S::ZERO {
            #[expect(clippy::cast_possible_truncation, reason = "a table has fewer than 2^32 rows")]
            let piece = piece as u32;
            self.piece = piece;
            self.enter(if sigma > S::ZERO { SLIP } else { REVERSE }, at_rest);
        } else {
            self.enter(FREE, false);
        }
    }

    fn enter(&mut self, contact: u32, at_rest: bool) {
        self.contact = contact;
        self.disarmed = NOTHING;
        if contact == FREE {
            self.disarmed = GAP;
        } else if contact <= REVERSE && at_rest {
            self.disarmed = REST;
        }
    }

    /// Decides the contact state at `v = 0`.
    fn at_rest(&mut self, scene: &Words<S>, belt: Belt<S>) {
        self.body.v[0] = belt.velocity;
        let [r, w] = self.loads(scene);
        let tangential = r + belt.acceleration;
        let normal = w - scene.kappa * belt.acceleration;
        let forward = scene.mu_stick * normal - tangential + scene.cone[0];
        let backward = scene.mu_stick * normal + tangential + scene.cone[1];
        if forward >= S::ZERO && backward >= S::ZERO {
            self.enter(STICK, true);
        } else {
            let sigma = if tangential + scene.t0 >= S::ZERO { S::ONE } else { -S::ONE };
            self.slip_or_free(scene, sigma, S::ZERO, true);
        }
    }

    /// Decides the contact state of a closed contact.
    pub fn enter_contact(&mut self, scene: &Words<S>, belt: Belt<S>) {
        let v = belt.velocity - self.body.v[0];
        if v > S::ZERO {
            self.slip_or_free(scene, S::ONE, v, false);
        } else if v < S::ZERO {
            self.slip_or_free(scene, -S::ONE, -v, false);
        } else {
            self.at_rest(scene, belt);
        }
    }

    /// `Δẋ2` of an impact that changes `ẏ2` by `change` with `P_t = q P_n`.
    fn tangential_jump(&mut self, scene: &Words<S>, q: S, change: S) -> S {
        let inertia = S::ONE + scene.kappa * q;
        if inertia <= S::ZERO {
            self.status = Status::Painleve;
            return S::ZERO;
        }
        (scene.normal_mass * q + scene.kappa) / inertia * change
    }

    /// Newton's impact with friction inside its cone, see [`crate::model::contact`].
    fn impact(&mut self, scene: &Words<S>, belt: Belt<S>) {
        let vx = self.body.v[0];
        let vy = self.body.v[1].min(S::ZERO);
        let mut rebound = -(scene.restitution * vy);
        if rebound < S::from_f64(SLOWEST_REBOUND) {
            rebound = S::ZERO;
        }
        let change = rebound - vy;
        let relative = belt.velocity - vx;
        let mut after = belt.velocity;
        if scene.impact_friction > S::ZERO {
            let limit = scene.mu(relative.abs());
            let q = if relative < S::ZERO { -limit } else { limit };
            let jump = self.tangential_jump(scene, q, change);
            let tangential = relative - scene.kappa * change;
            let normal = scene.normal_mass * change - scene.kappa * relative;
            if (relative - jump) * relative > S::ZERO {
                after = vx + jump;
            } else if tangential.abs() > limit * normal {
                after = vx + self.tangential_jump(scene, -q, change);
            }
        } else {
            after = vx + self.tangential_jump(scene, S::ZERO, change);
        }
        self.body.p[1] = S::ZERO;
        self.body.v[0] = after;
        self.body.v[1] = rebound;
        if rebound > S::ZERO {
            self.enter(FREE, false);
        } else {
            self.enter_contact(scene, belt);
        }
    }
}
