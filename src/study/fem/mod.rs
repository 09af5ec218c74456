//! Figures of a finite-element study: curves over friction, and pictures of its modes.

mod curves;
mod pictures;

pub use curves::curves_svg;
pub use pictures::pictures_svg;
