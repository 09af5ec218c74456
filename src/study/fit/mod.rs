//! Measured friction → a material.

pub use squares::*;

pub mod errors;
pub mod squares;
pub mod table;
