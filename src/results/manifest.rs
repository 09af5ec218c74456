//! `manifest.json`: what was computed, by which program and engine, with which result, and what the columns mean.

use std::time::Duration;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::{Map as Object, Value, json};

use crate::engine::computation::Computation;
use crate::engine::regime::Regime;
use crate::model::kind::InstabilityType;
use crate::model::status::Status;
use crate::results::accounted::accounted;
use crate::results::error::{Error, Result};
use crate::store::seal::sealed;
use crate::sweep::accuracy::frontier::Chosen;
use crate::sweep::columns::{Column, columns};
use crate::sweep::label::{Label, Tally};
use crate::sweep::map::Map;
use crate::sweep::sheet::Sheet;
use crate::sweep::spec::{Analysis, Starts};
use crate::version::{COMMIT, VERSION};

/// The document.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(default)]
pub struct Manifest {
    /// Title of the sweep; may be empty.
    pub title: String,
    /// What wrote it.
    pub program: Program,
    /// Whether these are the results of all instances with their checks.
    pub complete: bool,
    /// Where, how and how far it was computed.
    pub computation: Computed,
    /// How many instances have which label, see `counts`.
    pub counts: Value,
    /// Impacts that gained energy, of all instances; only the reference counts them.
    pub energy_gaining_impacts: Option<u64>,
    /// The sweep as it was resolved.
    pub spec: Value,
    /// The columns of `map.csv`.
    pub columns: Vec<Explained>,
    /// What the checks found, where there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub checks: Option<Value>,
    /// The identity of the sweep, where tiles are kept.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sweep_id: Option<String>,
    /// The tiles, where they are kept; none where some are not there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tiles: Option<Option<Tiles>>,
    /// The files beside it, where tiles are kept.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub files: Option<Sums>,
    /// The checksum of all before it, which [`sealed`] writes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub checksum: Option<String>,
}

/// The program that wrote a document.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
#[serde(default)]
pub struct Program {
    /// Its name; not every document has it.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Its version.
    pub version: String,
    /// The commit that it was built of, where known.
    pub git_commit: Option<String>,
}

impl Program {
    /// This one.
    #[must_use]
    pub fn this() -> Program {
        let name = env!("CARGO_PKG_NAME").to_owned();
        Program { name, version: VERSION.to_owned(), git_commit: COMMIT.map(str::to_owned) }
    }

    /// The one that a document says it was written by.
    #[must_use]
    pub fn of(document: &Value) -> Program {
        Program::deserialize(&document["program"]).unwrap_or_default()
    }
}

impl std::fmt::Display for Program {
    /// Version, and commit where known.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {}", env!("CARGO_PKG_NAME"), self.version)?;
        self.git_commit.as_ref().map_or(Ok(()), |commit| write!(f, " ({commit})"))
    }
}

/// Where, how and how far a sweep was computed.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(default)]
pub struct Computed {
    /// The eigenvalue analysis, when asked for.
    pub linear: Option<Computation>,
    /// The response, when asked for.
    pub response: Option<Computation>,
    /// Worker threads.
    pub threads: usize,
    /// Instances of the sweep.
    pub instances: usize,
    /// Instances that were computed.
    pub computed: usize,
    /// Why some are missing; `None` when none is.
    pub stopped: Option<String>,
    /// Wall time, s.
    pub elapsed_seconds: f64,
    /// Instances that were computed in this time over this time, 1/s.
    pub instances_per_second: Option<f64>,
    /// The accuracy that was asked for and what was chosen for it, where one was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<Chosen>,
    /// What was taken over from another sweep, where something was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reused: Option<Reused>,
}

/// What was taken over from another sweep.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
#[serde(default)]
pub struct Reused {
    /// How many instances.
    pub instances: usize,
    /// The identity of that sweep.
    pub from_sweep: String,
}

/// What a column of `map.csv` says.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
#[serde(default)]
pub struct Explained {
    /// The header.
    pub name: String,
    /// The SI unit; empty when dimensionless or a name.
    pub unit: String,
    /// One line of explanation.
    pub meaning: String,
}

