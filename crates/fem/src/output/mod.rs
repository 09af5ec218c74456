//! What other programs read.

mod inp;
mod picture;
mod vtu;

pub use inp::inp;
pub use picture::{Facet, View, facets, isometric};
pub use vtu::{Field, vtu};
