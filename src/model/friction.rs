//! Friction laws: μ(|v|) and its slope, both from the same piece of the law.
//!
//! A law is a chain of smooth pieces in `|v|`, see [`crate::model::piece`]. All that a law is to the rest of the program stands
//! here: its row in the table, and a match on every law for what a row cannot say. A law that lacks one does not compile.

use std::cmp::Ordering;
use std::sync::Arc;

use crate::model::piece::{LawForm, Piece, PieceChain};
use crate::model::{PARAMS, Param, Params};

pub use crate::model::table::MuTable;

macro_rules! laws {
    ($($kind:ident $name:literal $form:ident [$($needs:ident)*] [$($takes:ident)*];)*) => {
        /// Which law; the parameters of each are in [`FrictionLaw`].
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[expect(missing_docs, reason = "the variants are the names of the laws in FrictionLaw")]
        pub enum LawKind {
            $($kind,)*
        }

        impl LawKind {
            /// Every law.
            pub const ALL: [LawKind; [$($name),*].len()] = [$(LawKind::$kind),*];

            /// The name in a sweep file.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self { $(LawKind::$kind => $name,)* }
            }

            /// The form of its pieces.
            #[must_use]
            pub fn form(self) -> LawForm {
                match self { $(LawKind::$kind => LawForm::$form,)* }
            }

            /// The parameters that it cannot do without.
            #[must_use]
            pub fn needs(self) -> &'static [Param] {
                match self { $(LawKind::$kind => &[$(Param::$needs),*],)* }
            }

            /// The parameters that it takes where they are given.
            #[must_use]
            pub fn takes(self) -> &'static [Param] {
                match self { $(LawKind::$kind => &[$(Param::$takes),*],)* }
            }
        }
    };
}

// Name in a sweep file, form of the pieces, parameters that it needs, parameters that it takes where they are given.
laws! {
    Constant "constant" Pieces [MuD] [MuS];
    Bilinear "bilinear" Pieces [MuS MuD KneeVelocity] [];
    Exponential "exponential" Exponential [MuS MuD StribeckVelocity] [];
    Rational "rational" Rational [MuS Decay] [];
    Table "table" Pieces [] [];
}

impl LawKind {
    /// The law with this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<LawKind> {
        LawKind::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// Whether it reads `param`.
    #[must_use]
    pub fn reads(self, param: Param) -> bool {
        self.needs().contains(&param) || self.takes().contains(&param)
    }

    /// Every parameter of some law: what a material may give.
    pub fn params() -> impl Iterator<Item = Param> {
        PARAMS
            .iter()
            .map(|row| row.param)
            .filter(|param| LawKind::ALL.into_iter().any(|kind| kind.reads(*param)))
    }

    /// Whether it is read from a table, and not made of parameters.
    #[must_use]
    pub fn reads_table(self) -> bool {
        match self {
            LawKind::Table => true,
            LawKind::Constant | LawKind::Bilinear | LawKind::Exponential | LawKind::Rational => false,
        }
    }

    /// The law with these parameters; the constant one has `μ_s = μ_d` where only `μ_d` is given.
    ///
    /// # Panics
    /// When a parameter or the table is missing, which validation excludes.
    #[must_use]
    pub fn with(self, params: &Params, table: Option<&Arc<MuTable>>) -> FrictionLaw {
        let mu_s = || params.require(Param::MuS);
        let mu_d = || params.require(Param::MuD);
        match self {
            LawKind::Constant => {
                let mu_d = mu_d();
                FrictionLaw::Constant { mu_s: params.get(Param::MuS).unwrap_or(mu_d), mu_d }
            }
            LawKind::Bilinear => FrictionLaw::Bilinear {
                mu_s: mu_s(),
                mu_d: mu_d(),
                knee_velocity: params.require(Param::KneeVelocity),
            },
            LawKind::Exponential => FrictionLaw::Exponential {
                mu_s: mu_s(),
                mu_d: mu_d(),
                stribeck_velocity: params.require(Param::StribeckVelocity),
            },
            LawKind::Rational => FrictionLaw::Rational { mu_s: mu_s(), decay: params.require(Param::Decay) },
            LawKind::Table => {
                FrictionLaw::Table(Arc::clone(table.expect("the law `table` was validated to have its file")))
            }
        }
    }
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

impl FrictionLaw {
    /// Its parameters with their values; none of a table.
    #[must_use]
    pub fn parts(&self) -> Vec<(Param, f64)> {
        match *self {
            FrictionLaw::Constant { mu_s, mu_d } => vec![(Param::MuS, mu_s), (Param::MuD, mu_d)],
            FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity } => {
                vec![(Param::MuS, mu_s), (Param::MuD, mu_d), (Param::KneeVelocity, knee_velocity)]
            }
            FrictionLaw::Exponential { mu_s, mu_d, stribeck_velocity } => {
                vec![(Param::MuS, mu_s), (Param::MuD, mu_d), (Param::StribeckVelocity, stribeck_velocity)]
            }
            FrictionLaw::Rational { mu_s, decay } => vec![(Param::MuS, mu_s), (Param::Decay, decay)],
            FrictionLaw::Table(_) => Vec::new(),
        }
    }

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
        match self {
            FrictionLaw::Constant { mu_s, mu_d } => mu_s.partial_cmp(mu_d) != Some(Ordering::Less),
            FrictionLaw::Bilinear { .. }
            | FrictionLaw::Exponential { .. }
            | FrictionLaw::Rational { .. }
            | FrictionLaw::Table(_) => true,
        }
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
            FrictionLaw::Constant { .. }
            | FrictionLaw::Bilinear { .. }
            | FrictionLaw::Exponential { .. }
            | FrictionLaw::Rational { .. } => &[],
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
