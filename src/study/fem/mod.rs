//! Figures of a finite-element study: curves over friction or another parameter, pictures of its mesh and of its modes; each read back.

#[cfg(feature = "fem")]
mod bodies;
mod curves;
#[cfg(feature = "fem")]
mod mesh;
#[cfg(feature = "fem")]
mod of_study;
#[cfg(feature = "fem")]
mod open;
#[cfg(feature = "fem")]
mod painting;
#[cfg(feature = "fem")]
mod paper;
#[cfg(feature = "fem")]
mod pictures;
pub(crate) mod read;
#[cfg(all(feature = "identify", not(feature = "fem")))]
mod without;

#[cfg(feature = "fem")]
pub use bodies::{Bodies, Sliding};
pub use curves::{Curve, Curves, State, Transition};
#[cfg(feature = "fem")]
pub use open::{of_study, open, study};
#[cfg(feature = "fem")]
pub use paper::{claims, report};
#[cfg(all(feature = "identify", not(feature = "fem")))]
pub(crate) use without::Bodies;
