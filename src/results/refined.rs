//! The figure of a refined map, and `refine.json`: how the lines of a refined map were found, and what may be missed.

use serde::{Deserialize, Serialize};
use serde_json::{Map as Object, Value as Json};

use crate::engine::computation::Computation;
use crate::engine::record::Record;
use crate::results::error::Result;
use crate::results::figure::map::MapFigure;
use crate::results::manifest::{Program, Sum, Sums, counts, pretty};
use crate::store::grid_json;
use crate::store::refinement::Refinement;
use crate::store::seal::sealed;
use crate::sweep::grid::{Axis, Grid};
use crate::sweep::refine::Refined;
use crate::sweep::sheet::Sheet;
use crate::sweep::spec::Starts;
use crate::sweep::spec::refine::Settings;

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

/// The document, which is written and read; [`Refinement`] reads how the lines were followed, and of which sweep.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(default)]
pub(crate) struct Document {
    program: Program,
    /// Title of the sweep; may be empty.
    pub(crate) title: String,
    /// The engines in words.
    linear: Option<String>,
    response: Option<String>,
    /// Where and how the analyses were computed.
    pub(crate) computation: OfAnalyses<Option<Computation>>,
    /// Which were asked for.
    pub(crate) analysis: OfAnalyses<bool>,
    /// Whether every instance has a small and a large start.
    pub(crate) both_starts: bool,
    /// The grid, see [`grid_json`].
    pub(crate) grid: Json,
    /// The axes of a plane.
    x: String,
    y: String,
    /// The values of the other axes, plane by plane.
    planes: Vec<Object<String, Json>>,
    instances: usize,
    computed: usize,
    share_computed: f64,
    counts: Json,
    coarse_cells_per_side: usize,
    sample: Sample,
    /// The sweep, to be refined again.
    sweep: Json,
    /// Every part with its checksum, in the order of use.
    parts: Object<String, Json>,
    files: Sums,
}

/// Something of each of the analyses.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(default)]
pub(crate) struct OfAnalyses<T> {
    pub(crate) linear: T,
    pub(crate) response: T,
}

/// What the drawn instances showed.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
#[serde(default)]
struct Sample {
    seed: u64,
    asked_for: usize,
    instances: usize,
    with_another_label: usize,
    share_at_most_95_percent: Option<f64>,
}

/// The document, with a checksum of its own.
///
/// # Errors
/// When a number cannot be written.
pub fn document(asked: &Refinement, refined: &Refined, of: &OfParts) -> Result<Vec<u8>> {
    let sheet = asked.description.sheet();
    let instances = refined.labels.len();
    let axes: &[Axis] = if let Grid::Axes(axes) = sheet.grid { axes } else { &[] };
    let name = |i: usize| axes[i].key.name().to_owned();
    let [x, y] = refined.planes.axes;
    let plane = |plane: usize| {
        let coordinates = sheet.grid.coordinates(refined.planes.at(plane, 0, 0));
        let others = (0..axes.len()).filter(|i| *i != x && *i != y);
        others.map(|i| (name(i), Json::from(coordinates[i].to_string()))).collect()
    };
    let engine = |computation: Option<&Computation>| computation.map(ToString::to_string);
    let Settings { coarse, sample, seed } = asked.settings;
    let document = Document {
        // The name of the program was never written here.
        program: Program { name: String::new(), ..Program::this() },
        title: sheet.title.to_owned(),
        linear: engine(sheet.linear),
        response: engine(sheet.response),
        computation: OfAnalyses { linear: sheet.linear.cloned(), response: sheet.response.cloned() },
        analysis: OfAnalyses { linear: sheet.analysis.linear, response: sheet.analysis.response },
        both_starts: sheet.analysis.starts == Starts::Both,
        grid: grid_json::to_json(sheet.grid),
        x: name(x),
        y: name(y),
        planes: (0..refined.planes.count()).map(plane).collect(),
        instances,
        computed: refined.computed,
        share_computed: refined.computed as f64 / instances as f64,
        counts: counts(sheet.analysis, &refined.tally),
        coarse_cells_per_side: coarse,
        sample: Sample {
            seed,
            asked_for: sample,
            instances: refined.sampled,
            with_another_label: refined.missed,
            share_at_most_95_percent: refined.missed_at_most(),
        },
        sweep: asked.description.to_json(),
        parts: of.parts.iter().map(|(name, sum)| (name.clone(), sum.as_str().into())).collect(),
        files: of.files.iter().cloned().collect(),
    };
    pretty(&document).map(sealed)
}
