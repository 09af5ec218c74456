//! The figure of a refined map, and `refine.json`: how the lines of a refined map were found, and what may be missed.

use serde_json::{Value as Json, json};

use super::figure::MapFigure;
use super::manifest::{COMMIT, VERSION};
use super::sheet::Sheet;
use crate::error::{Error, Result};
use crate::grid::{Axis, Grid};
use crate::map::{Computation, Record};
use crate::refine::{Refined, Settings};
use crate::spec::Starts;
use crate::store::grid_json;

/// Labels that become records at a time.
const BLOCK: usize = 1 << 16;

/// The figure of all labels.
#[must_use]
pub fn figure<'a>(sheet: Sheet<'a>, refined: &Refined) -> MapFigure<'a> {
    let mut figure = MapFigure::new(sheet);
    for (block, labels) in refined.labels.chunks(BLOCK).enumerate() {
        let records: Vec<Record> = labels.iter().map(|label| Record::from(*label)).collect();
        figure.add(block * BLOCK, &records);
    }
    figure
}

/// The document.
///
/// # Errors
/// When a number cannot be written.
pub fn document(sheet: Sheet, refined: &Refined, settings: Settings) -> Result<Vec<u8>> {
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
    let document = json!({
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
        "coarse_cells_per_side": settings.coarse,
        "sample": {
            "seed": settings.seed,
            "asked_for": settings.sample,
            "instances": refined.sampled,
            "with_another_label": refined.missed,
            "share_at_most_95_percent": refined.missed_at_most(),
        },
    });
    let mut bytes = serde_json::to_vec_pretty(&document).map_err(Error::WriteManifest)?;
    bytes.push(b'\n');
    Ok(bytes)
}
