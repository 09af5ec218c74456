//! `manifest.json`: what was computed, by what, with which result, and what the columns mean.

use serde_json::{Map as Object, Value, json};

use super::accounted;
use super::columns::columns;
use crate::classify::{InstabilityType, Regime};
use crate::error::{Error, Result};
use crate::map::{Map, Record};
use crate::outcome::Status;

/// The crate's version.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The git commit the crate was built from, with `-dirty` when the checkout had changes; `None` outside a checkout.
pub const COMMIT: Option<&str> = option_env!("SQUEALMAP_COMMIT");

/// The manifest of a map: UTF-8 JSON, indented.
///
/// # Errors
/// When an instance was never computed, and not because the run was stopped.
pub fn manifest_json(map: &Map) -> Result<Vec<u8>> {
    accounted(map)?;
    let provenance = &map.provenance;
    let seconds = provenance.elapsed.as_secs_f64();
    let computed = map.computed();
    let gaining = map.records.iter().filter_map(|record| record.outcome?.energy_gaining_impacts);
    let columns: Vec<Value> = columns(&map.spec)
        .iter()
        .map(|column| json!({ "name": column.name, "unit": column.unit, "meaning": column.meaning }))
        .collect();
    let manifest = json!({
        "title": map.spec.title,
        "program": { "name": env!("CARGO_PKG_NAME"), "version": VERSION, "git_commit": COMMIT },
        "complete": map.stopped.is_none(),
        "computation": {
            "linear": provenance.linear,
            "response": provenance.response,
            "threads": provenance.threads,
            "instances": map.records.len(),
            "computed": computed,
            "stopped": map.stopped.as_ref().map(ToString::to_string),
            "elapsed_seconds": seconds,
            "instances_per_second": (seconds > 0.0).then(|| computed as f64 / seconds),
        },
        "counts": counts(map),
        "energy_gaining_impacts": gaining.reduce(|a, b| a + b),
        "spec": map.spec.resolved(),
        "columns": columns,
    });
    let mut bytes = serde_json::to_vec_pretty(&manifest).map_err(Error::WriteManifest)?;
    bytes.push(b'\n');
    Ok(bytes)
}

/// How many instances have each type, regime and status; names that do not occur are left out.
fn counts(map: &Map) -> Value {
    let mut result = Object::new();
    if map.spec.analysis.linear {
        let kinds = InstabilityType::ALL.map(|kind| (kind.name(), count(map, |r| r.kind == Some(kind))));
        result.insert("type".to_owned(), occurring(&kinds));
    }
    if map.spec.analysis.response {
        let regimes = Regime::ALL.map(|regime| (regime.name(), count(map, |r| r.regime == Some(regime))));
        result.insert("regime".to_owned(), occurring(&regimes));
        result.insert("unsettled".to_owned(), json!(count(map, |r| r.settled == Some(false))));
    }
    let statuses = Status::IN_MAP.map(|status| (status.name(), count(map, |r| r.status == status)));
    result.insert("status".to_owned(), occurring(&statuses));
    Value::Object(result)
}

fn count(map: &Map, selects: impl Fn(&Record) -> bool) -> usize {
    map.records.iter().filter(|record| selects(record)).count()
}

fn occurring(counts: &[(&str, usize)]) -> Value {
    counts.iter().filter(|(_, n)| *n > 0).map(|(name, n)| ((*name).to_owned(), json!(n))).collect()
}
