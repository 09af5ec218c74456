//! Zarr and NetCDF, read here byte by byte as their specifications have it, against `map.csv`.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::Value as Json;

use crate::cli::program::{squealmap, unwrapped};
use crate::results::netcdf_file::netcdf;
use crate::store::resume::{SWEEP, with};

/// The columns of `map.csv`.
fn table(directory: &Path) -> BTreeMap<String, Vec<String>> {
    let mut reader = csv::Reader::from_path(directory.join("out/s/map.csv")).unwrap();
    let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    names
        .into_iter()
        .enumerate()
        .map(|(k, name)| (name, rows.iter().map(|row| row[k].to_owned()).collect()))
        .collect()
}

/// The cells that a variable should have as text: numbers, or names by the codes of its attributes.
fn cells(values: &[f64], flags: Option<(&[f64], &str)>, settled: bool) -> Vec<String> {
    let number = |value: &f64| if value.is_nan() { String::new() } else { value.to_string() };
    let Some((codes, meanings)) = flags else { return values.iter().map(number).collect() };
    let names: Vec<&str> = meanings.split(' ').collect();
    assert_eq!(names.len(), codes.len());
    let name = |value: &f64| {
        let name = names[codes.iter().position(|code| code.to_bits() == value.to_bits()).unwrap()];
        match (name, settled) {
            ("undefined", _) => "",
            ("no", true) => "0",
            ("yes", true) => "1",
            (name, _) => name,
        }
        .to_owned()
    };
    values.iter().map(name).collect()
}

/// Compares text that may stand for numbers.
fn same(name: &str, found: &[String], wanted: &[String]) -> Result<(), String> {
    if found.len() != wanted.len() {
        return Err(format!("{name}: {} of {} values", found.len(), wanted.len()));
    }
    for (row, (found, wanted)) in found.iter().zip(wanted).enumerate() {
        let bits = |text: &str| text.parse::<f64>().map(f64::to_bits);
        if found != wanted && (bits(found).is_err() || bits(found) != bits(wanted)) {
            return Err(format!("{name}, row {row}: `{found}` instead of `{wanted}`"));
        }
    }
    Ok(())
}

/// One array of a Zarr group in the order of the grid, with its metadata.
fn zarr_array(group: &Path, name: &str) -> (Vec<f64>, Json) {
    let metadata: Json =
        serde_json::from_slice(&std::fs::read(group.join(name).join("zarr.json")).unwrap()).unwrap();
    let list = |value: &Json| {
        value
            .as_array()
            .unwrap()
            .iter()
            .map(|n| usize::try_from(n.as_u64().unwrap()).unwrap())
            .collect::<Vec<_>>()
    };
    let (shape, chunk) =
        (list(&metadata["shape"]), list(&metadata["chunk_grid"]["configuration"]["chunk_shape"]));
    let fill = metadata["fill_value"].as_f64().unwrap_or(f64::NAN);
    let width = match metadata["data_type"].as_str().unwrap() {
        "float64" => 8,
        "int32" => 4,
        "int8" => 1,
        other => panic!("{other}"),
    };
    let element = |index: usize| {
        let mut rest = index;
        let mut at: Vec<usize> = shape
            .iter()
            .rev()
            .map(|n| {
                let k = rest % n;
                rest /= n;
                k
            })
            .collect();
        at.reverse();
        let key: Vec<String> = at.iter().zip(&chunk).map(|(k, n)| (k / n).to_string()).collect();
        let Ok(bytes) = std::fs::read(group.join(name).join("c").join(key.join("/"))) else { return fill };
        assert_eq!(bytes.len(), width * chunk.iter().product::<usize>(), "{name}");
        let inside = at.iter().zip(&chunk).fold(0, |sum, (k, n)| sum * n + k % n);
        let bytes = &bytes[width * inside..][..width];
        match width {
            8 => f64::from_le_bytes(bytes.try_into().unwrap()),
            4 => f64::from(i32::from_le_bytes(bytes.try_into().unwrap())),
            _ => f64::from(i8::from_le_bytes(bytes.try_into().unwrap())),
        }
    };
    ((0..shape.iter().product()).map(element).collect(), metadata)
}

/// Compares all computed columns with a group.
fn compare_zarr(directory: &Path) -> Result<(), String> {
    let group = directory.join("out/s/map.zarr");
    let table = table(directory);
    let mut compared = 0;
    for (name, wanted) in
        table.iter().filter(|(name, _)| !["instance", "mu_d", "belt_velocity"].contains(&name.as_str()))
    {
        let (values, metadata) = zarr_array(&group, name);
        let attributes = &metadata["attributes"];
        let codes: Option<Vec<f64>> =
            attributes["flag_values"].as_array().map(|codes| codes.iter().filter_map(Json::as_f64).collect());
        let flags = codes.as_ref().map(|codes| (&codes[..], attributes["flag_meanings"].as_str().unwrap()));
        same(name, &cells(&values, flags, name == "settled"), wanted)?;
        if metadata["dimension_names"] != serde_json::json!(["mu_d", "belt_velocity"]) {
            return Err(format!("{name}: {}", metadata["dimension_names"]));
        }
        compared += 1;
    }
    if compared < 25 { Err(format!("{compared} columns")) } else { Ok(()) }
}

const RUN: [&str; 6] = ["run", "s.toml", "--backend", "cpu", "--tile", "32"];

