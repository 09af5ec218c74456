//! Two maps of the same grid beside one another: which labels differ, and by how much the numbers do.

use std::collections::BTreeMap;

use crate::model::status::Status;
use crate::results::number::NumberColumn;
use crate::results::read::Archive;
use crate::sweep::columns::{Class, Column, computed};
use crate::sweep::grid::{Axis, AxisKey, Grid, Value};

/// Swept values are the same where they differ by no more than this part of them, or of the length of their axis.
const SAME: f64 = 1e-9;
/// The shares of the instances for which a difference is stated: half of them have no larger one, and so on.
pub const QUANTILES: [f64; 4] = [0.5, 0.9, 0.99, 1.0];

/// What an instance is called, in the order of a comparison: the classes of the table, how it ended first, and the regime from
/// the large start.
fn labels() -> impl Iterator<Item = (&'static Column, &'static Class)> {
    let classes = || computed().filter_map(|column| Some((column, column.values()?.class()?)));
    let is_status = |(column, _): &(&Column, &Class)| column.quantity() == "status";
    let own = move || classes().filter(|(column, _)| !column.is_of_large_start);
    let large = classes().filter(|(column, _)| column.is_of_large_start && column.quantity() == "regime");
    own().filter(is_status).chain(own().filter(move |one| !is_status(one))).chain(large)
}

