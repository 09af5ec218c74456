//! Pieces of friction laws: the forms that the equations know, and chains of them.
//!
//! Between two kinks a trajectory stays on one piece, which the integrator continues analytically; crossing a kink is an
//! event. At a kink the slope is that of the larger `|v|`.

use smallvec::SmallVec;

macro_rules! forms {
    ($($form:ident $name:literal $meaning:literal;)*) => {
        /// The form of all pieces of a law, for which a kernel is built.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        #[repr(u32)]
        pub enum LawForm {
            $(#[doc = $meaning] $form,)*
        }

        impl LawForm {
            /// Every form.
            pub const ALL: [LawForm; [$($name),*].len()] = [$(LawForm::$form),*];

            /// The name in descriptions of scenes.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self { $(LawForm::$form => $name,)* }
            }
        }
    };
}

forms! {
    Pieces "pieces" "Straight pieces.";
    Exponential "exponential" "One exponential.";
    Rational "rational" "One hyperbola.";
}

impl LawForm {
    /// Whether the equations between two events are linear.
    #[must_use]
    pub fn is_straight(self) -> bool {
        match self {
            LawForm::Pieces => true,
            LawForm::Exponential | LawForm::Rational => false,
        }
    }
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

/// A change of an exponential by more than this many of its decay velocities is no small one: the difference of its values
/// at both ends has all its digits. What is left of it here, `exp(−40)`, is no part of any friction.
pub const FAR: f64 = 40.0;

impl Piece {
    /// Its form.
    #[must_use]
    pub fn form(self) -> LawForm {
        match self {
            Piece::Linear { .. } => LawForm::Pieces,
            Piece::Exponential { .. } => LawForm::Exponential,
            Piece::Rational { .. } => LawForm::Rational,
        }
    }

    /// μ at the speed `speed ≥ 0`.
    #[must_use]
    pub fn mu(self, speed: f64) -> f64 {
        match self {
            Piece::Linear { at_zero, slope } => at_zero + slope * speed,
            Piece::Exponential { floor, height, rate } => floor + height * (-rate * speed).exp(),
            Piece::Rational { at_zero, decay } => at_zero / (1.0 + decay * speed),
        }
    }

    /// The part of μ that fades with the speed: 0 of a straight piece.
    #[must_use]
    pub fn fading(self, speed: f64) -> f64 {
        match self {
            Piece::Linear { .. } => 0.0,
            Piece::Exponential { height, rate, .. } => height * (-rate * speed).exp(),
            Piece::Rational { .. } => self.mu(speed),
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

    /// This piece of the law as a function of `|v|/velocity_unit`.
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

    /// The form of its pieces, which is the same for all.
    #[must_use]
    pub fn form(&self) -> LawForm {
        self.pieces[0].form()
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
