//! What no outcome may be, whatever its instance.

use squealmap::engine::outcome::Outcome;
use squealmap::engine::record::Record;
use squealmap::model::status::Status;
use squealmap::sweep::columns::{Group, Values, computed};

/// What is wrong with an outcome.
pub(crate) fn defect(outcome: &Outcome) -> Option<String> {
    let record = Record { outcome: Some(Box::new(*outcome)), ..Record::default() };
    // What every transient has, with whatever status, is looked at below.
    let of_response = computed().filter(|column| {
        let own = matches!(column.group, Group::Response | Group::Settling) && !column.is_of_large_start;
        own && column.name != "simulated_time"
    });
    let numbers: Vec<(&str, Option<f64>)> = of_response
        .filter_map(|column| match column.values() {
            Some(Values::Number(place)) => Some((column.name, (place.get)(&record))),
            _ => None,
        })
        .collect();
    assert_eq!(numbers.iter().filter(|(name, _)| ["ay_peak", "settling_time"].contains(name)).count(), 2);
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
