//! The one table of output columns: order, names, units, meanings and values.

use crate::engine::record::{Basin, By, Check, Record};
use crate::engine::regime::Regime;
use crate::model::kind::InstabilityType;
use crate::sweep::grid::{AxisKey, Grid, Value};
use crate::sweep::spec::{Analysis, Starts};

/// The content of one cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// An undefined value.
    Empty,
    /// A number in base units.
    Number(f64),
    /// A count.
    Count(u64),
    /// A name.
    Text(String),
}

impl From<Option<f64>> for Cell {
    /// An undefined or non-finite number is an empty cell.
    fn from(value: Option<f64>) -> Cell {
        value.filter(|x| x.is_finite()).map_or(Cell::Empty, Cell::Number)
    }
}

impl From<f64> for Cell {
    fn from(value: f64) -> Cell {
        Cell::from(Some(value))
    }
}

impl From<&Value> for Cell {
    fn from(value: &Value) -> Cell {
        match value {
            Value::Number(x) => Cell::from(*x),
            Value::Text(text) => Cell::Text(text.to_string()),
        }
    }
}

impl Cell {
    fn text(value: Option<&str>) -> Cell {
        value.map_or(Cell::Empty, |name| Cell::Text(name.to_owned()))
    }
}

impl std::fmt::Display for Cell {
    /// Numbers in the shortest form that reads back to the same bits; zero has no sign.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        /// Outside these magnitudes an exponent is shorter than the zeros it replaces.
        const PLAIN: std::ops::Range<f64> = 1e-5..1e16;
        match self {
            Cell::Empty => Ok(()),
            Cell::Number(0.0) => f.write_str("0"),
            Cell::Number(x) if PLAIN.contains(&x.abs()) => write!(f, "{x}"),
            Cell::Number(x) => write!(f, "{x:e}"),
            Cell::Count(n) => write!(f, "{n}"),
            Cell::Text(text) => f.write_str(text),
        }
    }
}

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
    /// Instances computed again.
    Checks,
    /// Several starts.
    Starts,
    /// Starts from a box.
    Basin,
}

impl Group {
    fn asked(self, analysis: Analysis) -> bool {
        match self {
            Group::Always => true,
            Group::Linear => analysis.linear,
            Group::Response => analysis.response,
            Group::Settling => analysis.until_settled,
            Group::Checks => analysis.checks(),
            Group::Starts => analysis.starts != Starts::One,
            Group::Basin => matches!(analysis.starts, Starts::Box(_)),
        }
    }
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

/// Where the values of a column come from.
#[derive(Clone, Copy, Debug)]
enum Source {
    Instance,
    /// The swept value with this position in [`Grid::keys`].
    Swept(usize),
    Record(fn(&Record) -> Cell),
    /// The same of the record of the large start.
    Large(fn(&Record) -> Cell),
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
    /// The analysis it belongs to.
    pub group: Group,
    source: Source,
}

impl Column {
    /// Whether its values are computed: neither the index nor swept.
    #[must_use]
    pub fn is_computed(&self) -> bool {
        matches!(self.source, Source::Record(_) | Source::Large(_))
    }

    /// The record that its values are read from, and its name there: both are others in a column of the large start.
    #[must_use]
    pub fn of<'a>(&self, record: &'a Record) -> &'a Record {
        static NOTHING: Record = Record::NOT_COMPUTED;
        match self.source {
            Source::Large(_) => record.large().unwrap_or(&NOTHING),
            _ => record,
        }
    }

    /// The name of the same quantity of an only start.
    #[must_use]
    pub fn quantity(&self) -> &'static str {
        match self.source {
            Source::Large(_) => self.name.strip_suffix(LARGE_SUFFIX).unwrap_or(self.name),
            _ => self.name,
        }
    }

    /// What its cells hold; the tests compare it with every one of them.
    #[must_use]
    pub fn content(&self) -> Content {
        match self.quantity() {
            "instance" | "settled" | "checked" | "steps" | "bistable" => Content::Count,
            "law" | "material" | "type" | "regime" | "status" => Content::Name,
            _ => Content::Number,
        }
    }

    /// The cell of instance `index` with its swept values, see [`Grid::coordinates`], and its record.
    #[must_use]
    pub fn cell(&self, index: usize, coordinates: &[&Value], record: &Record) -> Cell {
        match self.source {
            Source::Instance => Cell::Count(index as u64),
            Source::Swept(position) => Cell::from(coordinates[position]),
            Source::Record(get) | Source::Large(get) => get(self.of(record)),
        }
    }
}