/// One label of every instance in both maps.
#[derive(Clone, Debug, PartialEq)]
pub struct Labels {
    /// The column.
    pub name: &'static str,
    /// The two labels of each instance, empty where it has none; `None` where it was not computed in both maps.
    pub pairs: Vec<Option<[&'static str; 2]>>,
}

impl Labels {
    /// How many instances have which two labels that differ, the most frequent first.
    #[must_use]
    pub fn changes(&self) -> Vec<([&'static str; 2], usize)> {
        let mut counts: BTreeMap<[&'static str; 2], usize> = BTreeMap::new();
        for pair in self.pairs.iter().flatten().filter(|[a, b]| a != b) {
            *counts.entry(*pair).or_default() += 1;
        }
        let mut counts: Vec<_> = counts.into_iter().collect();
        counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        counts
    }

    /// Whether the label of an instance differs.
    #[must_use]
    pub fn differs(&self, instance: usize) -> bool {
        self.pairs.get(instance).copied().flatten().is_some_and(|[a, b]| a != b)
    }
}

/// One column of numbers in both maps.
#[derive(Clone, Debug, PartialEq)]
pub struct Differences {
    /// The column.
    pub name: String,
    /// The difference of each instance as a part of the larger of both magnitudes, or for angles as a part of half a turn;
    /// `None` where the value is not defined in both maps.
    pub relative: Vec<Option<f64>>,
    /// How many instances have a number in one of the maps alone: in the first, in the second.
    pub alone: [usize; 2],
}

impl Differences {
    fn new(first: &NumberColumn, second: &NumberColumn, both: impl Fn(usize) -> bool) -> Differences {
        let mut alone = [0; 2];
        let mut difference = |(instance, pair): (usize, (&Option<f64>, &Option<f64>))| match pair {
            (Some(a), Some(b)) => Some(relative(*a, *b, first.is_angle())),
            (a, b) => {
                for (side, one) in [a, b].into_iter().enumerate() {
                    alone[side] += usize::from(both(instance) && one.is_some());
                }
                None
            }
        };
        let relative = first.values.iter().zip(&second.values).enumerate().map(&mut difference).collect();
        Differences { name: first.name.clone(), relative, alone }
    }

    /// How many instances have a number in both maps, and for how many of these the two numbers are equal to the last bit.
    #[must_use]
    pub fn compared(&self) -> [usize; 2] {
        let defined = || self.relative.iter().flatten();
        [defined().count(), defined().filter(|difference| **difference == 0.0).count()]
    }

    /// The differences that the shares [`QUANTILES`] of the instances do not exceed; none where nothing is compared.
    #[must_use]
    pub fn quantiles(&self) -> Option<[f64; QUANTILES.len()]> {
        let mut sorted: Vec<f64> = self.relative.iter().flatten().copied().collect();
        sorted.sort_by(f64::total_cmp);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of a count")]
        let rank = |share: f64| ((share * sorted.len() as f64).ceil() as usize).clamp(1, sorted.len()) - 1;
        (!sorted.is_empty()).then(|| QUANTILES.map(|share| sorted[rank(share)]))
    }
}

/// The difference of two numbers, as a part of the larger magnitude; of two angles as a part of half a turn.
fn relative(a: f64, b: f64, angle: bool) -> f64 {
    const HALF: f64 = 180.0;
    if angle {
        return ((a - b + HALF).rem_euclid(2.0 * HALF) - HALF).abs() / HALF;
    }
    let largest = a.abs().max(b.abs());
    if a.to_bits() == b.to_bits() || largest == 0.0 { 0.0 } else { (a / largest - b / largest).abs() }
}

/// How two maps compare.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// How many instances were computed in both, of all.
    pub computed: [usize; 2],
    /// The labels that both maps have.
    pub labels: Vec<Labels>,
    /// The columns of numbers that both have.
    pub columns: Vec<Differences>,
}

impl Comparison {
    /// Compares two maps.
    ///
    /// # Errors
    /// Why they cannot be compared, in words, where their grids differ or they have nothing in common.
    pub fn new(first: &Archive, second: &Archive) -> Result<Comparison, String> {
        same_grid(&first.map.spec.grid, &second.map.spec.grid)?;
        let [ours, theirs] = [first, second].map(|archive| &archive.map.records);
        let both = |instance: usize| {
            [ours, theirs].into_iter().all(|records| records[instance].status != Status::NotComputed)
        };
        let total = first.map.spec.grid.len();
        let computed = (0..total).filter(|instance| both(*instance)).count();
        if computed == 0 {
            return Err("no instance was computed in both".to_owned());
        }
        let of = |(column, class): (&'static Column, &'static Class)| {
            (column.name, move |record| class.name(column.of(record)))
        };
        let known = labels().map(of).filter(|(_, of)| {
            [ours, theirs].into_iter().all(|records| records.iter().any(|record| of(record).is_some()))
        });
        let known = known.map(|(name, of)| {
            let pair = |instance: usize| {
                both(instance)
                    .then(|| [ours, theirs].map(|records| of(&records[instance]).unwrap_or_default()))
            };
            Labels { name, pairs: (0..total).map(pair).collect() }
        });
        let columns =
            first.columns.iter().filter(|column| !labels().any(|(label, _)| label.name == column.name));
        let columns = columns.filter_map(|column| {
            let other = second.columns.iter().find(|other| other.name == column.name)?;
            Some(Differences::new(column, other, both))
        });
        Ok(Comparison { computed: [computed, total], labels: known.collect(), columns: columns.collect() })
    }
}

/// Whether two grids hold the same instances in the same order; otherwise what differs first.
fn same_grid(first: &Grid, second: &Grid) -> Result<(), String> {
    let names = |grid: &Grid| {
        let names: Vec<&str> = grid.keys().into_iter().map(AxisKey::name).collect();
        if names.is_empty() { "nothing".to_owned() } else { names.join(", ") }
    };
    if first.keys() != second.keys() {
        return Err(format!("the first sweeps {}, the second {}", names(first), names(second)));
    }
    match (first, second) {
        (Grid::Axes(ours), Grid::Axes(theirs)) => {
            ours.iter().zip(theirs).try_for_each(|(a, b)| same_axis(a, b))
        }
        (Grid::Tuples { rows: ours, .. }, Grid::Tuples { rows: theirs, .. }) => {
            if ours.len() != theirs.len() {
                return Err(format!("the first lists {} instances, the second {}", ours.len(), theirs.len()));
            }
            let differs = |row: &usize| ours[*row].iter().zip(&theirs[*row]).any(|(a, b)| !same(a, b, 0.0));
            match (0..ours.len()).find(differs) {
                Some(row) => Err(format!("they list different values for instance {row}")),
                None => Ok(()),
            }
        }
        _ => Err("one has axes, the other lists its instances".to_owned()),
    }
}

fn same_axis(first: &Axis, second: &Axis) -> Result<(), String> {
    let name = first.key.name();
    let counts = [first, second].map(|axis| axis.values.len());
    if counts[0] != counts[1] {
        return Err(format!("`{name}` has {} values in the first, {} in the second", counts[0], counts[1]));
    }
    let numbers = first.values.iter().filter_map(Value::number);
    let (low, high) =
        numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    let length = if first.log || low > high { 0.0 } else { high - low };
    let mut pairs = first.values.iter().zip(&second.values);
    match pairs.find(|(a, b)| !same(a, b, length)) {
        Some((a, b)) => Err(format!("`{name}` has {a} in the first where the second has {b}")),
        None => Ok(()),
    }
}

fn same(first: &Value, second: &Value, length: f64) -> bool {
    match (first, second) {
        (Value::Number(a), Value::Number(b)) => (a - b).abs() <= SAME * a.abs().max(b.abs()).max(length),
        (a, b) => a == b,
    }
}
