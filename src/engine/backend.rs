//! What may compute.

use crate::engine::method::Method;

/// The backend that is asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Backend {
    /// A hardware GPU where there is one, else the CPU engine.
    #[default]
    Auto,
    /// A GPU, or a software adapter.
    Gpu,
    /// The CPU engine: many instances at a time in vector registers.
    Cpu,
    /// The f64 reference, one instance at a time.
    Reference,
    /// Runge–Kutta steps in its place, events located: to compare with.
    LocatedRk4,
    /// Runge–Kutta steps in its place, events at their ends: to compare with.
    FixedStep,
}

impl Backend {
    /// All that compute.
    pub const ALL: [Backend; 5] =
        [Backend::Gpu, Backend::Cpu, Backend::Reference, Backend::LocatedRk4, Backend::FixedStep];

    /// All that a user may ask for.
    pub const OFFERED: [Backend; 4] = [Backend::Auto, Backend::Gpu, Backend::Cpu, Backend::Reference];

    /// The name in tables, manifests, and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Backend::Auto => "auto",
            Backend::Gpu => "gpu",
            Backend::Cpu => "cpu",
            Backend::Reference => "reference",
            Backend::LocatedRk4 => "located RK4",
            Backend::FixedStep => "fixed step",
        }
    }

    /// The one of this name.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Backend> {
        Backend::ALL.into_iter().find(|backend| backend.name() == name)
    }

    /// The one that computes by a method, one instance at a time.
    #[must_use]
    pub fn of_method(method: Method) -> Backend {
        match method {
            Method::Taylor => Backend::Reference,
            Method::LocatedRk4 => Backend::LocatedRk4,
            Method::FixedStep => Backend::FixedStep,
        }
    }

    /// Whether it is there to be compared with: no accuracy is reached by it that another does not reach faster.
    #[must_use]
    pub fn is_comparison(self) -> bool {
        matches!(self, Backend::LocatedRk4 | Backend::FixedStep)
    }

    /// The method of those that compute one instance at a time in f64.
    #[must_use]
    pub fn method(self) -> Option<Method> {
        match self {
            Backend::Reference => Some(Method::Taylor),
            Backend::LocatedRk4 => Some(Method::LocatedRk4),
            Backend::FixedStep => Some(Method::FixedStep),
            Backend::Auto | Backend::Gpu | Backend::Cpu => None,
        }
    }
}
