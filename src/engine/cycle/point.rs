//! Points where `ẋ2` rises through zero.

/// What the number of an order is multiplied by from event to event: it keeps the last dozens of them.
pub const FORGETS: f64 = 0.618_033_988_749_894_8;

/// A point of the section; scaled, deviations from the equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// `x2 y2 y1`.
    pub position: [f64; 3],
    /// Their velocities; that of `x2` is 0.
    pub velocity: [f64; 3],
    /// The contact state, by the code of the kernels.
    pub contact: u32,
    /// The piece of the friction law.
    pub piece: u32,
}

/// A return of a flight to the section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Return {
    /// Where.
    pub point: Point,
    /// The time since the return before it.
    pub time: f64,
    /// A number that stands for the sequence of events on the way.
    pub order: f64,
}

/// Which coordinates a point of the section is free in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Freedom {
    /// `x2` alone: the single mass.
    Single,
    /// `x2`, `y1` and its velocity, with the contact closed.
    Closed,
    /// The same, and the gap with its velocity.
    Open,
}

impl Freedom {
    /// Those of a point. Where the contact is `upright`, without inclination, nothing moves `y1` that rests; `open` is the contact
    /// state of flight.
    #[must_use]
    pub fn of(point: &Point, upright: bool, open: u32) -> Freedom {
        let ([_, y2, y1], [_, vy2, vy1]) = (point.position, point.velocity);
        let rests = [y2, y1, vy2, vy1].iter().all(|value| *value == 0.0);
        match (upright && rests, point.contact == open) {
            (true, _) => Freedom::Single,
            (false, false) => Freedom::Closed,
            (false, true) => Freedom::Open,
        }
    }

    /// How many there are.
    #[must_use]
    pub fn count(self) -> usize {
        match self {
            Freedom::Single => 1,
            Freedom::Closed => 3,
            Freedom::Open => 5,
        }
    }
}

impl Point {
    /// Its free coordinates.
    #[must_use]
    pub fn coordinates(&self, freedom: Freedom) -> Vec<f64> {
        let ([x2, y2, y1], [_, vy2, vy1]) = (self.position, self.velocity);
        [x2, y1, vy1, y2, vy2][..freedom.count()].to_vec()
    }

    /// The same point but for its free coordinates.
    #[must_use]
    pub fn with(&self, coordinates: &[f64]) -> Point {
        let mut point = *self;
        let ([x2, y2, y1], [_, vy2, vy1]) = (&mut point.position, &mut point.velocity);
        for (place, value) in [x2, y1, vy1, y2, vy2].into_iter().zip(coordinates) {
            *place = *value;
        }
        point
    }
}
