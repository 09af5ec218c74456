//! How a sweep is cut into tiles.

use std::ops::Range;

/// Most instances of a tile: some 3 MB of eigenvalues, 14 MB with response.
pub const TILE: usize = 65_536;

/// Fewest, however much they cost: they fill the lanes of one core's widest register.
pub const LEAST: usize = 16;

/// The tiles of a sweep; their bounds depend on nothing else, so that threads, processes and machines agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tiling {
    /// Instances of the sweep.
    pub instances: usize,
    /// Instances of a tile, at least 1; the last one may have fewer.
    pub tile: usize,
}

impl Tiling {
    /// The number of tiles.
    #[must_use]
    pub fn count(self) -> usize {
        self.instances.div_ceil(self.tile)
    }

    /// The instances of tile `number`.
    #[must_use]
    pub fn bounds(self, number: usize) -> Range<usize> {
        let first = number * self.tile;
        first..(first + self.tile).min(self.instances)
    }
}
