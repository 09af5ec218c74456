//! Every key of a sweep file: its section, unit, meaning, default and range. What is numeric comes from [`PARAMS`]; the others
//! have their rows here.

use crate::model::friction::LawKind;
use crate::model::motion::Motion;
use crate::model::{PARAMS, Param, ParamInfo};
use crate::sweep::error::{Error, Result};
use crate::sweep::spec::duration::LONGEST;
use crate::sweep::spec::names::advice;
use crate::sweep::spec::refine::{COARSE, Settings};
use crate::sweep::spec::start::{AMPLITUDES, BOX_SAMPLES, Kind, SAMPLES_RANGE};
use crate::sweep::spec::{MEASURE, SETTLE, SETTLE_LIMIT, STEPS_PER_PERIOD, law, model};
use squealmap_input::place::Place;
use squealmap_input::quote::list;

/// The section of what varies, which has no keys of its own.
const AXES: &str = "axes";

/// Fewest and most steps per period that may be asked for.
pub(super) const STEPS_RANGE: (usize, usize) = (3, 100_000);

/// A key of a sweep file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Key {
    /// Its section; empty at the top of the file.
    pub section: &'static str,
    /// Its name, the same in axes and tables.
    pub name: &'static str,
    /// The SI unit; empty where it has none.
    pub unit: &'static str,
    /// What it means, in a few words.
    pub meaning: &'static str,
    /// The value where it is omitted, as it is written; `None` where there is none.
    pub default: Option<String>,
    /// What it may be.
    pub range: String,
    /// What reads it; empty where every sweep does.
    pub read_by: String,
    /// Whether an axis or a column of `points` may vary it.
    pub varies: bool,
}

/// The sections in the order of the pages on them, with what they are about; the first is the top of the file.
pub const SECTIONS: [(&str, &str); 8] = [
    ("", "the top of the file, before any section"),
    ("model", "masses, springs, dampers and the geometry of the contact"),
    ("friction", "the friction law and its parameters"),
    ("belt", "the velocity of the belt"),
    (AXES, "what varies"),
    ("start", "where the motion starts"),
    ("response", "how long the motion is followed, and how finely"),
    ("refine", "only the lines of a map are computed"),
];

/// A key with a value that is no number of the model.
struct Row {
    section: &'static str,
    name: &'static str,
    meaning: &'static str,
    default: fn() -> Option<String>,
    range: fn() -> String,
    read_by: &'static str,
    varies: bool,
}

