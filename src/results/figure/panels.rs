//! The panels of a picture: its axes, and which instances stand in which panel.

use std::cmp::Ordering;
use std::collections::HashSet;
use std::ops::Range;

use crate::engine::record::{Basin, Record};
use crate::results::figure::picture_axis::PictureAxis;
use crate::sweep::grid::{Axis, AxisKey, Grid, Rows, Value};
use crate::sweep::label::Label;
use squealmap_figure::scale::value_label;
use squealmap_figure::text::Text;

/// More panels than this do not fit a page; the figure then shows an even selection and says so.
const MOST_PANELS: usize = 40;
/// Tuples fall into panels when their other columns take no more combinations than this.
const MOST_TUPLE_PANELS: usize = 12;
/// More cells than this no print resolves; the figure then shows an even selection of the values and says so.
const MOST_CELLS: usize = 1 << 22;
/// The most values that an axis may have for that.
const MOST_VALUES: usize = 1 << 12;

/// One panel.
#[derive(Clone, Debug, Default)]
pub(crate) struct Panel {
    /// Lines above it: the values of the further axes.
    pub(crate) title: Vec<Text>,
    /// Its places in [`Panels::instances`]: cells row by row from the bottom, or points.
    pub(crate) cells: Range<usize>,
}

/// The scattered points of panels: which columns they stand by, and how dense they are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scatter {
    /// Their column for x.
    pub(crate) x: usize,
    /// Their column for y, where another one varies.
    pub(crate) y: Option<usize>,
    /// How many different points the fullest panel has.
    pub(crate) fullest: usize,
}

/// The panels of a map; every block of the figure has the same. They keep the labels of what they show, and
/// nothing of the rest.
#[derive(Clone, Debug)]
pub(crate) struct Panels {
    pub(crate) x: PictureAxis,
    pub(crate) y: Option<PictureAxis>,
    pub(crate) all: Vec<Panel>,
    /// The instances that are shown, panel after panel.
    pub(crate) instances: Vec<usize>,
    /// The label of each.
    pub(crate) labels: Vec<Label>,
    /// Where the starts of each have ended, where they are drawn from a box; empty where a sweep has no box.
    pub(crate) basins: Vec<Option<Basin>>,
    /// The places in `instances` in the order of the grid.
    order: Vec<u32>,
    /// The number of values of the fastest further axis, when there are two or more such axes.
    pub(crate) columns: Option<usize>,
    /// For scattered points.
    pub(crate) scatter: Option<Scatter>,
    /// A note that a reader has to know of.
    pub(crate) note: Option<String>,
}

impl Panels {
    /// The panels of a grid.
    pub(crate) fn new(grid: &Grid) -> Panels {
        match grid {
            Grid::Axes(axes) => from_axes(axes),
            Grid::Tuples { keys, rows } => from_tuples(keys, rows),
        }
    }

    /// Panels of titles and instances that nothing is known of yet.
    fn empty(all: Vec<(Vec<Text>, Vec<usize>)>) -> Panels {
        let mut instances = Vec::with_capacity(all.iter().map(|(_, shown)| shown.len()).sum());
        let all = all.into_iter().map(|(title, shown)| {
            let first = instances.len();
            instances.extend(shown);
            Panel { title, cells: first..instances.len() }
        });
        let all = all.collect();
        #[expect(clippy::cast_possible_truncation, reason = "cells are few, and tuples fit the memory")]
        let mut order: Vec<u32> = (0..instances.len() as u32).collect();
        order.sort_unstable_by_key(|place| instances[*place as usize]);
        let labels = vec![Label::NOT_COMPUTED; instances.len()];
        let x = PictureAxis::single();
        let basins = Vec::new();
        Panels { x, y: None, all, instances, labels, basins, order, columns: None, scatter: None, note: None }
    }

    /// The panels of a sweep with starts from a box: they keep the fractions of starts, too.
    pub(crate) fn with_basins(self) -> Panels {
        Panels { basins: vec![None; self.instances.len()], ..self }
    }

    /// Takes the labels, and the fractions, of the records from instance `first` on.
    pub(crate) fn add(&mut self, first: usize, records: &[Record]) {
        let from = self.order.partition_point(|place| self.instances[*place as usize] < first);
        for place in &self.order[from..] {
            let place = *place as usize;
            match records.get(self.instances[place] - first) {
                Some(record) => {
                    self.labels[place] = Label::from(record);
                    if let Some(basin) = self.basins.get_mut(place) {
                        *basin = record.basin();
                    }
                }
                None => break,
            }
        }
    }
}

