//! From a mesh, supports and contact to sparse matrices.
//!
//! The displacements are u = Z q + g: q are the unknowns, g what is prescribed, and the rows of Z say how a node moves with the
//! unknowns. Supports, bonded nodes and tied normal displacements are all rows of Z.

mod along;
mod build;
mod joined;
mod loads;
mod model;
mod numbering;
mod penalty;
mod pencil;
mod point;
mod sparse;
mod springs;
mod supports;
mod surface;

pub use build::assemble;
pub use joined::check_joined;
pub use loads::{Loads, internal_forces, load_vector, nodal_forces};
pub use model::Model;
pub use numbering::Numbering;
pub use penalty::Penalty;
pub use pencil::{Modal, Pencil};
pub use point::{Partly, Point};
pub use sparse::{Pattern, Rows, Symmetric};
pub use supports::{Supports, Tie};
pub use surface::{SHARE, Surface, pressures};
