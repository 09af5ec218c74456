//! One element: its shape functions, its points of integration, its stiffness and mass.
//!
//! Nodes are ordered as Abaqus, CalculiX and VTK order them.

mod face;
mod kind;
mod matrices;
mod rule;
mod shape;

pub use face::{FaceKind, face_shape};
pub use kind::Kind;
pub use matrices::{Matrices, matrices};
pub use rule::{Inertia, Point, face_rule, mass_rule, stiffness_rule, triangle_rule};
pub use shape::{Shape, shape};

pub(crate) use matrices::{add_geometric, jacobian};
