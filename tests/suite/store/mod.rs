//! Directories of tiles: whole, damaged, shared, stopped and gone on with.

pub(crate) mod bistable_files;
pub(crate) mod direct;
pub(crate) mod earlier;
#[cfg(unix)]
pub(crate) mod interrupt;
#[cfg(unix)]
pub(crate) mod killed;
pub(crate) mod left_alone;
pub(crate) mod occupied;
pub(crate) mod refine_parts;
pub(crate) mod refine_whole;
pub(crate) mod resume;
pub(crate) mod reuse;
pub(crate) mod shards;
#[cfg(unix)]
pub(crate) mod submit;
pub(crate) mod tile_cost;
pub(crate) mod tiles;
pub(crate) mod turmoil;
#[cfg(unix)]
pub(crate) mod unwritable;
pub(crate) mod whole;
