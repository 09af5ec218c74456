//! How a step is taken, one file per method.
//!
//! - [`taylor`]: Taylor series of the solution on one contact state, the reference method.
//! - [`pace`]: the longest step that resolves every mode of a contact state.
//! - [`quartic`]: the eigenvalues of two degrees of freedom in closed form.
//! - [`roots`]: the first crossing of a polynomial event function inside a step.

pub mod pace;
pub mod quartic;
pub mod roots;
pub mod taylor;
