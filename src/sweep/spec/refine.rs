//! `[refine]`: how a map is refined.

/// How a map is refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Cells along each side of a plane to begin with.
    pub coarse: usize,
    /// How many instances that no line asks for are drawn, to see how much is missed.
    pub sample: usize,
    /// Seed of the drawing.
    pub seed: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings { coarse: 32, sample: 1000, seed: 1 }
    }
}

/// Fewest and most coarse cells along a side.
pub const COARSE: (usize, usize) = (2, 4096);
