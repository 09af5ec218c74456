//! Eigenvalues along an axis.
//!
//! - [`follow`]: all modes from value to value, and their table.
//! - [`figure`]: their figure; [`read`]: both read back.

#[cfg(feature = "figures")]
pub mod figure;
pub mod follow;
#[cfg(feature = "figures")]
pub mod read;
