//! Tiles as bytes: what they hold, what they say of themselves, and what is refused.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::synthetic::{axis, failed, record, span, spec};
use squealmap::engine::backend::Backend;
use squealmap::engine::computation::Computation;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::record::{Basin, By, Check, Others, Record};
use squealmap::engine::reference::records::in_f64;
use squealmap::engine::regime::Regime;
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType;
use squealmap::model::linear::Linear;
use squealmap::model::status::Status;
use squealmap::store::columns::{decode, width};
use squealmap::store::description::{Description, Unread};
use squealmap::store::grid_json;
use squealmap::store::grid_json::{from_json, to_json};
use squealmap::store::identity::{Id, identity, kind};
use squealmap::store::tile::{Fault, Label};
use squealmap::store::tiling::Tiling;
use squealmap::sweep::grid::{Axis, AxisKey, Grid, Value};
use squealmap::sweep::spec::{Analysis, Spec, Starts};

const BOTH: Analysis = Analysis {
    linear: true,
    response: true,
    until_settled: false,
    finds_cycles: false,
    checked: false,
    starts: Starts::One,
};
/// Both, until settled: with the time that took.
const UNTIL_SETTLED: Analysis = Analysis { until_settled: true, finds_cycles: false, ..BOTH };

/// The columns of some records.
fn encode(records: &[Record], analysis: Analysis) -> Vec<u8> {
    let mut bytes = vec![0; records.len() * width(analysis)];
    squealmap::store::columns::encode(records.iter(), analysis, &mut bytes);
    bytes
}

/// A record of which every number is different and known: `base` and its place in the documented order.
fn numbered(base: f64) -> Record {
    let next = std::cell::Cell::new(base);
    let number = || next.replace(next.get() + 1.0);
    let some = || Some(number());
    Record {
        status: Status::Ok,
        kind: Some(InstabilityType::Interaction),
        linear: Some(Linear {
            growth_rate: number(),
            frequency: Some(number()),
            phase: some(),
            growth_rate_flat: number(),
            growth_rate_frozen: number(),
        }),
        regime: Some(Regime::DetachingStickSlip),
        settled: Some(true),
        outcome: Some(Box::new(Outcome {
            status: Status::Ok,
            x2_mean: some(),
            x2_std: some(),
            y1_mean: some(),
            y1_std: some(),
            ax_rms: some(),
            ay_rms: some(),
            ax_peak: some(),
            ay_peak: some(),
            friction_mean: some(),
            n_peak: some(),
            response_frequency: some(),
            phase_cycle: some(),
            growth_rate_measured: some(),
            frequency_measured: some(),
            phase_measured: some(),
            stick: some(),
            free: some(),
            reverse: some(),
            impacts_per_second: some(),
            energy_gaining_impacts: Some(24 + 1000),
            simulated_time: base + 25.0,
            steps: 26 + 1000,
            ..Outcome::default()
        })),
        ..Record::default()
    }
}

/// Records of all sorts.
fn records() -> Vec<Record> {
    let mut sparse = record(InstabilityType::Stable, Regime::Equilibrium, false);
    sparse.linear.as_mut().unwrap().phase = None;
    let linear_only = Record { regime: None, settled: None, outcome: None, ..sparse.clone() };
    vec![numbered(1000.0), failed(Status::Painleve), Record::NOT_COMPUTED, sparse, linear_only]
}

fn tile(bounds: std::ops::Range<usize>) -> Label {
    let sweep = Id(std::array::from_fn(|k| u8::try_from(k).unwrap()));
    Label { sweep, kind: "cpu f64".to_owned(), analysis: BOTH, bounds }
}

#[test]
fn tiles_cover_every_instance_once() {
    for (instances, tile, count) in [(1, 5, 1), (5, 5, 1), (6, 5, 2), (100, 7, 15), (65_537, 65_536, 2)] {
        let tiling = Tiling { instances, tile };
        assert_eq!(tiling.count(), count);
        let mut next = 0;
        for bounds in (0..count).map(|number| tiling.bounds(number)) {
            assert_eq!(bounds.start, next);
            assert!(!bounds.is_empty() && bounds.len() <= tile);
            next = bounds.end;
        }
        assert_eq!(next, instances);
    }
}

