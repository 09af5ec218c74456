//! Where the values of a column stand in a record: one definition reads them for every output and puts them back.

use crate::engine::record::{Basin, Record};
use crate::sweep::columns::cell::Cell;
use crate::sweep::columns::class::Class;

/// Where a number stands in a record. Tiles keep it as f64, and NaN where it is undefined.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// The number; `None` where it is undefined.
    pub get: fn(&Record) -> Option<f64>,
    /// Puts it back into a record that has the part of the analysis that it belongs to.
    pub put: fn(&mut Record, f64),
}

/// The count of the starts of a box that have ended in one way. Tiles keep it as u32.
pub type Share = fn(&mut Basin) -> &mut u32;

/// Where the values of a column stand in a record.
#[derive(Clone, Copy, Debug)]
pub enum Values {
    /// A number.
    Number(Place),
    /// A count.
    Count(Place),
    /// A name. Tiles keep its code in a byte.
    Name(&'static Class),
    /// No or yes: 0 or 1 in tables. Tiles keep it among their flags.
    Flag(&'static Class),
    /// A part of the starts of a box: their count over that of all.
    Share(Share),
    /// A number that tells several properties at once, which tiles keep among their flags.
    Summary(fn(&Record) -> Option<u64>),
}

/// What the cells of a column hold where they are not empty.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// [`Cell::Number`].
    Number,
    /// [`Cell::Count`].
    Count,
    /// [`Cell::Text`].
    Name,
}

impl Values {
    /// What the cells hold; the tests compare it with every one of them.
    #[must_use]
    pub fn content(self) -> Content {
        match self {
            Values::Number(_) | Values::Share(_) => Content::Number,
            Values::Count(_) | Values::Flag(_) | Values::Summary(_) => Content::Count,
            Values::Name(_) => Content::Name,
        }
    }

    /// The class, where it is one.
    #[must_use]
    pub fn class(self) -> Option<&'static Class> {
        match self {
            Values::Name(class) | Values::Flag(class) => Some(class),
            Values::Number(_) | Values::Count(_) | Values::Share(_) | Values::Summary(_) => None,
        }
    }

    /// Where the number stands that a tile keeps, where it keeps one.
    #[must_use]
    pub fn place(self) -> Option<Place> {
        match self {
            Values::Number(place) | Values::Count(place) => Some(place),
            Values::Name(_) | Values::Flag(_) | Values::Share(_) | Values::Summary(_) => None,
        }
    }

    /// The cell of a record.
    #[must_use]
    pub fn cell(self, record: &Record) -> Cell {
        let count = |count: Option<u64>| count.map_or(Cell::Empty, Cell::Count);
        match self {
            Values::Number(place) => Cell::from((place.get)(record)),
            Values::Count(place) => count((place.get)(record).map(whole)),
            Values::Name(class) => class.name(record).map_or(Cell::Empty, |name| Cell::Text(name.to_owned())),
            Values::Flag(class) => count(class.position(record).map(|position| position as u64)),
            Values::Share(share) => Cell::from(record.basin().and_then(|basin| part(share, basin))),
            Values::Summary(of) => count(of(record)),
        }
    }
}

/// The part of all starts of a box that a count of them is.
fn part(share: Share, mut basin: Basin) -> Option<f64> {
    let count = *share(&mut basin);
    basin.fraction(count)
}

/// A count that was kept as f64.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it was written from a count")]
fn whole(number: f64) -> u64 {
    number as u64
}

/// A field of a record as a number, and back.
pub(super) trait Kept {
    fn number(self) -> Option<f64>;
    fn kept(number: f64) -> Self;
}

impl Kept for f64 {
    fn number(self) -> Option<f64> {
        Some(self)
    }

    fn kept(number: f64) -> f64 {
        number
    }
}

impl Kept for Option<f64> {
    fn number(self) -> Option<f64> {
        self
    }

    fn kept(number: f64) -> Option<f64> {
        Some(number).filter(|number| !number.is_nan())
    }
}

impl Kept for u64 {
    fn number(self) -> Option<f64> {
        Some(self as f64)
    }

    fn kept(number: f64) -> u64 {
        whole(number)
    }
}

impl Kept for Option<u64> {
    fn number(self) -> Option<f64> {
        self.map(|count| count as f64)
    }

    fn kept(number: f64) -> Option<u64> {
        Option::<f64>::kept(number).map(whole)
    }
}
