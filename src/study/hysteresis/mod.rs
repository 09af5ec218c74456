//! A cycle followed while a parameter rises and falls.
//!
//! - [`follow`]: both branches, value by value.
//! - [`table`], [`figure`]: their files; `cycles` are the branches of cycles in the figure.
//! - [`read`]: these read back.

#[cfg(feature = "figures")]
mod cycles;
#[cfg(feature = "figures")]
pub mod figure;
pub mod follow;
#[cfg(feature = "figures")]
pub mod read;
#[cfg(feature = "figures")]
pub mod table;
