//! `manifest.json`: what was computed, by which program and engine, with which result, and what the columns mean.

use std::time::Duration;

use serde_json::{Map as Object, Value, json};

use crate::engine::regime::Regime;
use crate::model::kind::InstabilityType;
use crate::model::status::Status;
use crate::results::accounted::accounted;
use crate::results::columns::columns;
use crate::results::error::{Error, Result};
use crate::store::seal::sealed;
use crate::sweep::accuracy::frontier::Chosen;
use crate::sweep::label::{Label, Tally};
use crate::sweep::map::Map;
use crate::sweep::sheet::Sheet;
use crate::sweep::spec::{Analysis, Starts};
use crate::version::{COMMIT, VERSION};

/// The tiles that results are of, and the results beside the manifest.
#[derive(Clone, Debug)]
pub struct OfTiles {
    /// The identity of the sweep.
    pub sweep_id: String,
    /// The number of its tiles and the checksum of all ([`crate::store::directory::Fingerprint`]); `None` where some tiles
    /// are missing.
    pub checksum: Option<(usize, String)>,
    /// Every file with its length and BLAKE3 checksum.
    pub files: Vec<(&'static str, Sum)>,
}

/// Length and checksum of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sum {
    /// Bytes.
    pub bytes: u64,
    /// BLAKE3, hexadecimal.
    pub blake3: String,
}

impl Sum {
    /// The length and the checksum of some bytes.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Sum {
        Sum { bytes: bytes.len() as u64, blake3: blake3::hash(bytes).to_hex().to_string() }
    }

    /// The sum that a manifest states for a file; `None` where it states none.
    #[must_use]
    pub fn in_manifest(manifest: &Value, file: &str) -> Option<Sum> {
        let entry = manifest.get("files")?.get(file)?;
        Some(Sum { bytes: entry.get("bytes")?.as_u64()?, blake3: entry.get("blake3")?.as_str()?.to_owned() })
    }
}

/// The part of a manifest about the run: everything besides the sweep and its counts.
#[derive(Clone, Debug)]
pub struct Run {
    /// Worker threads.
    pub threads: usize,
    /// Wall time of the computation.
    pub elapsed: Duration,
    /// Instances that were computed in this time.
    pub computed: usize,
    /// Instances that were taken over from another sweep in this time, and the identity of that; `None` without one.
    pub reused: Option<(usize, String)>,
    /// Why some are missing; `None` when none is.
    pub stopped: Option<String>,
    /// The tiles that the results are of, where tiles are kept.
    pub tiles: Option<OfTiles>,
    /// The accuracy that was asked for and what was chosen for it, where one was.
    pub accuracy: Option<Chosen>,
}

impl Run {
    /// Whether these are the results of all instances with their checks, which a run that is stopped may not have come to:
    /// where tiles are kept, whether all are there.
    #[must_use]
    pub fn is_complete(&self, tally: &Tally) -> bool {
        let checked = match &self.tiles {
            Some(tiles) => tiles.checksum.is_some(),
            None => self.stopped.is_none(),
        };
        checked && tally.computed() == tally.total()
    }
}

/// The manifest of a map: UTF-8 JSON, indented.
///
/// # Errors
/// When an instance was never computed, and not because the run was stopped.
pub fn manifest_json(map: &Map) -> Result<Vec<u8>> {
    accounted(map)?;
    let run = Run {
        threads: map.provenance.threads,
        elapsed: map.provenance.elapsed,
        computed: map.computed(),
        reused: None,
        stopped: map.stopped.as_ref().map(ToString::to_string),
        tiles: None,
        accuracy: None,
    };
    manifest(Sheet::from(map), &map.spec.resolved(), &Tally::of(&map.records), &run)
}

