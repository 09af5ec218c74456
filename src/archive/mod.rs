//! What the commands have written, read back: enough of each directory to draw its figure again.
//!
//! - `kind.rs`: which figures there are, what each is drawn from, and which of them a directory holds.
//! - `picture.rs`: one figure read back, ready to be drawn at any width.
//! - `map.rs`: the map of `run`; its table is there for quantities too.
//! - `choose.rs`, `slice.rs`: a value of an axis by its name, and the part of a map that has it.
//! - `trace.rs`, `hysteresis.rs`, `modes.rs`, `tradeoff.rs`, `paper.rs`, `refined.rs`, `identify.rs`: the other
//!   commands.
//! - `compare.rs`: two maps of the same grid beside one another.
//! - `folder.rs`: files and tables of a directory, and what to say when they are not as they should be.

pub(crate) mod choose;
pub mod compare;
mod folder;
mod hysteresis;
mod identify;
mod kind;
mod map;
mod modes;
mod paper;
mod picture;
mod refined;
mod slice;
mod trace;
mod tradeoff;

pub use choose::Taken;
pub use kind::Kind;
pub use map::{Archive, NumberColumn};
pub use picture::Picture;
