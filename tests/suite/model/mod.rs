//! The model: eigenvalues, the quartic behind them, and the speed of its modes.

pub(crate) mod fastest;
pub(crate) mod linear;
pub(crate) mod quartic;
pub(crate) mod spectrum;