const ROWS: &[Row] = &[
    Row {
        section: "",
        name: "title",
        meaning: "title of the figure and the manifest",
        default: || Some("\"\"".to_owned()),
        range: || "one line of text".to_owned(),
        read_by: "",
        varies: false,
    },
    Row {
        section: "",
        name: "analysis",
        meaning: "what is computed: eigenvalues with the type of instability, and the motion that follows",
        default: || Some("[\"linear\", \"response\"]".to_owned()),
        range: || "an array of \"linear\" and \"response\"".to_owned(),
        read_by: "",
        varies: false,
    },
    Row {
        section: "",
        name: "points",
        meaning: "CSV file with one instance a row, instead of [axes]",
        default: || None,
        range: || "a path, relative to the sweep file".to_owned(),
        read_by: "",
        varies: false,
    },
    Row {
        section: "model",
        name: "kind",
        meaning: "two masses on a belt, or a few modes of any structure, of which only eigenvalues are computed",
        default: || Some("\"two_mass\"".to_owned()),
        range: || quoted(&model::Kind::ALL.map(|(name, _)| name)),
        read_by: "",
        varies: false,
    },
    Row {
        section: "model",
        name: "modes",
        meaning: "file of modes that `squealmap fem` writes; `f_ext` is its load where it is left out",
        default: || None,
        range: || "a path, relative to the sweep file".to_owned(),
        read_by: "kind `modal`",
        varies: false,
    },
    Row {
        section: "model",
        name: "impact_friction",
        meaning: "whether friction acts while the contact closes again after a detachment",
        default: || Some("true".to_owned()),
        range: || "true or false".to_owned(),
        read_by: "kind `two_mass`",
        varies: false,
    },
    Row {
        section: "friction",
        name: "law",
        meaning: "friction coefficient against relative velocity",
        default: || Some("\"bilinear\"".to_owned()),
        range: || quoted(&law::names()),
        read_by: "",
        varies: true,
    },
    Row {
        section: "friction",
        name: "table",
        meaning: "CSV file with columns velocity (m/s) and mu, straight between rows",
        default: || None,
        range: || "a path, relative to the sweep file".to_owned(),
        read_by: "law `table`",
        varies: false,
    },
    Row {
        section: "friction",
        name: "material",
        meaning: "CSV file with a column temperature (°C) and parameters of the law, or for law `table` with velocity (m/s) and mu, straight between rows",
        default: || None,
        range: || "a path, relative to the sweep file".to_owned(),
        read_by: "",
        varies: true,
    },
    Row {
        section: "friction",
        name: "outside",
        meaning: "what a temperature beyond the rows of the material is: an error, or the nearest row",
        default: || Some("\"error\"".to_owned()),
        range: || quoted(&["error", "clamp"]),
        read_by: "a `material`",
        varies: false,
    },
    Row {
        section: "belt",
        name: "motion",
        meaning: "how the velocity goes: a ramp (constant without an end), half a sine wave or a trapeze from rest to rest, or as a table has it",
        default: || Some("\"ramp\"".to_owned()),
        range: || quoted(&Motion::NAMES),
        read_by: "kind `two_mass`",
        varies: false,
    },
    Row {
        section: "belt",
        name: "motion_table",
        meaning: "CSV file with columns time (s), velocity (m/s) and perhaps temperature (°C), straight between rows; its largest velocity is `belt_velocity`",
        default: || None,
        range: || "a path, relative to the sweep file".to_owned(),
        read_by: "motion `table`",
        varies: false,
    },
    Row {
        section: "start",
        name: "kind",
        meaning: "a kick of the sliding equilibrium, its most unstable mode, a kick and a large start, or many starts from a box",
        default: || Some("\"kick\"".to_owned()),
        range: || quoted(&Kind::ALL.map(|(name, _)| name)),
        read_by: "",
        varies: false,
    },
    Row {
        section: "start",
        name: "box_samples",
        meaning: "starts drawn from the box",
        default: || Some(BOX_SAMPLES.to_string()),
        range: || whole(SAMPLES_RANGE),
        read_by: "kind `box`",
        varies: false,
    },
    Row {
        section: "response",
        name: "settle",
        meaning: "time before the measuring window; \"auto\" goes on until windows agree, \"cycle\" until a limit cycle is found by shooting",
        default: || Some(format!("\"{SETTLE}\"; 0 with a ramp")),
        range: || {
            format!(
                "\"auto\", \"cycle\", or a time from 0 to {LONGEST:e}, such as \"6 s\" or \"200 periods\""
            )
        },
        read_by: "",
        varies: false,
    },
    Row {
        section: "response",
        name: "settle_limit",
        meaning: "longest time to settle",
        default: || Some(format!("\"{SETTLE_LIMIT}\"")),
        range: time,
        read_by: "settle `auto`, `cycle`",
        varies: false,
    },
    Row {
        section: "response",
        name: "measure",
        meaning: "length of the measuring window",
        default: || Some(format!("\"{MEASURE}\"; the ramp with a ramp")),
        range: time,
        read_by: "",
        varies: false,
    },
    Row {
        section: "response",
        name: "steps_per_period",
        meaning: "steps of integration per period 2π/ω0 of the instance, at least",
        default: || Some(STEPS_PER_PERIOD.to_string()),
        range: || whole(STEPS_RANGE),
        read_by: "",
        varies: false,
    },
    Row {
        section: "response",
        name: "check",
        meaning: "whether a few instances are computed again to measure the error of the others",
        default: || Some("true".to_owned()),
        range: || "true or false".to_owned(),
        read_by: "",
        varies: false,
    },
    Row {
        section: "refine",
        name: "coarse",
        meaning: "cells along each side of a map to begin with; a region smaller than one of them may be missed",
        default: || Some(Settings::default().coarse.to_string()),
        range: || whole(COARSE),
        read_by: "",
        varies: false,
    },
    Row {
        section: "refine",
        name: "sample",
        meaning: "instances drawn among those that no line asks for, to see what is missed",
        default: || Some(Settings::default().sample.to_string()),
        range: || "a whole number from 0 on".to_owned(),
        read_by: "",
        varies: false,
    },
    Row {
        section: "refine",
        name: "seed",
        meaning: "seed of that drawing",
        default: || Some(Settings::default().seed.to_string()),
        range: || "a whole number from 0 on".to_owned(),
        read_by: "",
        varies: false,
    },
];

