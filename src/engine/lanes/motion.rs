//! Which laws and contact states a step is built for.

/// The laws of a pass are straight pieces.
pub const PIECES: bool = false;

/// They have one of the curved forms; which one is known when it runs.
pub const CURVED: bool = true;

/// Motion of `x2` alone: θ = 0 and `y1` at rest, so that the normal force is that of the equilibrium.
pub const SINGLE: u8 = 0;

/// No lane flies: `y2` is 0.
pub const CLOSED: u8 = 1;

/// Some lane may fly.
pub const FLIGHT: u8 = 2;
