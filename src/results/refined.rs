//! The figure of a refined map, and `refine.json`: how the lines of a refined map were found, and what may be missed.

use serde_json::{Value as Json, json};

use crate::engine::computation::Computation;
use crate::engine::record::Record;
use crate::results::error::Result;
use crate::results::figure::map::MapFigure;
use crate::results::manifest::{Sum, counts, pretty, sums};
use crate::store::grid_json;
use crate::store::refinement::Refinement;
use crate::store::seal::sealed;
use crate::sweep::grid::{Axis, Grid};
use crate::sweep::refine::Refined;
use crate::sweep::sheet::Sheet;
use crate::sweep::spec::Starts;
use crate::version::{COMMIT, VERSION};

/// Labels that become records at a time.
const BLOCK: usize = 1 << 16;

/// The figure of all labels, which says how many of them were computed.
#[must_use]
pub fn figure<'a>(sheet: Sheet<'a>, refined: &Refined) -> MapFigure<'a> {
    let mut figure = MapFigure::new(sheet);
    if refined.computed < refined.labels.len() {
        figure = figure.of_computed(refined.tally.clone());
    }
    for (block, labels) in refined.labels.chunks(BLOCK).enumerate() {
        let records: Vec<Record> = labels.iter().map(|label| Record::from(*label)).collect();
        figure.add(block * BLOCK, &records);
    }
    figure
}

/// The parts that the results of a refinement are made from, and the files beside the document.
#[derive(Clone, Debug, Default)]
pub struct OfParts {
    /// Every part by its name with its checksum, in the order of use.
    pub parts: Vec<(String, String)>,
    /// Every file with its length and BLAKE3 checksum.
    pub files: Vec<(&'static str, Sum)>,
}

impl OfParts {
    /// The parts that a document names; `None` where it names none.
    #[must_use]
    pub fn parts_in(document: &Json) -> Option<Vec<(String, String)>> {
        let part = |(name, sum): (&String, &Json)| Some((name.clone(), sum.as_str()?.to_owned()));
        document.get("parts")?.as_object()?.iter().map(part).collect()
    }
}

/// Whether a document is of a version that named neither files nor parts in it.
#[must_use]
pub fn is_without_sums(document: &Json) -> bool {
    let has = |key: &str| document.get(key).is_some();
    has("coarse_cells_per_side") && !["files", "parts", "checksum"].into_iter().any(has)
}

/// The document, with a checksum of its own.
///
/// # Errors
/// When a number cannot be written.
pub fn document(asked: &Refinement, refined: &Refined, of: &OfParts) -> Result<Vec<u8>> {
    let sheet = asked.description.sheet();
    let instances = refined.labels.len();
    let axes: &[Axis] = if let Grid::Axes(axes) = sheet.grid { axes } else { &[] };
    let name = |i: usize| axes[i].key.name();
    let [x, y] = refined.planes.axes;
    let planes: Vec<Json> = (0..refined.planes.count())
        .map(|plane| {
            let coordinates = sheet.grid.coordinates(refined.planes.at(plane, 0, 0));
            let others = (0..axes.len()).filter(|i| *i != x && *i != y);
            others.map(|i| (name(i).to_owned(), Json::from(coordinates[i].to_string()))).collect()
        })
        .collect();
    let engine = |computation: Option<&Computation>| computation.map(ToString::to_string);
    let mut document = json!({
        "program": { "version": VERSION, "git_commit": COMMIT },
        "title": sheet.title,
        "linear": engine(sheet.linear),
        "response": engine(sheet.response),
        "computation": { "linear": sheet.linear, "response": sheet.response },
        "analysis": { "linear": sheet.analysis.linear, "response": sheet.analysis.response },
        "both_starts": sheet.analysis.starts == Starts::Both,
        "grid": grid_json::to_json(sheet.grid),
        "x": name(x),
        "y": name(y),
        "planes": planes,
        "instances": instances,
        "computed": refined.computed,
        "share_computed": refined.computed as f64 / instances as f64,
        "counts": counts(sheet.analysis, &refined.tally),
    });
    let parts = of.parts.iter().map(|(name, sum)| (name.clone(), json!(sum))).collect::<Json>();
    if let (Json::Object(all), Json::Object(asked)) = (&mut document, asked.to_json()) {
        all.extend(asked);
    }
    document["sample"]["instances"] = json!(refined.sampled);
    document["sample"]["with_another_label"] = json!(refined.missed);
    document["sample"]["share_at_most_95_percent"] = json!(refined.missed_at_most());
    document["parts"] = parts;
    document["files"] = sums(&of.files);
    pretty(&document).map(sealed)
}
