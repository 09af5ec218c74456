//! The accuracy that a user asks for.

use std::fmt;

/// An accuracy that can be asked for: the reference, or a bound on the relative errors of `x2_std`, `ax_rms`, `ay_rms` and
/// `response_frequency` that 95 % of the settled oscillations keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Level {
    /// A bound on the relative error.
    Within(f64),
    /// The f64 reference.
    Reference,
}

/// Largest bound: an error of a tenth is no result.
const LARGEST: f64 = 0.1;

/// The names, and what they stand for.
pub const NAMES: [(&str, Level); 4] = [
    ("draft", Level::Within(1e-2)),
    ("standard", Level::Within(1e-3)),
    ("paper", Level::Within(1e-4)),
    ("reference", Level::Reference),
];

impl Level {
    /// The level of a name or a number.
    ///
    /// # Errors
    /// What may be written, as the end of a sentence.
    pub fn parse(text: &str) -> Result<Level, String> {
        if let Some((_, level)) = NAMES.into_iter().find(|(name, _)| *name == text) {
            return Ok(level);
        }
        match text.parse::<f64>() {
            Ok(bound) if bound > 0.0 && bound <= LARGEST => Ok(Level::Within(bound)),
            _ => Err(format!(
                "must be draft (1e-2), standard (1e-3), paper (1e-4), reference, or a relative error above 0 and at \
                 most {LARGEST}"
            )),
        }
    }
}

impl fmt::Display for Level {
    /// The name, where there is one, and the bound: `standard (1e-3)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = NAMES.into_iter().find(|(_, level)| level == self).map(|(name, _)| name);
        match (name, self) {
            (Some(name), Level::Within(bound)) => write!(f, "{name} ({bound:e})"),
            (None, Level::Within(bound)) => write!(f, "{bound:e}"),
            (_, Level::Reference) => f.write_str("reference"),
        }
    }
}
