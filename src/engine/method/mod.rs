//! How a step is taken, one file per method.
//!
//! - [`taylor`]: Taylor series of the solution on one contact state, the reference method.
//! - [`rk4`]: the classical Runge–Kutta step with dense output, for comparison.
//! - [`fixed`]: events seen at the ends of steps only, for comparison.
//! - [`pace`]: the longest step that resolves every mode of a contact state.
//! - [`roots`]: the first crossing of a polynomial event function inside a step.

pub mod fixed;
pub mod pace;
pub mod rk4;
pub mod roots;
pub mod taylor;

use roots::Crossing;

/// How an integration steps and finds its events. Contact states, transitions and observables are the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Taylor series, events located: the reference.
    #[default]
    Taylor,
    /// Classical Runge–Kutta steps of fixed length, half of it in free flight; events located on the dense output. For
    /// comparison.
    LocatedRk4,
    /// Classical Runge–Kutta steps of fixed length; the contact state changes at their ends only. For comparison.
    FixedStep,
}

impl Method {
    /// The function that finds the first event of a step, see [`roots::first_crossing`].
    #[must_use]
    pub fn finder(self) -> fn(&[f64], f64, bool) -> Crossing {
        match self {
            Method::Taylor | Method::LocatedRk4 => roots::first_crossing,
            Method::FixedStep => fixed::at_end,
        }
    }
}
