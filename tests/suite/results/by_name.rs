//! Results by column name, and as arrays over the axes.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use squealmap::FrictionLaw::Bilinear;
use squealmap::results::csv::map_csv;
use squealmap::{Backend, Duration, Map, Options, Param, Settle, Sweep};

fn sweep() -> Sweep {
    Sweep::two_mass()
        .friction(Bilinear { mu_s: 0.4, mu_d: 0.2, knee_velocity: 5.0 })
        .values(Param::BeltVelocity, [0.0, 1.0, 3.0, 6.0])
        .axis(Param::MuD, 0.1..=0.3, 3)
        .response(Settle::After(Duration::Periods(20.0)))
        .measure(Duration::Periods(10.0))
}

fn computed(sweep: &Sweep) -> Map {
    sweep.run_with(&Options { backend: Backend::Cpu, ..Options::default() }).unwrap()
}

/// The fields of a column of `map.csv`.
fn written(map: &Map, name: &str) -> Vec<String> {
    let text = String::from_utf8(map_csv(map).unwrap()).unwrap();
    let mut lines = text.lines();
    let at = lines.next().unwrap().split(',').position(|column| column == name).unwrap();
    lines.map(|line| line.split(',').nth(at).unwrap().to_owned()).collect()
}

#[test]
fn every_column_of_the_table_is_there_by_its_name() {
    let map = computed(&sweep());
    let (mut numbers, mut names) = (0, 0);
    for column in map.columns() {
        let written = written(&map, column.name);
        if let Ok(found) = map.names(column.name) {
            names += 1;
            assert_eq!(found.into_iter().map(Option::unwrap_or_default).collect::<Vec<_>>(), written);
            assert!(map.column(column.name).is_err(), "{}", column.name);
        } else {
            numbers += 1;
            for (found, written) in map.column(column.name).unwrap().into_iter().zip(&written) {
                match written.parse::<f64>() {
                    Ok(written) => {
                        assert!(found.to_bits() == written.to_bits() || found == 0.0, "{}", column.name);
                    }
                    Err(_) => assert!(written.is_empty() && found.is_nan(), "{}: {written}", column.name),
                }
            }
        }
    }
    assert!(numbers >= 28 && names == 3, "{numbers} columns of numbers, {names} of names");
    // A belt at rest has no sliding equilibrium.
    assert!(map.column("growth_rate").unwrap()[0].is_nan());
    assert_eq!(map.column("mu_d").unwrap()[..3], [0.1, 0.2, 0.3]);
}

#[test]
fn arrays_have_the_shape_of_the_axes() {
    let map = computed(&sweep());
    let array = map.array("y1_mean").unwrap();
    assert_eq!((array.unit, array.shape()), ("m", vec![4, 3]));
    assert_eq!(array.dimensions, [("belt_velocity", 4), ("mu_d", 3)]);
    assert_eq!(array.along("belt_velocity"), Some(&[0.0, 1.0, 3.0, 6.0][..]));
    for (index, value) in map.column("y1_mean").unwrap().into_iter().enumerate() {
        let found = array.get(&[index / 3, index % 3]).unwrap();
        let (fast, slow) =
            (array.at("belt_velocity", index / 3).unwrap(), array.at("mu_d", index % 3).unwrap());
        for found in [found, fast.get(&[index % 3]).unwrap(), slow.get(&[index / 3]).unwrap()] {
            assert_eq!(found.to_bits(), value.to_bits(), "{index}");
        }
    }
    let slow = array.at("mu_d", 1).unwrap();
    assert_eq!((slow.shape(), slow.along("mu_d")), (vec![4], None));
    assert_eq!(slow.along("belt_velocity"), array.along("belt_velocity"));
    for beyond in [&[0, 3][..], &[4, 0], &[0], &[0, 0, 0], &[]] {
        assert_eq!(array.get(beyond), None, "{beyond:?}");
    }
    assert!(array.at("mu_d", 3).is_none() && array.at("mu_s", 0).is_none());
    let none = slow.at("belt_velocity", 2).unwrap();
    assert_eq!((none.shape(), none.get(&[])), (vec![], slow.get(&[2])));
    let points = sweep().spec().unwrap();
    let points = Map {
        spec: squealmap::Spec { grid: squealmap::sweep::grid::Grid::Axes(Vec::new()), ..points },
        records: map.records[..1].to_vec(),
        ..map
    };
    assert_eq!(
        points.array("status").unwrap_err().to_string(),
        ".column: `status` must be a column of numbers, which `column` gives, found a column of names, which `names` gives"
    );
    assert_eq!(points.array("x2_std").unwrap().dimensions, [("instance", 1)]);
}

#[test]
fn a_name_that_is_none_is_refused_with_the_nearest() {
    let map = computed(&sweep().without_response());
    let said = map.column("growth_rat").unwrap_err();
    assert_eq!(
        said.to_string(),
        ".column: unknown column `growth_rat` of the map; did you mean `growth_rate`?"
    );
    assert!(said.is_bad_input());
    let said = map.names("x2_std").unwrap_err().to_string();
    assert!(said.starts_with(".names: unknown column `x2_std` of the map; "), "{said}");
}