#[test]
fn records_come_back_bit_by_bit() {
    let all = records();
    let bytes = encode(&all, BOTH);
    assert_eq!(bytes.len(), all.len() * width(BOTH));
    let back = decode(&bytes, all.len(), BOTH).unwrap();
    assert_eq!(back, all);
    // A flipped bit of any number is seen by this comparison.
    let mut flipped = bytes.clone();
    flipped[4 * all.len()] ^= 1;
    assert_ne!(decode(&flipped, all.len(), BOTH).unwrap(), all);
    assert_eq!(decode(&bytes[1..], all.len(), BOTH), None);
    let checked = Analysis { checked: true, ..UNTIL_SETTLED };
    for (by, taken, changed, error) in [
        (By::Fine, false, true, Some(3e-5)),
        (By::Fine, true, false, None),
        (By::Reference, false, false, Some(f64::INFINITY)),
    ] {
        let check = Some(Check { by, taken, changed, error });
        let late = |one: &Outcome| Box::new(Outcome { settling_time: Some(1.5), ..*one });
        let [first, second] = [None, check].map(|check| Record {
            check,
            outcome: all[0].outcome.as_deref().map(late),
            ..all[0].clone()
        });
        let all = [first, second, all[2].clone()];
        let bytes = encode(&all, checked);
        assert_eq!(decode(&bytes, 3, checked).unwrap(), all);
        // A flipped bit of the flags or of the error says something else.
        let of_error = error.map(|_| (bytes.len() - 16, 1));
        for (at, bit) in [(3 * 3 + 1, 64)].into_iter().chain(of_error) {
            let mut flipped = bytes.clone();
            flipped[at] ^= bit;
            assert_ne!(decode(&flipped, 3, checked).unwrap()[1].check, check);
        }
    }
    for analysis in [Analysis { response: false, ..BOTH }, Analysis { linear: false, ..BOTH }, UNTIL_SETTLED]
    {
        let only = |one: &Record| Record {
            kind: one.kind.filter(|_| analysis.linear),
            linear: one.linear.filter(|_| analysis.linear),
            regime: one.regime.filter(|_| analysis.response),
            settled: one.settled.filter(|_| analysis.response),
            outcome: one
                .outcome
                .as_deref()
                .filter(|_| analysis.response)
                .map(|outcome| Outcome { settling_time: analysis.until_settled.then_some(12.5), ..*outcome })
                .map(Box::new),
            ..one.clone()
        };
        let all: Vec<Record> = all.iter().map(only).collect();
        assert_eq!(decode(&encode(&all, analysis), all.len(), analysis).unwrap(), all);
    }
}

#[test]
fn a_tile_has_the_documented_layout() {
    let two = [numbered(1000.0), numbered(2000.0)];
    let bytes = tile(7..9).write(&two);
    assert_eq!(bytes.len(), 80 + 2 * (4 + 27 * 8) + 40);
    assert_eq!(&bytes[..8], b"SQMTILE1");
    assert_eq!(bytes[8..40], std::array::from_fn::<u8, 32, _>(|k| u8::try_from(k).unwrap()));
    let integer = |at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap());
    assert_eq!((integer(40), integer(48)), (7, 9));
    assert_eq!(&bytes[56..72], b"cpu f64\0\0\0\0\0\0\0\0\0");
    assert_eq!(bytes[72..80], [3, 0, 0, 0, 0, 0, 0, 0]);
    // Status ok, type interaction (5th), regime 6th, flags: everything there, settled.
    assert_eq!(bytes[80..88], [1, 1, 5, 5, 6, 6, 15, 15]);
    for column in 0..27_u16 {
        for row in 0..2 {
            let at = 88 + 16 * usize::from(column) + 8 * row;
            let number = f64::from_le_bytes(bytes[at..at + 8].try_into().unwrap());
            // Two counts are numbered from 1000 in both.
            let base = if matches!(column, 24 | 26) { 1000.0 } else { 1000.0 * (row as f64 + 1.0) };
            assert!(
                (number - base - f64::from(column)).abs() < 1e-12,
                "column {column}, row {row}: {number}"
            );
        }
    }
    let end = bytes.len() - 40;
    assert_eq!(bytes[end..end + 32], *blake3::hash(&bytes[..end]).as_bytes());
    assert_eq!(&bytes[end + 32..], b"SQMTEND1");
}

