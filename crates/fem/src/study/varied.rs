//! What may be varied beside friction, and whether it can be.

use super::document::{Document, Varied, Vary};
use super::values::rising;
use crate::Error;

impl Varied {
    /// Its name in a description.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::ContactStiffness => "contact_stiffness",
            Self::Stiffness => "stiffness",
            Self::Load => "load",
            Self::Damping => "damping",
            Self::Slope => "slope",
        }
    }

    /// What it is, and its unit.
    fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::ContactStiffness => ("Contact stiffness", "Pa/m"),
            Self::Stiffness => ("Factor of the moduli", ""),
            Self::Load => ("Factor of the load", ""),
            Self::Damping => ("Factor of the damping", ""),
            Self::Slope => ("Slope of friction", "s/m"),
        }
    }
}

impl Vary {
    /// What is varied, of which material, and its unit.
    #[must_use]
    pub fn words(&self) -> [String; 2] {
        let (what, unit) = self.parameter.words();
        let of = self.material.iter().map(|material| format!(" of {}", material.replace('_', " ")));
        [what.to_owned() + &of.collect::<String>(), unit.to_owned()]
    }
}

/// Checks what is varied.
pub(super) fn check_vary(document: &Document) -> Result<(), Error> {
    let Some(vary) = &document.vary else { return Ok(()) };
    let wrong = |key: &str, what: String| Err(Error::at(format!("vary.{key}"), what));
    let values = rising("vary.values", &vary.values)?;
    if !(vary.mu >= 0.0 && vary.mu.is_finite()) {
        return wrong("mu", format!("{} is no coefficient of friction, it must be 0 or more", vary.mu));
    }
    let least = match vary.parameter {
        Varied::Slope => f64::NEG_INFINITY,
        Varied::Damping => 0.0,
        Varied::ContactStiffness | Varied::Stiffness | Varied::Load => f64::MIN_POSITIVE,
    };
    if let Some(value) = values.iter().find(|value| !(**value >= least && value.is_finite())) {
        let limit = match vary.parameter {
            Varied::Slope => "a finite number",
            Varied::Damping => "0 or more",
            Varied::ContactStiffness | Varied::Stiffness | Varied::Load => "above 0",
        };
        return wrong("values", format!("{value} is no {}, it must be {limit}", vary.parameter.name()));
    }
    match (vary.parameter, &vary.material) {
        (Varied::Stiffness, Some(name)) if document.materials.contains_key(name) => {}
        (Varied::Stiffness, name) => {
            let all: Vec<&str> = document.materials.keys().map(String::as_str).collect();
            let name =
                name.as_ref().map_or("none is named".to_owned(), |name| format!("there is no \"{name}\""));
            return wrong(
                "material",
                format!("{name}: name the material whose stiffness is varied, of {}", all.join(", ")),
            );
        }
        (_, None) => {}
        (_, Some(_)) => {
            let what = format!("a material has no {} of its own: leave it out", vary.parameter.name());
            return wrong("material", what);
        }
    }
    if vary.parameter == Varied::ContactStiffness && document.friction.contact_stiffness.is_none() {
        let what = "the surfaces do not overlap (multipliers): give friction.contact_stiffness, too";
        return wrong("parameter", what.to_owned());
    }
    if vary.parameter == Varied::Damping
        && document.materials.values().all(|constants| constants.rayleigh.iter().all(|c| *c == 0.0))
    {
        return wrong(
            "parameter",
            "no material has Rayleigh damping: give one, as rayleigh = [0, 1e-8]".to_owned(),
        );
    }
    let by_modes = !document.modes.damping_ratios.is_empty()
        || document.materials.values().any(|constants| constants.loss_factor > 0.0);
    if by_modes {
        let what =
            "a variation knows Rayleigh damping only: leave out damping_ratios and loss_factor, or [vary]";
        return wrong("parameter", what.to_owned());
    }
    Ok(())
}
