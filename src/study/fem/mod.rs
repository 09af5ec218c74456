//! Figures of a finite-element study: curves over friction, pictures of its mesh and of its modes; the curves read back.

mod curves;
#[cfg(feature = "fem")]
mod mesh;
#[cfg(feature = "fem")]
mod of_study;
#[cfg(feature = "fem")]
mod painting;
#[cfg(feature = "fem")]
mod paper;
#[cfg(feature = "fem")]
mod pictures;
pub(crate) mod read;

pub use curves::{Curve, Curves, State, Transition};
#[cfg(feature = "fem")]
pub use mesh::mesh_svg;
#[cfg(feature = "fem")]
pub use paper::{claims, report};
#[cfg(feature = "fem")]
pub use pictures::pictures_svg;
