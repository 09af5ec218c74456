//! One instance as scalars, for what happens lane by lane: its start, and rare events.
//!
//! The host computes every word in f64 and narrows it once. Differences of nearly equal numbers (friction
//! against that of the equilibrium, the stick cone at the equilibrium) are formed there.

use smallvec::SmallVec;

use crate::engine::kernel::scalar::Real;
use crate::engine::method::pace::{Turns, stands_still};
use crate::engine::reference::bounds::MAX_EVENTS_AT_ONCE;
use crate::engine::scene::Scene;
use crate::model::piece::{FAR, LawForm, Piece as LawPiece};
use crate::model::scaled::Scaled;

/// A kink no speed reaches.
pub const NO_KINK: f64 = 1e30;

/// Events at one instant before an instance is given up; the same as in the reference.
pub const EVENTS_AT_ONCE: u32 = MAX_EVENTS_AT_ONCE;

/// One piece of the friction law.
#[derive(Clone, Copy, Debug)]
pub struct Piece<S> {
    /// μ continued to `|v| = 0`; μ at infinity for `exponential`.
    pub at_zero: S,
    /// `dμ/d|v|`.
    pub slope: S,
    /// Decay rate of `exponential` and `rational`; the longest step of slip on a straight piece.
    pub rate: S,
    /// μ of this piece at the initial belt velocity less μ of the equilibrium; of `exponential`: its
    /// height there.
    pub offset: S,
    /// Upper end in `|v|`; [`NO_KINK`] for the last piece.
    pub kink: S,
}

/// One instance.
#[derive(Clone, Debug)]
pub struct Words<S> {
    /// Form of the friction law.
    pub law: LawForm,
    /// `sin θ`.
    pub s: S,
    /// `cos θ`.
    pub c: S,
    /// Tangential stiffness.
    pub k1: S,
    /// Normal stiffness.
    pub k2: S,
    /// Tangential damping.
    pub c1: S,
    /// Normal damping.
    pub c2: S,
    /// `κ = m1 s c`.
    pub kappa: S,
    /// `m2 + m1 s²`.
    pub normal_mass: S,
    /// Normal force of the equilibrium.
    pub n0: S,
    /// Tangential force of the equilibrium.
    pub t0: S,
    /// μ of the equilibrium.
    pub mu0: S,
    /// Belt velocity of the equilibrium.
    pub v0: S,
    /// Limit of stick.
    pub mu_stick: S,
    /// `(μ_s − μ0) N0` and `(μ_s + μ0) N0`: the margins of the stick cone at the equilibrium.
    pub cone: [S; 2],
    /// Newton restitution.
    pub restitution: S,
    /// 1 with a Coulomb impulse, else 0.
    pub impact_friction: S,
    /// Start: `x2`, `y1`, `ẋ2`, `ẏ1`.
    pub start: [S; 4],
    /// The pieces of the law.
    pub pieces: SmallVec<[Piece<S>; 2]>,
}

/// A piece of the law; `turns` says how far a mode may turn within a step.
fn piece<S: Real>(model: &Scaled, v0: f64, index: usize, turns: &Turns) -> Piece<S> {
    let kink = model.law.kinks.get(index).copied().unwrap_or(NO_KINK);
    let [at_zero, slope, rate, offset, kink] = match model.law.pieces[index] {
        LawPiece::Linear { at_zero, slope } => {
            let longest = turns.longest_step_on(model, index).min(NO_KINK);
            [at_zero, slope, longest, at_zero + slope * v0 - model.mu0, kink]
        }
        LawPiece::Exponential { floor, height, rate } => {
            [floor, height, rate, height * (-rate * v0).exp(), kink]
        }
        LawPiece::Rational { at_zero, decay } => [at_zero, 0.0, decay, 1.0 / (1.0 + decay * v0), kink],
    }
    .map(S::from_f64);
    Piece { at_zero, slope, rate, offset, kink }
}

