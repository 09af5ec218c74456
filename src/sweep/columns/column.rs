//! One output column.

use crate::engine::record::Record;
use crate::sweep::columns::cell::Cell;
use crate::sweep::columns::values::{Content, Values};
use crate::sweep::grid::{AxisKey, Value};
use crate::sweep::spec::{Analysis, Starts};

/// What the names of columns of the large start end in.
pub const LARGE_SUFFIX: &str = "_large";

/// The analysis a column belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// In every table.
    Always,
    /// Complex eigenvalue analysis.
    Linear,
    /// Time integration.
    Response,
    /// Time integration until settled.
    Settling,
    /// Limit cycles found by shooting.
    Cycles,
    /// Instances computed again.
    Checks,
    /// Several starts.
    Starts,
    /// Starts from a box.
    Basin,
}

impl Group {
    /// Whether an analysis has the columns of this group.
    #[must_use]
    pub fn is_asked(self, analysis: Analysis) -> bool {
        match self {
            Group::Always => true,
            Group::Linear => analysis.linear,
            Group::Response => analysis.response,
            Group::Settling => analysis.until_settled,
            Group::Cycles => analysis.finds_cycles,
            Group::Checks => analysis.checks(),
            Group::Starts => analysis.starts != Starts::One,
            Group::Basin => matches!(analysis.starts, Starts::Box(_)),
        }
    }

    /// What of a sweep file asks for it, in words.
    #[must_use]
    pub fn asked_by(self) -> &'static str {
        match self {
            Group::Always => "every sweep",
            Group::Linear => "analysis: linear",
            Group::Response => "analysis: response",
            Group::Settling => "settle: auto, cycle",
            Group::Cycles => "settle: cycle",
            Group::Checks => "check: true",
            Group::Starts => "start: both, box",
            Group::Basin => "start: box",
        }
    }
}

/// How the values of a column are read off a scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// By their differences.
    Linear,
    /// By their sign, which says what happens: growth or decay.
    Sign,
    /// By their ratios: they span decades.
    Ratios,
    /// As angles from 0 to 180 degrees, which have no other side.
    HalfTurn,
}

/// Where the values of a column come from.
#[derive(Clone, Copy, Debug)]
pub(super) enum Source {
    /// The index of the instance.
    Instance,
    /// The swept value with this position in [`crate::sweep::grid::Grid::keys`].
    Swept(usize),
    /// The record, or the one of the large start in it.
    Record(Values),
}

/// What a column is of the measuring window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Window {
    /// Nothing: it is read before the window, or of the run as a whole.
    Not,
    /// A quantity that means little where the response has not settled.
    Quantity,
    /// A size of the vibration, which is 0 at rest: of a motion that decays it is what is left in the window.
    Vibration,
}

/// One output column.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    /// The header.
    pub name: &'static str,
    /// The SI unit; empty when dimensionless or a name.
    pub unit: &'static str,
    /// One line of explanation.
    pub meaning: &'static str,
    /// The name in print, a long one and one for narrow places; symbols stand in braces.
    pub print: [&'static str; 2],
    /// The analysis it belongs to.
    pub group: Group,
    /// What it is of the measuring window.
    pub window: Window,
    /// How its values are read.
    pub reading: Reading,
    /// Whether it is of the large start of two.
    pub is_of_large_start: bool,
    /// Whether it stands in tiles alone.
    pub(super) is_hidden: bool,
    pub(super) source: Source,
}

impl Column {
    /// A column of records that none of the following words changes.
    pub(super) const fn new(
        group: Group,
        name: &'static str,
        unit: &'static str,
        values: Values,
        print: &[&'static str],
        meaning: &'static str,
    ) -> Column {
        Column {
            name,
            unit,
            meaning,
            print: [print[0], print[print.len() - 1]],
            group,
            window: Window::Not,
            reading: Reading::Linear,
            is_of_large_start: false,
            is_hidden: false,
            source: Source::Record(values),
        }
    }

    /// It is a quantity of the measuring window.
    pub(super) const fn window(self) -> Column {
        Column { window: Window::Quantity, ..self }
    }

    /// It is a size of the vibration in the measuring window.
    pub(super) const fn vibration(self) -> Column {
        Column { window: Window::Vibration, ..self }
    }

    /// Its values are read so.
    pub(super) const fn read_by(self, reading: Reading) -> Column {
        Column { reading, ..self }
    }

    /// It stands in tiles alone.
    pub(super) const fn hidden(self) -> Column {
        Column { is_hidden: true, ..self }
    }

    /// It is of the large start.
    pub(super) const fn of_large_start(self) -> Column {
        Column { is_of_large_start: true, ..self }
    }

    /// The column of the indices of instances.
    pub(super) const INSTANCE: Column = Column {
        source: Source::Instance,
        ..Column::new(
            Group::Always,
            "instance",
            "",
            Values::Summary(|_| None),
            &["Instance"],
            "index of the instance; the first axis varies slowest",
        )
    };

    /// The column of the values of an axis.
    pub(super) fn swept(position: usize, key: AxisKey) -> Column {
        let (unit, meaning) = match key {
            AxisKey::Param(param) => (param.info().unit, param.info().meaning),
            AxisKey::Law => ("", "friction law"),
            AxisKey::Material => ("", "material file"),
        };
        let (name, source) = (key.name(), Source::Swept(position));
        Column { name, unit, meaning, print: [name; 2], source, ..Column::INSTANCE }
    }

    /// Where its values stand in a record; `None` of the index and of what is swept, which are not computed.
    #[must_use]
    pub fn values(&self) -> Option<Values> {
        match self.source {
            Source::Record(values) => Some(values),
            Source::Instance | Source::Swept(_) => None,
        }
    }

    /// The record that its values are read from: another in a column of the large start.
    #[must_use]
    pub fn of<'a>(&self, record: &'a Record) -> &'a Record {
        static NOTHING: Record = Record::NOT_COMPUTED;
        if self.is_of_large_start { record.large().unwrap_or(&NOTHING) } else { record }
    }

    /// The name of the same quantity of an only start.
    #[must_use]
    pub fn quantity(&self) -> &'static str {
        match self.name.strip_suffix(LARGE_SUFFIX) {
            Some(name) if self.is_of_large_start => name,
            _ => self.name,
        }
    }

    /// Whether its values are parts of the starts from a box.
    #[must_use]
    pub fn is_share(&self) -> bool {
        matches!(self.source, Source::Record(Values::Share(_)))
    }

    /// What its cells hold; the tests compare it with every one of them.
    #[must_use]
    pub fn content(&self) -> Content {
        match self.source {
            Source::Instance => Content::Count,
            Source::Swept(_) if ["law", "material"].contains(&self.name) => Content::Name,
            Source::Swept(_) => Content::Number,
            Source::Record(values) => values.content(),
        }
    }

    /// The cell of instance `index` with its swept values, see [`crate::sweep::grid::Grid::coordinates`], and its record.
    #[must_use]
    pub fn cell(&self, index: usize, coordinates: &[&Value], record: &Record) -> Cell {
        match self.source {
            Source::Instance => Cell::Count(index as u64),
            Source::Swept(position) => Cell::from(coordinates[position]),
            Source::Record(values) => values.cell(self.of(record)),
        }
    }
}
