//! The arithmetic of a device: its scalar, and how it rounds.

use crate::engine::precision::Precision;

/// The arithmetic that a device is opened for.
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
