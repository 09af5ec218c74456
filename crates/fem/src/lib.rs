//! Complex eigenvalues of elastic bodies in sliding contact, by finite elements.
//!
//! The folders are the way of the data:
//!
//! | stage | module |
//! |---|---|
//! | files of Gmsh, Abaqus and CalculiX | [`read`] |
//! | nodes, elements, sets; structured blocks, rings, cylinders | [`mesh`] |
//! | constants of a material | [`material`] |
//! | shape functions, quadrature, stiffness and mass of one element | [`elements`] |
//! | supports, numbering, sparse matrices, loads | [`assembly`] |
//! | sliding and bonded surfaces | [`contact`] |
//! | a load, which points stay in contact, normal forces | [`statics`] |
//! | real modes, projection, complex eigenvalues, coalescence | [`modes`] |
//! | many coefficients of friction | [`sweep`] |
//! | any other parameter | [`vary`] |
//! | what ParaView reads | [`output`] |
//! | all of this from a description in a file | [`study`] |
//!
//! A pin that slides on a clamped block, and the growth of its modes at one coefficient of friction:
//!
//! ```
//! use squealmap_fem::assembly::{Model, Rows, assemble};
//! use squealmap_fem::contact::sliding;
//! use squealmap_fem::elements::Kind;
//! use squealmap_fem::material::Material;
//! use squealmap_fem::mesh::Block;
//! use squealmap_fem::modes::{Basis, Factor, Ordering, lowest, pairs, refine};
//!
//! let kind = Kind::Hex20;
//! let block = Block { origin: [0.0; 3], size: [0.03, 0.01, 0.01], cells: [6.into(), 2.into(), 2.into()], kind };
//! let pin = Block { origin: [0.01, 0.0, 0.01], size: [0.01, 0.01, 0.025], cells: [2.into(), 2.into(), 5.into()], kind };
//! let steel = Material::isotropic("steel", 210e9, 0.3, 7800.0)?;
//! let mut model = Model { mesh: block.mesh()?, materials: vec![steel], ..Model::default() };
//! model.mesh.add(pin.mesh()?, "pin.", 0);
//! model.supports.clamp(model.mesh.node_set("z0")?);
//! model.supports.clamp(model.mesh.node_set("pin.z1")?);
//! let (slaves, masters) = (model.mesh.node_set("pin.z0")?, model.mesh.node_set("z1")?);
//! model.contact = sliding(&model.mesh, slaves, masters, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0])?;
//!
//! let (_, pencil) = assemble(&model)?;
//! let ordering = Ordering::new(&pencil.stiffness.pattern)?;
//! let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0)?;
//! let modes = lowest(&pencil, &factor, 20)?;
//! let mut basis = Basis::new(&pencil, &modes.shapes);
//! let no_slope = Rows::default();
//! refine(&pencil, &factor, &mut basis, &[0.4], &no_slope, 8, 1e-6, 20)?;
//! let unstable = pairs(&basis.at(0.4, &no_slope))?.into_iter().find(|pair| pair.growth() > 1.0);
//! let unstable = unstable.expect("two modes have coalesced below this friction");
//! assert!((unstable.frequency() - 64_170.8).abs() < 0.1);
//! # Ok::<(), squealmap_fem::Error>(())
//! ```
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
pub mod study;
pub mod sweep;
pub mod vary;

pub use error::Error;
pub use faer::c64;
