//! Complex eigenvalues of elastic bodies in sliding contact, by finite elements.
//!
//! The folders are the way of the data:
//!
//! | stage | module |
//! |---|---|
//! | files of Gmsh, Abaqus and CalculiX | [`read`] |
//! | nodes, elements, sets; structured blocks | [`mesh`] |
//! | constants of a material | [`material`] |
//! | shape functions, quadrature, stiffness and mass of one element | [`elements`] |
//! | supports, numbering, sparse matrices, loads | [`assembly`] |
//! | sliding and bonded surfaces | [`contact`] |
//! | a load, which points stay in contact, normal forces | [`statics`] |
//! | real modes, projection, complex eigenvalues, coalescence | [`modes`] |
//! | what ParaView reads | [`output`] |
//!
//! Units are SI throughout: m, kg, s, N, Pa. The theory stands in `docs/fem.md`.

pub mod assembly;
pub mod contact;
pub mod elements;
pub mod error;
pub mod material;
pub mod mesh;
pub mod modes;
pub mod output;
pub mod read;
pub mod statics;

pub use error::Error;
