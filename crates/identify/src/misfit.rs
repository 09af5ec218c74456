//! Whether a rig is that of the record, as far as its segments tell.

use crate::cross::Measured;
use crate::level::UNFIT;
use crate::segment::Segment;

/// The part by which the stiffness across the contact may be off, beside two standard errors: a quarter of a per cent of a frequency, and
/// as much for how it is read.
const STIFFNESS: f64 = 0.02;

/// Why nothing is taken from the rig: a quarter of the time that tells contradicts it.
pub(super) fn misfit(segments: &[Segment]) -> Option<String> {
    let vibrating = || segments.iter().filter(|segment| segment.state.vibrates());
    let time = |segment: &Segment| segment.time[1] - segment.time[0];
    let forces = vibrating().filter_map(|s| Some((time(s), s.friction?.misfit? >= UNFIT)));
    if contradicts(forces) {
        return Some(
            "the forces of --model contradict themselves in a good part of the record: it is another rig (masses, stiffnesses, the sign of \
             theta), or the normal acceleration is late (--skew); nothing is taken from it"
                .to_owned(),
        );
    }
    let off = |across: Measured| (across.value - 1.0).abs() > STIFFNESS + 2.0 * across.error;
    let across = || vibrating().filter_map(|segment| Some((time(segment), segment.across?)));
    contradicts(across().map(|(time, across)| (time, off(across)))).then(|| {
        let longest = across().filter(|(_, across)| off(*across)).max_by(|a, b| a.0.total_cmp(&b.0));
        let shown = longest.map_or(f64::NAN, |(_, across)| across.value);
        format!(
            "the accelerations show {shown:.3} of the stiffness k2 of --model (or of what --rate, m1 and the sign of the normal \
             acceleration make of it): it is another rig; nothing is taken from it"
        )
    })
}

/// Whether a quarter of the time is against it.
fn contradicts(known: impl Iterator<Item = (f64, bool)>) -> bool {
    let [all, against] = known.fold([0.0, 0.0], |[all, against], (time, unfit)| {
        [all + time, against + if unfit { time } else { 0.0 }]
    });
    4.0 * against > all
}