impl<S: Real> Words<S> {
    /// An instance whose steps may turn so far.
    #[must_use]
    pub fn new(law: LawForm, scene: &Scene, turns: &Turns) -> Words<S> {
        let (model, v0, start) = (&scene.model, scene.model.v0, scene.start());
        let w = S::from_f64;
        let (mu0, n0, mu_s) = (model.mu0, model.n0, model.law.mu_stick);
        Words {
            law,
            s: w(model.s),
            c: w(model.c),
            k1: w(model.k1),
            k2: w(model.k2),
            c1: w(model.c1),
            c2: w(model.c2),
            kappa: w(model.kappa),
            normal_mass: w(model.normal_mass),
            n0: w(n0),
            t0: w(mu0 * n0),
            mu0: w(mu0),
            v0: w(v0),
            mu_stick: w(mu_s),
            cone: [(mu_s - mu0) * n0, (mu_s + mu0) * n0].map(w),
            restitution: w(model.restitution),
            impact_friction: w(f64::from(u8::from(model.impact_friction))),
            start: [start.position[0], start.position[2], start.velocity[0], start.velocity[2]].map(w),
            pieces: (0..model.law.pieces.len()).map(|index| piece(model, v0, index, turns)).collect(),
        }
    }

    /// `q = σ μ` and `q − μ0` at the relative velocity `v`; `lag = V0 − v`, known without cancellation.
    #[must_use]
    pub fn friction(&self, piece: &Piece<S>, sigma: S, v: S, lag: S) -> (S, S) {
        let forward = sigma > S::ZERO;
        match self.law {
            LawForm::Pieces => {
                let q = sigma * piece.at_zero + piece.slope * v;
                (q, if forward { piece.offset - piece.slope * lag } else { q - self.mu0 })
            }
            LawForm::Exponential => {
                // From the equilibrium, without cancellation, or from rest, where that is too far down.
                let ahead = piece.rate * lag;
                let near = forward && ahead <= S::from_f64(FAR);
                let base = if near { piece.offset } else { piece.slope };
                let less = base * exp_m1(if near { ahead } else { -(piece.rate * (sigma * v).max(S::ZERO)) });
                let q = sigma * (piece.at_zero + (base + less));
                (q, if near { less } else { q - self.mu0 })
            }
            LawForm::Rational => {
                let reciprocal = S::ONE / (S::ONE + piece.rate * sigma * v);
                let q = sigma * piece.at_zero * reciprocal;
                let less = piece.at_zero * piece.rate * lag * reciprocal * piece.offset;
                (q, if forward { less } else { q - self.mu0 })
            }
        }
    }

    /// Whether a rising piece asks for steps in which a position stands still, so that what slides there slowly comes to is lost.
    #[must_use]
    pub fn stands_still_on_a_rise(&self) -> bool {
        let still = |longest: S| stands_still(longest.to_f64(), S::EPSILON.to_f64());
        self.law == LawForm::Pieces
            && self.pieces.iter().any(|piece| piece.slope > S::ZERO && still(piece.rate))
    }

    /// μ at the speed `|v|`, whatever its piece.
    #[must_use]
    pub fn mu(&self, speed: S) -> S {
        self.friction(&self.pieces[self.piece_at(speed)], S::ONE, speed, self.v0 - speed).0
    }

    /// The piece at a speed.
    #[must_use]
    pub fn piece_at(&self, speed: S) -> usize {
        let mut index = 0;
        while index + 1 < self.pieces.len() && speed >= self.pieces[index].kink {
            index += 1;
        }
        index
    }
}

/// `exp(x) − 1` for `x` in [−80, 80]: a series for `|x| ≤ 1/2`, doubled by `(1 + e)² − 1 = e (2 + e)`.
#[must_use]
pub fn exp_m1<S: Real>(x: S) -> S {
    let mut y = x.max(S::from_f64(-FARTHEST)).min(S::from_f64(FARTHEST));
    let mut doublings = 0;
    while y.abs() > S::from_f64(0.5) {
        y *= S::from_f64(0.5);
        doublings += 1;
    }
    let mut sum = S::ONE;
    for k in (2..=EXP_DEGREE).rev() {
        sum = S::ONE + y * sum / S::from_f64(f64::from(k));
    }
    let mut e = y * sum;
    for _ in 0..doublings {
        e *= S::from_f64(2.0) + e;
    }
    e
}

/// Degree of the exponential's series: below 1e-17 at 1/2.
pub const EXP_DEGREE: u8 = 14;

/// Doublings of a large argument of the exponential: all, and those from `exp(x/16)` on.
pub const DOUBLINGS: i32 = 8;
/// See [`DOUBLINGS`].
pub const POWER: i32 = 4;

/// Below this `1 + (exp(x) − 1)` has lost too many digits of `exp(x)`.
pub const DOWN: f64 = -3.0;

/// Up to here exponents are told apart: below it `exp(x)` is nothing, or in f32 all but.
pub const FARTHEST: f64 = 80.0;
