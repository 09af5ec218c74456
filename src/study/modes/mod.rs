//! Eigenvalues along an axis.

pub mod figure;
pub mod follow;
pub mod read;
