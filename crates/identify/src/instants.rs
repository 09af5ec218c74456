//! What a record does over time, in as many instants as a picture shows.

use crate::cells::Cell;
use crate::segment::Has;

/// What a record does at an instant, each where it is recorded.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Deserialize, serde::Serialize)]
pub struct Instant {
    /// Time, s.
    pub time: f64,
    /// Velocity, m/s.
    pub velocity: Option<f64>,
    /// Temperature, °C.
    pub temperature: Option<f64>,
    /// Phase of the normal against the tangential acceleration, degrees, where an oscillation stands out.
    pub phase: Option<f64>,
    /// The squared coherence of the two.
    pub coherence: Option<f64>,
}

/// The course of a record.
pub(super) fn instants(cells: &[Cell], has: Has, skew: f64) -> Vec<Instant> {
    let instant = |cell: &Cell| {
        let shown = cell.phase(skew).filter(|_| cell.is_loud() && has.normal_acceleration);
        Instant {
            time: cell.middle(),
            velocity: has.velocity.then(|| cell.velocity()),
            temperature: has.temperature.then(|| cell.temperature()),
            phase: shown.map(|(phase, _)| phase.value),
            coherence: shown.map(|(_, coherence)| coherence),
        }
    };
    cells.iter().map(instant).collect()
}
