//! A cycle followed while a parameter rises and falls.
//!
//! - [`follow`]: both branches, value by value.
//! - [`table`], [`figure`]: their files.
//! - [`read`]: these read back.

#[cfg(feature = "figures")]
pub mod figure;
pub mod follow;
#[cfg(feature = "figures")]
pub mod read;
#[cfg(feature = "figures")]
pub mod table;
