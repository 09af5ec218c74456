//! What a newcomer's hands do: a negative value after a flag, tables as spreadsheets write them, names with a slip.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fs;
use std::path::Path;

use crate::cli::program::{squealmap, unwrapped, with_sweep};

/// Points of a constant law, colder than freezing to hot.
const POINTS: &str = "V,mu,temperature\n1,0.3,-20\n2,0.3,-20\n6,0.3,-20\n1,0.5,100\n2,0.5,100\n6,0.5,100\n";

fn fit(points: &[u8], more: &[&str]) -> (Option<i32>, String, String) {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("points.csv"), points).unwrap();
    let arguments = [&["fit", "points.csv", "--friction", "mu", "--law", "constant"], more].concat();
    let ended = squealmap(directory.path(), &arguments);
    let table = fs::read_to_string(directory.path().join("out/points/material.csv")).unwrap_or_default();
    (ended.code, table, ended.err)
}

#[test]
fn negative_values_stand_after_their_flag() {
    for flags in [&["--temperatures", "-20,100"][..], &["--temperatures=-20,100"]] {
        let (code, table, err) = fit(POINTS.as_bytes(), flags);
        assert_eq!(code, Some(0), "{flags:?}: {err}");
        assert!(table.contains("\n-20,0.3") && table.contains("\n100,0.5"), "{table}");
    }
    // A value that may not be negative is answered by its limit, not as an unknown option.
    let directory = with_sweep("");
    for (arguments, words) in [
        (&["fit", "small.toml", "--law-velocity", "-3"][..], "'-3' for '--law-velocity"),
        (&["run", "small.toml", "--threads", "-2"], "-2 is not in 1..=1024"),
        (&["paper", "--ramp-duration", "-1"], "from 0.5 to 100"),
        (&["tradeoff", "small.toml", "--sample", "-5"], "-5 is not in 16..=100000"),
        (&["trace", "small.toml", "--rate", "-10"], "'-10' for '--rate"),
        (&["trace", "small.toml", "--rate", "1e12"], "samples per second from 1 to 4294967295"),
        (&["trace", "small.toml", "--instance", "-1"], "must be a whole number from 0 on"),
        (&["identify", "small.toml", "--window", "-1"], "'-1' for '--window"),
    ] {
        let ended = squealmap(directory.path(), arguments);
        assert_eq!(ended.code, Some(2), "{arguments:?}");
        assert!(ended.err.contains(words), "{arguments:?}: {}", ended.err);
        assert!(!ended.err.contains("unexpected argument"), "{arguments:?}: {}", ended.err);
    }
}

/// `map.csv` of a sweep over the temperatures of a material.
fn with_material(material: &[u8]) -> (Option<i32>, String, String) {
    let directory = tempfile::tempdir().unwrap();
    let sweep = "[friction]\nmaterial = \"pad.csv\"\n[axes]\ntemperature = { values = [100, 150, 200] }\n\
                 belt_velocity = { values = [1, 8] }\n[response]\nsettle = \"2 periods\"\nmeasure = \"2 periods\"\n";
    fs::write(directory.path().join("s.toml"), sweep).unwrap();
    fs::write(directory.path().join("pad.csv"), material).unwrap();
    let ended = squealmap(directory.path(), &["run", "s.toml", "--backend", "cpu"]);
    let table = fs::read_to_string(directory.path().join("out/s/map.csv")).unwrap_or_default();
    (ended.code, table, ended.err)
}

#[test]
fn a_material_is_read_as_spreadsheets_write_it() {
    let plain = with_material(b"temperature,mu_s,mu_d\n100,0.5,0.25\n200,0.75,0.5\n");
    assert_eq!(plain.0, Some(0), "{}", plain.2);
    for written in [
        &b"temperature;mu_s;mu_d\n100;0,5;0,25\n200;0,75;0,5\n"[..],
        b"temperature;mu_s;mu_d\r\n100;0.5;0.25\r\n200;0.75;0.5\r\n",
        b"temperature\tmu_s\tmu_d\n100\t0,5\t0,25\n200\t0,75\t0,5\n",
        b"temperature,mu_s,mu_d\n[\xB0C],-,-\n100,0.5,0.25\n200,0.75,0.5\n",
        "temperature;mu_s;mu_d\n°C;;\n100;0,5;0,25\n200;0,75;0,5\n".as_bytes(),
        b"# in \xB0C\ntemperature,mu_s,mu_d\n100,0.5,0.25\n200,0.75,0.5\n",
    ] {
        let (code, table, err) = with_material(written);
        assert_eq!(code, Some(0), "{}: {err}", String::from_utf8_lossy(written));
        assert!(table == plain.1, "{}", String::from_utf8_lossy(written));
    }
    for (written, words) in [
        (&b"temperature,mu_s,mu_d\n100,0,5,0,25\n"[..], "separate the fields with semicolons"),
        (b"\xFF\xFEt\0e\0m\0p\0", "save it as CSV in UTF-8"),
        // A mistake in a row is none of units.
        (
            b"temperature,mu_s,mu_d\nhot,0.5,0.25\n200,0.75,0.5\n",
            "column `temperature` must be a number, found `hot`",
        ),
        (b"temperature,mu_s,mu_d\n\xB0C,-,-\n", "`°C`"),
    ] {
        let (code, _, err) = with_material(written);
        assert_eq!(code, Some(2), "{}", String::from_utf8_lossy(written));
        assert!(unwrapped(&err).contains(words), "{words}: {err}");
    }
}

