//! Twin: shaders/scene.wgsl
//!
//! What one instance hands to a kernel, word by word.
//!
//! The host computes every word in f64 and narrows it once. Differences of nearly equal numbers (friction
//! against that of the equilibrium, the stick cone at the equilibrium) are formed there.

use std::sync::LazyLock;

use smallvec::SmallVec;

use crate::engine::kernel::scalar::Real;
use crate::engine::kernel::steps::{ORDER, TOLERANCE};
use crate::engine::kernel::table::{head, piece, segment};
use crate::engine::method::pace::Turns;
use crate::engine::reference::bounds::MAX_EVENTS_AT_ONCE;
use crate::model::piece::{FAR, LawForm, Piece as LawPiece};
use crate::model::scaled::Scaled;

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

impl<S: Real> Piece<S> {
    fn read(words: &[f64]) -> Piece<S> {
        let w = |i: usize| S::from_f64(words[i]);
        Piece {
            at_zero: w(piece::AT_ZERO),
            slope: w(piece::SLOPE),
            rate: w(piece::RATE),
            offset: w(piece::OFFSET),
            kink: w(piece::KINK),
        }
    }
}

impl Piece<f64> {
    fn words(self) -> [f64; piece::WORDS] {
        let mut words = [0.0; piece::WORDS];
        words[piece::AT_ZERO] = self.at_zero;
        words[piece::SLOPE] = self.slope;
        words[piece::RATE] = self.rate;
        words[piece::OFFSET] = self.offset;
        words[piece::KINK] = self.kink;
        words
    }
}

/// A stretch of constant belt acceleration and step inside one part of the run.
#[derive(Clone, Copy, Debug)]
pub struct Segment<S> {
    /// Steps; 0 for an unused segment.
    pub steps: S,
    /// Length of a step.
    pub step: S,
    /// Belt velocity at its start.
    pub velocity: S,
    /// Belt acceleration.
    pub acceleration: S,
    /// [`SETTLE`], [`FIRST_HALF`], [`SECOND_HALF`] or [`OPEN_HALF`].
    pub part: S,
}

/// Before the measuring window.
pub const SETTLE: u32 = 0;
/// First half of the window.
pub const FIRST_HALF: u32 = 1;
/// Second half of the window.
pub const SECOND_HALF: u32 = 2;
/// Second half of a window that is not passed a second time.
pub const OPEN_HALF: u32 = 3;

/// Segments per instance: a ramp may end inside any part.
pub const SEGMENTS: usize = 4;

/// The words of the segments of an instance, in the order of [`Segment`].
pub type Segments = [[f64; segment::WORDS]; SEGMENTS];

/// A kink no speed reaches.
pub const NO_KINK: f64 = 1e30;

/// One instance as a kernel sees it.
#[derive(Clone, Debug)]
pub struct Scene<S> {
    /// Form of the friction law.
    pub law: LawForm,
    /// `sin θ`.
    pub s: S,
    /// `cos θ`.
    pub c: S,
    /// `1/m1`.
    pub inv_m1: S,
    /// Stiffness and damping.
    pub k1: S,
    /// Normal stiffness.
    pub k2: S,
    /// Tangential damping.
    pub c1: S,
    /// Normal damping.
    pub c2: S,
    /// `κ = m1 s c`.
    pub kappa: S,
    /// `1/det` of the mass matrix of `(x2, y2)`.
    pub inv_det: S,
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
    /// Smallest rebound.
    pub slowest_rebound: S,
    /// The longest step of each contact state.
    pub longest: [S; 4],
    /// How far a step of a curved law may go, see [`crate::engine::method::pace::Layer::inverses`].
    pub layer: [S; 2],
    /// The pieces of the law.
    pub pieces: SmallVec<[Piece<S>; 2]>,
    /// The segments.
    pub segments: [Segment<S>; SEGMENTS],
}

/// Events at one instant before an instance is given up; the same as in the reference.
pub const EVENTS_AT_ONCE: u32 = MAX_EVENTS_AT_ONCE;

/// How far a mode may turn within a step of the kernel.
static TURNS: LazyLock<Turns> = LazyLock::new(|| Turns::new(ORDER, f64::from(TOLERANCE)));

/// The words of an instance in f64, in the order of the kernel's input buffer.
#[must_use]
pub fn words(model: &Scaled, v0: f64, start: [f64; 4], segments: &Segments, pieces: usize) -> Vec<f64> {
    let last = model.law.pieces.len() - 1;
    let mut words = Vec::with_capacity(head::WORDS + SEGMENTS * segment::WORDS + pieces * piece::WORDS);
    words.extend(head(model, v0, start));
    words.extend(segments.as_flattened());
    // What there is room for beyond the last is the last.
    words.extend((0..pieces).flat_map(|index| piece(model, v0, index.min(last), &TURNS).words()));
    words
}