#[test]
fn what_is_no_such_tile_is_refused() {
    let all = records();
    let label = tile(10..10 + all.len());
    // One of them was not computed: what a stopped run keeps, and no tile.
    let some = label.write(&all);
    assert_eq!((label.read(&some), label.read_some(&some).unwrap()), (Err(Fault::Uncomputed), all.clone()));
    let all: Vec<Record> = all.into_iter().filter(|record| record.status != Status::NotComputed).collect();
    let label = tile(10..10 + all.len());
    let bytes = label.write(&all);
    assert_eq!(label.read(&bytes).unwrap(), all);
    assert_eq!(label.read(&[]), Err(Fault::Empty));
    assert_eq!(label.read(b"instance,mu_s\n"), Err(Fault::Format));
    for length in 1..bytes.len() {
        assert!(label.read(&bytes[..length]).is_err(), "{length} bytes");
    }
    let half = bytes.len() / 2;
    assert_eq!(label.read(&bytes[..half]), Err(Fault::Length { found: half, wanted: bytes.len() }));
    let longer = [&bytes[..], &[0]].concat();
    assert!(matches!(label.read(&longer), Err(Fault::Length { .. })));
    for bit in 0..8 * bytes.len() {
        let mut flipped = bytes.clone();
        flipped[bit / 8] ^= 1 << (bit % 8);
        assert!(label.read(&flipped).is_err(), "bit {bit}");
    }
    let mut other = label.clone();
    other.sweep.0[31] ^= 1;
    assert_eq!(other.read(&bytes), Err(Fault::Sweep));
    assert_eq!(tile(11..11 + all.len()).read(&bytes), Err(Fault::Bounds));
    assert_eq!(Label { kind: "gpu f64".to_owned(), ..label.clone() }.read(&bytes), Err(Fault::Bounds));
    // A code that no writer writes, under a checksum that fits.
    let mut content = bytes[..bytes.len() - 40].to_vec();
    content[80] = 99;
    let checksum = blake3::hash(&content);
    content.extend(checksum.as_bytes());
    content.extend(b"SQMTEND1");
    assert_eq!(label.read(&content), Err(Fault::Code));
}

#[test]
fn the_key_depends_on_sweep_bounds_and_engine() {
    let label = tile(10..20);
    let mut hashed = label.sweep.0.to_vec();
    hashed.extend(10_u64.to_le_bytes());
    hashed.extend(20_u64.to_le_bytes());
    hashed.extend(b"cpu f64");
    assert_eq!(label.key(), blake3::hash(&hashed).to_hex()[..16]);
    let mut other = label.clone();
    other.sweep.0[0] ^= 1;
    for different in
        [tile(11..20), tile(10..21), Label { kind: "cpu f32".to_owned(), ..label.clone() }, other]
    {
        assert_ne!(different.key(), label.key());
    }
}

