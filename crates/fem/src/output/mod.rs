//! What other programs read.

mod vtu;

pub use vtu::{Field, vtu};
