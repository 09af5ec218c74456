//! What no outcome may be, whatever its instance.

use squealmap::engine::outcome::Outcome;
use squealmap::model::status::Status;

/// What is wrong with an outcome.
pub(crate) fn defect(outcome: &Outcome) -> Option<String> {
    let numbers = [
        ("x2_mean", outcome.x2_mean),
        ("x2_std", outcome.x2_std),
        ("y1_mean", outcome.y1_mean),
        ("y1_std", outcome.y1_std),
        ("ax_rms", outcome.ax_rms),
        ("ay_rms", outcome.ay_rms),
        ("ax_peak", outcome.ax_peak),
        ("ay_peak", outcome.ay_peak),
        ("friction_mean", outcome.friction_mean),
        ("n_peak", outcome.n_peak),
        ("response_frequency", outcome.response_frequency),
        ("phase_cycle", outcome.phase_cycle),
        ("growth_rate_measured", outcome.growth_rate_measured),
        ("frequency_measured", outcome.frequency_measured),
        ("phase_measured", outcome.phase_measured),
        ("stick", outcome.stick),
        ("free", outcome.free),
        ("reverse", outcome.reverse),
        ("impacts_per_second", outcome.impacts_per_second),
        ("settling_time", outcome.settling_time),
    ];
    let has = |name: &str| numbers.iter().any(|(other, number)| *other == name && number.is_some());
    match outcome.status {
        Status::Unwritten | Status::NotComputed => {
            return Some(format!("its status is {:?}", outcome.status));
        }
        Status::Ok => {}
        _ if numbers.iter().any(|(_, number)| number.is_some()) => {
            return Some(format!("{:?} beside numbers", outcome.status));
        }
        _ => return (!outcome.simulated_time.is_finite()).then(|| "its time is not finite".to_owned()),
    }
    if let Some((name, number)) = numbers.iter().find(|(_, number)| number.is_some_and(|x| !x.is_finite())) {
        return Some(format!("{name} is {number:?} with the status ok"));
    }
    let halves = [outcome.speed_rms_halves, outcome.x2_std_halves, outcome.ay_rms_halves];
    if !halves.iter().flatten().chain([&outcome.simulated_time]).all(|number| number.is_finite()) {
        return Some(format!("a half or the time is not finite with the status ok: {halves:?}"));
    }
    if let Some(name) =
        ["x2_mean", "x2_std", "y1_std", "ax_rms", "ay_peak", "stick"].iter().find(|name| !has(name))
    {
        return Some(format!("{name} is missing with the status ok"));
    }
    let share = |number: Option<f64>| number.is_some_and(|share| (-1e-9..=1.0 + 1e-6).contains(&share));
    (!(share(outcome.stick) && share(outcome.free) && share(outcome.reverse)))
        .then(|| format!("shares of time: {:?} {:?} {:?}", outcome.stick, outcome.free, outcome.reverse))
}
