//! A cut through a map: quantities along one axis, a curve for each value of another; the figure is in `cut_figure.rs`.

use crate::results::choose::{Taken, choose_all};
use crate::results::csv::Table;
use crate::results::error::{Error, Result};
use crate::results::number::NumberColumn;
use crate::results::trust::{self, Doubt};
use crate::sweep::columns::Cell;
use crate::sweep::grid::{Axis, AxisKey, Grid, Value};
use crate::sweep::map::Map;

#[cfg(feature = "figures")]
pub use crate::results::figure::cut_figure::{cut_svg, left_out};

/// The most curves of a panel that can be told apart.
pub const MOST_CURVES: usize = 6;

/// One curve: the instances along the axis, in rising order of its values.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The value of the further axis that this curve is for; `None` where there is one curve.
    pub of: Option<(AxisKey, Value)>,
    /// The values of the axis, rising.
    pub x: Vec<f64>,
    /// The instance at each.
    pub instances: Vec<usize>,
}

/// The curves that share a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct CutPanel {
    /// The values of the axes beyond.
    pub of: Vec<(AxisKey, Value)>,
    /// One curve for each value of the further axis.
    pub curves: Vec<Curve>,
}

/// A cut.
#[derive(Clone, Debug, PartialEq)]
pub struct Cut {
    /// The axis along which the curves run.
    pub axis: Axis,
    /// The values that are held.
    pub held: Vec<(AxisKey, Value)>,
    /// The panels; one where no axis is left for more.
    pub panels: Vec<CutPanel>,
    /// The values that were taken for those that an axis does not have.
    pub taken: Vec<Taken>,
}

impl Cut {
    /// Cuts a grid of axes where some of them have given values, or the nearest that they have, such as
    /// `mu_d=0.3,belt_velocity=3`. An axis that is named several times, as in `mu_d=0.1,mu_d=0.2`, has a curve for each
    /// value. Of the axes that are not named, curves run along the numeric one with the most values; the shortest of the
    /// others has a curve for each of its values, and any further one a panel for each.
    ///
    /// # Errors
    /// When the grid has no such axis, a value is outside it, no axis of numbers is left, or more values of an axis are named than a
    /// panel can show curves.
    pub fn new(grid: &Grid, at: &str) -> Result<Cut> {
        let refused = |why: String| Error::Cut { cut: at.to_owned(), why };
        let Grid::Axes(axes) = grid else {
            return Err(refused("a map of single points has no axes to cut".to_owned()));
        };
        // The indices that are asked for of each axis; none: it is free.
        let mut asked: Vec<Vec<usize>> =
            axes.iter().map(|axis| if axis.values.len() == 1 { vec![0] } else { Vec::new() }).collect();
        let choices = choose_all(axes, at).map_err(refused)?;
        for choice in &choices {
            if !asked[choice.axis].contains(&choice.value) {
                asked[choice.axis].push(choice.value);
            }
        }
        let taken = choices.into_iter().filter_map(|choice| choice.taken).collect();
        let mut free: Vec<usize> = (0..axes.len()).filter(|i| asked[*i].is_empty()).collect();
        free.sort_by_key(|i| axes[*i].values.len());
        let numeric = |i: &usize| matches!(axes[*i].key, AxisKey::Param(_));
        let along = free.iter().copied().rfind(numeric);
        let along = along.ok_or_else(|| {
            let advice = "no axis of numbers is left for the curves; leave one of them out, or --cut as a whole: without \
                          it --quantity draws a curve along the one axis of a sweep";
            refused(advice.to_owned())
        })?;
        // What was asked for by several values is to be compared: it has the curves.
        let several = (0..axes.len()).filter(|i| asked[*i].len() > 1);
        if let Some(i) = several.clone().next().filter(|i| asked[*i].len() > MOST_CURVES) {
            let (name, many) = (axes[i].key.name(), asked[i].len());
            return Err(refused(format!(
                "{many} values of `{name}` are named, but a panel shows {MOST_CURVES} curves; leave some out, or draw several \
                 figures with -o"
            )));
        }
        let others: Vec<usize> = several.chain(free.into_iter().filter(|i| *i != along)).collect();
        let (curves, beyond) = (others.first().copied(), others.get(1..).unwrap_or_default());
        let one = |i: usize| if let [index] = asked[i][..] { Some(setting(axes, i, index)) } else { None };
        let held = (0..axes.len()).filter_map(one).collect();
        let base: Vec<usize> = asked.iter().map(|indices| indices.first().copied().unwrap_or(0)).collect();
        let values: Vec<Vec<usize>> = asked
            .into_iter()
            .zip(axes)
            .map(|(asked, axis)| if asked.is_empty() { (0..axis.values.len()).collect() } else { asked })
            .collect();
        let panels = combinations(&values, beyond, &base)
            .into_iter()
            .map(|of_panel| CutPanel {
                of: beyond.iter().map(|i| setting(axes, *i, of_panel[*i])).collect(),
                curves: combinations(&values, curves.as_slice(), &of_panel)
                    .into_iter()
                    .map(|of_curve| {
                        let of = curves.map(|i| setting(axes, i, of_curve[i]));
                        curve(axes, along, of, &of_curve)
                    })
                    .collect(),
            })
            .collect();
        Ok(Cut { axis: axes[along].clone(), held, panels, taken })
    }
}

