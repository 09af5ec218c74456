//! What other programs read.

mod inp;
mod vtu;

pub use inp::inp;
pub use vtu::{Field, vtu};
