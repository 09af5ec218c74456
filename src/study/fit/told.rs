//! What a fit says beside its material: what was left out, what the points do not determine, and the laws beside each other.

use crate::study::fit::each::own_velocity;
use crate::study::fit::{Candidate, Fit, range};
use squealmap_identify::{Measurements, Point};
use squealmap_input::quote::rounded;

/// What was not taken as it stands in the file.
#[must_use]
pub fn remarks(measured: &Measurements) -> Vec<String> {
    /// The largest usual friction coefficient that passes without a word.
    const LARGEST: f64 = 2.0;
    let Measurements { points, without_contact, left_out, at_rest, remarks } = measured;
    let mut remarks = remarks.clone();
    let mut sizes: Vec<f64> = points.iter().map(|point| point.friction.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    if let Some(usual) = sizes.get(sizes.len() / 2).filter(|usual| **usual > LARGEST) {
        remarks.push(format!(
            "half of the friction coefficients are above {}: is a column in percent, or a force in another unit? A header may say so, as \
             `mu (%)` or `T (kN)`",
            rounded(*usual)
        ));
    }
    if *at_rest > 0.0 {
        remarks.push(format!(
            "{:.1} % are at rest and left out: friction is there whatever holds the body",
            100.0 * at_rest
        ));
    }
    if *without_contact > 0 {
        remarks.push(format!("{without_contact} row(s) without contact are passed over"));
    }
    if *left_out > 0.0 {
        remarks.push(format!(
            "{:.0} % of the record vibrate so that the mean of T/N is not the friction at the mean velocity; they are left out",
            100.0 * left_out
        ));
    }
    remarks
}

/// Warnings about parts of the material that the points do not determine.
#[must_use]
pub fn warnings(fitted: &Fit, points: &[Point]) -> Vec<String> {
    let mut warnings = Vec::new();
    let [low, high] = range(points, |point| point.temperature);
    let measured = format!("{} to {} °C", rounded(low), rounded(high));
    let beyond = fitted.temperature.iter().filter(|row| !(low..=high).contains(*row));
    let beyond: Vec<String> = beyond.map(f64::to_string).collect();
    // A single row holds at every temperature.
    if !beyond.is_empty() && fitted.temperature.len() > 1 {
        warnings.push(format!(
            "the points are from {measured}, so that the row(s) at {} °C are extrapolated; measure there, or ask for rows \
             inside with --temperatures",
            beyond.join(", ")
        ));
    }
    let (first, last) = (fitted.temperature[0], fitted.temperature[fitted.temperature.len() - 1]);
    let outside = points.iter().filter(|point| !(first..=last).contains(&point.temperature)).count();
    if outside > 0 {
        let rows = if first < last { format!("{first} to {last}") } else { first.to_string() };
        warnings.push(format!(
            "{outside} of {} points lie outside the rows of {rows} °C and count for the nearest row; ask for rows from {measured} \
             with --temperatures, or leave these points out",
            points.len()
        ));
    }
    if let Some(param) = own_velocity(fitted) {
        warnings.push(format!(
            "no one `{}` describes the points at all temperatures: each row has its own, and a sweep takes what is straight between them",
            param.info().name
        ));
    }
    if let (true, Some((param, values))) = (fitted.open, fitted.columns.last()) {
        warnings.push(format!(
            "the points do not bound `{}`: {:.3} m/s fits best, but the fastest of them as well, so that there are no standard \
             errors; measure faster, give it with --law-velocity, or choose another --law",
            param.info().name,
            values[0]
        ));
    }
    warnings
}

/// The laws beside each other, a line each.
#[must_use]
pub fn compared(candidates: &[Candidate]) -> String {
    let least = |k: usize| {
        candidates.iter().filter_map(|one| one.criteria).map(|all| all[k]).fold(f64::INFINITY, f64::min)
    };
    let line = |candidate: &Candidate| match (&candidate.fit, candidate.criteria) {
        (Ok(fit), Some([aicc, bic])) => format!(
            "law \"{}\": root mean square residual {:.2e}, AICc {:+.1}, BIC {:+.1} above the least\n",
            candidate.law.name(),
            fit.residual,
            aicc - least(0),
            bic - least(1)
        ),
        (Err(why), _) => format!("law \"{}\": {why}\n", candidate.law.name()),
        (Ok(_), None) => format!("law \"{}\": too few points to compare\n", candidate.law.name()),
    };
    candidates.iter().map(line).collect()
}
