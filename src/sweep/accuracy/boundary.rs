//! How near an instance is to another label: where the last digits of a result decide what it is called.

use crate::engine::record::Record;
use crate::engine::regime::THRESHOLDS;
use crate::model::status::Status;

/// A growth rate this small against its angular frequency is near the border of stability: some ten times what f32
/// makes of it. Light damping alone is a hundred times as much.
const GROWTH: f64 = 1e-6;

/// A fraction of the window within this factor of the one that counts is near it.
const FRACTION: f64 = 2.0;

/// A ratio of the halves of the window within this distance of its threshold is near it.
const RATIO: f64 = 2e-3;

/// Whether a record that was just computed is near the border of its type, regime, `settled` or status. For regime and
/// `settled` the halves of the window are needed, which records read back from tiles do not have.
#[must_use]
pub fn is_near(record: &Record) -> bool {
    near_stability(record) || near_regime(record)
}

/// The real part of an eigenvalue that decides the type is near zero.
fn near_stability(record: &Record) -> bool {
    record.linear.is_some_and(|linear| {
        // No mode leads: all have no growth but for rounding.
        let Some(frequency) = linear.frequency else { return true };
        let limit = GROWTH * std::f64::consts::TAU * frequency.abs();
        let unstable = linear.growth_rate > 0.0;
        // Attribution matters only where there is something to attribute.
        linear.growth_rate.abs() < limit
            || unstable
                && [linear.growth_rate_flat, linear.growth_rate_frozen].iter().any(|g| g.abs() < limit)
    })
}

/// A value that decides regime, `settled` or status is near its threshold.
fn near_regime(record: &Record) -> bool {
    let Some(outcome) = &record.outcome else { return false };
    match record.status {
        Status::Ok => {}
        status => return status.may_come_through(),
    }
    let counts = THRESHOLDS.state_counts;
    let fraction = [outcome.stick, outcome.free, outcome.reverse]
        .into_iter()
        .flatten()
        .any(|value| value > counts / FRACTION && value < counts * FRACTION);
    let ratio = |[first, second]: [f64; 2]| second / first;
    let about = |value: f64, threshold: f64| (value - threshold).abs() < RATIO;
    let speed = ratio(outcome.speed_rms_halves);
    let motion = about(speed, THRESHOLDS.decay) || about(speed, THRESHOLDS.small_growth);
    let settled = [outcome.x2_std_halves, outcome.ay_rms_halves]
        .into_iter()
        .any(|[a, b]| about((a - b).abs() / a.max(b), THRESHOLDS.settled));
    fraction || motion || settled
}
