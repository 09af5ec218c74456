//! Measured friction → a material.

mod errors;
mod fault;
mod problem;
mod squares;
pub mod table;

pub use fault::FitFault;
pub use squares::{Fit, fit, range};
