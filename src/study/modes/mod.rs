//! Eigenvalues along an axis.
//!
//! - [`follow`]: both modes from value to value, and their table.
//! - [`figure`]: their figure; [`read`]: both read back.

pub mod figure;
pub mod follow;
pub mod read;
