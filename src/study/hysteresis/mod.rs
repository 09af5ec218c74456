//! A cycle followed while a parameter rises and falls.

#[cfg(feature = "figures")]
pub mod figure;
pub mod follow;
#[cfg(feature = "figures")]
pub mod read;
#[cfg(feature = "figures")]
pub mod table;