/// All tiles of a sweep.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
#[serde(default)]
pub struct Tiles {
    /// How many.
    pub count: usize,
    /// The checksum of all.
    pub blake3: String,
}

/// The tiles that results are of, and the results beside the manifest.
#[derive(Clone, Debug)]
pub struct OfTiles {
    /// The identity of the sweep.
    pub sweep_id: String,
    /// The number of its tiles and the checksum of all ([`crate::store::directory::Fingerprint`]); `None` where some tiles
    /// are missing.
    pub checksum: Option<(usize, String)>,
    /// Every file with its length and BLAKE3 checksum.
    pub files: Sums,
}

/// Length and checksum of a file.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, Serialize)]
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
        Sum::deserialize(manifest.get("files")?.get(file)?).ok()
    }
}

/// Files with their lengths and checksums, in the order in which they were written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sums(pub Vec<(String, Sum)>);

impl FromIterator<(&'static str, Sum)> for Sums {
    fn from_iter<I: IntoIterator<Item = (&'static str, Sum)>>(files: I) -> Sums {
        Sums(files.into_iter().map(|(name, sum)| (name.to_owned(), sum)).collect())
    }
}

impl Serialize for Sums {
    fn serialize<S: Serializer>(&self, out: S) -> std::result::Result<S::Ok, S::Error> {
        out.collect_map(self.0.iter().map(|(name, sum)| (name, sum)))
    }
}

impl<'de> Deserialize<'de> for Sums {
    fn deserialize<D: Deserializer<'de>>(from: D) -> std::result::Result<Sums, D::Error> {
        let sum = |(name, sum): (String, Value)| Ok((name, Sum::deserialize(sum).map_err(D::Error::custom)?));
        Object::deserialize(from)?.into_iter().map(sum).collect::<std::result::Result<_, _>>().map(Sums)
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
    let explained = |column: Column| Explained {
        name: column.name.to_owned(),
        unit: column.unit.to_owned(),
        meaning: column.meaning.to_owned(),
    };
    let computation = Computed {
        linear: sheet.linear.cloned(),
        response: sheet.response.cloned(),
        threads: run.threads,
        instances: tally.total(),
        computed: tally.computed(),
        stopped: run.stopped.clone().filter(|_| !complete),
        elapsed_seconds: seconds,
        instances_per_second: (seconds > 0.0).then(|| run.computed as f64 / seconds),
        accuracy: run.accuracy.clone(),
        reused: run.reused.clone().map(|(instances, from_sweep)| Reused { instances, from_sweep }),
    };
    let mut manifest = Manifest {
        title: sheet.title.to_owned(),
        program: Program::this(),
        complete,
        computation,
        counts: counts(sheet.analysis, tally),
        energy_gaining_impacts: tally.energy_gaining_impacts(),
        spec: resolved.clone(),
        columns: columns(sheet.grid, sheet.analysis).into_iter().map(explained).collect(),
        checks: sheet.analysis.checks().then(|| tally.checks().to_json()),
        ..Manifest::default()
    };
    if let Some(OfTiles { sweep_id, checksum, files }) = &run.tiles {
        manifest.sweep_id = Some(sweep_id.clone());
        manifest.tiles = Some(checksum.clone().map(|(count, blake3)| Tiles { count, blake3 }));
        manifest.files = Some(files.clone());
    }
    pretty(&manifest).map(sealed)
}

/// What a table does not say of its figure, with the program that wrote both: UTF-8 JSON, indented.
pub(crate) fn described(entries: &impl Serialize) -> Result<Vec<u8>> {
    #[derive(Serialize)]
    struct Described<'a, T> {
        program: Program,
        #[serde(flatten)]
        entries: &'a T,
    }
    pretty(&Described { program: Program::this(), entries })
}

/// A document as bytes, indented.
pub(crate) fn pretty(document: &impl Serialize) -> Result<Vec<u8>> {
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
