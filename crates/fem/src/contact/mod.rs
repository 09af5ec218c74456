//! Surfaces in contact: sliding points and bonded pairs.

mod interpolated;
mod matching;
mod mortar;
mod rotation;

pub use crate::assembly::{Point, SHARE, Surface, pressures};
pub use interpolated::bonded_points;
pub use matching::{bonded, conforms, periodic, sliding, sliding_on_rigid};
pub use mortar::{bonded_mortar, mortar, overhangs};
pub use rotation::rotating;