/// The columns of a sweep's table in order; those of an analysis that was not asked for are left out.
#[must_use]
pub fn columns(grid: &Grid, analysis: Analysis) -> Vec<Column> {
    let instance = Column {
        name: "instance",
        unit: "",
        meaning: "index of the instance; the first axis varies slowest",
        group: Group::Always,
        source: Source::Instance,
    };
    let swept = grid.keys().into_iter().enumerate().map(|(position, key)| {
        let (unit, meaning) = match key {
            AxisKey::Param(param) => (param.info().unit, param.info().meaning),
            AxisKey::Law => ("", "friction law"),
            AxisKey::Material => ("", "material file"),
        };
        Column { name: key.name(), unit, meaning, group: Group::Always, source: Source::Swept(position) }
    });
    let asked = |column: &Column| column.group.asked(analysis);
    let computed = COMPUTED.iter().copied().filter(asked);
    let of_large = |column: &Column| {
        analysis.starts == Starts::Both
            && !matches!(column.group, Group::Linear | Group::Starts)
            && asked(column)
    };
    let large = LARGE.iter().copied().filter(of_large);
    std::iter::once(instance).chain(swept).chain(computed).chain(large).collect()
}

/// What the names of columns of the large start end in.
const LARGE_SUFFIX: &str = "_large";

macro_rules! computed {
    ($($group:ident $name:literal $unit:literal $get:expr, $meaning:literal;)*) => {
        /// What is computed of an instance, in the order of `map.csv`.
        const COMPUTED: &[Column] = &[$(Column {
            name: $name, unit: $unit, meaning: $meaning, group: Group::$group, source: Source::Record($get),
        }),*];

        /// The same of the large start; what concerns both is left out.
        const LARGE: &[Column] = &[$(Column {
            name: concat!($name, "_large"),
            unit: $unit,
            meaning: concat!("from the large start: ", $meaning),
            group: Group::$group,
            source: Source::Large($get),
        }),*];
    };
}

/// The code of a check.
fn checked(check: Check) -> u64 {
    match check {
        Check { by: By::Reference, .. } => 3,
        Check { taken: true, .. } => 2,
        Check { taken: false, .. } => 1,
    }
}

/// A yes or no.
fn flag(value: Option<bool>) -> Cell {
    value.map_or(Cell::Empty, |flag| Cell::Count(u64::from(flag)))
}

/// The fraction of the starts of a box that a count of them is.
fn fraction(record: &Record, count: fn(&Basin) -> u32) -> Cell {
    Cell::from(record.basin().and_then(|basin| basin.fraction(count(&basin))))
}

/// A number of the eigenvalue analysis.
macro_rules! linear {
    ($field:ident) => {
        |record| Cell::from(record.linear.map(|linear| linear.$field))
    };
}

/// A number of the response.
macro_rules! response {
    ($field:ident) => {
        |record| Cell::from(record.outcome.as_ref().and_then(|outcome| outcome.$field))
    };
}