#[test]
fn measured_points_may_have_units_and_a_header_in_latin_1() {
    let ends = "--temperatures=-20,100";
    let plain = fit(POINTS.as_bytes(), &[ends]);
    assert_eq!(plain.0, Some(0), "{}", plain.2);
    let with_units = POINTS.replace("temperature\n", "temperature\nm/s,-,degC\n");
    let decimal =
        POINTS.replace(',', ";").replace('.', ",").replace("temperature\n", "temperature\n[m/s];[1/1];[C]\n");
    for (written, flags) in [
        (with_units.as_bytes().to_vec(), &[ends][..]),
        (decimal.into_bytes(), &[ends]),
        ([&b"V,mu,\xB0C\n"[..], &POINTS.as_bytes()[17..]].concat(), &[ends, "--temperature", "°C"]),
    ] {
        let (code, table, err) = fit(&written, flags);
        assert_eq!(code, Some(0), "{}: {err}", String::from_utf8_lossy(&written));
        assert_eq!(table, plain.1);
    }
}

#[test]
fn a_slip_of_a_name_is_answered_with_the_name() {
    let directory = with_sweep("");
    let here = directory.path();
    assert_eq!(squealmap(here, &["run", "small.toml", "--backend", "cpu"]).code, Some(0));
    for (arguments, words) in [
        (&["plot", "out/small", "--quantity", "grwth_rate"][..], "did you mean `growth_rate`?"),
        (&["plot", "out/small", "--quantity", "amplitud"], "did you mean `amplitude`?"),
        (&["plot", "out/small", "--cut", "mud=0.3"], "did you mean `mu_d`?"),
        (&["plot", "out/small", "--cut", "belt_velocty=1"], "did you mean `belt_velocity`?"),
        (&["trace", "small.toml", "--at", "mu_d=0.3,belt_velocty=1"], "did you mean `belt_velocity`?"),
        (&["trace", "small.toml", "--sweep-up-down", "belt_velocty=1..2"], "did you mean `belt_velocity`?"),
        (&["keys", "setle"], "did you mean `settle`?"),
        (&["init", "hysteresys"], "hysteresis"),
        (&["statuz", "out/small"], "'status'"),
    ] {
        let ended = squealmap(here, arguments);
        assert_eq!(ended.code, Some(2), "{arguments:?}: {}", ended.out);
        assert!(unwrapped(&ended.err).contains(words), "{arguments:?}: {}", ended.err);
    }
}

#[test]
fn an_export_makes_the_folder_of_its_file() {
    let directory = with_sweep("");
    let here = directory.path();
    assert_eq!(squealmap(here, &["run", "small.toml", "--backend", "cpu"]).code, Some(0));
    for (format, file) in
        [("netcdf", "no/x.nc"), ("csv", "a/b/x.csv"), ("zarr", "z/x.zarr"), ("parquet", "p/x.parquet")]
    {
        let ended = squealmap(here, &["export", "out/small", "--format", format, "-o", file]);
        assert_eq!(ended.code, Some(0), "{format}: {}", ended.err);
        assert!(here.join(file).exists(), "{file}");
    }
    for (format, file) in
        [("netcdf", "notes.txt"), ("csv", "notes.txt"), ("parquet", "out/small/manifest.json")]
    {
        fs::write(here.join("notes.txt"), "mine").unwrap();
        let before = fs::read(here.join(file)).unwrap();
        let export = ["export", "out/small", "--format", format, "-o", file];
        let ended = squealmap(here, &export);
        assert_eq!(ended.code, Some(2), "{format}: {}", ended.err);
        assert!(
            unwrapped(&ended.err).contains("is there already; name another file with -o"),
            "{}",
            ended.err
        );
        assert_eq!(fs::read(here.join(file)).unwrap(), before);
    }
    let forced = squealmap(here, &["export", "out/small", "--format", "csv", "-o", "notes.txt", "--force"]);
    assert_eq!(forced.code, Some(0), "{}", forced.err);
    let ended = squealmap(here, &["export", "out/small", "--format", "csv", "-o", "out"]);
    assert_eq!(ended.code, Some(2), "{}", ended.err);
    assert!(here.join("out").is_dir());
    fs::write(here.join("taken"), "").unwrap();
    let ended = squealmap(here, &["export", "out/small", "--format", "csv", "-o", "taken/x.csv"]);
    assert_ne!(ended.code, Some(0));
    assert!(ended.err.contains("taken/x.csv"), "{}", ended.err);
    assert!(Path::new(&here.join("taken")).is_file());
}

#[test]
fn a_judgement_from_few_oscillations_says_so() {
    let directory = tempfile::tempdir().unwrap();
    let sweep = "[model]\nm1 = 0.9\nm2 = 0.1\nk1 = 1\nk2 = 1\nf_ext = 1\ntheta = 0\n[friction]\nlaw = \"exponential\"\n\
                 mu_s = 1\nmu_d = 0.5\nstribeck_velocity = 0.5\n[axes]\nbelt_velocity = { values = [0.3, 0.5, 0.7, 3] }\n\
                 [response]\nsettle = \"auto\"\n";
    fs::write(directory.path().join("small.toml"), sweep).unwrap();
    for more in [&["--no-store"][..], &["--store", "table.csv"]] {
        let ended =
            squealmap(directory.path(), &[&["tradeoff", "small.toml", "--sample", "16"], more].concat());
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        assert!(ended.err.contains("settled oscillation(s), too few for a 95th percentile"), "{}", ended.err);
    }
}
