//! Friction laws: μ(|v|) and its slope, both from the same piece of the law.
//!
//! A law is a chain of smooth pieces in `|v|`. Between two kinks a trajectory stays on one piece, which
//! the integrator continues analytically; crossing a kink is an event. At a kink the slope is that of
//! the larger `|v|`.

use std::sync::Arc;

/// Which law; the parameters of each are in [`FrictionLaw`].
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
