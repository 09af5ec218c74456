//! A campaign of braking tests: what each stroke of its records says, and what strokes of one condition have in common.

pub mod condition;
#[cfg(feature = "figures")]
pub mod figure;
#[cfg(feature = "figures")]
pub mod read;
pub mod row;
