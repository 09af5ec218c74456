//! `map.parquet`, read back and compared with `map.csv`; pandas reads it in `.ci/exports.py`.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::collections::BTreeSet;
use std::fs::File;
use std::path::Path;

use crate::cli::program::squealmap;
use crate::store::resume::{SWEEP, with};
use parquet::file::metadata::RowGroupMetaData;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use serde_json::Value as Json;
use squealmap::store::directory::Store;
use squealmap::sweep::columns::{Cell, Content, columns};

/// A sweep with a law on an axis, computed in tiles of 32.
fn computed() -> tempfile::TempDir {
    let sweep = SWEEP.replace(
        "[axes]\n",
        "knee_velocity = 5.0\ndecay = 0.1\n[axes]\nlaw = { values = [\"bilinear\", \"rational\"] }\n",
    );
    let directory = with(&sweep);
    let ended = squealmap(directory.path(), &["run", "s.toml", "--backend", "cpu", "--tile", "32"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let ended = squealmap(directory.path(), &["export", "out/s", "--format", "parquet"]);
    assert_eq!((ended.code, ended.out.as_str()), (Some(0), "wrote out/s/map.parquet\n"), "{}", ended.err);
    directory
}

/// The rows of the table as text.
fn csv(directory: &Path) -> Vec<Vec<String>> {
    let mut reader =
        csv::ReaderBuilder::new().has_headers(false).from_path(directory.join("out/s/map.csv")).unwrap();
    reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect()
}

/// Whether a field is the cell of the table.
fn is_same(field: &Field, cell: &str) -> bool {
    match field {
        Field::Null => cell.is_empty(),
        Field::Double(number) => {
            cell.parse::<f64>().is_ok_and(|wanted| wanted.to_bits() == (number + 0.0).to_bits())
        }
        Field::Long(count) => cell.parse() == Ok(*count),
        Field::Str(text) => text == cell,
        _ => false,
    }
}

#[test]
fn every_cell_is_that_of_the_table() {
    let directory = computed();
    let file = File::open(directory.path().join("out/s/map.parquet")).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    let mut table = csv(directory.path()).into_iter();
    let header = table.next().unwrap();
    let rows: Vec<Vec<(String, Field)>> =
        reader.get_row_iter(None).unwrap().map(|row| row.unwrap().into_columns()).collect();
    let wanted: Vec<Vec<String>> = table.collect();
    assert_eq!(rows.len(), 600);
    let differ = |wanted: &[Vec<String>]| {
        let cells = |(row, wanted): (&Vec<(String, Field)>, &Vec<String>)| {
            row.iter().zip(wanted).filter(|((_, field), cell)| !is_same(field, cell)).count()
        };
        rows.iter().zip(wanted).map(cells).sum::<usize>()
    };
    assert!(rows.iter().all(|row| row.iter().map(|(name, _)| name).eq(&header)), "the columns differ");
    assert_eq!(differ(&wanted), 0);
    // The comparison sees one wrong cell of each kind.
    for column in [0, 2, header.len() - 1] {
        let mut spoilt = wanted.clone();
        spoilt[17][column].push('1');
        assert_eq!(differ(&spoilt), 1, "column {column}");
    }
    let parts: Vec<i64> = reader.metadata().row_groups().iter().map(RowGroupMetaData::num_rows).collect();
    assert_eq!(parts, [[32; 18].as_slice(), &[24]].concat());

    let said = reader.metadata().file_metadata().key_value_metadata().unwrap();
    let said = |key: &str| said.iter().find(|one| one.key == key).unwrap().value.clone().unwrap();
    assert_eq!(said("title"), "Tiles");
    let units: Json = serde_json::from_str(&said("units")).unwrap();
    assert_eq!(
        (&units["belt_velocity"], &units["ax_rms"], &units["mu_d"]),
        (&"m/s".into(), &"m/s^2".into(), &"".into())
    );
    let attrs: Json = serde_json::from_str(&said("PANDAS_ATTRS")).unwrap();
    assert_eq!(attrs["units"], units);
    assert_eq!(attrs["meanings"]["x2_std"], "standard deviation of x2");
}

/// A column of the large start is none of numbers where that of the only start is none.
#[test]
fn columns_of_several_starts_have_the_content_they_say() {
    for (start, least) in [
        ("kind = \"both\"", "bistable"),
        (
            "kind = \"box\"\nbox_samples = 3\nbox_displacement_from = 0\nbox_displacement_to = 0\nbox_velocity_from = 0\nbox_velocity_to = 2",
            "basin_other",
        ),
    ] {
        let sweep = SWEEP.replace("[response]", &format!("[start]\n{start}\n[response]"));
        let sweep = sweep.replace("settle = \"2 periods\"\nmeasure = \"2 periods\"", "settle = \"auto\"");
        let directory = with(&sweep);
        let ended = squealmap(directory.path(), &["run", "s.toml", "--backend", "cpu"]);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        let met = contents(directory.path());
        assert!(met.contains(least), "{met:?}");
        assert!(
            start.contains("box") || met.contains("regime_large") && met.contains("steps_large"),
            "{met:?}"
        );
    }
}

#[test]
fn every_column_has_the_content_it_says() {
    assert!(contents(computed().path()).len() > 20);
}

/// Compares every cell of a run with what its column says; gives the columns that have any.
fn contents(directory: &Path) -> BTreeSet<&'static str> {
    let store = Store::open(&directory.join("out/s")).unwrap();
    let (grid, tiling) = (&store.description.grid, store.description.tiling);
    let mut met = BTreeSet::new();
    for number in 0..tiling.count() {
        for (index, record) in tiling.bounds(number).zip(store.read(number).unwrap().unwrap()) {
            for column in columns(grid, store.description.analysis) {
                let content = match column.cell(index, &grid.coordinates(index), &record) {
                    Cell::Empty => continue,
                    Cell::Number(_) => Content::Number,
                    Cell::Count(_) => Content::Count,
                    Cell::Text(_) => Content::Name,
                };
                assert_eq!(content, column.content(), "{}", column.name);
                met.insert(column.name);
            }
        }
    }
    met
}
