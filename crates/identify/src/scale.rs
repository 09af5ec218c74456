//! The unit of a channel by its header, where that is another one than it is read in.

use crate::channel::Channel;
use crate::unit::bracketed;

/// Standard gravity, m/s².
const GRAVITY: f64 = 9.80665;

/// Units as people write them, without spaces, and what one of them is in that of the channel; its own come first.
const ACCELERATION: [(&str, f64); 11] = [
    ("m/s²", 1.0),
    ("m/s2", 1.0),
    ("m/s^2", 1.0),
    ("g", GRAVITY),
    ("mg", 1e-3 * GRAVITY),
    ("mm/s²", 1e-3),
    ("mm/s2", 1e-3),
    ("mm/s^2", 1e-3),
    ("km/s²", 1e3),
    ("km/s2", 1e3),
    ("km/s^2", 1e3),
];
const FORCE: [(&str, f64); 5] = [("N", 1.0), ("kN", 1e3), ("mN", 1e-3), ("daN", 10.0), ("%", 0.01)];
const VELOCITY: [(&str, f64); 8] = [
    ("m/s", 1.0),
    ("mm/s", 1e-3),
    ("cm/s", 1e-2),
    ("\u{b5}m/s", 1e-6),
    ("\u{3bc}m/s", 1e-6),
    ("um/s", 1e-6),
    ("km/h", 1.0 / 3.6),
    ("m/min", 1.0 / 60.0),
];
const TEMPERATURE: [(&str, f64); 3] = [("°C", 1.0), ("C", 1.0), ("degC", 1.0)];

/// What stands before the brackets that a header ends with, the unit in them, and what one of it is in that of the channel; `None` where
/// there is none that the channel may have.
fn known(channel: Channel, header: &str) -> Option<(&str, String, f64)> {
    let units: &[(&str, f64)] = match channel {
        Channel::TangentialAcceleration | Channel::NormalAcceleration => &ACCELERATION,
        Channel::TangentialForce | Channel::NormalForce => &FORCE,
        Channel::Velocity => &VELOCITY,
        Channel::Temperature => &TEMPERATURE,
    };
    let (name, unit) = bracketed(header)?;
    let unit: String = unit.chars().filter(|letter| !letter.is_whitespace()).collect();
    let (_, factor) = units.iter().find(|(name, _)| *name == unit)?;
    Some((name.trim_end(), unit, *factor))
}

/// The header of a channel without the unit in brackets that it ends with; `None` where there is none that the channel may have.
pub(super) fn without_unit(channel: Channel, header: &str) -> Option<&str> {
    known(channel, header).map(|(name, ..)| name)
}

/// What one of the unit in brackets that a header ends with is in the unit of the channel, and that unit; `None` where it is that of the
/// channel, or none that is known.
pub(super) fn scale(channel: Channel, header: &str) -> Option<(f64, String)> {
    let (_, unit, factor) = known(channel, header)?;
    factor.total_cmp(&1.0).is_ne().then_some((factor, unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_read_from_brackets() {
        assert_eq!(scale(Channel::Velocity, "V (mm/s)"), Some((1e-3, "mm/s".to_owned())));
        assert_eq!(scale(Channel::Velocity, "speed [ km/h ] "), Some((1.0 / 3.6, "km/h".to_owned())));
        assert_eq!(scale(Channel::NormalAcceleration, "ay (g)"), Some((9.80665, "g".to_owned())));
        assert_eq!(scale(Channel::TangentialForce, "mu (%)"), Some((0.01, "%".to_owned())));
        for header in ["V (m/s)", "V", "V (belt)", "V mm/s", "mm/s)"] {
            assert_eq!(scale(Channel::Velocity, header), None, "{header}");
        }
        assert_eq!(without_unit(Channel::TangentialForce, "T (kN)"), Some("T"));
        assert_eq!(without_unit(Channel::NormalAcceleration, "ay1 [m/s²]"), Some("ay1"));
        assert_eq!(without_unit(Channel::Temperature, "temperature (°C)"), Some("temperature"));
        for header in ["T", "T (V)", "T (m/s)"] {
            assert_eq!(without_unit(Channel::TangentialForce, header), None, "{header}");
        }
        // A kilonewton is no velocity.
        assert_eq!(scale(Channel::Velocity, "V (kN)"), None);
    }
}
