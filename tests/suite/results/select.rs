//! A part of a map by the values of its axes, and the nearest value where an axis does not have the one that is named.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::cli::program::{squealmap, unwrapped};
use crate::results::plot::directory;
use crate::synthetic::{axis, map, number, record, span};
use squealmap::engine::regime::Regime;
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType as Kind;
use squealmap::results::cut::Cut;
use squealmap::results::read::Archive;
use squealmap::sweep::grid::{Axis, AxisKey, Grid, Value};
use squealmap::sweep::map::Map;

/// Two laws by three angles, of which the middle one is a zero that rounding has left, by seven frictions; the growth of an
/// instance is its number.
fn laws() -> Map {
    let law = ["bilinear", "rational"].map(|name| Value::Text(name.to_owned().into())).to_vec();
    let axes = vec![
        Axis { key: AxisKey::Law, values: law, log: false },
        axis(Param::Theta, &[-0.02, 6.9e-18, 0.02]),
        span(Param::MuS, 0.0, 0.6, 7),
    ];
    let mut map = map(Grid::Axes(axes), |k, _| record(Kind::ALL[k % 7], Regime::ALL[k % 7], true));
    for (k, record) in map.records.iter_mut().enumerate() {
        record.linear.as_mut().unwrap().growth_rate = k as f64;
    }
    map
}

fn growth(archive: &Archive) -> Vec<f64> {
    let column = archive.columns.iter().find(|column| column.name == "growth_rate").unwrap();
    column.values.iter().flatten().copied().collect()
}

#[test]
fn a_slice_has_the_instances_of_its_values() {
    let archive = Archive::read(directory(&laws()).path()).unwrap();
    // The law varies slowest: 3 by 7 instances each.
    let (part, taken) = archive.slice("law=rational, theta=0.02").unwrap();
    assert_eq!(growth(&part), (35..42).map(f64::from).collect::<Vec<_>>());
    assert_eq!((part.map.records.len(), part.map.spec.grid.len(), taken.len()), (7, 7, 0));
    assert_eq!(part.map.records[3].kind, Some(Kind::ALL[38 % 7]));
    // Several values of an axis stay in its order; what is not named stays whole.
    let (part, _) = archive.slice("theta=0.02,theta=-0.02").unwrap();
    let expected = (0..7).chain(14..21).chain(21..28).chain(35..42).map(f64::from);
    assert_eq!(growth(&part), expected.collect::<Vec<_>>());
    let Grid::Axes(axes) = &part.map.spec.grid else { panic!("axes") };
    assert_eq!(axes[1].values, [-0.02, 0.02].map(Value::Number));
    // What rounding has left of zero is zero, and no other value.
    let (part, taken) = archive.slice("theta=0").unwrap();
    assert_eq!((growth(&part).len(), taken.len()), (14, 0));
    assert_eq!(Cut::new(&archive.map.spec.grid, "theta=0").unwrap().taken, []);
}

#[test]
fn the_nearest_value_is_taken_and_named() {
    let archive = Archive::read(directory(&laws()).path()).unwrap();
    let (part, taken) = archive.slice("mu_s=0.23").unwrap();
    assert_eq!(growth(&part), (0..6).map(|k| f64::from(2 + 7 * k)).collect::<Vec<_>>());
    let [taken] = &taken[..] else { panic!("{taken:?}") };
    assert_eq!(taken.to_string(), "`mu_s` has no value 0.23; the nearest is taken, 0.2");
    // On a log axis the nearest is that of the smaller ratio: 300 is nearer to 1000 than to 10, and 9 to 10.
    let log = Axis { log: true, ..axis(Param::K2, &[10.0, 1e3, 1e5]) };
    let grid = Grid::Axes(vec![log, span(Param::MuS, 0.0, 0.6, 7)]);
    let held = |cut: &str| Cut::new(&grid, cut).map(|cut| cut.held[0].1.clone()).ok();
    assert_eq!(held("k2=300"), Some(Value::Number(1e3)));
    assert_eq!(held("k2=99"), Some(Value::Number(10.0)));
    assert_eq!(held("k2=20000"), Some(Value::Number(1e5)));
    // Half a step beyond the ends is the end, more is outside.
    assert_eq!((held("k2=1.1"), held("k2=0.9")), (Some(Value::Number(10.0)), None));
}

#[test]
fn a_list_of_instances_is_sliced_too() {
    let keys = vec![AxisKey::Param(Param::MuS), AxisKey::Param(Param::BeltVelocity)];
    let rows = (0..12).map(|k| [0.1 * f64::from(k), 1.0 + f64::from(k % 3)].map(Value::Number).to_vec());
    let list =
        map(Grid::Tuples { keys, rows: rows.collect() }, |k, _| record(Kind::ALL[k % 7], Regime::Slip, true));
    let archive = Archive::read(directory(&list).path()).unwrap();
    let (part, taken) = archive.slice("belt_velocity=2.2").unwrap();
    assert_eq!(taken[0].value.to_bits(), 2.0_f64.to_bits());
    let kinds: Vec<_> = part.map.records.iter().map(|record| record.kind.unwrap()).collect();
    assert_eq!(kinds, [1, 4, 7, 10].map(|k| Kind::ALL[k % 7]));
    assert!((0..4).all(|k| number(part.map.spec.grid.coordinates(k)[1]).to_bits() == 2.0_f64.to_bits()));
    let error = archive.slice("belt_velocity=1,mu_s=0.1").unwrap_err();
    assert!(error.is_bad_input() && error.to_string().contains("no instance of the list"), "{error}");
}

#[test]
fn select_is_an_option_of_plot() {
    let directory = directory(&laws());
    let plot = |options: &[&str]| squealmap(directory.path(), &[&["plot", "."], options].concat());
    let ended = plot(&["--select", "law=rational,theta=0.012", "--quantity", "growth"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let said = unwrapped(&ended.err);
    assert!(said.contains("--select: `theta` has no value 0.012; the nearest is taken, 0.02"), "{said}");
    let svg = std::fs::read_to_string(directory.path().join("plot.svg")).unwrap();
    assert!(svg.contains("7 instances") && svg.contains("--select"), "{svg:.900}");
    // Both together: the cut is one of the slice.
    let ended = plot(&["--select=law=rational", "--cut=theta=0", "--quantity=growth"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(!ended.err.contains("nearest"), "{}", ended.err);
    let table = std::fs::read_to_string(directory.path().join("cut.csv")).unwrap();
    let found: Vec<&str> = table.lines().skip(1).filter_map(|line| line.rsplit(',').next()).collect();
    assert_eq!(found, ["28", "29", "30", "31", "32", "33", "34"]);
    for (select, words) in [
        ("low=rational", "--select low=rational: the map has no axis `low`; did you mean `law`?"),
        ("law=rationl", "`law` has no value `rationl`; did you mean `rational`?"),
        ("theta", "write name=value"),
        ("theta=0.5", "`theta` has no value 0.5; its values go from -0.02 to 0.02"),
    ] {
        let ended = plot(&["--select", select]);
        assert_eq!(ended.code, Some(2), "{}", ended.err);
        assert!(unwrapped(&ended.err).contains(words), "{}", ended.err);
    }
}
