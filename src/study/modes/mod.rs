//! Eigenvalues along an axis.

#[cfg(feature = "figures")]
pub mod figure;
pub mod follow;
#[cfg(feature = "figures")]
pub mod read;
