//! Curves over the planes of a map on which cycles meet, double their period, become tori, or are born.
//!
//! - [`seek`]: lines across each plane are gone up and down, and what is special on them is followed over both parameters.
//! - [`table`], [`figure`]: their files; [`read`]: these read back.

pub mod figure;
pub mod read;
pub mod seek;
pub mod table;
