//! A cycle followed while a parameter rises and falls.

pub mod figure;
pub mod follow;
pub mod read;
pub mod table;