/// Whether the values of an axis are numbers.
fn numeric(key: AxisKey) -> bool {
    matches!(key, AxisKey::Param(_))
}

/// Numeric axes of more values than this come before shorter ones: those make panels.
const FEW_VALUES: usize = 7;

/// The axes of the picture: the first two numeric ones that vary, those with many values before those with few. Where there
/// are not two, an axis of names takes the place, or else any.
fn choose(axes: &[Axis]) -> (Option<usize>, Option<usize>) {
    let varying = |i: &usize| axes[*i].values.len() > 1;
    let all = || 0..axes.len();
    let mut chosen: Vec<usize> = all().filter(|i| numeric(axes[*i].key) && varying(i)).collect();
    chosen.sort_by_key(|i| axes[*i].values.len() <= FEW_VALUES);
    let mut chosen = chosen.into_iter();
    match (chosen.next(), chosen.next()) {
        (Some(x), Some(y)) => (Some(x.min(y)), Some(x.max(y))),
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
    let stride = |axis: Option<usize>| axis.map_or(0, |i| strides[i]);
    let further: Vec<usize> = (0..axes.len()).filter(|i| Some(*i) != x_axis && Some(*i) != y_axis).collect();
    // The longest of them runs along the rows of panels.
    let mut varying: Vec<usize> = further.iter().copied().filter(|i| axes[*i].values.len() > 1).collect();
    varying.sort_by_key(|i| axes[*i].values.len());
    let total: usize = varying.iter().map(|i| axes[*i].values.len()).product();
    let shown = total.min(MOST_PANELS);
    let limit = if y_axis.is_some() { (MOST_CELLS / shown).isqrt() } else { MOST_CELLS / shown };
    let thin = |i: usize| Thinned::new(&axes[i], limit.min(MOST_VALUES));
    let (x, y) = (x_axis.map(thin), y_axis.map(thin));
    let across = x.as_ref().map_or_else(|| vec![0], Thinned::indices);
    let rows = y.as_ref().map_or_else(|| vec![0], Thinned::indices);
    let panels = selection(total, MOST_PANELS)
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
                .flat_map(|j| across.iter().map(move |i| (i, row(j))))
                .map(|(i, row)| row + i * stride(x_axis))
                .collect();
            (title, instances)
        })
        .collect::<Vec<_>>();
    let columns = (varying.len() > 1 && panels.len() == total)
        .then(|| varying.last().map_or(1, |i| axes[*i].values.len()));
    let mut left_out = Vec::new();
    if panels.len() < total {
        left_out.push(format!("{} of {total} panels", panels.len()));
    }
    for thinned in x.iter().chain(&y).filter(|one| one.picks.len() < one.of) {
        left_out.push(format!("{} of {} values of {}", thinned.picks.len(), thinned.of, thinned.name));
    }
    let note = (!left_out.is_empty())
        .then(|| format!("{} shown; the table holds all instances.", left_out.join(", ")));
    let x = x.map_or_else(PictureAxis::single, |thinned| thinned.axis);
    Panels { x, y: y.map(|thinned| thinned.axis), columns, note, ..Panels::empty(panels) }
}

/// An axis of a picture with no more values than a print resolves.
struct Thinned {
    axis: PictureAxis,
    /// The indices of its values on the axis of the sweep.
    picks: Vec<usize>,
    /// How many values that has, and what they are of.
    of: usize,
    name: &'static str,
}

impl Thinned {
    fn new(axis: &Axis, limit: usize) -> Thinned {
        let (of, name) = (axis.values.len(), axis.key.name());
        let picks: Vec<usize> = selection(of, limit).collect();
        let axis = if picks.len() < of {
            let values = picks.iter().map(|i| axis.values[*i].clone()).collect();
            PictureAxis::cells(&Axis { key: axis.key, values, log: axis.log })
        } else {
            PictureAxis::cells(axis)
        };
        Thinned { axis, picks, of, name }
    }

    /// The index on the axis of the sweep of each cell.
    fn indices(&self) -> Vec<usize> {
        self.axis.order.iter().map(|cell| self.picks[*cell]).collect()
    }
}

/// An even selection of at most `most` of `total`, first and last included.
pub(crate) fn selection(total: usize, most: usize) -> impl Iterator<Item = usize> {
    let shown = total.min(most);
    (0..shown).map(move |i| if shown < total { i * (total - 1) / (shown - 1).max(1) } else { i })
}

