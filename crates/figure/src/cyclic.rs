//! Angles in figures: colours and curves of a circle without ends.
//!
//! The colours are dark around ±180° and light around 0°:
//! 48 colours evenly along the 256 of vikO, one of the Scientific colour maps of Fabio Crameri (version 8,
//! <https://doi.org/10.5281/zenodo.1243862>, MIT licence; F. Crameri, G. E. Shephard, P. J. Heron: The misuse of colour in
//! science communication, Nature Communications 11, 5444, 2020). Of the cyclic ones of that collection it keeps angles a
//! quarter of a turn apart the furthest apart under the three kinds of dichromacy; a test measures it.

use crate::scale::{Scale, Tick, snapped, value_label};

/// From −180° on, evenly.
#[rustfmt::skip]
const COLOURS: [&str; 48] = [
    "#4F1A3D", "#4B1D44", "#47214B", "#432653", "#3F2C5B", "#3B3364", "#383B6E", "#354377",
    "#334C80", "#345689", "#376091", "#3D6A99", "#4575A1", "#4F80A8", "#5B8AAF", "#6895B6",
    "#769FBC", "#85A8C1", "#93B1C5", "#A2B8C8", "#B0BEC8", "#BCC1C6", "#C7C3C2", "#CFC1BB",
    "#D5BEB3", "#D8B9A9", "#D9B39E", "#D9AB92", "#D7A286", "#D49979", "#D08F6D", "#CA8561",
    "#C47A55", "#BD6F49", "#B4633E", "#AB5734", "#A14B2C", "#964025", "#8C3521", "#822C1F",
    "#7A251E", "#721F1F", "#6B1A21", "#651724", "#601628", "#5B152C", "#571631", "#531737",
];

/// Half a turn, degrees.
const HALF: f64 = 180.0;

/// The number of colours.
pub const STEPS: usize = COLOURS.len();

/// The colour around an angle, degrees; any number of whole turns away is the same.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within one turn")]
#[must_use]
pub fn step(angle: f64) -> usize {
    let turn = ((angle + HALF) / (2.0 * HALF)).rem_euclid(1.0);
    (turn * STEPS as f64) as usize % STEPS
}

/// The fill of a step.
#[must_use]
pub fn fill(step: usize) -> &'static str {
    COLOURS[step % STEPS]
}

/// The whole circle as a scale.
#[must_use]
pub fn scale() -> Scale {
    Scale::Linear { low: -HALF, high: HALF }
}

/// Ticks at quarters of a turn, for an axis that reaches over more than half a turn. `None` for a shorter one, where any
/// round values will do.
#[must_use]
pub fn ticks(scale: &Scale) -> Option<Vec<Tick>> {
    const QUARTERS: [f64; 5] = [-HALF, -0.5 * HALF, 0.0, 0.5 * HALF, HALF];
    let reach = scale.value(1.0) - scale.value(0.0);
    let tick = |angle: f64| Tick { at: snapped(scale.position(angle)), label: value_label(angle) };
    let inside = |tick: &Tick| (0.0..=1.0).contains(&tick.at);
    (reach > HALF).then(|| QUARTERS.map(tick).into_iter().filter(inside).collect())
}

/// Whether the shorter way between two angles leads across ±180°.
fn crosses(from: f64, to: f64) -> bool {
    (to - from).abs() > HALF
}

/// A curve of angles along positions `x`: where it crosses ±180° it goes on at the other side, with a gap (NaN) between.
#[must_use]
pub fn parted(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut parted: Vec<(f64, f64)> = Vec::with_capacity(points.len());
    for (x, angle) in points.iter().copied() {
        if let Some((before, from)) = parted.last().copied().filter(|(_, from)| crosses(*from, angle)) {
            let side = HALF.copysign(from);
            // The angle unwrapped, so that the way to the side is a part of the way.
            let to = angle + 2.0 * side;
            let way = to - from;
            let at = if way == 0.0 { before } else { before + (side - from) / way * (x - before) };
            parted.extend([(at, side), (at, f64::NAN), (at, -side)]);
        }
        parted.push((x, angle));
    }
    parted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_has_no_ends() {
        assert_eq!([-180.0, 180.0, 540.0].map(step), [0; 3]);
        assert_eq!([179.9, -180.1].map(step), [STEPS - 1; 2]);
        assert_eq!([-0.1, 0.1].map(step), [STEPS / 2 - 1, STEPS / 2]);
    }

    #[test]
    fn curves_go_on_at_the_other_side() {
        let curve = parted(&[(0.0, 150.0), (1.0, 170.0), (2.0, -160.0), (3.0, -170.0), (4.0, 180.0)]);
        let finite: Vec<(f64, f64)> = curve.iter().copied().filter(|(_, angle)| angle.is_finite()).collect();
        // From 170° to 200° a third of the way; from −170° to −180° all of it.
        let third = 1.0 + 1.0 / 3.0;
        let expected: [(f64, f64); 9] = [
            (0.0, 150.0),
            (1.0, 170.0),
            (third, 180.0),
            (third, -180.0),
            (2.0, -160.0),
            (3.0, -170.0),
            (4.0, -180.0),
            (4.0, 180.0),
            (4.0, 180.0),
        ];
        assert_eq!(finite.len(), expected.len());
        for (one, other) in finite.iter().zip(expected) {
            assert!((one.0 - other.0).abs() < 1e-12 && one.1.to_bits() == other.1.to_bits(), "{one:?}");
        }
        assert_eq!(curve.len() - finite.len(), 2, "two gaps");
        assert!(parted(&[(0.0, 10.0), (1.0, f64::NAN), (2.0, -175.0)]).len() == 3, "nothing is across a gap");
    }
}
