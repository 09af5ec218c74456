//! Which instances stand in which panel: the picture's axes and the small multiples.

use super::picture_axis::PictureAxis;
use super::scale::value_label;
use super::text::Text;
use crate::grid::{Axis, AxisKey, Grid, Value};

/// More panels than this do not fit a page; the figure then shows an even selection and says so.
const MOST_PANELS: usize = 40;
/// Tuples fall into panels when their other columns take no more combinations than this.
const MOST_TUPLE_PANELS: usize = 12;

/// One panel.
#[derive(Clone, Debug, Default)]
pub(super) struct Panel {
    /// Lines above it: the values of the further axes.
    pub(super) title: Vec<Text>,
    /// Cells: the instances row by row from the bottom. Points: the instances.
    pub(super) instances: Vec<usize>,
}

/// The panels of a map; every block of the figure has the same.
#[derive(Clone, Debug)]
pub(super) struct Panels {
    pub(super) x: PictureAxis,
    pub(super) y: Option<PictureAxis>,
    pub(super) all: Vec<Panel>,
    /// The number of values of the fastest further axis, when there are two or more such axes.
    pub(super) columns: Option<usize>,
    /// For scattered points: their columns for x and y.
    pub(super) scatter: Option<(usize, Option<usize>)>,
    /// What a reader has to know.
    pub(super) note: Option<String>,
}

impl Panels {
    /// The panels of a grid.
    pub(super) fn new(grid: &Grid) -> Panels {
        match grid {
            Grid::Axes(axes) => from_axes(axes),
            Grid::Tuples { keys, rows } => from_tuples(keys, rows),
        }
    }
}

/// Whether the values of an axis are numbers.
fn numeric(key: AxisKey) -> bool {
    matches!(key, AxisKey::Param(_))
}

/// The axes of the picture: the first two numeric ones that vary; failing that a named one, failing that any.
fn choose(axes: &[Axis]) -> (Option<usize>, Option<usize>) {
    let varying = |i: &usize| axes[*i].values.len() > 1;
    let all = || 0..axes.len();
    let mut chosen = all().filter(|i| numeric(axes[*i].key) && varying(i));
    match (chosen.next(), chosen.next()) {
        (Some(x), Some(y)) => (Some(x), Some(y)),
        (Some(x), None) => (Some(x), all().find(|i| !numeric(axes[*i].key) && varying(i))),
        _ => {
            let mut named = all().filter(varying);
            match (named.next(), named.next()) {
                (Some(x), y) => (Some(x), y),
                (None, _) => (all().next(), all().nth(1)),
            }
        }
    }
}

fn from_axes(axes: &[Axis]) -> Panels {
    let (x_axis, y_axis) = choose(axes);
    let mut strides = vec![1; axes.len()];
    for i in (1..axes.len()).rev() {
        strides[i - 1] = strides[i] * axes[i].values.len();
    }
    let x = x_axis.map_or_else(PictureAxis::single, |i| PictureAxis::cells(&axes[i]));
    let y = y_axis.map(|i| PictureAxis::cells(&axes[i]));
    let stride = |axis: Option<usize>| axis.map_or(0, |i| strides[i]);
    let rows: &[usize] = y.as_ref().map_or(&[0], |y| &y.order);
    let further: Vec<usize> = (0..axes.len()).filter(|i| Some(*i) != x_axis && Some(*i) != y_axis).collect();
    // The longest of them runs along the rows of panels.
    let mut varying: Vec<usize> = further.iter().copied().filter(|i| axes[*i].values.len() > 1).collect();
    varying.sort_by_key(|i| axes[*i].values.len());
    let total: usize = varying.iter().map(|i| axes[*i].values.len()).product();
    let panels = selection(total)
        .map(|number| {
            let mut rest = number;
            let mut at = vec![0; axes.len()];
            for i in varying.iter().rev() {
                at[*i] = rest % axes[*i].values.len();
                rest /= axes[*i].values.len();
            }
            let offset: usize = varying.iter().map(|i| at[*i] * strides[*i]).sum();
            // An axis of one value has its place in the title too.
            let title = further.iter().map(|i| setting(axes[*i].key, &axes[*i].values[at[*i]])).collect();
            let row = |j: &usize| offset + j * stride(y_axis);
            let instances = rows
                .iter()
                .flat_map(|j| x.order.iter().map(move |i| (i, row(j))))
                .map(|(i, row)| row + i * stride(x_axis))
                .collect();
            Panel { title, instances }
        })
        .collect::<Vec<_>>();
    let columns = (varying.len() > 1 && panels.len() == total)
        .then(|| varying.last().map_or(1, |i| axes[*i].values.len()));
    let note = (panels.len() < total)
        .then(|| format!("{} of {total} panels shown; the table holds all instances.", panels.len()));
    Panels { x, y, all: panels, columns, scatter: None, note }
}

