//! Numbers of a description: whether they are what they can be.

use super::document::{Document, Friction, Modes, Output, Values};
use super::modal::MOST as MOST_VECTORS;
use crate::Error;

/// Coefficients of friction, rising.
///
/// # Errors
/// What is no range and no list; values that fall, are negative or no numbers; too many.
pub(super) fn coefficients(mu: &Values) -> Result<Vec<f64>, Error> {
    let key = "friction.mu";
    let values = listed(key, mu)?;
    if let Some(mu) = values.iter().find(|mu| !(**mu >= 0.0 && mu.is_finite())) {
        return Err(Error::at(
            key,
            format!(
                "{mu} is no coefficient of friction, it must be 0 or more: turn the direction of sliding around instead"
            ),
        ));
    }
    in_order(key, values)
}

/// Values of any parameter, rising.
pub(super) fn rising(key: &str, values: &Values) -> Result<Vec<f64>, Error> {
    in_order(key, listed(key, values)?)
}

fn listed(key: &str, values: &Values) -> Result<Vec<f64>, Error> {
    /// A sweep of more values takes hours for curves that no print resolves.
    const MOST: usize = 100_000;
    let found = match (values.from, values.to, values.points, &values.values) {
        (Some(from), Some(to), Some(points), None) => {
            if !(2..=MOST).contains(&points) {
                let what = format!("there are {points} points, a range has 2 to {MOST}");
                return Err(Error::at(format!("{key}.points"), what));
            }
            let last = points - 1;
            // Both ends exactly.
            (0..points)
                .map(|i| if i == last { to } else { from + (to - from) * i as f64 / last as f64 })
                .collect()
        }
        (None, None, None, Some(values)) => values.clone(),
        _ => {
            let what = "it needs either from, to and points, or values: give one of both";
            return Err(Error::at(key, what));
        }
    };
    if found.is_empty() || found.len() > MOST {
        return Err(Error::at(key, format!("there are {} values, there must be 1 to {MOST}", found.len())));
    }
    Ok(found)
}

fn in_order(key: &str, values: Vec<f64>) -> Result<Vec<f64>, Error> {
    if let Some((before, after)) = values.iter().zip(&values[1..]).find(|(before, after)| !(before < after)) {
        return Err(Error::at(key, format!("{after} follows {before}: let the values rise")));
    }
    Ok(values)
}

/// Checks the other numbers of friction.
pub(super) fn check_friction(friction: &Friction) -> Result<(), Error> {
    if !friction.slope.is_finite() {
        return Err(Error::at("friction.slope", format!("{} s/m is no finite number", friction.slope)));
    }
    if let Some(k) = friction.contact_stiffness
        && !(k > 0.0 && k.is_finite())
    {
        let what = format!(
            "{k} Pa/m is no stiffness, it must be above 0; leave it out for surfaces that do not overlap"
        );
        return Err(Error::at("friction.contact_stiffness", what));
    }
    if !(friction.static_mu >= 0.0 && friction.static_mu.is_finite()) {
        return Err(Error::at("friction.static_mu", format!("{} must be 0 or more", friction.static_mu)));
    }
    Ok(())
}

/// Checks what modes are asked for.
pub(super) fn check_modes(modes: &Modes) -> Result<(), Error> {
    /// A projected problem of more modes is solved more slowly than its modes are worth.
    const MOST: usize = 500;
    /// Larger residuals are no modes.
    const WORST: f64 = 1e-2;
    if modes.count == 0 || modes.count > MOST {
        return Err(Error::at(
            "modes.count",
            format!("{} modes are asked for, it must be 1 to {MOST}", modes.count),
        ));
    }
    let [low, high] = modes.band;
    if !(low >= 0.0 && low < high) {
        return Err(Error::at(
            "modes.band",
            format!("the band is {low} to {high} Hz, it must rise from 0 or more: swap or correct its ends"),
        ));
    }
    if !(modes.residual > 0.0 && modes.residual <= WORST) {
        return Err(Error::at(
            "modes.residual",
            format!("the residual is {}, it must be above 0 and at most {WORST}", modes.residual),
        ));
    }
    if let Some(ratio) = modes.damping_ratios.iter().find(|ratio| !(0.0..1.0).contains(*ratio)) {
        let what = format!("{ratio} is no damping ratio, it must be 0 or more and below 1");
        return Err(Error::at("modes.damping_ratios", what));
    }
    if modes.damping_ratios.len() > modes.count {
        let what = format!(
            "there are {} for {} modes: give one for each of the lowest at most",
            modes.damping_ratios.len(),
            modes.count
        );
        return Err(Error::at("modes.damping_ratios", what));
    }
    Ok(())
}

/// Checks what is written.
pub(super) fn check_output(output: &Output) -> Result<(), Error> {
    if let Some(vectors) = output.vectors.filter(|vectors| !(1..=MOST_VECTORS).contains(vectors)) {
        return Err(Error::at(
            "output.vectors",
            format!("there are {vectors} vectors, it must be 1 to {MOST_VECTORS}"),
        ));
    }
    if output.vectors.is_some() && !output.modal {
        let what =
            "vectors are counted, but no projected problem is written: add modal = true or leave it out";
        return Err(Error::at("output.vectors", what));
    }
    Ok(())
}

/// Checks the range of contact stiffness of the projected problem.
pub(super) fn check_kn(document: &Document) -> Result<(), Error> {
    let Some([low, high]) = document.output.kn else { return Ok(()) };
    let wrong = |what: &str| Err(Error::at("output.kn", what));
    if !(low > 0.0 && low < high && high.is_finite()) {
        return wrong(&format!("the range is {low:e} to {high:e} Pa/m, it must rise from above 0"));
    }
    if !document.output.modal {
        return wrong(
            "a range is given, but no projected problem is written: add modal = true or leave it out",
        );
    }
    let Some(own) = document.friction.contact_stiffness else {
        return wrong("the surfaces do not overlap (multipliers): give friction.contact_stiffness, too");
    };
    if !(low..=high).contains(&own) {
        return wrong(&format!(
            "the range is {low:e} to {high:e} Pa/m, but friction.contact_stiffness is {own:e}: let it lie in the range"
        ));
    }
    if document.modes.stressed {
        return wrong(
            "the stress of the static step depends on the contact stiffness: leave out modes.stressed or kn",
        );
    }
    Ok(())
}
