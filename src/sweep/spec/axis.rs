//! One axis: `{ from, to, points, scale }` or `{ values }`.

use std::ops::Range;

use toml::de::DeTable;

use crate::model::Param;
use crate::sweep::error::{Error, Result};
use crate::sweep::grid::{Axis, AxisKey, Value, spaced};
use crate::sweep::spec::MAX_VALUES;
use crate::sweep::spec::document::{
    Node, array, choice, entries, integer, number, out_of_range_at, string, table,
};
use crate::sweep::spec::names::unknown;
use crate::sweep::spec::sections::law_value;
use squealmap_input::place::Source;

const EXPECTED: &str = "a table { from, to, points } or { values = [...] }";

/// Reads an axis with the place of each of its values (one for all of `{ from, to, points }`); `admit` hears their number before they are made.
pub(super) fn axis(
    source: &Source,
    key: AxisKey,
    node: &Node,
    admit: &mut dyn FnMut(usize) -> Result<()>,
) -> Result<(Axis, Vec<Range<usize>>)> {
    let name = key.name();
    let keys = table(source, node, &format!("axis `{name}`"), EXPECTED)?;
    let param = match key {
        AxisKey::Param(param) => Some(param),
        AxisKey::Law | AxisKey::Material => None,
    };
    let known: &[&str] = match param {
        Some(_) => &["from", "to", "points", "scale", "values"],
        None => &["values"],
    };
    for entry in entries(keys) {
        if !known.contains(&entry.key) {
            let within = format!("of axis `{name}`");
            return Err(unknown(source, entry.key_span(), "key", entry.key, &within, known));
        }
    }
    match (keys.get("values"), param) {
        (Some(values), _) => {
            if let Some(other) = entries(keys).into_iter().find(|entry| entry.key != "values") {
                let at = source.place(other.key_span());
                let key = format!("`{}` of axis `{name}`", other.key);
                return Err(Error::Conflict { at, key, other: "`values` of the same axis".to_owned() });
            }
            explicit(source, key, values, admit)
        }
        (None, Some(param)) => range(source, param, node.span(), keys, admit),
        (None, None) => Err(missing(source, node.span(), name, "values")),
    }
}

fn missing(source: &Source, span: Range<usize>, axis: &str, key: &'static str) -> Error {
    Error::Missing {
        at: source.place(span),
        key,
        needed_by: format!("axis `{axis}` does not say its values"),
        remedy: "write { from = …, to = …, points = … } or { values = […] }".to_owned(),
    }
}

/// `{ values = [...] }`.
fn explicit(
    source: &Source,
    key: AxisKey,
    node: &Node,
    admit: &mut dyn FnMut(usize) -> Result<()>,
) -> Result<(Axis, Vec<Range<usize>>)> {
    let name = key.name();
    let nodes = array(source, node, &format!("`values` of axis `{name}`"), "an array")?;
    if nodes.is_empty() {
        let at = source.place(node.span());
        return Err(Error::Empty { at, what: format!("axis `{name}`"), least: "one value" });
    }
    admit(nodes.len())?;
    let mut values = Vec::with_capacity(nodes.len());
    let mut spans = Vec::with_capacity(nodes.len());
    for (index, node) in nodes.iter().enumerate() {
        let label = format!("value {} of axis `{name}`", index + 1);
        values.push(match key {
            AxisKey::Param(param) => Value::Number(number(source, node, &label, param.info().range)?),
            AxisKey::Law => {
                let law = string(source, node, &label, "the name of a friction law, as a string")?;
                law_value(source, node.span(), law, &format!("as {label}"))?;
                Value::Text(law.to_owned().into())
            }
            AxisKey::Material => Value::Text(
                string(source, node, &label, "the path of a file, as a string")?.to_owned().into(),
            ),
        });
        spans.push(node.span());
    }
    Ok((Axis { key, values, log: false }, spans))
}

/// `{ from, to, points, scale }`.
fn range(
    source: &Source,
    param: Param,
    span: Range<usize>,
    keys: &DeTable,
    admit: &mut dyn FnMut(usize) -> Result<()>,
) -> Result<(Axis, Vec<Range<usize>>)> {
    let name = param.info().name;
    let get = |key: &'static str| keys.get(key).ok_or_else(|| missing(source, span.clone(), name, key));
    let label = |key: &str| format!("`{key}` of axis `{name}`");
    let (from_node, to_node) = (get("from")?, get("to")?);
    let from = number(source, from_node, &label("from"), param.info().range)?;
    let to = number(source, to_node, &label("to"), param.info().range)?;
    let points = integer(source, get("points")?, &label("points"), 1, MAX_VALUES)?;
    let log = match keys.get("scale") {
        None => false,
        Some(scale) => choice(source, scale, &label("scale"), "scale", &[("linear", false), ("log", true)])?,
    };
    let at = [from_node.span(), to_node.span()];
    spaced_axis(source, param, &Ends { from, to, points, log, whole: span, at }, admit)
}

/// The ends of an axis with the number of its points and its scale, and where they stand.
pub(super) struct Ends {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) points: usize,
    pub(super) log: bool,
    /// Where the axis stands.
    pub(super) whole: Range<usize>,
    /// Where `from` and `to` stand.
    pub(super) at: [Range<usize>; 2],
}

/// The axis between ends that are legal by themselves.
pub(super) fn spaced_axis(
    source: &Source,
    param: Param,
    ends: &Ends,
    admit: &mut dyn FnMut(usize) -> Result<()>,
) -> Result<(Axis, Vec<Range<usize>>)> {
    let name = param.info().name;
    let label = |key: &str| format!("`{key}` of axis `{name}`");
    let &Ends { from, to, points, log, .. } = ends;
    let [from_at, to_at] = &ends.at;
    if log {
        for (key, value, at) in [("from", from, from_at), ("to", to, to_at)] {
            if value <= 0.0 {
                let limit = "greater than 0 for scale = \"log\"";
                return Err(out_of_range_at(source, at.clone(), &label(key), limit));
            }
        }
    }
    #[expect(clippy::float_cmp, reason = "the ends are compared as the user wrote them")]
    let equal = from == to;
    if equal != (points == 1) {
        let remedy = if equal { "give 1 point or different ends" } else { "give 2 points or more" };
        let at = source.place(ends.whole.clone());
        return Err(Error::AxisEnds { at, axis: name, points, from, to, remedy });
    }
    if !(to - from).is_finite() {
        let limit = "a finite distance away from `from`";
        return Err(out_of_range_at(source, to_at.clone(), &label("to"), limit));
    }
    admit(points)?;
    let values = (0..points).map(|index| Value::Number(spaced([from, to], points, log, index))).collect();
    Ok((Axis { key: AxisKey::Param(param), values, log }, vec![ends.whole.clone()]))
}
