//! Branches of limit cycles over a parameter: stable and unstable ones, through folds.
//!
//! A cycle is a fixed point of the return map. Where the parameter moves, so does the point: a curve in the space of both,
//! which is followed by its arc length (pseudo-arclength continuation), so that it may turn back.
//!
//! - `map`: the return map over coordinates and parameter.
//! - `newton`: a fixed point near a guess, its Jacobian and its tangent.
//! - `follow`: from one fixed point to the next.
//! - `corner`: where the sequence of contact states changes, the curve has a corner.
//! - [`special`]: where stability changes, to the rounding.
//! - [`branch`]: what is found.
//! - [`curve`]: a special point followed over a second parameter; `locate`: near where it is expected.
//!
//! References: H. B. Keller, in "Applications of Bifurcation Theory" (1977); M. di Bernardo et al., "Piecewise-smooth
//! Dynamical Systems" (Springer, 2008), chapters 2 and 8.

pub mod branch;
mod corner;
pub mod curve;
mod follow;
mod locate;
pub(crate) mod map;
mod newton;
pub mod special;