/// The manifest of a sweep from its resolved form and its counts: UTF-8 JSON, indented.
///
/// # Errors
/// When it cannot be written as JSON.
pub fn manifest(sheet: Sheet, resolved: &Value, tally: &Tally, run: &Run) -> Result<Vec<u8>> {
    let seconds = run.elapsed.as_secs_f64();
    let complete = run.is_complete(tally);
    let columns: Vec<Value> = columns(sheet.grid, sheet.analysis)
        .iter()
        .map(|column| json!({ "name": column.name, "unit": column.unit, "meaning": column.meaning }))
        .collect();
    let mut manifest = json!({
        "title": sheet.title,
        "program": { "name": env!("CARGO_PKG_NAME"), "version": VERSION, "git_commit": COMMIT },
        "complete": complete,
        "computation": {
            "linear": sheet.linear,
            "response": sheet.response,
            "threads": run.threads,
            "instances": tally.total(),
            "computed": tally.computed(),
            "stopped": run.stopped.as_ref().filter(|_| !complete),
            "elapsed_seconds": seconds,
            "instances_per_second": (seconds > 0.0).then(|| run.computed as f64 / seconds),
        },
        "counts": counts(sheet.analysis, tally),
        "energy_gaining_impacts": tally.energy_gaining_impacts(),
        "spec": resolved,
        "columns": columns,
    });
    if sheet.analysis.checks() {
        manifest["checks"] = tally.checks().to_json();
    }
    if let Some(accuracy) = &run.accuracy {
        manifest["computation"]["accuracy"] = json!(accuracy);
    }
    if let Some((instances, from)) = &run.reused {
        manifest["computation"]["reused"] = json!({ "instances": instances, "from_sweep": from });
    }
    if let Some(OfTiles { sweep_id, checksum, files }) = &run.tiles {
        manifest["sweep_id"] = json!(sweep_id);
        manifest["tiles"] =
            json!(checksum.as_ref().map(|(count, sum)| json!({ "count": count, "blake3": sum })));
        manifest["files"] = sums(files);
    }
    pretty(&manifest).map(sealed)
}

/// The entry of a manifest about files, which [`Sum::in_manifest`] reads.
pub(crate) fn sums(files: &[(&'static str, Sum)]) -> Value {
    let sum =
        |(name, sum): &(&str, Sum)| ((*name).to_owned(), json!({ "bytes": sum.bytes, "blake3": sum.blake3 }));
    files.iter().map(sum).collect()
}

/// The document beside a table: what its figure needs besides, and the program that wrote both. UTF-8 JSON, indented.
pub(crate) fn described(entries: &Value) -> Result<Vec<u8>> {
    let mut document =
        json!({ "program": { "name": env!("CARGO_PKG_NAME"), "version": VERSION, "git_commit": COMMIT } });
    if let (Value::Object(all), Value::Object(entries)) = (&mut document, entries) {
        all.extend(entries.clone());
    }
    pretty(&document)
}

/// A document as bytes, indented.
pub(crate) fn pretty(document: &Value) -> Result<Vec<u8>> {
    let mut bytes = serde_json::to_vec_pretty(document).map_err(Error::WriteManifest)?;
    bytes.push(b'\n');
    Ok(bytes)
}

/// How many instances have each type, regime and status; names that do not occur are left out.
pub(crate) fn counts(analysis: Analysis, tally: &Tally) -> Value {
    let count = |selects: &dyn Fn(Label) -> bool| tally.count(selects);
    let mut result = Object::new();
    if analysis.linear {
        let kinds = InstabilityType::ALL.map(|kind| (kind.name(), count(&|one| one.kind() == Some(kind))));
        result.insert("type".to_owned(), occurring(&kinds));
    }
    if analysis.response {
        let regimes = Regime::ALL.map(|regime| (regime.name(), count(&|one| one.regime() == Some(regime))));
        result.insert("regime".to_owned(), occurring(&regimes));
        result.insert("unsettled".to_owned(), json!(count(&|one| one.settled() == Some(false))));
    }
    if analysis.starts != Starts::One {
        let computed = |one: Label| one.status() != Status::NotComputed;
        let verdict = |wanted: Option<bool>| count(&|one| computed(one) && one.bistable() == wanted);
        let verdicts =
            json!({ "yes": verdict(Some(true)), "no": verdict(Some(false)), "no_verdict": verdict(None) });
        result.insert("bistable".to_owned(), verdicts);
    }
    let statuses = Status::IN_MAP.map(|status| (status.name(), count(&|one| one.status() == status)));
    result.insert("status".to_owned(), occurring(&statuses));
    Value::Object(result)
}

fn occurring(counts: &[(&str, usize)]) -> Value {
    counts.iter().filter(|(_, n)| *n > 0).map(|(name, n)| ((*name).to_owned(), json!(n))).collect()
}