fn setting(axes: &[Axis], place: usize, index: usize) -> (AxisKey, Value) {
    (axes[place].key, axes[place].values[index].clone())
}

/// Every combination of the indices of some axes, the others as in `base`; the last axis varies fastest.
fn combinations(values: &[Vec<usize>], of: &[usize], base: &[usize]) -> Vec<Vec<usize>> {
    of.iter().fold(vec![base.to_vec()], |all, place| {
        let each = |at: Vec<usize>| {
            values[*place].iter().map(move |index| {
                let mut at = at.clone();
                at[*place] = *index;
                at
            })
        };
        all.into_iter().flat_map(each).collect()
    })
}

/// The instances along an axis, the other indices as in `at`.
fn curve(axes: &[Axis], along: usize, of: Option<(AxisKey, Value)>, at: &[usize]) -> Curve {
    let mut points: Vec<(f64, usize)> = axes[along]
        .values
        .iter()
        .enumerate()
        .map(|(index, value)| {
            let number = if let Value::Number(x) = value { *x } else { f64::NAN };
            let index_of = |i: usize| if i == along { index } else { at[i] };
            // The first axis varies slowest.
            let instance =
                (0..axes.len()).fold(0, |instance, i| instance * axes[i].values.len() + index_of(i));
            (number, instance)
        })
        .collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (x, instances) = points.into_iter().unzip();
    Curve { of, x, instances }
}

/// The cut as a table with a row per instance: the numbers of panel and curve (from 1), every swept value, and the
/// quantities. A quantity of the measuring window is followed by a column of its name with `_settled` at the end: 1, or 0
/// where the response has not settled.
///
/// # Errors
/// When the table cannot be written.
pub fn cut_csv(map: &Map, cut: &Cut, quantities: &[&NumberColumn]) -> Result<Vec<u8>> {
    let grid = &map.spec.grid;
    let swept = grid.keys().into_iter().map(|key| -> &str { key.name() });
    let names = quantities.iter().flat_map(|column| {
        let settled = trust::is_of_the_window(column).then(|| format!("{}_settled", column.name));
        std::iter::once(column.name.clone()).chain(settled)
    });
    let header = ["panel", "curve"].into_iter().chain(swept).map(str::to_owned).chain(names);
    let header: Vec<String> = header.collect();
    let doubts: Vec<Doubt<'_>> = quantities.iter().map(|column| Doubt::of(column)).collect();
    let mut table = Table::new(header.iter().map(String::as_str))?;
    for (panel, of_panel) in cut.panels.iter().enumerate() {
        for (curve, of_curve) in of_panel.curves.iter().enumerate() {
            for instance in &of_curve.instances {
                let numbers = [panel + 1, curve + 1].map(|number| number.to_string());
                let swept =
                    grid.coordinates(*instance).into_iter().map(|value| Cell::from(value).to_string());
                let of = |(column, doubt): (&&NumberColumn, &Doubt<'_>)| {
                    let number = column.values.get(*instance).copied().flatten();
                    let value = Cell::from(number).to_string();
                    let record = map.records.get(*instance);
                    let unsettled = record.is_some_and(|record| doubt.is_unsettled_in(record, number));
                    let settled =
                        if value.is_empty() { String::new() } else { u8::from(!unsettled).to_string() };
                    let settled = trust::is_of_the_window(column).then_some(settled);
                    std::iter::once(value).chain(settled)
                };
                table.row(
                    numbers.into_iter().chain(swept).chain(quantities.iter().zip(&doubts).flat_map(of)),
                )?;
            }
        }
    }
    table.finish()
}
