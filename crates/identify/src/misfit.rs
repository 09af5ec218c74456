//! Whether a rig is that of the record, as far as its segments tell.

use crate::cross::Measured;
use crate::level::UNFIT;
use crate::rig::Rig;
use crate::segment::Segment;

/// The part by which the stiffness across the contact may be off, beside two standard errors: a quarter of a per cent of a frequency, and
/// as much for how it is read.
const STIFFNESS: f64 = 0.02;
/// The same of the damping.
const DAMPING: f64 = 0.5;
/// Factor by which the mean normal force may be off: beyond it a unit is another one.
const LOAD: f64 = 3.0;
/// Velocity of a vibration over that of sliding that friction does not excite: again a unit.
const REACH: f64 = 10.0;

/// Why nothing is taken from the rig: a quarter of the time that tells contradicts it. `normal` is the mean normal force, N.
pub(super) fn misfit(segments: &[Segment], rig: &Rig, normal: f64) -> Option<String> {
    let vibrating = || segments.iter().filter(|segment| segment.state.vibrates());
    let time = |segment: &Segment| segment.time[1] - segment.time[0];
    if !(1.0 / LOAD..LOAD).contains(&(normal / rig.load)) {
        return Some(format!(
            "the mean normal force is {normal:.4} N, the load of --model {:.4} N: check the unit of the forces; nothing is taken from the \
             model",
            rig.load
        ));
    }
    let reach = vibrating().filter_map(|segment| segment.reach).fold(0.0, f64::max);
    if reach > REACH {
        return Some(format!(
            "the vibration has {reach:.0} times the velocity of sliding: check the units of accelerations and velocity; nothing is taken \
             from --model"
        ));
    }
    if contradicts(vibrating().filter_map(|s| Some((time(s), s.friction?.misfit? >= UNFIT)))) {
        return Some(
            "the forces of --model contradict themselves in a good part of the record: it is another rig (masses, stiffnesses, theta and its \
             sign), the normal acceleration is late (--skew) or has the other sign, or something else drives the vibration; nothing is \
             taken from the model"
                .to_owned(),
        );
    }
    for (which, part, words) in [(0, STIFFNESS, "stiffness k2"), (1, DAMPING, "damping c2")] {
        let off = |shown: &Measured| (shown.value - 1.0).abs() > part + 2.0 * shown.error;
        let known = || vibrating().filter_map(|segment| Some((time(segment), segment.across?[which])));
        let against = known().filter(|(_, shown)| off(shown)).max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, longest)) =
            against.filter(|_| contradicts(known().map(|(time, shown)| (time, off(&shown)))))
        {
            return Some(format!(
                "the accelerations show {:.3} times the {words} of --model, if its m1, theta and the sign of theta (it turns with the direction of sliding), --rate and --skew are right: it is \
                 another rig; nothing is taken from it",
                longest.value
            ));
        }
    }
    None
}

/// Whether a quarter of the time is against it.
fn contradicts(known: impl Iterator<Item = (f64, bool)>) -> bool {
    let [all, against] = known.fold([0.0, 0.0], |[all, against], (time, unfit)| {
        [all + time, against + if unfit { time } else { 0.0 }]
    });
    4.0 * against > all
}
