//! Limit cycles found as fixed points of the return map: by Newton's method from a transient that approaches one.
//!
//! The section is where `ẋ2` rises through zero. A point on it is followed for some returns; so are neighbours, one for each
//! coordinate, and their differences make the Jacobian of the map. What Newton's method then finds is the cycle that the
//! transient comes to only if it is stable, if all neighbours pass through the same contact states, and if the transient's
//! own last returns approach it as the multipliers predict.
//!
//! | question | where |
//! |---|---|
//! | a point of the section, and a return to it | [`point`] |
//! | which points an engine is to follow next | [`hunt`] |
//! | whether a transient comes to the cycle that was found | [`candidate`], [`approach`] |
//! | when a run looks for its cycle | [`pursuit`] |

pub mod approach;
pub mod candidate;
pub mod hunt;
pub mod point;
pub mod pursuit;
