//! What `run` and `refine` have written, read back: enough to draw the figure again, and the columns of the table.

pub use crate::results::choose::Taken;
pub use map::Archive;

pub mod compare;
pub mod folder;
pub mod map;
pub mod refined;
pub mod slice;
