//! Every reader of the program against any bytes: an error is an answer, a panic, a hang or runaway memory is a finding.
//!
//! One program for all readers, as linking takes longer than most findings; `FUZZ_TARGET` names the reader.
#![no_main]

use std::io::{Cursor, Read};
use std::sync::{LazyLock, OnceLock};

use libfuzzer_sys::fuzz_target;
use serde_json::Value as Json;
use squealmap::engine::record::Record;
use squealmap::store::description::Description;
use squealmap::store::identity::Id;
use squealmap::store::tile::{Label, instances_in};
use squealmap::study::{Kind, Picture};
use squealmap::sweep::spec::{Analysis, Spec, Starts};
use squealmap_identify::{FrictionColumn, Settings, identify, read_points};
use tempfile::TempDir;

/// A reader and the bytes it is given.
type Target = fn(&[u8]);

/// The readers by name; `fuzz/run` takes the names from here.
const TARGETS: [(&str, Target); 8] = [
    ("tile", tile),
    ("description", description),
    ("results", results),
    ("sweep", sweep),
    ("points", points),
    ("table", table),
    ("material", material),
    ("signals", signals),
];

fuzz_target!(|bytes: &[u8]| {
    static TARGET: OnceLock<Target> = OnceLock::new();
    TARGET.get_or_init(|| {
        let name = std::env::var("FUZZ_TARGET").unwrap_or_default();
        let found = TARGETS.iter().find(|(target, _)| *target == name);
        found.expect("FUZZ_TARGET names a reader").1
    })(bytes);
});

/// A directory for the readers that open files; sweeps find nothing else in it.
static DIRECTORY: LazyLock<TempDir> =
    LazyLock::new(|| tempfile::tempdir().expect("a directory for a few files"));

/// A file in it.
fn put(name: &str, bytes: &[u8]) {
    std::fs::write(DIRECTORY.path().join(name), bytes).expect("a small file can be written");
}

/// The bytes as they are, and as the records of a tile that is whole otherwise.
fn tile(bytes: &[u8]) {
    let _ = instances_in(bytes);
    let (first, body) = bytes.split_at(bytes.len().min(1));
    let first = first.first().copied().unwrap_or(0);
    let starts = [Starts::One, Starts::Both, Starts::Box(3)][usize::from(first >> 5) % 3];
    let analysis = Analysis {
        linear: first & 1 != 0,
        response: first & 2 != 0,
        until_settled: first & 4 != 0,
        checked: first & 8 != 0,
        finds_cycles: first & 0x80 != 0,
        starts,
    };
    let label =
        |instances| Label { sweep: Id([7; 32]), kind: "cpu f64".to_owned(), analysis, bounds: 0..instances };
    let _ = label(2).read(bytes);
    let instances = usize::from(first >> 4 & 1) + 1;
    let mut whole = label(instances).write(&vec![Record::NOT_COMPUTED; instances]);
    let empty = label(0).write(&[]);
    // An empty tile is head, checksum and end.
    let sum = |content: &[u8]| *blake3::hash(content).as_bytes();
    let head =
        (0..empty.len() - 32).find(|at| empty[*at..*at + 32] == sum(&empty[..*at])).expect("a checksum");
    let foot = empty.len() - head;
    let end = whole.len() - foot;
    for (place, byte) in whole[head..end].iter_mut().zip(body) {
        *place = *byte;
    }
    let checksum = sum(&whole[..end]);
    whole[end..end + 32].copy_from_slice(&checksum);
    assert_eq!(instances_in(&whole), Some(instances));
    if let Ok(records) = label(instances).read(&whole) {
        assert_eq!(records.len(), instances);
    }
}

/// The bytes as they are, and with the id that their content has.
fn description(bytes: &[u8]) {
    let _ = Description::from_bytes(bytes);
    let Ok(mut document) = serde_json::from_slice::<Json>(bytes) else { return };
    let id = Id::of(&document["identity"]).to_string();
    let Some(entries) = document.as_object_mut() else { return };
    entries.insert("sweep_id".to_owned(), id.into());
    if let Ok(read) = Description::from_bytes(document.to_string().as_bytes()) {
        let back = Description::from_bytes(&read.to_bytes()).expect("what was read can be written");
        assert_eq!((back.id, back.grid, back.tiling), (read.id, read.grid, read.tiling));
    }
}

/// Where one file of a directory ends and the next begins.
const NEXT: &[u8] = b"\n=====\n";

/// A directory of results: the first byte says of which figure, the files follow in the order of its list.
fn results(bytes: &[u8]) {
    let Some((first, rest)) = bytes.split_first() else { return };
    let kind = Kind::ALL[usize::from(*first) % Kind::ALL.len()];
    let mut rest = rest;
    for name in kind.files() {
        let end = rest.windows(NEXT.len()).position(|part| part == NEXT);
        let (file, after) = end.map_or((rest, &[][..]), |end| (&rest[..end], &rest[end + NEXT.len()..]));
        put(name, file);
        rest = after;
    }
    let _ = Picture::read(DIRECTORY.path(), kind);
}

fn parsed(sweep: &str) {
    if let Ok(spec) = Spec::parse(sweep, "s.toml", DIRECTORY.path()) {
        let count = spec.grid.len();
        for index in [0, count / 2, count - 1] {
            let _ = spec.instance(index);
        }
        if count < 1000 {
            let _ = spec.resolved();
        }
    }
}

/// A sweep file in an empty directory.
fn sweep(bytes: &[u8]) {
    if let Ok(text) = std::str::from_utf8(bytes) {
        // Only names of the directory itself: what else the machine has is no part of the input.
        if !text.contains(['/', '\\']) {
            parsed(text);
        }
    }
}

fn points(bytes: &[u8]) {
    put("p.csv", bytes);
    parsed("points = \"p.csv\"\n[friction]\nmu_s = 0.4\nmu_d = 0.3\n[belt]\nbelt_velocity = 1\n");
    parsed("points = \"p.csv\"\n[friction]\nlaw = \"rational\"\n");
}

fn table(bytes: &[u8]) {
    put("t.csv", bytes);
    parsed("[friction]\nlaw = \"table\"\ntable = \"t.csv\"\n[belt]\nbelt_velocity = 1\n");
}

fn material(bytes: &[u8]) {
    put("m.csv", bytes);
    for law in ["constant", "bilinear", "exponential", "rational"] {
        parsed(&format!(
            "[friction]\nlaw = \"{law}\"\nmaterial = \"m.csv\"\ntemperature = 100\noutside = \"clamp\"\n[belt]\nbelt_velocity = 1\n"
        ));
    }
}

fn signals(bytes: &[u8]) {
    let input = || Box::new(Cursor::new(bytes.to_owned())) as Box<dyn Read>;
    for rate in [None, Some(1000.0)] {
        let settings = Settings { rate, ..Settings::default() };
        let _ = identify(|| Ok(input()), "x.csv", &settings, &mut |_, _| {});
    }
    // The names that WAV has.
    let mut settings = Settings::default();
    for (number, column) in settings.columns.iter_mut().enumerate().take(2) {
        *column = Some(format!("channel_{}", number + 1));
    }
    let _ = identify(|| Ok(input()), "x.wav", &settings, &mut |_, _| {});
    let _ = read_points(input(), "x.csv", &Settings::default(), &FrictionColumn::Forces, None);
    let named = FrictionColumn::Named("mu".to_owned());
    let _ = read_points(input(), "x.csv", &Settings::default(), &named, Some(20.0));
}
