//! The unit of a channel by its header, where that is another one than it is read in.

use crate::channel::Channel;
use crate::unit::bracketed;

/// Standard gravity, m/s².
const GRAVITY: f64 = 9.80665;

/// Units as people write them, without spaces, and what one of them is in that of the channel.
const ACCELERATION: [(&str, f64); 8] = [
    ("g", GRAVITY),
    ("mg", 1e-3 * GRAVITY),
    ("mm/s²", 1e-3),
    ("mm/s2", 1e-3),
    ("mm/s^2", 1e-3),
    ("km/s²", 1e3),
    ("km/s2", 1e3),
    ("km/s^2", 1e3),
];
const FORCE: [(&str, f64); 4] = [("kN", 1e3), ("mN", 1e-3), ("daN", 10.0), ("%", 0.01)];
const VELOCITY: [(&str, f64); 7] = [
    ("mm/s", 1e-3),
    ("cm/s", 1e-2),
    ("\u{b5}m/s", 1e-6),
    ("\u{3bc}m/s", 1e-6),
    ("um/s", 1e-6),
    ("km/h", 1.0 / 3.6),
    ("m/min", 1.0 / 60.0),
];

/// What one of the unit in brackets that a header ends with is in the unit of the channel, and that unit; `None` where it is that of the
/// channel, or none that is known.
pub(super) fn scale(channel: Channel, header: &str) -> Option<(f64, String)> {
    let units: &[(&str, f64)] = match channel {
        Channel::TangentialAcceleration | Channel::NormalAcceleration => &ACCELERATION,
        Channel::TangentialForce | Channel::NormalForce => &FORCE,
        Channel::Velocity => &VELOCITY,
        Channel::Temperature => &[],
    };
    let (_, unit) = bracketed(header)?;
    let unit: String = unit.chars().filter(|letter| !letter.is_whitespace()).collect();
    let (_, factor) = units.iter().find(|(name, _)| *name == unit)?;
    Some((*factor, unit))
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
        // A kilonewton is no velocity.
        assert_eq!(scale(Channel::Velocity, "V (kN)"), None);
    }
}
