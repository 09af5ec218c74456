//! Why no model has what was measured.

/// Why no model has what was measured.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// Frequencies that do not rise.
    #[error(
        "the frequencies are {first} and {second} Hz but must rise; give the lower one first with --frequencies"
    )]
    NotRising {
        /// The first, Hz.
        first: f64,
        /// The second, Hz.
        second: f64,
    },
    /// Friction that no inclination makes critical.
    #[error(
        "modes at {first} and {second} Hz do not coalesce at a friction coefficient of {wanted}: with the inclinations that these \
         frequencies allow it is {low:.4} {}; measure the frequencies again (closer ones coalesce at less friction), or \
         give another --critical-friction",
        up_to(*high, *most)
    )]
    Coalescence {
        /// The lower frequency, Hz.
        first: f64,
        /// The upper one, Hz.
        second: f64,
        /// The friction coefficient that was measured.
        wanted: f64,
        /// The least that is possible.
        low: f64,
        /// The most that was tried, infinite where they do not coalesce at the flattest inclination.
        high: f64,
        /// The largest friction coefficient that was tried.
        most: f64,
    },
    /// Modes that no friction couples.
    #[error(
        "modes at {first} and {second} Hz do not coalesce at any friction coefficient up to {most}, whatever the inclination: they are too \
         far apart, or damped too differently; give the two that couple with --frequencies, or one ratio for both with --damping-ratio"
    )]
    NoCoalescence {
        /// The lower frequency, Hz.
        first: f64,
        /// The upper one, Hz.
        second: f64,
        /// The largest friction coefficient that was tried.
        most: f64,
    },
}

/// The end of a range of friction coefficients.
fn up_to(high: f64, most: f64) -> String {
    if high.is_finite() { format!("to {high:.4}") } else { format!("and more, looked for up to {most}") }
}
