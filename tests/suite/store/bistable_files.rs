//! Several starts in files: tiles, shards, tables, figures and exports.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use crate::cli::program::squealmap;
use crate::store::resume::{tiles, with};
use crate::sweep::bistable::{SINGLE, oscillation, parse};
use crate::synthetic::record;
use squealmap::engine::backend::Backend;
use squealmap::engine::options::Options;
use squealmap::engine::record::{Basin, Others, Record};
use squealmap::engine::regime::Regime;
use squealmap::model::kind::InstabilityType;
use squealmap::results::csv::map_csv;
use squealmap::results::figure::map::map_svg;
use squealmap::store::{columns, starts};
use squealmap::sweep::spec::{Analysis, Starts};

/// Tiles keep what other starts gave; a sweep of one start has not a byte more than before.
#[test]
fn tiles_keep_all_starts() {
    let one = Analysis {
        linear: true,
        response: true,
        until_settled: true,
        finds_cycles: false,
        checked: false,
        starts: Starts::One,
    };
    assert_eq!(starts::width(one), columns::width(one));
    let large = Record { kind: None, linear: None, ..oscillation(Regime::StickSlip, 2.5) };
    let small = || record(InstabilityType::Stable, Regime::Equilibrium, true);
    let with = |bistable, others| Record { bistable, others: Some(others), ..small() };
    let basin = Basin { equilibrium: 70_000, oscillation: 2, other: 1, failed: 3 };
    for (starts, records) in [
        (Starts::Both, [with(Some(true), Others::Large(Box::new(large.clone()))), Record::NOT_COMPUTED]),
        (
            Starts::Both,
            [
                with(None, Others::Large(Box::new(large.clone()))),
                with(Some(false), Others::Large(Box::new(large))),
            ],
        ),
        (Starts::Box(70_006), [with(Some(true), Others::Basin(basin)), Record::NOT_COMPUTED]),
    ] {
        let analysis = Analysis { starts, ..one };
        let mut bytes = vec![0; 2 * starts::width(analysis)];
        starts::encode(records.as_slice().into(), analysis, &mut bytes);
        // What no export shows, the halves of the window, is not kept; here it is zero.
        assert!(starts::decode(&bytes, 2, analysis).unwrap() == records, "{starts:?}");
        assert_eq!(starts::decode(&bytes[1..], 2, analysis), None);
        let flag = 2 * columns::width(one);
        bytes[flag] = 3;
        assert_eq!(starts::decode(&bytes, 2, analysis), None, "a code that is none");
        bytes[flag] = 1;
        assert!(starts::decode(&bytes, 2, analysis).unwrap() != records, "another verdict");
    }
}

/// Tiles, shards, a run again and the exports of sweeps of several starts are those of the library in memory.
#[test]
fn the_program_keeps_all_starts_through_tiles_and_shards() {
    let boxed = "kind = \"box\"\nbox_samples = 6\nbox_displacement_from = -2.5\nbox_displacement_to = 1.5\n\
        box_velocity_from = 0\nbox_velocity_to = 2\n";
    for (start, columns) in [
        (
            "kind = \"both\"\n",
            &["bistable", "x2_std_large", "regime_large", "checked_large", "status_large"][..],
        ),
        (boxed, &["bistable", "basin_equilibrium", "basin_oscillation", "basin_other", "basin_failed"]),
    ] {
        let sweep = format!(
            "title = \"Starts\"\n{SINGLE}c1 = 0.1\n[friction]\nlaw = \"exponential\"\nmu_s = 1\nmu_d = 0.5\n\
             stribeck_velocity = 0.5\n[axes]\nbelt_velocity = {{ from = 1, to = 2, points = 11 }}\n\
             mu_s = {{ values = [0.9, 1.0] }}\n[start]\n{start}[response]\nsettle = \"40 periods\"\nmeasure = \"20 periods\"\n"
        )
        .replace("mu_s = 1\n", "");
        let (directory, other) = (with(&sweep), with(&sweep));
        let run = |directory: &tempfile::TempDir, more: &[&str]| {
            let all = ["run", "s.toml", "--backend", "cpu", "--tile", "5"].iter().chain(more).copied();
            let ended = squealmap(directory.path(), &all.collect::<Vec<_>>());
            assert_eq!(ended.code, Some(0), "{}", ended.err);
            ended
        };
        let read = |directory: &tempfile::TempDir, name: &str| {
            std::fs::read(directory.path().join("out/s").join(name)).unwrap()
        };
        let ended = run(&directory, &[]);
        assert!(ended.out.contains(" of 22 instances are bistable"), "{}", ended.out);
        let options = Options { backend: Backend::Cpu, ..Options::default() };
        let map = squealmap::sweep::run::run(parse(&sweep), &options, &|_| {}).unwrap();
        let table = map_csv(&map).unwrap();
        assert!(read(&directory, "map.csv") == table);
        assert!(read(&directory, "map.svg") == map_svg(&map).unwrap().into_bytes());
        let header = String::from_utf8(table.clone()).unwrap().lines().next().unwrap().to_owned();
        for column in columns {
            assert!(header.split(',').any(|name| name == *column), "{column} in {header}");
        }
        let manifest: serde_json::Value = serde_json::from_slice(&read(&directory, "manifest.json")).unwrap();
        let found = |verdict: Option<bool>| map.records.iter().filter(|one| one.bistable == verdict).count();
        assert_eq!(
            manifest["counts"]["bistable"],
            serde_json::json!({ "yes": found(Some(true)), "no": found(Some(false)), "no_verdict": found(None) })
        );
        assert!(found(Some(true)) > 0 && found(Some(false)) > 0);
        // A lost tile is computed again, shards make the whole, and nothing is left to do.
        let (name, _) = tiles(directory.path()).into_iter().nth(2).unwrap();
        std::fs::remove_file(directory.path().join("out/s/tiles").join(name)).unwrap();
        std::fs::remove_file(directory.path().join("out/s/map.csv")).unwrap();
        assert!(run(&directory, &[]).out.contains("; 17 were there before"));
        assert!(read(&directory, "map.csv") == table);
        run(&other, &["--shard", "0/2"]);
        run(&other, &["--shard", "1/2"]);
        assert_eq!(squealmap(other.path(), &["merge", "out/s"]).code, Some(0));
        assert!(read(&other, "map.csv") == table);
        assert_eq!(tiles(other.path()), tiles(directory.path()));
        for arguments in [
            &["export", "out/s", "--format", "netcdf"][..],
            &["export", "out/s", "--format", "zarr"],
            &["plot", "out/s", "--quantity", &["bistable", columns[1]].join(",")],
            &["status", "out/s"],
        ] {
            let ended = squealmap(directory.path(), arguments);
            assert_eq!(ended.code, Some(0), "{arguments:?}: {}", ended.err);
        }
    }
}