#[test]
fn canonical_text_is_sorted_short_and_exact() {
    let json: serde_json::Value =
        serde_json::from_str(r#"{ "b": [1, 0.1, -2.50, "ä\""], "a": { "d": null, "c": true } }"#).unwrap();
    let text = r#"{"a":{"c":true,"d":null},"b":[1,0.1,-2.5,"ä\""]}"#;
    assert_eq!(Id::of(&json).0, *blake3::hash(text.as_bytes()).as_bytes());
}

#[test]
fn rows_beside_the_json_have_the_id_and_the_text_of_rows_in_it() {
    let rows = vec![
        vec![Value::Text("pad \"1\".csv".to_owned().into()), Value::Number(1.0)],
        vec![Value::Text("ä".to_owned().into()), Value::Number(-0.0)],
        vec![Value::Text("ä".to_owned().into()), Value::Number(1e300 / 3.0)],
    ];
    let grid =
        Grid::Tuples { keys: vec![AxisKey::Material, AxisKey::Param(Param::Temperature)], rows: rows.into() };
    let whole = serde_json::json!({ "columns": ["material", "temperature"],
        "rows": [["pad \"1\".csv", 1.0], ["ä", -0.0], ["ä", 1e300 / 3.0]] });
    assert_eq!(Id::with_rows(&to_json(&grid), grid_json::rows(&grid)), Id::of(&whole));
    let made = Description::new(&spec(grid.clone()), computed("f64"), 4);
    let written: serde_json::Value = serde_json::from_slice(&made.to_bytes()).unwrap();
    assert_eq!(written["identity"]["physics"]["grid"], whole);
    assert_eq!(Id::of(&written["identity"]), made.id);
    // Laid out as any JSON of these values is.
    let pretty = serde_json::to_string_pretty(&written).unwrap() + "\n";
    assert_eq!(String::from_utf8(made.to_bytes()).unwrap(), pretty);
}

fn computed(precision: &str) -> [Option<Computation>; 2] {
    let made = Computation { precision: precision.to_owned(), ..in_f64(Backend::Cpu, "method".to_owned()) };
    [Some(made.clone()), Some(made)]
}

fn grid() -> Grid {
    Grid::Axes(vec![span(Param::MuS, 0.1, 0.3, 3), axis(Param::MuD, &[0.1, 0.2])])
}

#[test]
fn the_id_is_that_of_physics_and_method_alone() {
    let id = |spec: &Spec, made: &[Option<Computation>; 2]| {
        Id::with_rows(&identity(spec, made), grid_json::rows(&spec.grid))
    };
    let base = spec(grid());
    let reference_id = id(&base, &computed("f64"));
    let same = [Spec { title: "Another".to_owned(), ..base.clone() }, base.clone()];
    assert!(same.iter().all(|spec| id(spec, &computed("f64")) == reference_id));
    let mut on_another_gpu = computed("f64");
    on_another_gpu[0].as_mut().unwrap().adapter = Some("another".to_owned());
    assert_eq!(id(&base, &on_another_gpu), reference_id);
    let mut warmer = base.clone();
    warmer.base.set(Param::K1, f64::from_bits(warmer.base.require(Param::K1).to_bits() + 1));
    let reordered = Grid::Axes(vec![axis(Param::MuD, &[0.1, 0.2]), span(Param::MuS, 0.1, 0.3, 3)]);
    let keys = vec![AxisKey::Param(Param::MuS), AxisKey::Param(Param::MuD)];
    let tuples = |last: f64| {
        let rows = [0.1, last].map(|x| vec![Value::Number(x), Value::Number(0.2)]).to_vec();
        spec(Grid::Tuples { keys: keys.clone(), rows: rows.into() })
    };
    let others = [
        warmer,
        spec(reordered),
        Spec { steps_per_period: 61, ..base.clone() },
        Spec { impact_friction: false, ..base.clone() },
        tuples(0.3),
        tuples(0.4),
    ];
    let mut ids: Vec<Id> = others.iter().map(|spec| id(spec, &computed("f64"))).collect();
    ids.push(reference_id);
    ids.push(id(&base, &computed("f32")));
    ids.push(id(&base, &[computed("f64")[0].clone(), None]));
    // Another version of the program.
    let mut newer = identity(&base, &computed("f64"));
    newer["program"]["version"] = "999.0.0".into();
    ids.push(Id::of(&newer));
    for (k, one) in ids.iter().enumerate() {
        assert!(ids[..k].iter().all(|other| other != one), "{k}");
    }
    assert_eq!(kind(&computed("f32")), "cpu f32");
}

#[test]
fn a_description_comes_back() {
    for grid in [
        grid(),
        Grid::Axes(Vec::new()),
        Grid::Axes(vec![Axis {
            key: AxisKey::Law,
            values: vec![Value::Text("constant".to_owned().into())],
            log: false,
        }]),
        Grid::Tuples {
            keys: vec![AxisKey::Material, AxisKey::Param(Param::Temperature)],
            rows: vec![vec![Value::Text("pad \"1\", new.csv".to_owned().into()), Value::Number(0.1 + 0.2)]]
                .into(),
        },
        Grid::Axes(vec![axis(Param::C1, &[5e-324, 1.0 / 3.0, 0.1 + 0.2, f64::MAX])]),
    ] {
        assert_eq!(from_json(&to_json(&grid), grid_json::rows(&grid).cloned()), Some(grid.clone()));
        let sweep = spec(grid.clone());
        let made = Description::new(&sweep, computed("f64"), 4);
        let back = Description::from_bytes(&made.to_bytes()).unwrap();
        assert_eq!((back.id, &back.grid, back.tiling), (made.id, &grid, made.tiling));
        assert_eq!((&back.resolved, &back.computations), (&sweep.resolved(), &made.computations));
        assert_eq!((&back.title, &back.kind, back.analysis), (&sweep.title, &made.kind, BOTH));
        let changed = String::from_utf8(made.to_bytes())
            .unwrap()
            .replace("\"steps_per_period\": 60", "\"steps_per_period\": 6");
        let refused = Description::from_bytes(changed.as_bytes()).unwrap_err();
        assert!(matches!(&refused, Unread::Bad(why) if why.contains("changed")), "{refused:?}");
    }
}

#[test]
fn counts_of_a_box_beyond_their_sum_are_a_bad_tile() {
    let basin = Basin { equilibrium: u32::MAX, oscillation: 1, other: 0, failed: 0 };
    let record = Record { others: Some(Others::Basin(basin)), ..Record::NOT_COMPUTED };
    let label = Label {
        sweep: Id([7; 32]),
        kind: "cpu f64".to_owned(),
        analysis: Analysis { starts: Starts::Box(3), ..BOTH },
        bounds: 0..1,
    };
    assert_eq!(label.read(&label.write(&[record])).unwrap_err(), Fault::Code);
}