/// An even selection of at most [`MOST_PANELS`] of `total` panels, first and last included.
fn selection(total: usize) -> impl Iterator<Item = usize> {
    let shown = total.min(MOST_PANELS);
    (0..shown).map(move |i| if shown < total { i * (total - 1) / (shown - 1) } else { i })
}

/// `V = 3 m/s`, or the name of a law or material.
pub(super) fn setting(key: AxisKey, value: &Value) -> Text {
    match (key, value) {
        (AxisKey::Param(param), Value::Number(x)) => {
            let row = param.info();
            let text = Text::default().symbol(row.symbol).plain(" = ").then(value_label(*x));
            if row.unit.is_empty() { text } else { text.plain(" ").unit(row.unit) }
        }
        (_, Value::Number(x)) => value_label(*x),
        (_, Value::Text(name)) => Text::from(name.as_str()),
    }
}

fn from_tuples(keys: &[AxisKey], rows: &[Vec<Value>]) -> Panels {
    let column = |i: usize| rows.iter().map(|row| &row[i]).collect::<Vec<&Value>>();
    let varying = |i: &usize| rows.iter().any(|row| row[*i] != rows[0][*i]);
    let mut numbers = (0..keys.len()).filter(|i| numeric(keys[*i]) && varying(i));
    let x_column = numbers.next().or_else(|| (0..keys.len()).find(varying)).unwrap_or(0);
    let y_column = numbers.next().or_else(|| (0..keys.len()).find(|i| *i != x_column && varying(i)));
    let further: Vec<usize> =
        (0..keys.len()).filter(|i| *i != x_column && Some(*i) != y_column && varying(i)).collect();
    let mut groups: Vec<(Vec<&Value>, Panel)> = Vec::new();
    for (instance, row) in rows.iter().enumerate() {
        let group: Vec<&Value> = further.iter().map(|i| &row[*i]).collect();
        if let Some((_, panel)) = groups.iter_mut().find(|(other, _)| *other == group) {
            panel.instances.push(instance);
        } else if groups.len() <= MOST_TUPLE_PANELS {
            let title = further.iter().map(|i| setting(keys[*i], &row[*i])).collect();
            groups.push((group, Panel { title, instances: vec![instance] }));
        }
    }
    // Worth separate panels only when these collect points.
    let split = groups.len() <= MOST_TUPLE_PANELS && 2 * groups.len() <= rows.len();
    let (panels, note) = if split || further.is_empty() {
        (groups.into_iter().map(|(_, panel)| panel).collect(), None)
    } else {
        let names: Vec<&str> = further.iter().map(|i| keys[*i].name()).collect();
        let note = format!("Also varying between the points: {}.", names.join(", "));
        (vec![Panel { title: Vec::new(), instances: (0..rows.len()).collect() }], Some(note))
    };
    let axis = |i: usize| PictureAxis::scatter(keys[i], &column(i));
    let (x, y) = if keys.is_empty() || rows.is_empty() {
        (PictureAxis::single(), None)
    } else {
        (axis(x_column), y_column.map(axis))
    };
    Panels { x, y, all: panels, columns: None, scatter: Some((x_column, y_column)), note }
}
