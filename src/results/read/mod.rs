//! Results of `run` and `refine` read back: enough to draw the figure again, and the columns of the table.
//!
//! - [`folder`]: the files of a directory, and errors that name them.
//! - [`map`], [`refined`]: a map, and a refined map.
//! - [`slice`](mod@slice): a part of a map.
//! - [`compare`]: two maps of the same grid.

pub use crate::results::choose::Taken;
pub use map::Archive;

pub mod compare;
pub mod folder;
pub mod map;
pub mod refined;
pub mod slice;
