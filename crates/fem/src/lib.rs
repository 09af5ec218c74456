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
//! | many coefficients of friction | [`sweep`] |
//! | what ParaView reads | [`output`] |
//!
//! Units are SI throughout: m, kg, s, N, Pa. The theory stands in `docs/fem.md`.

#![allow(clippy::doc_markdown, reason = "symbols of equations, such as μ_c or K_n, are no code")]
#![allow(clippy::needless_range_loop, reason = "indices of directions and nodes are those of the formulas")]
#![allow(clippy::neg_cmp_op_on_partial_ord, reason = "what is no number takes the branch of what is wrong")]

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
pub mod sweep;

pub use error::Error;
