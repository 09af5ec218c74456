//! A cycle followed while a parameter rises and falls.
//!
//! - [`follow`]: both branches, value by value.
//! - [`table`], [`figure`]: their files.
//! - [`read`]: these read back.

pub mod figure;
pub mod follow;
pub mod read;
pub mod table;
