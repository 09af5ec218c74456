//! Friction laws: μ(|v|) and its slope, both from the same piece of the law.
//!
//! A law is a chain of smooth pieces in `|v|`. Between two kinks a trajectory stays on one piece, which
//! the integrator continues analytically; crossing a kink is an event. At a kink the slope is that of
//! the larger `|v|`.

use std::sync::Arc;

use smallvec::SmallVec;

/// The kind of a friction law; the parameters of each are in [`FrictionLaw`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the variants are the names of the laws in FrictionLaw")]
pub enum LawKind {
    Constant,
    Bilinear,
    Exponential,
    Rational,
    Table,
}

impl LawKind {
    /// Every law.
    pub const ALL: [LawKind; 5] =
        [LawKind::Constant, LawKind::Bilinear, LawKind::Exponential, LawKind::Rational, LawKind::Table];

    /// The name in a sweep file.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            LawKind::Constant => "constant",
            LawKind::Bilinear => "bilinear",
            LawKind::Exponential => "exponential",
            LawKind::Rational => "rational",
            LawKind::Table => "table",
        }
    }
}

/// A tabulated law: strictly rising velocities (m/s), the first 0, with their friction coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct MuTable {
    /// `|v|`, m/s, strictly rising from 0.
    pub velocity: Vec<f64>,
    /// μ at each velocity.
    pub mu: Vec<f64>,
}

/// A friction law `μ(|v|)` of the relative velocity `v = V − ẋ2` (m/s).
#[derive(Clone, Debug, PartialEq)]
pub enum FrictionLaw {
    /// `μ_d` in slip, `μ_s ≥ μ_d` the limit of stick.
    Constant {
        /// Limit of stick.
        mu_s: f64,
        /// Friction in slip.
        mu_d: f64,
    },
    /// `μ_d` for `|v| ≥ v_k`, else `μ_s + (μ_d − μ_s)|v|/v_k`.
    Bilinear {
        /// μ at rest.
        mu_s: f64,
        /// μ from the knee on.
        mu_d: f64,
        /// Knee `v_k`, m/s.
        knee_velocity: f64,
    },
    /// `μ_d + (μ_s − μ_d) exp(−|v|/v0)`.
    Exponential {
        /// μ at rest.
        mu_s: f64,
        /// μ at infinite velocity.
        mu_d: f64,
        /// Decay velocity `v0`, m/s.
        stribeck_velocity: f64,
    },
    /// `μ_s/(1 + δ|v|)`.
    Rational {
        /// μ at rest.
        mu_s: f64,
        /// Decay `δ`, s/m.
        decay: f64,
    },
    /// Piecewise linear in `|v|`; constant beyond the last row.
    Table(Arc<MuTable>),
}

/// One smooth piece of a law, a function of the speed `|v|`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Piece {
    /// `μ = at_zero + slope |v|`.
    Linear {
        /// The piece continued to `|v| = 0`.
        at_zero: f64,
        /// `dμ/d|v|`.
        slope: f64,
    },
    /// `μ = floor + height exp(−rate |v|)`.
    Exponential {
        /// μ at infinity.
        floor: f64,
        /// μ(0) − μ(∞).
        height: f64,
        /// `1/v0`.
        rate: f64,
    },
    /// `μ = at_zero/(1 + decay |v|)`.
    Rational {
        /// μ at rest.
        at_zero: f64,
        /// δ.
        decay: f64,
    },
}

/// Between two speeds that are more than this many decay velocities apart, the difference of an exponential's values keeps
/// all its digits. At that distance `exp(−40)` is left of it, which no friction notices.
pub const FAR: f64 = 40.0;

impl Piece {
    /// μ at the speed `speed ≥ 0`.
    #[must_use]
    pub fn mu(self, speed: f64) -> f64 {
        match self {
            Piece::Linear { at_zero, slope } => at_zero + slope * speed,
            Piece::Exponential { floor, height, rate } => floor + height * (-rate * speed).exp(),
            Piece::Rational { at_zero, decay } => at_zero / (1.0 + decay * speed),
        }
    }

