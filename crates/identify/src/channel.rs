//! The measured quantities.

/// A measured quantity; SI units, temperature in °C.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// Acceleration along the sliding direction, m/s².
    TangentialAcceleration,
    /// Acceleration normal to the contact, m/s².
    NormalAcceleration,
    /// Friction force `T`, N.
    TangentialForce,
    /// Normal contact force `N`, positive in compression, N.
    NormalForce,
    /// Sliding (belt, disc) velocity `V`, m/s.
    Velocity,
    /// Temperature, °C.
    Temperature,
}

impl Channel {
    /// Every channel.
    pub const ALL: [Channel; 6] = [
        Channel::TangentialAcceleration,
        Channel::NormalAcceleration,
        Channel::TangentialForce,
        Channel::NormalForce,
        Channel::Velocity,
        Channel::Temperature,
    ];

    /// The column that is read when none is named: what `squealmap trace --rate` writes.
    #[must_use]
    pub fn default_column(self) -> &'static str {
        match self {
            Channel::TangentialAcceleration => "ax2",
            Channel::NormalAcceleration => "ay1",
            Channel::TangentialForce => "T",
            Channel::NormalForce => "N",
            Channel::Velocity => "V",
            Channel::Temperature => "temperature",
        }
    }

    /// The option that names the column.
    #[must_use]
    pub fn flag(self) -> &'static str {
        match self {
            Channel::TangentialAcceleration => "--tangential-acceleration",
            Channel::NormalAcceleration => "--normal-acceleration",
            Channel::TangentialForce => "--tangential-force",
            Channel::NormalForce => "--normal-force",
            Channel::Velocity => "--velocity",
            Channel::Temperature => "--temperature",
        }
    }

    /// The quantity in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Channel::TangentialAcceleration => "the tangential acceleration",
            Channel::NormalAcceleration => "the normal acceleration",
            Channel::TangentialForce => "the tangential force",
            Channel::NormalForce => "the normal force",
            Channel::Velocity => "the velocity",
            Channel::Temperature => "the temperature",
        }
    }

    /// Whether the channel follows the vibration, so that a constant or clipped one tells nothing.
    #[must_use]
    pub fn vibrates(self) -> bool {
        !matches!(self, Channel::Velocity | Channel::Temperature)
    }
}

/// One value per channel, in the order of [`Channel::ALL`].
pub(super) type PerChannel<T> = [T; Channel::ALL.len()];
