//! `modes`: the eigenvalues along an axis, as a table; the figure is in `figure.rs`.

use num_complex::Complex64;
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

use crate::model::linear::spectrum;
use crate::results::csv::Table;
use crate::results::manifest::described;
use crate::store::grid_json;
use crate::study::error::{Error, Result};
use crate::sweep::columns::Cell;
use crate::sweep::grid::{Axis, AxisKey, Grid, Value};
use crate::sweep::spec::Spec;

#[cfg(feature = "figures")]
pub use crate::study::modes::figure::{draw, modes_svg};

/// One mode at one point: an eigenvalue pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// The member with the larger real part, or with the positive imaginary part, 1/s.
    pub value: Complex64,
    /// The faster decaying member of a real (overdamped) pair, 1/s.
    pub fast: Option<f64>,
}

impl Mode {
    /// Frequency, Hz; 0 for a real pair.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        self.value.im / std::f64::consts::TAU
    }

    /// Real part, 1/s.
    #[must_use]
    pub fn growth_rate(&self) -> f64 {
        self.value.re
    }
}

/// The modes along the axis for one combination of the further axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// The index of the combination's first instance.
    pub first: usize,
    /// The instances in rising order of the axis.
    pub instances: Vec<usize>,
    /// The axis value of each.
    pub values: Vec<f64>,
    /// The modes of each, as many everywhere; `None` where no equilibrium or no analysis is defined.
    pub modes: Vec<Option<Vec<Mode>>>,
    /// Axis values at which the largest growth rate changes sign, in rising order.
    pub critical: Vec<f64>,
}

/// The eigenvalues of a sweep along its first numeric axis of at least two values.
#[derive(Clone, Debug, PartialEq)]
pub struct Modes {
    /// The position of that axis.
    pub axis: usize,
    /// One branch per combination of the further axes.
    pub branches: Vec<Branch>,
}

impl Modes {
    /// How many modes there are.
    #[must_use]
    pub fn count(&self) -> usize {
        let all = self.branches.iter().flat_map(|branch| &branch.modes).flatten();
        all.map(Vec::len).max().unwrap_or(0)
    }
}

/// Gives the eigenvalues of an instance of a sweep, 1/s: two for each of its modes.
pub type Eigenvalues<'a> = &'a dyn Fn(&Spec, usize) -> Option<Vec<Complex64>>;

/// Most instances whose modes are followed: a gigabyte of memory.
const MOST_FOLLOWED: usize = 2_000_000;

/// Follows the modes of a sweep.
///
/// # Errors
/// When the sweep has no axis of numbers with at least two values, no instance with modes, or more than two million.
pub fn follow(spec: &Spec, eigenvalues: Eigenvalues<'_>) -> Result<Modes> {
    let Grid::Axes(axes) = &spec.grid else { return Err(Error::NoModesOfTuples) };
    if spec.grid.len() > MOST_FOLLOWED {
        return Err(Error::TooManyModes { instances: spec.grid.len(), limit: MOST_FOLLOWED });
    }
    let Modes { axis, mut branches } = along(axes)?;
    for branch in &mut branches {
        let raw: Vec<_> = branch.instances.iter().map(|index| eigenvalues(spec, *index).map(pairs)).collect();
        let growth: Vec<_> = raw.iter().map(|modes| modes.as_deref().map(largest)).collect();
        let between = |x: f64| {
            eigenvalues(&single(spec, axes, axis, branch.first, x), 0).map(|values| largest(&pairs(values)))
        };
        branch.critical = critical_values(&branch.values, &growth, &between);
        branch.modes = connect(&branch.values, raw);
    }
    if branches.iter().all(|branch| branch.modes.iter().all(Option::is_none)) {
        return Err(Error::NoModes);
    }
    Ok(Modes { axis, branches })
}

/// The branches of axes, without modes.
///
/// # Errors
/// When none is of numbers with at least two values.
pub(crate) fn along(axes: &[Axis]) -> Result<Modes> {
    let axis = axes
        .iter()
        .position(|axis| matches!(axis.key, AxisKey::Param(_)) && axis.values.len() > 1)
        .ok_or(Error::NoModesAxis)?;
    let stride: usize = axes[axis + 1..].iter().map(|axis| axis.values.len()).product();
    let length = axes[axis].values.len();
    let total = axes.iter().map(|axis| axis.values.len()).product();
    let order = rising(&axes[axis]);
    let branch = |first: usize| Branch {
        first,
        instances: order.iter().map(|(i, _)| first + i * stride).collect(),
        values: order.iter().map(|(_, x)| *x).collect(),
        modes: Vec::new(),
        critical: Vec::new(),
    };
    let firsts = (0..total).filter(|index: &usize| (index / stride).is_multiple_of(length));
    Ok(Modes { axis, branches: firsts.map(branch).collect() })
}