/// `V = 3 m/s`, or the name of a law or material.
pub(crate) fn setting(key: AxisKey, value: &Value) -> Text {
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

/// The instances of a panel, and what they have in common.
type Group<'a> = (Vec<&'a Value>, Vec<usize>);

/// Panels in an order for readers: numbers ascend, names stay in the order in which they come.
fn sorted(groups: Vec<Group<'_>>) -> Vec<Group<'_>> {
    let first = |column: usize, name: &Value| groups.iter().position(|(setting, _)| setting[column] == name);
    let rank = |(column, value): (usize, &&Value)| match value {
        Value::Number(number) => *number,
        name @ Value::Text(_) => first(column, name).map_or(0.0, |place| place as f64),
    };
    let ranks = |group: &Group<'_>| group.0.iter().enumerate().map(rank).collect();
    let ranks: Vec<Vec<f64>> = groups.iter().map(ranks).collect();
    let mut ranked: Vec<(Vec<f64>, Group<'_>)> = ranks.into_iter().zip(groups).collect();
    ranked.sort_by(|(one, _), (other, _)| {
        one.iter().zip(other).fold(Ordering::Equal, |order, (a, b)| order.then(a.total_cmp(b)))
    });
    ranked.into_iter().map(|(_, group)| group).collect()
}

/// How many different points the fullest panel of some has.
fn fullest<'a>(panels: &[(Vec<Text>, Vec<usize>)], place: impl Fn(usize) -> [Option<&'a Value>; 2]) -> usize {
    let key = |value: Option<&'a Value>| match value {
        Some(Value::Number(number)) => (number.to_bits(), ""),
        Some(Value::Text(name)) => (0, name.as_str()),
        None => (0, ""),
    };
    let different = |panel: &(Vec<Text>, Vec<usize>)| {
        let places = panel.1.iter().map(|instance| place(*instance).map(key));
        places.collect::<HashSet<_>>().len()
    };
    panels.iter().map(different).max().unwrap_or(0)
}

fn from_tuples(keys: &[AxisKey], rows: &Rows) -> Panels {
    let column = |i: usize| rows.iter().map(|row| &row[i]).collect::<Vec<&Value>>();
    let varying = |i: &usize| rows.iter().any(|row| row[*i] != rows[0][*i]);
    let mut numbers = (0..keys.len()).filter(|i| numeric(keys[*i]) && varying(i));
    let x_column = numbers.next().or_else(|| (0..keys.len()).find(varying)).unwrap_or(0);
    let y_column = numbers.next().or_else(|| (0..keys.len()).find(|i| *i != x_column && varying(i)));
    let further: Vec<usize> =
        (0..keys.len()).filter(|i| *i != x_column && Some(*i) != y_column && varying(i)).collect();
    let mut groups: Vec<Group<'_>> = Vec::new();
    for (instance, row) in rows.iter().enumerate() {
        let group: Vec<&Value> = further.iter().map(|i| &row[*i]).collect();
        if let Some((_, panel)) = groups.iter_mut().find(|(other, _)| *other == group) {
            panel.push(instance);
        } else if groups.len() <= MOST_TUPLE_PANELS {
            groups.push((group, vec![instance]));
        }
    }
    let groups = sorted(groups);
    // Worth separate panels only when these collect points.
    let split = groups.len() <= MOST_TUPLE_PANELS && 2 * groups.len() <= rows.len();
    let (panels, note): (Vec<_>, _) = if split || further.is_empty() {
        let title =
            |group: &[&Value]| further.iter().zip(group).map(|(i, value)| setting(keys[*i], value)).collect();
        (groups.into_iter().map(|(group, panel)| (title(&group), panel)).collect(), None)
    } else {
        let names: Vec<&str> = further.iter().map(|i| keys[*i].name()).collect();
        let note = format!("Also varying between the points: {}.", names.join(", "));
        (vec![(Vec::new(), (0..rows.len()).collect())], Some(note))
    };
    let axis = |i: usize| PictureAxis::scatter(keys[i], &column(i));
    let (x, y) = if keys.is_empty() || rows.is_empty() {
        (PictureAxis::single(), None)
    } else {
        (axis(x_column), y_column.map(axis))
    };
    let place = |instance: usize| [Some(x_column), y_column].map(|i| rows[instance].get(i?));
    let scatter = Some(Scatter { x: x_column, y: y_column, fullest: fullest(&panels, place) });
    Panels { x, y, scatter, note, ..Panels::empty(panels) }
}