    /// `μ(speed + change) − μ(speed)`, to the last digits of however small a change.
    #[must_use]
    pub fn change(self, speed: f64, change: f64) -> f64 {
        match self {
            Piece::Linear { slope, .. } => slope * change,
            // Far down the exponential its foot is 0 and the ratio infinite, whose product is no number.
            Piece::Exponential { height, rate, .. } if -rate * change > FAR => {
                height * ((-rate * (speed + change)).exp() - (-rate * speed).exp())
            }
            Piece::Exponential { height, rate, .. } => {
                height * (-rate * speed).exp() * (-rate * change).exp_m1()
            }
            Piece::Rational { at_zero, decay } => {
                -at_zero * decay * change / ((1.0 + decay * speed) * (1.0 + decay * (speed + change)))
            }
        }
    }

    /// The largest of its numbers.
    #[must_use]
    pub fn largest(self) -> f64 {
        let [a, b, c] = match self {
            Piece::Linear { at_zero, slope } => [at_zero, slope, 0.0],
            Piece::Exponential { floor, height, rate } => [floor, height, rate],
            Piece::Rational { at_zero, decay } => [at_zero, decay, 0.0],
        };
        // A NaN is not to be lost in a maximum.
        if (a + b + c).is_nan() { f64::NAN } else { a.abs().max(b.abs()).max(c.abs()) }
    }

    /// This piece as a function of `|v|/velocity_unit` instead of `|v|`.
    #[must_use]
    pub fn scaled(self, velocity_unit: f64) -> Piece {
        match self {
            Piece::Linear { at_zero, slope } => Piece::Linear { at_zero, slope: slope * velocity_unit },
            Piece::Exponential { floor, height, rate } => {
                Piece::Exponential { floor, height, rate: rate * velocity_unit }
            }
            Piece::Rational { at_zero, decay } => Piece::Rational { at_zero, decay: decay * velocity_unit },
        }
    }

    /// `dμ/d|v|` at the speed `speed ≥ 0`.
    #[must_use]
    pub fn slope(self, speed: f64) -> f64 {
        match self {
            Piece::Linear { slope, .. } => slope,
            Piece::Exponential { height, rate, .. } => -rate * height * (-rate * speed).exp(),
            Piece::Rational { at_zero, decay } => -decay * at_zero / (1.0 + decay * speed).powi(2),
        }
    }
}

/// A law as a chain of pieces: piece `i` holds for speeds from `kinks[i - 1]` to `kinks[i]`.
#[derive(Clone, Debug, PartialEq)]
pub struct PieceChain {
    /// The pieces, from `|v| = 0` on; at least one.
    pub pieces: SmallVec<[Piece; 2]>,
    /// The speeds between the pieces, rising; one fewer than pieces.
    pub kinks: SmallVec<[f64; 1]>,
    /// Limit of stick: `|T| ≤ mu_stick N`.
    pub mu_stick: f64,
}

impl PieceChain {
    /// The index of the piece at `speed`; at a kink that of the larger speed.
    #[must_use]
    pub fn index(&self, speed: f64) -> usize {
        self.kinks.partition_point(|&kink| kink <= speed)
    }

    /// `dμ/d|v|` of a straight piece, 0 of others.
    #[must_use]
    pub fn slope_of(&self, piece: usize) -> f64 {
        match self.pieces[piece] {
            Piece::Linear { slope, .. } => slope,
            Piece::Exponential { .. } | Piece::Rational { .. } => 0.0,
        }
    }

    /// The largest μ at any speed.
    #[must_use]
    pub fn highest(&self) -> f64 {
        let lower_ends = std::iter::once(&0.0).chain(&self.kinks);
        let ends = self.pieces.iter().zip(lower_ends).map(|(piece, lower)| match piece {
            // A straight piece ends where the next one begins, the last one is level.
            Piece::Linear { .. } | Piece::Rational { .. } => piece.mu(*lower),
            Piece::Exponential { floor, .. } => piece.mu(*lower).max(*floor),
        });
        ends.fold(self.mu_stick, f64::max)
    }

    /// The inverse of the speed within which a curved law changes near rest; 0 of straight pieces.
    #[must_use]
    pub fn rate(&self) -> f64 {
        match self.pieces[0] {
            Piece::Linear { .. } => 0.0,
            Piece::Exponential { rate, .. } => rate,
            Piece::Rational { decay, .. } => decay,
        }
    }

    /// μ in slip at the speed `speed ≥ 0`.
    #[must_use]
    pub fn mu(&self, speed: f64) -> f64 {
        self.pieces[self.index(speed)].mu(speed)
    }

    /// `dμ/d|v|` at the speed `speed ≥ 0`.
    #[must_use]
    pub fn slope(&self, speed: f64) -> f64 {
        self.pieces[self.index(speed)].slope(speed)
    }
}

