//! The model: eigenvalues and the speed of its modes.

pub(crate) mod fastest;
pub(crate) mod linear;
pub(crate) mod spectrum;
