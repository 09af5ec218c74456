//! What a run has computed already: the values of its cells, found by where they stand.

use std::collections::BTreeMap;

use crate::sweep::grid::{Axis, AxisKey, Value};
use crate::sweep::spec::Spec;

/// Values stand at the same place where they differ by no more than this part of them, or of the length of their axis.
const SAME: f64 = 1e-9;

/// A run, as far as it came.
#[derive(Clone, Debug)]
pub struct Finished {
    /// The program that computed it: version, and commit where known.
    pub program: String,
    /// Whether it has transients.
    pub response: bool,
    /// How many of its instances are computed.
    pub computed: usize,
    axes: Vec<Places>,
    /// The numbers of a column by instance, names by their codes.
    columns: BTreeMap<&'static str, Vec<f64>>,
    is_computed: Vec<bool>,
}

/// What a run has of a region.
#[derive(Clone, Debug)]
pub struct Known<'a> {
    /// The instance of the run at each cell; `None` where there is none.
    pub cells: Vec<Option<usize>>,
    /// The numbers of each wanted column, by instance.
    pub columns: Vec<&'a [f64]>,
}

/// The values of an axis, to be found.
#[derive(Clone, Debug)]
struct Places {
    key: AxisKey,
    /// Numbers from the smallest up, with their places on the axis.
    numbers: Vec<(f64, usize)>,
    texts: Vec<String>,
    length: f64,
    /// Instances from one value to the next.
    stride: usize,
}

impl Places {
    fn new(axis: &Axis, stride: usize) -> Places {
        let (mut numbers, mut texts) = (Vec::new(), Vec::new());
        for (place, value) in axis.values.iter().enumerate() {
            match value {
                Value::Number(number) => numbers.push((*number, place)),
                Value::Text(text) => texts.push(text.to_string()),
            }
        }
        numbers.sort_by(|a, b| a.0.total_cmp(&b.0));
        let ends = numbers.first().zip(numbers.last());
        let length = ends.map_or(0.0, |(first, last)| if axis.log { 0.0 } else { last.0 - first.0 });
        Places { key: axis.key, numbers, texts, length, stride }
    }

    /// The place of a value on the axis.
    fn find(&self, value: &Value) -> Option<usize> {
        let wanted = match value {
            Value::Text(text) => return self.texts.iter().position(|one| one == text.as_str()),
            Value::Number(wanted) => *wanted,
        };
        let above = self.numbers.partition_point(|(number, _)| *number < wanted);
        let beside = self.numbers[above.saturating_sub(1)..].iter().take(2);
        let apart = |number: f64| (number - wanted).abs();
        let nearest = beside.min_by(|a, b| apart(a.0).total_cmp(&apart(b.0)))?;
        let most = SAME * nearest.0.abs().max(wanted.abs()).max(self.length);
        (apart(nearest.0) <= most).then_some(nearest.1)
    }
}

impl Finished {
    /// A run over `axes`: which instances it has computed, and their columns, all in the order of the grid.
    #[must_use]
    pub fn new(
        (program, response): (String, bool),
        axes: &[Axis],
        is_computed: Vec<bool>,
        columns: BTreeMap<&'static str, Vec<f64>>,
    ) -> Finished {
        let mut stride = 1;
        let mut places: Vec<Places> = axes
            .iter()
            .rev()
            .map(|axis| {
                let of = Places::new(axis, stride);
                stride *= axis.values.len();
                of
            })
            .collect();
        places.reverse();
        let computed = is_computed.iter().filter(|is| **is).count();
        Finished { program, response, computed, axes: places, columns, is_computed }
    }

    /// What the run has of some columns over the grid of `axes`, of the sweep `spec`; `None` where it has not all of the columns, or nothing
    /// of the grid.
    #[must_use]
    pub fn known(&self, names: &[String], axes: &[Axis], spec: &Spec) -> Option<Known<'_>> {
        let columns = names.iter().map(|name| self.columns.get(name.as_str()).map(Vec::as_slice));
        let known = Known { columns: columns.collect::<Option<_>>()?, cells: self.instances(axes, spec) };
        known.cells.iter().any(Option::is_some).then_some(known)
    }

    /// For each cell of the grid of `axes` the instance of the run that stands there, of the sweep `spec`; `None` where the run has
    /// computed none.
    fn instances(&self, axes: &[Axis], spec: &Spec) -> Vec<Option<usize>> {
        let mut cells = vec![Some(0)];
        for axis in axes {
            let own = self.axes.iter().find(|own| own.key == axis.key);
            let step = |value: &Value| match own {
                Some(own) => own.find(value).map(|place| place * own.stride),
                None => is_value_of(spec, axis.key, value).then_some(0),
            };
            let steps: Vec<Option<usize>> = axis.values.iter().map(step).collect();
            let next = |cell: &Option<usize>| {
                let cell = *cell;
                steps.iter().map(move |step| Some(cell? + (*step)?)).collect::<Vec<_>>()
            };
            cells = cells.iter().flat_map(next).collect();
        }
        let all = self.axes.iter().all(|own| axes.iter().any(|axis| axis.key == own.key));
        cells.into_iter().map(|cell| cell.filter(|instance| all && self.is_computed[*instance])).collect()
    }
}

/// Whether a sweep has this value of what it does not vary.
fn is_value_of(spec: &Spec, key: AxisKey, value: &Value) -> bool {
    match (key, value) {
        (AxisKey::Param(param), Value::Number(number)) => {
            spec.base.get(param).is_some_and(|own| (own - number).abs() <= SAME * own.abs().max(number.abs()))
        }
        (AxisKey::Law, Value::Text(text)) => spec.law.name() == text.as_str(),
        _ => false,
    }
}
