//! A map to look into: a sweep that is open, regions of its map, and single cells, asked for and answered as bytes; and the page that
//! asks.
//!
//! A question is a JSON object, see [`explorer::Question`]. An [`answer::Answer`] is a JSON object and numbers beside it. The page of
//! `crates/explorer/page` asks WebAssembly made of this in the reader's browser, or the server of `squealmap explore`. Everything that
//! is computed comes from the engines, so that the numbers are those of `run` and `trace`.
//!
//! | module | what it answers |
//! |---|---|
//! | [`explorer`], [`opened`] | who is asked |
//! | [`by`] | what computes |
//! | [`about`](mod@about) | what varies, what may be varied, which columns there are |
//! | [`region`] | the cells of a rectangle of the map |
//! | [`finished`] | which of them a run has computed already |
//! | [`cell`] | one instance: eigenvalues, motion, friction law, record |
//! | [`mod@file`] | the sweep of a region as a sweep file |
//! | `page`, `archive` | the page of a sweep; a run read from its directory |

#[doc(inline)]
pub use explorer::Explorer;

pub mod about;
pub mod answer;
#[cfg(feature = "figures")]
pub mod archive;
pub mod by;
pub mod cell;
pub mod explorer;
pub mod file;
pub mod finished;
pub mod opened;
#[cfg(feature = "figures")]
pub mod page;
pub mod place;
pub mod region;
