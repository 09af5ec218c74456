//! What a device computes in.

use crate::engine::precision::Precision;

/// What a device computes in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arithmetic {
    /// The scalar.
    pub precision: Precision,
    /// Whether every operation is rounded by itself, as on the CPU, at the price of some speed.
    pub strict: bool,
}

impl From<Precision> for Arithmetic {
    /// Not strict.
    fn from(precision: Precision) -> Arithmetic {
        Arithmetic { precision, strict: false }
    }
}