#[test]
fn zarr_holds_what_the_table_holds() {
    let directory = with(SWEEP);
    squealmap(directory.path(), &RUN);
    let ended = squealmap(directory.path(), &["export", "out/s", "--format", "zarr"]);
    assert_eq!((ended.code, ended.out.as_str()), (Some(0), "wrote out/s/map.zarr\n"), "{}", ended.err);
    compare_zarr(directory.path()).unwrap();
    let group = directory.path().join("out/s/map.zarr");
    let (values, metadata) = zarr_array(&group, "belt_velocity");
    assert_eq!(
        (values[0].to_bits(), values[19].to_bits(), values.len()),
        (1_f64.to_bits(), 8_f64.to_bits(), 20)
    );
    assert_eq!(
        (&metadata["attributes"]["units"], &metadata["dimension_names"][0]),
        (&"m/s".into(), &"belt_velocity".into())
    );
    // 20 values of the last axis and one of the first: at most a tile of 32.
    assert_eq!(
        zarr_array(&group, "growth_rate").1["chunk_grid"]["configuration"]["chunk_shape"],
        serde_json::json!([1, 20])
    );
    // Again in its place; then a planted fault, which the comparison sees.
    assert_eq!(squealmap(directory.path(), &["export", "out/s", "--format", "zarr"]).code, Some(0));
    let chunk = group.join("growth_rate/c/3/0");
    let mut bytes = std::fs::read(&chunk).unwrap();
    bytes[8] ^= 1;
    std::fs::write(&chunk, bytes).unwrap();
    assert!(compare_zarr(directory.path()).unwrap_err().starts_with("growth_rate, row 61: "));
}

#[test]
fn missing_tiles_are_not_computed_in_every_format() {
    let directory = with(SWEEP);
    squealmap(directory.path(), &[&RUN[..], &["--shard", "1/3"]].concat());
    let out = directory.path().join("out/s");
    for (format, ending) in [("csv", "csv"), ("zarr", "zarr"), ("netcdf", "nc")] {
        let ended = squealmap(directory.path(), &["export", "out/s", "--format", format]);
        assert_eq!(ended.code, Some(2));
        assert_eq!(
            ended.err,
            "error: `out/s` holds 3 of 10 tiles; run the sweep to its end, or add --partial for what is there\n"
        );
        let ended = squealmap(directory.path(), &["export", "out/s", "--format", format, "--partial"]);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        assert_eq!(ended.err, "3 of 10 tiles are there; the rest is `not_computed`\n");
        // Not where the whole map would stand, which a manifest may call complete; nor by name.
        let whole = format!("out/s/map.{ending}");
        assert!(!directory.path().join(&whole).exists());
        let named = ["export", "out/s", "--format", format, "--partial", "--output", &whole];
        let ended = squealmap(directory.path(), &named);
        assert_eq!(ended.code, Some(2), "{}", ended.out);
        assert!(unwrapped(&ended.err).contains("is where the whole map belongs"), "{}", ended.err);
        assert!(!directory.path().join(&whole).exists());
        std::fs::rename(out.join(format!("partial.{ending}")), directory.path().join(whole)).unwrap();
    }
    let status = &table(directory.path())["status"];
    assert_eq!(status.iter().filter(|status| *status == "not_computed").count(), 300 - 3 * 32);
    compare_zarr(directory.path()).unwrap();
    compare_netcdf(directory.path()).unwrap();
}

/// Compares all computed columns with a file.
fn compare_netcdf(directory: &Path) -> Result<(), String> {
    let variables = netcdf(&directory.join("out/s/map.nc"), "Tiles");
    let table = table(directory);
    if variables.len() != table.len() - 1 {
        return Err(format!("{} variables", variables.len()));
    }
    for (name, (dimensions, attributes, values)) in &variables {
        if name == "mu_d" || name == "belt_velocity" {
            continue;
        }
        assert_eq!(dimensions, &["mu_d", "belt_velocity"]);
        let codes: Option<Vec<f64>> = attributes
            .get("flag_values")
            .map(|codes| codes.split(' ').map(|code| code.parse().unwrap()).collect());
        let flags = codes.as_ref().map(|codes| (&codes[..], attributes["flag_meanings"].as_str()));
        same(name, &cells(values, flags, name == "settled"), &table[name])?;
    }
    Ok(())
}

#[test]
fn netcdf_holds_what_the_table_holds() {
    let directory = with(SWEEP);
    squealmap(directory.path(), &RUN);
    let ended = squealmap(directory.path(), &["export", "out/s", "--format", "netcdf"]);
    assert_eq!((ended.code, ended.out.as_str()), (Some(0), "wrote out/s/map.nc\n"), "{}", ended.err);
    compare_netcdf(directory.path()).unwrap();
    let path = directory.path().join("out/s/map.nc");
    let variables = netcdf(&path, "Tiles");
    let (dimensions, attributes, values) = &variables["belt_velocity"];
    assert_eq!(
        (dimensions.as_slice(), attributes["units"].as_str()),
        (&["belt_velocity".to_owned()][..], "m/s")
    );
    assert_eq!((values[0].to_bits(), values[19].to_bits()), (1_f64.to_bits(), 8_f64.to_bits()));
    assert_eq!(variables["growth_rate"].1["units"], "1/s");
    let mut bytes = std::fs::read(&path).unwrap();
    let last = bytes.len() - 301;
    bytes[last] ^= 1;
    std::fs::write(&path, bytes).unwrap();
    assert!(compare_netcdf(directory.path()).is_err());
}
