//! Sweeps of any size in a directory, tile by tile.
//!
//! A grid is cut into tiles of a fixed number of instances. Each is a file in `tiles/` that appears complete or
//! not at all, says of which sweep, program and engine it is, and carries a checksum. Nothing else is the truth:
//! what is done is found by reading the tiles, and a tile that is not what it should be is set aside and done
//! again. What a stopped run has of a tile is kept beside it, in a file of the same form, until the tile is there. So a run
//! goes on where it was stopped or killed, several processes work in one directory, and memory holds the records of a few
//! tiles whatever the size of the sweep.
//!
//! - [`tiling`], [`cut`]: how a sweep is cut, and into how many tiles.
//! - [`identity`], [`grid_json`]: which sweep, program and engine, as one hash.
//! - [`columns`], [`starts`], [`tile`]: records as bytes, with header and checksum.
//! - [`description`](mod@description): the file `tiles/sweep.json`; [`seal`]: it shows when it was changed.
//! - [`claim`]: one process at a time writes a file.
//! - [`direct`]: bytes of large tiles, past the system's cache.
//! - `folder.rs`: files of a folder, what is set aside.
//! - [`directory`]: the tiles of a directory.
//! - `begin.rs`, [`fill`], [`finish`]: a directory made ready, its missing tiles computed, and these checked and written.
//! - [`parts`]: pieces of a sweep whose order shows only on the way; [`refinement`]: what asks for them.
//! - [`reuse`]: what another directory has of it.
//! - [`shard`]: a share of the tiles.
//! - [`status`], [`merge`](mod@merge): how far a directory has come; several directories in one.
//! - [`origin`], [`occupant`]: from which input file a directory was made, and whose results it holds.
//! - [`space`]: how much of the disk it takes.
//! - [`error`]: why a directory cannot be read or written.

mod begin;
pub mod claim;
pub mod columns;
pub mod cut;
pub mod description;
pub mod direct;
pub mod directory;
pub mod error;
pub mod fill;
pub mod finish;
mod folder;
pub mod grid_json;
pub mod identity;
pub mod merge;
pub mod occupant;
pub mod origin;
pub mod parts;
pub mod refinement;
pub mod reuse;
pub mod seal;
pub mod shard;
pub mod space;
pub mod starts;
pub mod status;
pub mod tile;
pub mod tiling;