/// The modes of a sweep by its own eigenvalues.
///
/// # Errors
/// Those of [`follow`].
pub fn modes_of(spec: &Spec) -> Result<Modes> {
    follow(spec, &|spec, index| spectrum(&spec.instance(index)))
}

/// The growth rate of the least stable mode; what rounding leaves of none is none.
fn largest(modes: &[Mode]) -> f64 {
    /// The part of an eigenvalue that rounding makes, many times over.
    const ROUNDING: f64 = 1e-12;
    let growth = |mode: &Mode| {
        let growth = mode.growth_rate();
        if growth > ROUNDING * mode.value.norm() { growth } else { growth.min(0.0) }
    };
    modes.iter().map(growth).fold(f64::NEG_INFINITY, f64::max)
}

/// A sweep of one instance: that with index `first`, but with the value `x` on `axis`.
fn single(spec: &Spec, axes: &[Axis], axis: usize, first: usize, x: f64) -> Spec {
    let mut axes = axes.to_vec();
    for (axis, value) in axes.iter_mut().zip(spec.grid.coordinates(first)) {
        axis.values = vec![value.clone()];
    }
    axes[axis].values = vec![Value::Number(x)];
    Spec { grid: Grid::Axes(axes), ..spec.clone() }
}

/// Where the growth rate changes sign, by bisection between neighbouring values.
fn critical_values(values: &[f64], growth: &[Option<f64>], at: &dyn Fn(f64) -> Option<f64>) -> Vec<f64> {
    /// Halvings: enough to leave only rounding.
    const HALVINGS: usize = 52;
    let changes = (1..values.len()).filter(|i| match (growth[i - 1], growth[*i]) {
        (Some(before), Some(after)) => (before > 0.0) != (after > 0.0),
        _ => false,
    });
    let bisect = |i: usize| {
        let rising = growth[i].is_some_and(|g| g > 0.0);
        let (mut low, mut high) = (values[i - 1], values[i]);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if at(middle).is_some_and(|g| g > 0.0) == rising { high = middle } else { low = middle }
        }
        0.5 * (low + high)
    };
    changes.map(bisect).collect()
}

/// Index and value of an axis' numbers in rising order.
fn rising(axis: &Axis) -> Vec<(usize, f64)> {
    let number = |value: &Value| match value {
        Value::Number(x) => *x,
        Value::Text(_) => f64::NAN,
    };
    let mut order: Vec<(usize, f64)> =
        axis.values.iter().enumerate().map(|(i, value)| (i, number(value))).collect();
    order.sort_by(|a, b| a.1.total_cmp(&b.1));
    order
}

/// The modes of eigenvalues, half as many: complex ones by their conjugates, real ones by size; rising frequency.
fn pairs(eigenvalues: Vec<Complex64>) -> Vec<Mode> {
    let count = eigenvalues.len() / 2;
    let (complex, mut real): (Vec<Complex64>, Vec<Complex64>) =
        eigenvalues.into_iter().partition(|z| z.im != 0.0);
    real.sort_by(|a, b| b.re.total_cmp(&a.re));
    let oscillating = complex.into_iter().filter(|z| z.im > 0.0).map(|value| Mode { value, fast: None });
    let overdamped = real.chunks(2).map(|pair| Mode { value: pair[0], fast: pair.get(1).map(|z| z.re) });
    let mut modes: Vec<Mode> = oscillating.chain(overdamped).collect();
    modes.sort_by(|a, b| a.value.im.total_cmp(&b.value.im).then(b.value.re.total_cmp(&a.value.re)));
    modes.resize(count, Mode { value: Complex64::new(f64::NAN, f64::NAN), fast: None });
    modes
}

