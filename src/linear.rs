//! Complex eigenvalue analysis and attribution: independent of method, observe and classify.

/// Eigenvalue analysis of one sliding equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear {
    /// Largest real part of the eigenvalues, both mechanisms present, 1/s.
    pub growth_rate: f64,
    /// Its imaginary part over 2π, Hz.
    pub frequency: f64,
    /// Phase of `ÿ1` against `ẍ2` in that mode, degrees in (−180, 180]; `None` at θ = 0 and for real eigenvalues.
    pub phase: Option<f64>,
    /// Growth rate with the slope set to 0 (mode coupling alone), 1/s.
    pub growth_rate_flat: f64,
    /// Growth rate with the normal force frozen (negative slope alone), 1/s.
    pub growth_rate_frozen: f64,
}
