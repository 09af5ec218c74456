//! What the commands have written, read back: enough of each directory to draw its figure again.
//!
//! - `kind.rs`: which figures there are, what each is drawn from, and which of them a directory holds.
//! - `picture.rs`: one figure read back, ready to be drawn at any width.
//! - `map.rs`: the map of `run`; its table is there for quantities too.
//! - `trace.rs`, `hysteresis.rs`, `modes.rs`, `tradeoff.rs`, `paper.rs`, `refined.rs`, `identify.rs`: the other
//!   commands.
//! - `folder.rs`: files and tables of a directory, and what to say when they are not as they should be.

mod folder;
mod hysteresis;
mod identify;
mod kind;
mod map;
mod modes;
mod paper;
mod picture;
mod refined;
mod trace;
mod tradeoff;

pub use kind::Kind;
pub use map::{Archive, NumberColumn};
pub use picture::Picture;