/// Names the modes so that each goes on as it has come: the modes that are nearest to where the last two values lead are joined first.
fn connect(values: &[f64], raw: Vec<Option<Vec<Mode>>>) -> Vec<Option<Vec<Mode>>> {
    let mut known: [Option<(f64, Vec<Mode>)>; 2] = [None, None];
    let mut name = |x: f64, found: Vec<Mode>| {
        let named = match &known {
            [_, None] => found,
            [before, Some((at, last))] => {
                let expected = (0..last.len()).map(|k| match before {
                    None => last[k].value,
                    Some((from, before)) => {
                        last[k].value + (last[k].value - before[k].value) * ((x - at) / (at - from))
                    }
                });
                joined(&expected.collect::<Vec<_>>(), &found)
            }
        };
        known = [known[1].take(), Some((x, named.clone()))];
        named
    };
    values.iter().zip(raw).map(|(x, found)| found.map(|found| name(*x, found))).collect()
}

/// Modes in the order of the values that are expected of them.
fn joined(expected: &[Complex64], found: &[Mode]) -> Vec<Mode> {
    let apart = |i: usize, k: usize| (expected[i] - found[k].value).norm();
    let mut offers: Vec<(f64, usize, usize)> = (0..expected.len())
        .flat_map(|i| (0..found.len()).map(move |k| (i, k)))
        .map(|(i, k)| (apart(i, k), i, k))
        .collect();
    offers.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut of = vec![None; found.len()];
    let mut taken = vec![false; found.len()];
    for (_, i, k) in offers {
        if of.get(i) == Some(&None) && !taken[k] {
            (of[i], taken[k]) = (Some(k), true);
        }
    }
    let order = of.iter().enumerate().map(|(i, k)| k.unwrap_or(i));
    order.map(|k| found[k]).collect()
}

/// The table of a sweep's eigenvalues in the order of its instances: the swept parameters, then of each mode
/// the frequency (Hz), the growth rate (1/s) and, where a mode is overdamped, its faster decay (1/s).
///
/// # Errors
/// When the sweep has no axis of numbers with at least two values, or no instance with modes.
pub fn modes_csv(spec: &Spec) -> Result<Vec<u8>> {
    table(spec, &modes_of(spec)?)
}

/// The columns of a mode in `modes.csv`, counted from 1: frequency (Hz), growth rate, and the faster decay of an overdamped one (1/s).
pub(crate) fn columns(mode: usize) -> [String; 3] {
    [format!("frequency_{mode}"), format!("growth_rate_{mode}"), format!("growth_rate_{mode}_fast")]
}

/// The table of modes that were followed.
///
/// # Errors
/// When the table cannot be written.
pub fn table(spec: &Spec, modes: &Modes) -> Result<Vec<u8>> {
    let names = spec.grid.keys().into_iter().map(|key| key.name().to_owned());
    let count = modes.count();
    let mut rows: Vec<(usize, &Option<Vec<Mode>>)> = modes
        .branches
        .iter()
        .flat_map(|branch| branch.instances.iter().copied().zip(&branch.modes))
        .collect();
    rows.sort_by_key(|(index, _)| *index);
    let columns = (1..=count).flat_map(columns);
    let mut table = Table::new(std::iter::once("instance".to_owned()).chain(names).chain(columns))?;
    for (index, found) in rows {
        let swept = spec.grid.coordinates(index).into_iter().map(|value| Cell::from(value).to_string());
        let mode = |k: usize| {
            let mode = found.as_ref().map(|modes| modes[k]);
            [mode.map(|m| m.frequency()), mode.map(|m| m.growth_rate()), mode.and_then(|m| m.fast)]
        };
        let cells = (0..count).flat_map(mode).map(|x| Cell::from(x).to_string());
        table.row(std::iter::once(index.to_string()).chain(swept).chain(cells))?;
    }
    Ok(table.finish()?)
}

/// What the figure needs beside the table: title and axes of the sweep, and the critical values of each branch.
#[derive(Default, Deserialize, Serialize)]
#[serde(default)]
pub(crate) struct Document {
    pub(crate) title: String,
    /// The grid, see [`grid_json`].
    pub(crate) grid: Json,
    pub(crate) critical: Vec<Vec<f64>>,
}

/// This document as JSON.
///
/// # Errors
/// When it cannot be written.
pub fn document(spec: &Spec, modes: &Modes) -> Result<Vec<u8>> {
    let critical = modes.branches.iter().map(|branch| branch.critical.clone()).collect();
    Ok(described(&Document { title: spec.title.clone(), grid: grid_json::to_json(&spec.grid), critical })?)
}
