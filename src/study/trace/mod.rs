//! One instance over time.

#[cfg(feature = "figures")]
pub mod figure;
#[cfg(feature = "figures")]
pub mod read;
pub mod run;
#[cfg(feature = "figures")]
pub mod table;