/// Every key, section by section in the order of [`SECTIONS`].
#[must_use]
pub fn all() -> Vec<Key> {
    SECTIONS.iter().flat_map(|(section, _)| of_section(section)).collect()
}

/// The keys of a section, by its name.
fn of_section(section: &str) -> impl Iterator<Item = Key> {
    let rows = ROWS.iter().filter(move |row| row.section == section).map(|row| Key {
        section: row.section,
        name: row.name,
        unit: "",
        meaning: row.meaning,
        default: (row.default)(),
        range: (row.range)(),
        read_by: row.read_by.to_owned(),
        varies: row.varies,
    });
    rows.chain(PARAMS.iter().filter(move |row| row.section.name() == section).map(Key::from))
}

impl From<&ParamInfo> for Key {
    fn from(row: &ParamInfo) -> Key {
        Key {
            section: row.section.name(),
            name: row.name,
            unit: row.unit,
            meaning: row.meaning,
            default: row.default.map(|value| value.to_string()),
            range: row.range.to_string(),
            read_by: readers(row.param),
            varies: true,
        }
    }
}

/// What reads a parameter of the model.
fn readers(param: Param) -> String {
    let named = |what: &str, names: &[&str]| {
        let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
        format!("{what} {}", list(&names.iter().map(String::as_str).collect::<Vec<_>>()))
    };
    if LawKind::params().any(|one| one == param) {
        return named("law", &law::users(param));
    }
    if AMPLITUDES.contains(&param) {
        let kinds = Kind::ALL.iter().filter(|(_, kind)| kind.reader(param, false).is_none());
        return named("kind", &kinds.map(|(name, _)| *name).collect::<Vec<_>>());
    }
    if Param::TEMPERATURES.contains(&param) {
        return "a `material`".to_owned();
    }
    if let Some(model) = model::Kind::only_reader(param) {
        let name = model::Kind::ALL.iter().find(|(_, one)| *one == model).map(|(name, _)| *name);
        return named("kind", &Vec::from_iter(name));
    }
    String::new()
}

/// The keys that `name` stands for: a key, `section.key`, or a section with all its keys. `axes` stands for all keys that
/// may vary.
///
/// # Errors
/// When there is no such key or section; the sentence names the nearest.
pub fn named(name: &str) -> Result<Vec<Key>> {
    let all = all();
    let wanted = name.trim().trim_start_matches('[').trim_end_matches(']');
    let is = |key: &Key| match wanted.split_once('.') {
        Some((section, name)) => key.section == section && key.name == name,
        None => key.name == wanted || (wanted == AXES && key.varies),
    };
    let found: Vec<Key> = all.iter().filter(|key| is(key)).cloned().collect();
    let found = if found.is_empty() && !wanted.is_empty() { of_section(wanted).collect() } else { found };
    if !found.is_empty() {
        return Ok(found);
    }
    let names = all.iter().map(|key| key.name).chain(SECTIONS.iter().map(|(name, _)| *name));
    let names: Vec<&str> = names.filter(|name| !name.is_empty()).collect();
    Err(Error::Unknown {
        at: Place::argument("keys", name, 0..name.len()),
        what: "key",
        name: name.to_owned(),
        within: "of a sweep file".to_owned(),
        advice: advice(wanted, &names),
    })
}

/// The names of the keys of a section.
pub(super) fn names_of(section: &str) -> Vec<&'static str> {
    of_section(section).map(|key| key.name).collect()
}

/// What may stand at the top of a file: keys and sections.
pub(super) fn top_level() -> Vec<&'static str> {
    let sections = SECTIONS.iter().map(|(name, _)| *name).filter(|name| !name.is_empty());
    names_of("").into_iter().chain(sections).collect()
}

/// The section that has a key, if one does.
pub(super) fn home(key: &str) -> Option<&'static str> {
    let row = ROWS.iter().find(|row| row.name == key && !row.section.is_empty()).map(|row| row.section);
    row.or_else(|| Param::from_name(key).map(|param| param.info().section.name()))
}

/// Whether a key holds for the whole sweep.
pub(super) fn is_fixed(key: &str) -> bool {
    ROWS.iter().any(|row| row.name == key && !row.varies)
}

fn quoted(names: &[&str]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    let (last, rest) = names.split_last().expect("there are names to choose from");
    format!("{} or {last}", rest.join(", "))
}

fn whole((least, most): (usize, usize)) -> String {
    format!("a whole number from {least} to {most}")
}

fn time() -> String {
    format!("a time above 0 and at most {LONGEST:e}, such as \"6 s\" or \"200 periods\"")
}
