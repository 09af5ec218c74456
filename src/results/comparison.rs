//! The files of a comparison of two maps: a table of every instance, a document with the sums, and a figure that shows where
//! they differ.

use serde_json::{Value as Json, json};

use crate::results::csv::Table;
use crate::results::error::Result;
use crate::results::figure::look::{Content, Look};
use crate::results::figure::map::look_svg;
use crate::results::manifest::described;
use crate::results::number::NumberColumn;
use crate::results::read::Archive;
use crate::results::read::compare::{Comparison, Differences, Labels, QUANTILES};
use crate::sweep::columns::Cell;

/// The labels of the figure, and the fill of each: what differs of an instance.
const DIFFER: [(&str, &str); 4] = [
    ("same labels", "#F2F2EE"),
    ("another type", "#56B4E9"),
    ("another regime", "#D98B2B"),
    ("both", "#3B1F5B"),
];
/// The columns whose differences the figure shows, as far as both maps have them.
const SHOWN: [&str; 2] = ["growth_rate", "x2_std"];
/// The difference that values equal to the last bit have in the figure, which draws its logarithm.
const LEAST: f64 = 1e-16;

/// The table: a row per instance with its swept values, both of each label, and the relative difference of each number.
///
/// # Errors
/// When it cannot be written.
pub fn table(archive: &Archive, found: &Comparison) -> Result<Vec<u8>> {
    let grid = &archive.map.spec.grid;
    let swept = grid.keys().into_iter().map(|key| key.name().to_owned());
    let labels = found.labels.iter().flat_map(|labels| [1, 2].map(|side| format!("{}_{side}", labels.name)));
    let numbers = found.columns.iter().map(|column| format!("{}_difference", column.name));
    let header: Vec<String> =
        std::iter::once("instance".to_owned()).chain(swept).chain(labels).chain(numbers).collect();
    let mut table = Table::new(header.iter().map(String::as_str))?;
    for instance in 0..grid.len() {
        let swept = grid.coordinates(instance).into_iter().map(|value| Cell::from(value).to_string());
        let labels = found.labels.iter().flat_map(|labels| labels.pairs[instance].unwrap_or_default());
        let numbers = found.columns.iter().map(|column| Cell::from(column.relative[instance]).to_string());
        let cells = swept.chain(labels.map(str::to_owned)).chain(numbers);
        table.row(std::iter::once(instance.to_string()).chain(cells))?;
    }
    table.finish()
}

/// The document: how many instances differ in which label and how, and the quantiles of the differences.
///
/// # Errors
/// When it cannot be written.
pub fn document(directories: [&str; 2], found: &Comparison) -> Result<Vec<u8>> {
    let change = |([from, to], count): &([&str; 2], usize)| json!({ "from": from, "to": to, "count": count });
    let label = |labels: &Labels| {
        let changes = labels.changes();
        let differ: usize = changes.iter().map(|(_, count)| count).sum();
        let changes: Vec<Json> = changes.iter().map(change).collect();
        (labels.name.to_owned(), json!({ "differ": differ, "changes": changes }))
    };
    let column = |column: &Differences| {
        let [compared, equal] = column.compared();
        let quantile = |(share, value): (f64, f64)| (share.to_string(), json!(value));
        let quantiles = column.quantiles().into_iter().flat_map(|found| QUANTILES.into_iter().zip(found));
        let entry = json!({
            "compared": compared,
            "equal": equal,
            "in_the_first_alone": column.alone[0],
            "in_the_second_alone": column.alone[1],
            "quantiles": quantiles.map(quantile).collect::<serde_json::Map<_, _>>(),
        });
        (column.name.clone(), entry)
    };
    described(&json!({
        "first": directories[0],
        "second": directories[1],
        "instances": found.computed[1],
        "computed_in_both": found.computed[0],
        "labels": found.labels.iter().map(label).collect::<serde_json::Map<_, _>>(),
        "relative_differences": found.columns.iter().map(column).collect::<serde_json::Map<_, _>>(),
    }))
}

/// The figure: where types and regimes differ, and by how much growth and amplitude.
///
/// # Errors
/// When an instance was never computed, and not because a run was stopped.
pub fn figure(archive: &Archive, found: &Comparison) -> Result<String> {
    let column = |name: &str, values: Vec<Option<f64>>| NumberColumn {
        name: name.to_owned(),
        unit: String::new(),
        meaning: String::new(),
        values,
    };
    let differs = |name: &str, instance: usize| {
        found.labels.iter().any(|labels| labels.name == name && labels.differs(instance))
    };
    let total = archive.map.spec.grid.len();
    let computed = |instance: usize| found.labels.iter().any(|labels| labels.pairs[instance].is_some());
    let class = |instance: usize| {
        let [kind, regime] = ["type", "regime"].map(|name| u8::from(differs(name, instance)));
        computed(instance).then(|| f64::from(kind + 2 * regime))
    };
    let classes = column("labels", (0..total).map(class).collect());
    let shown = SHOWN.into_iter().filter_map(|name| found.columns.iter().find(|column| column.name == name));
    // Where all are equal there is nothing to see.
    let shown = shown.filter(|column| column.compared()[0] > column.compared()[1]);
    let logarithms: Vec<NumberColumn> = shown
        .map(|differences| {
            let of = |value: &Option<f64>| value.map(|value| value.max(LEAST).log10());
            let name = format!("log10_of_the_relative_difference_of_{}", differences.name);
            column(&name, differences.relative.iter().map(of).collect())
        })
        .collect();
    let mut contents =
        vec![Content::Named { column: &classes, heading: "Labels that differ", names: &DIFFER }];
    contents.extend(logarithms.iter().map(Content::quantity));
    look_svg(&archive.map, &Look { contents, ..Look::default() })
}
