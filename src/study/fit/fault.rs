//! Why there is no fit.

/// Why there is no fit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitFault {
    /// None at all.
    #[error(
        "there is no point to fit: all rows are left out, as they vibrate or rest, or the contact is open there, or there are none; measure where \
         nothing squeals"
    )]
    NoPoints,
    /// Temperatures of some files, and not one for each.
    #[error(
        "{given} temperatures are given for {files} file(s); give --at-temperature one for all of them, or one for each in their order"
    )]
    Temperatures {
        /// Temperatures.
        given: usize,
        /// Files.
        files: usize,
    },
    /// Friction that opposes the sliding at some points and drives it at others.
    #[error(
        "the friction coefficient is below 0 at {negative} of {points} points: where strokes go both ways, the velocity needs a sign, or the force \
         none; make both have the sign of the motion"
    )]
    BothSigns {
        /// Points with a negative one.
        negative: usize,
        /// All of them.
        points: usize,
    },
    /// Fewer points than unknowns.
    #[error(
        "{points} point(s) do not determine {unknowns} value(s); measure more, or ask for fewer rows with --temperatures"
    )]
    TooFew {
        /// Points.
        points: usize,
        /// Values to find.
        unknowns: usize,
    },
    /// Rows that do not rise.
    #[error(
        "the temperatures of the rows are {first} and then {second} °C but must rise; sort --temperatures"
    )]
    NotRising {
        /// One temperature, °C.
        first: f64,
        /// The next, °C.
        second: f64,
    },
    /// Points that do not tell the parameters apart.
    #[error(
        "the points near {temperature} °C do not determine `{param}`: they cover velocities from {low} to {high} m/s; measure more velocities there, choose --law constant, or other --temperatures"
    )]
    Undetermined {
        /// The row, °C.
        temperature: f64,
        /// The parameter.
        param: &'static str,
        /// Lowest velocity near it, m/s.
        low: f64,
        /// Highest velocity near it, m/s.
        high: f64,
    },
    /// Points that do not make a table.
    #[error(
        "{points} point(s) near {temperature} °C, at {low} to {high} m/s, do not make a table, which takes two bins of 6 points \
         at velocities 2 % apart or more; measure more there, or ask for other rows with --temperatures"
    )]
    FewBins {
        /// The row, °C.
        temperature: f64,
        /// Points near it.
        points: usize,
        /// Their lowest velocity, m/s.
        low: f64,
        /// Their highest velocity, m/s.
        high: f64,
    },
    /// A law that cannot be fitted this way.
    #[error(
        "the law `{law}` is not linear in its coefficients; choose bilinear, exponential or constant with --law"
    )]
    Law {
        /// Its name.
        law: &'static str,
    },
    /// A negative friction coefficient.
    #[error(
        "`{param}` would be {value:.4} at {temperature} °C, but friction coefficients are not negative; choose another law, or other --temperatures"
    )]
    Negative {
        /// The parameter.
        param: &'static str,
        /// Its value.
        value: f64,
        /// The row, °C.
        temperature: f64,
    },
}
