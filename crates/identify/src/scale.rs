//! The unit of a channel by its header, or by what the file says beside it, where that is another one than it is read in.

use crate::channel::Channel;
use crate::unit::bracketed;

/// Standard gravity, m/s².
const GRAVITY: f64 = 9.80665;
/// A pound of force, N, a foot and an inch, m.
const POUND: f64 = 4.448_221_615_260_5;
const FOOT: f64 = 0.3048;
const INCH: f64 = 0.0254;
/// 0 °C in kelvin.
const ICE: f64 = 273.15;

/// What a number of a unit is in that of the channel: times a factor, plus an offset.
pub(super) type Scale = [f64; 2];
/// Units as people write them, without spaces; the one of the channel comes first, then its other names.
type Units = &'static [(&'static str, Scale)];

const ACCELERATION: Units = &[
    ("m/s²", [1.0, 0.0]),
    ("m/s2", [1.0, 0.0]),
    ("m/s^2", [1.0, 0.0]),
    ("m/s/s", [1.0, 0.0]),
    ("M/S^2", [1.0, 0.0]),
    ("M/S2", [1.0, 0.0]),
    ("g", [GRAVITY, 0.0]),
    ("G", [GRAVITY, 0.0]),
    ("mg", [1e-3 * GRAVITY, 0.0]),
    ("mm/s²", [1e-3, 0.0]),
    ("mm/s2", [1e-3, 0.0]),
    ("mm/s^2", [1e-3, 0.0]),
    ("km/s²", [1e3, 0.0]),
    ("km/s2", [1e3, 0.0]),
    ("km/s^2", [1e3, 0.0]),
    ("ft/s²", [FOOT, 0.0]),
    ("ft/s2", [FOOT, 0.0]),
    ("ft/s^2", [FOOT, 0.0]),
    ("in/s²", [INCH, 0.0]),
    ("in/s2", [INCH, 0.0]),
    ("in/s^2", [INCH, 0.0]),
];
/// A friction coefficient may take the place of a force.
const FORCE: Units = &[
    ("N", [1.0, 0.0]),
    ("1", [1.0, 0.0]),
    ("kN", [1e3, 0.0]),
    ("KN", [1e3, 0.0]),
    ("mN", [1e-3, 0.0]),
    ("daN", [10.0, 0.0]),
    ("kgf", [GRAVITY, 0.0]),
    ("kp", [GRAVITY, 0.0]),
    ("lbf", [POUND, 0.0]),
    ("%", [0.01, 0.0]),
];
const VELOCITY: Units = &[
    ("m/s", [1.0, 0.0]),
    ("M/S", [1.0, 0.0]),
    ("mm/s", [1e-3, 0.0]),
    ("MM/S", [1e-3, 0.0]),
    ("cm/s", [1e-2, 0.0]),
    ("\u{b5}m/s", [1e-6, 0.0]),
    ("\u{3bc}m/s", [1e-6, 0.0]),
    ("um/s", [1e-6, 0.0]),
    ("km/h", [1.0 / 3.6, 0.0]),
    ("kph", [1.0 / 3.6, 0.0]),
    ("m/min", [1.0 / 60.0, 0.0]),
    ("ft/s", [FOOT, 0.0]),
    ("in/s", [INCH, 0.0]),
    ("mph", [5280.0 * FOOT / 3600.0, 0.0]),
];
const TEMPERATURE: Units = &[
    ("°C", [1.0, 0.0]),
    ("C", [1.0, 0.0]),
    ("degC", [1.0, 0.0]),
    ("\u{2103}", [1.0, 0.0]),
    ("K", [1.0, -ICE]),
    ("°F", [5.0 / 9.0, -160.0 / 9.0]),
    ("F", [5.0 / 9.0, -160.0 / 9.0]),
    ("degF", [5.0 / 9.0, -160.0 / 9.0]),
];

/// What files write where a column has no unit.
const NONE: [&str; 5] = ["", "-", "\u{2013}", "NONE", "none"];

fn units(channel: Channel) -> Units {
    match channel {
        Channel::TangentialAcceleration | Channel::NormalAcceleration => ACCELERATION,
        Channel::TangentialForce | Channel::NormalForce => FORCE,
        Channel::Velocity => VELOCITY,
        Channel::Temperature => TEMPERATURE,
    }
}

/// The unit that a channel is read in.
pub(super) fn own(channel: Channel) -> &'static str {
    units(channel)[0].0
}

