//! Measured friction → a material.

mod errors;
mod fault;
mod problem;
mod shape;
mod squares;
pub mod table;

pub use fault::FitFault;
pub use squares::{Fit, fit, range};