computed! {
    Linear "type" "" |r| Cell::text(r.kind.map(InstabilityType::name)), "type of instability by complex eigenvalues and attribution";
    Linear "growth_rate" "1/s" linear!(growth_rate), "largest real part of the eigenvalues, both mechanisms present";
    Linear "frequency" "Hz" linear!(frequency), "imaginary part of that eigenvalue over 2 pi";
    Linear "phase" "deg" |r| Cell::from(r.linear.and_then(|linear| linear.phase)), "phase of y1'' against x2'' in that mode; negative when y1'' lags";
    Linear "growth_rate_flat" "1/s" linear!(growth_rate_flat), "growth rate with the friction slope set to 0 (mode coupling alone)";
    Linear "growth_rate_frozen" "1/s" linear!(growth_rate_frozen), "growth rate with the normal force frozen (negative slope alone)";
    Response "regime" "" |r| Cell::text(r.regime.map(Regime::name)), "what the system does in the measuring window";
    Response "x2_mean" "m" response!(x2_mean), "mean of x2";
    Response "x2_std" "m" response!(x2_std), "standard deviation of x2";
    Response "y1_mean" "m" response!(y1_mean), "mean of y1";
    Response "y1_std" "m" response!(y1_std), "standard deviation of y1";
    Response "ax_rms" "m/s^2" response!(ax_rms), "root mean square of x2''";
    Response "ay_rms" "m/s^2" response!(ay_rms), "root mean square of y1''";
    Response "ax_peak" "m/s^2" response!(ax_peak), "largest |x2''|";
    Response "ay_peak" "m/s^2" response!(ay_peak), "largest |y1''|";
    Response "friction_mean" "" response!(friction_mean), "time integral of T over time integral of N";
    Response "n_peak" "N" response!(n_peak), "largest normal force";
    Response "response_frequency" "Hz" response!(response_frequency), "upward zero crossings of x2' over the time from the first to the last";
    Response "phase_cycle" "deg" response!(phase_cycle), "phase of y1'' against x2'' at the response frequency";
    Response "growth_rate_measured" "1/s" response!(growth_rate_measured), "growth rate before the first contact event";
    Response "frequency_measured" "Hz" response!(frequency_measured), "frequency before the first contact event";
    Response "phase_measured" "deg" response!(phase_measured), "phase of y1'' against x2'' before the first contact event";
    Response "stick" "" response!(stick), "fraction of the window in stick";
    Response "free" "" response!(free), "fraction of the window in free flight";
    Response "reverse" "" response!(reverse), "fraction of the window in reversed slip";
    Response "impacts_per_second" "1/s" response!(impacts_per_second), "impacts per second, counting every bounce down to a rebound of 1e-6 ω0 F_ext/k2";
    Response "settled" "" |r| flag(r.settled), "1 when the two halves of the window agree (until settled: when the windows do), else 0";
    Settling "settling_time" "s" response!(settling_time), "start of the last window of a run until settled";
    Checks "checked" "" |r| r.check.map_or(Cell::Empty, |check| Cell::Count(checked(check))), "1: computed again in f64 with fine steps; 2: the same, and near a border between labels, so that the row is that result; 3: computed again by the reference; else empty";
    Checks "check_error" "" |r| Cell::from(r.check.and_then(|check| check.error)), "worst relative error of x2_std, ax_rms, ay_rms and response_frequency against that, of a settled oscillation";
    Response "simulated_time" "s" |r| Cell::from(r.outcome.as_ref().map(|outcome| outcome.simulated_time)), "simulated time";
    Response "steps" "" |r| r.outcome.as_ref().map_or(Cell::Empty, |outcome| Cell::Count(outcome.steps)), "steps taken, those ended by an event included";
    Starts "bistable" "" |r| flag(r.bistable), "1 where starts end differently: in sliding, in an oscillation, stuck, or (small and large) in oscillations with amplitudes more than 5 % apart; empty where one has not settled";
    Basin "basin_equilibrium" "" |r| fraction(r, |basin| basin.equilibrium), "fraction p of the starts in the box that end in a stable sliding equilibrium; its standard error is sqrt(p (1 - p)/box_samples)";
    Basin "basin_oscillation" "" |r| fraction(r, |basin| basin.oscillation), "fraction p of the starts in the box that end in a settled oscillation; its standard error is sqrt(p (1 - p)/box_samples)";
    Basin "basin_other" "" |r| fraction(r, |basin| basin.other), "fraction of the starts in the box that end stuck or have not settled";
    Basin "basin_failed" "" |r| fraction(r, |basin| basin.failed), "fraction of the starts in the box whose response failed";
    Always "status" "" |r| Cell::text(Some(r.status.name())), "how the instance ended; not_computed: the run was stopped before it";
}