/// The words of a scene before its segments.
fn head(model: &Scaled, v0: f64, start: [f64; 4]) -> [f64; head::WORDS] {
    let (mu0, n0) = (model.mu0, model.n0);
    let mu_s = model.law.mu_stick;
    let mut words = [0.0; head::WORDS];
    let mut put = |first: usize, values: &[f64]| words[first..first + values.len()].copy_from_slice(values);
    put(head::SIN, &[model.s]);
    put(head::COS, &[model.c]);
    put(head::INV_M1, &[1.0 / model.m1]);
    put(head::K1, &[model.k1]);
    put(head::K2, &[model.k2]);
    put(head::C1, &[model.c1]);
    put(head::C2, &[model.c2]);
    put(head::KAPPA, &[model.kappa]);
    put(head::INV_DET, &[1.0 / model.det]);
    put(head::NORMAL_MASS, &[model.normal_mass]);
    put(head::N0, &[n0]);
    put(head::T0, &[mu0 * n0]);
    put(head::MU0, &[mu0]);
    put(head::V0, &[v0]);
    put(head::MU_STICK, &[mu_s]);
    put(head::CONE, &[(mu_s - mu0) * n0, (mu_s + mu0) * n0]);
    put(head::RESTITUTION, &[model.restitution]);
    put(head::IMPACT_FRICTION, &[f64::from(u8::from(model.impact_friction))]);
    put(head::START, &start);
    put(head::SLOWEST_REBOUND, &[crate::model::contact::SLOWEST_REBOUND]);
    put(head::LONGEST, &TURNS.longest_steps(&model.fastest).map(|step| step.min(NO_KINK)));
    put(head::LAYER, &TURNS.layer().inverses(model));
    words
}

/// The words of a piece of the law; `turns` says how far a mode may turn within a step.
fn piece(model: &Scaled, v0: f64, index: usize, turns: &Turns) -> Piece<f64> {
    let kink = model.law.kinks.get(index).copied().unwrap_or(NO_KINK);
    match model.law.pieces[index] {
        LawPiece::Linear { at_zero, slope } => {
            let longest = turns.longest_step_on(model, index).min(NO_KINK);
            Piece { at_zero, slope, rate: longest, offset: at_zero + slope * v0 - model.mu0, kink }
        }
        LawPiece::Exponential { floor, height, rate } => {
            Piece { at_zero: floor, slope: height, rate, offset: height * (-rate * v0).exp(), kink }
        }
        LawPiece::Rational { at_zero, decay } => {
            Piece { at_zero, slope: 0.0, rate: decay, offset: 1.0 / (1.0 + decay * v0), kink }
        }
    }
}

impl<S: Real> Scene<S> {
    /// Reads the words of an instance.
    #[must_use]
    pub fn read(law: LawForm, pieces: usize, words: &[f64]) -> Scene<S> {
        let w = |i: usize| S::from_f64(words[i]);
        let segment = |i: usize| {
            let at = head::WORDS + i * segment::WORDS;
            Segment {
                steps: w(at + segment::STEPS),
                step: w(at + segment::STEP),
                velocity: w(at + segment::VELOCITY),
                acceleration: w(at + segment::ACCELERATION),
                part: w(at + segment::PART),
            }
        };
        let piece = |i: usize| {
            let at = head::WORDS + SEGMENTS * segment::WORDS + i * piece::WORDS;
            Piece::read(&words[at..at + piece::WORDS])
        };
        let pieces = (0..pieces).map(piece).collect();
        Scene { pieces, segments: std::array::from_fn(segment), ..Scene::read_head(law, words) }
    }

    /// An instance without segments, by its law's own pieces, whose steps may turn so far.
    #[must_use]
    pub fn of(law: LawForm, model: &Scaled, v0: f64, start: [f64; 4], turns: &Turns) -> Scene<S> {
        let piece = |index: usize| Piece::read(&piece(model, v0, index, turns).words());
        let pieces = (0..model.law.pieces.len()).map(piece).collect();
        Scene { pieces, ..Scene::read_head(law, &head(model, v0, start)) }
    }

    /// What stands before the segments.
    fn read_head(law: LawForm, words: &[f64]) -> Scene<S> {
        let w = |i: usize| S::from_f64(words[i]);
        let nothing = Segment {
            steps: S::ZERO,
            step: S::ZERO,
            velocity: S::ZERO,
            acceleration: S::ZERO,
            part: S::ZERO,
        };
        Scene {
            law,
            s: w(head::SIN),
            c: w(head::COS),
            inv_m1: w(head::INV_M1),
            k1: w(head::K1),
            k2: w(head::K2),
            c1: w(head::C1),
            c2: w(head::C2),
            kappa: w(head::KAPPA),
            inv_det: w(head::INV_DET),
            normal_mass: w(head::NORMAL_MASS),
            n0: w(head::N0),
            t0: w(head::T0),
            mu0: w(head::MU0),
            v0: w(head::V0),
            mu_stick: w(head::MU_STICK),
            cone: std::array::from_fn(|i| w(head::CONE + i)),
            restitution: w(head::RESTITUTION),
            impact_friction: w(head::IMPACT_FRICTION),
            start: std::array::from_fn(|i| w(head::START + i)),
            slowest_rebound: w(head::SLOWEST_REBOUND),
            longest: std::array::from_fn(|i| w(head::LONGEST + i)),
            layer: std::array::from_fn(|i| w(head::LAYER + i)),
            pieces: SmallVec::new(),
            segments: [nothing; SEGMENTS],
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

    /// The longest step of a curved law at a relative velocity and its rate of change, see [`crate::engine::method::pace::Layer`].
    #[must_use]
    pub fn longest_in_layer(&self, piece: &Piece<S>, q: S, v: S, acceleration: S) -> S {
        let narrowing = S::ONE / (S::ONE + piece.rate * v.abs());
        let sloped = match self.law {
            LawForm::Exponential => (q.abs() - piece.at_zero).abs(),
            LawForm::Pieces | LawForm::Rational => q.abs() * narrowing,
        };
        let inverse = piece.rate * (acceleration.abs() * narrowing * self.layer[0] + sloped * self.layer[1]);
        S::ONE / inverse.max(S::from_f64(1.0 / NO_KINK))
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
    let mut y = x.max(S::from_f64(-80.0)).min(S::from_f64(80.0));
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
