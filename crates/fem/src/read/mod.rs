//! Meshes of other programs: Gmsh's `.msh` (2 and 4.1, text) and the `.inp` of Abaqus and CalculiX; and what was written for ParaView.

mod abaqus;
mod cards;
mod gmsh;
mod raw;
mod sets;
mod unread;
mod vtu;

pub use abaqus::{Deck, abaqus, abaqus_at};
pub use gmsh::gmsh;
pub use vtu::vtu;
