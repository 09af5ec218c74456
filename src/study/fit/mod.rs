//! Measured friction → a material.
//!
//! - `squares.rs`: the fit by least squares; `problem.rs`: points as a linear problem.
//! - `errors.rs`: how far the values of a fit would scatter.
//! - [`table`]: the files of a fit.
//! - `fault.rs`: why there is none.

mod errors;
mod fault;
mod problem;
mod shape;
mod squares;
pub mod table;

pub use fault::FitFault;
pub use squares::{Fit, fit, range};