/// What is said of the unit of a column.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Said {
    /// Nothing, or that of the channel.
    Own,
    /// Another one.
    Other(Scale, String),
    /// One that the channel does not have, as far as is known.
    Unknown(String),
}

/// What a unit is to a channel.
fn of_unit(channel: Channel, unit: &str) -> Said {
    let unit: String = unit.trim_matches(['[', ']', '(', ')']).split_whitespace().collect();
    if NONE.contains(&unit.as_str()) {
        return Said::Own;
    }
    match units(channel).iter().find(|(name, _)| *name == unit) {
        None => Said::Unknown(unit),
        Some((_, [factor, offset])) if factor.total_cmp(&1.0).is_eq() && *offset == 0.0 => Said::Own,
        Some((_, scale)) => Said::Other(*scale, unit),
    }
}

/// The unit of a column: in brackets at the end of its header, or else `beside` it, in a row of units or where the format has one.
pub(super) fn said(channel: Channel, header: &str, beside: Option<&str>) -> Said {
    match (bracketed(header), beside) {
        (Some((_, unit)), None) => of_unit(channel, unit),
        (Some((_, unit)), Some(beside)) => match of_unit(channel, unit) {
            // `V (belt)`.
            Said::Unknown(_) => of_unit(channel, beside),
            known => known,
        },
        (None, Some(beside)) => of_unit(channel, beside),
        (None, None) => Said::Own,
    }
}

/// The header of a column without the unit in brackets that it ends with; `None` where the channel has no such unit.
pub(super) fn without_unit(channel: Channel, header: &str) -> Option<&str> {
    let (name, unit) = bracketed(header)?;
    (!matches!(of_unit(channel, unit), Said::Unknown(_))).then(|| name.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn other(factor: f64, offset: f64, unit: &str) -> Said {
        Said::Other([factor, offset], unit.to_owned())
    }

    #[test]
    fn units_are_read_from_brackets() {
        let header = |channel, header| said(channel, header, None);
        assert_eq!(header(Channel::Velocity, "V (mm/s)"), other(1e-3, 0.0, "mm/s"));
        assert_eq!(header(Channel::Velocity, "speed [ km/h ] "), other(1.0 / 3.6, 0.0, "km/h"));
        assert_eq!(header(Channel::NormalAcceleration, "ay (g)"), other(9.80665, 0.0, "g"));
        assert_eq!(header(Channel::TangentialForce, "mu (%)"), other(0.01, 0.0, "%"));
        assert_eq!(header(Channel::Temperature, "temperature [K]"), other(1.0, -273.15, "K"));
        for own in ["V (m/s)", "V", "V mm/s", "mm/s)"] {
            assert_eq!(header(Channel::Velocity, own), Said::Own, "{own}");
        }
        // A kilonewton is no velocity.
        for unit in ["belt", "kN"] {
            let found = said(Channel::Velocity, &format!("V ({unit})"), None);
            assert_eq!(found, Said::Unknown(unit.to_owned()));
        }
        assert_eq!(without_unit(Channel::TangentialForce, "T (kN)"), Some("T"));
        assert_eq!(without_unit(Channel::NormalAcceleration, "ay1 [m/s²]"), Some("ay1"));
        assert_eq!(without_unit(Channel::Temperature, "temperature (°C)"), Some("temperature"));
        for header in ["T", "T (V)", "T (m/s)"] {
            assert_eq!(without_unit(Channel::TangentialForce, header), None, "{header}");
        }
    }

    #[test]
    fn units_are_read_beside_the_header() {
        for (unit, expected) in [
            ("[mm/s]", other(1e-3, 0.0, "mm/s")),
            (" in / s ", other(0.0254, 0.0, "in/s")),
            ("m/s", Said::Own),
            ("NONE", Said::Own),
            ("V", Said::Unknown("V".to_owned())),
        ] {
            assert_eq!(said(Channel::Velocity, "V", Some(unit)), expected, "{unit}");
            assert_eq!(said(Channel::Velocity, "V (belt)", Some(unit)), expected, "{unit}");
        }
        // What the header says holds.
        assert_eq!(said(Channel::Velocity, "V (cm/s)", Some("m/s")), other(1e-2, 0.0, "cm/s"));
        let Said::Other([factor, offset], _) = said(Channel::Temperature, "temperature", Some("°F")) else {
            panic!("a unit of temperature");
        };
        for (fahrenheit, celsius) in [(32.0, 0.0), (212.0, 100.0), (932.0, 500.0)] {
            assert!((factor * fahrenheit + offset - celsius).abs() < 1e-12, "{fahrenheit}");
        }
    }
}