impl FrictionLaw {
    /// The kind of this law.
    #[must_use]
    pub fn kind(&self) -> LawKind {
        match self {
            FrictionLaw::Constant { .. } => LawKind::Constant,
            FrictionLaw::Bilinear { .. } => LawKind::Bilinear,
            FrictionLaw::Exponential { .. } => LawKind::Exponential,
            FrictionLaw::Rational { .. } => LawKind::Rational,
            FrictionLaw::Table(_) => LawKind::Table,
        }
    }

    /// Whether the law is well-posed. `constant` with `μ_s < μ_d` leaves stick and re-sticks at once.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        !matches!(self, FrictionLaw::Constant { mu_s, mu_d } if mu_s < mu_d)
    }

    /// The piece of the law at the speed `speed ≥ 0` (m/s); at a kink that of the larger speed.
    #[must_use]
    pub fn piece(&self, speed: f64) -> Piece {
        match self {
            FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity } if speed < *knee_velocity => {
                Piece::Linear { at_zero: *mu_s, slope: (mu_d - mu_s) / knee_velocity }
            }
            FrictionLaw::Constant { mu_d, .. } | FrictionLaw::Bilinear { mu_d, .. } => {
                Piece::Linear { at_zero: *mu_d, slope: 0.0 }
            }
            FrictionLaw::Exponential { mu_s, mu_d, stribeck_velocity } => {
                let height = mu_s - mu_d;
                // What does not change has no layer that a step would have to resolve.
                let rate = if height == 0.0 { 0.0 } else { 1.0 / stribeck_velocity };
                Piece::Exponential { floor: *mu_d, height, rate }
            }
            FrictionLaw::Rational { mu_s, decay } => Piece::Rational { at_zero: *mu_s, decay: *decay },
            FrictionLaw::Table(table) => table.piece(table.velocity.partition_point(|&v| v <= speed)),
        }
    }

    /// μ in slip at the relative velocity `v`, m/s.
    #[must_use]
    pub fn mu(&self, v: f64) -> f64 {
        self.piece(v.abs()).mu(v.abs())
    }

    /// `dμ/d|v|` at the relative velocity `v` (m/s), s/m.
    #[must_use]
    pub fn slope(&self, v: f64) -> f64 {
        self.piece(v.abs()).slope(v.abs())
    }

    /// Where the pieces meet, m/s, rising.
    fn kinks(&self) -> &[f64] {
        match self {
            FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity } if mu_s.to_bits() != mu_d.to_bits() => {
                std::slice::from_ref(knee_velocity)
            }
            FrictionLaw::Table(table) => &table.velocity[1..],
            _ => &[],
        }
    }

    /// The limit of stick, `|T| ≤ μ_s N`.
    fn mu_stick(&self) -> f64 {
        match self {
            FrictionLaw::Constant { mu_s, .. }
            | FrictionLaw::Bilinear { mu_s, .. }
            | FrictionLaw::Exponential { mu_s, .. }
            | FrictionLaw::Rational { mu_s, .. } => *mu_s,
            FrictionLaw::Table(table) => table.mu[0],
        }
    }

    /// The law as pieces in `|v|/velocity_unit` (1 for m/s).
    #[must_use]
    pub fn pieces(&self, velocity_unit: f64) -> PieceChain {
        let kinks = self.kinks();
        // Every piece holds at its lower end.
        let starts = std::iter::once(&0.0).chain(kinks);
        PieceChain {
            pieces: starts.map(|&speed| self.piece(speed).scaled(velocity_unit)).collect(),
            kinks: kinks.iter().map(|kink| kink / velocity_unit).collect(),
            mu_stick: self.mu_stick(),
        }
    }
}

impl MuTable {
    /// Piece `index`: before row `index`, constant beyond the last row.
    fn piece(&self, index: usize) -> Piece {
        match (self.velocity.get(index), self.mu.get(index)) {
            (Some(v1), Some(mu1)) => {
                let (v0, mu0) = (self.velocity[index - 1], self.mu[index - 1]);
                let slope = (mu1 - mu0) / (v1 - v0);
                Piece::Linear { at_zero: mu0 - slope * v0, slope }
            }
            _ => Piece::Linear { at_zero: self.mu[self.mu.len() - 1], slope: 0.0 },
        }
    }
}
