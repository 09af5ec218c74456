//! What an earlier version has written is read, or refused by name: `tests/fixtures/format1` is of commit 6b942b1,
//! `format2`, which has checksums of results and description, of 61ea1ad.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use crate::cli::program::{squealmap, unwrapped};
use crate::store::resume::tiles;

/// A copy of a fixture as `out/s`, with its sweep file.
fn copied(format: &str) -> TempDir {
    let fixture = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(format);
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("out/s");
    fs::create_dir_all(out.join("tiles")).unwrap();
    for folder in ["", "tiles"] {
        for entry in fs::read_dir(fixture.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.is_file() {
                fs::copy(&path, out.join(folder).join(path.file_name().unwrap())).unwrap();
            }
        }
    }
    fs::rename(out.join("sweep.toml"), directory.path().join("s.toml")).unwrap();
    directory
}

/// What a fixture is, whichever version reads it; without its picture, which is large.
fn give_the_table_of_their_day(directory: &Path, said_of_results: &str) {
    let csv = fs::read(directory.join("out/s/map.csv")).unwrap();
    let before = tiles(directory);
    assert_eq!(before.len(), 3);
    let exported = squealmap(directory, &["export", "out/s", "--format", "csv", "--output", "again.csv"]);
    assert_eq!(exported.code, Some(0), "{}", exported.err);
    assert!(fs::read(directory.join("again.csv")).unwrap() == csv);
    let status = squealmap(directory, &["status", "out/s", "--verify"]);
    assert!(status.out.contains("tiles      3 of 3 done, 0 in work, 0 bad"), "{}", status.out);
    let said = squealmap(directory, &["verify", "out/s"]);
    assert_eq!(said.code, Some(1));
    assert!(said.out.contains(said_of_results), "{}", said.out);
    assert_eq!(said.out.matches("\nbad ").count(), 1, "{}", said.out);
    let merged = squealmap(directory, &["merge", "out/s"]);
    assert_eq!(merged.code, Some(0), "{}", merged.err);
    assert!(fs::read(directory.join("out/s/map.csv")).unwrap() == csv);
    assert_eq!(squealmap(directory, &["verify", "out/s"]).code, Some(0));
    // A tile with another bit is seen.
    let (name, mut bytes) = before.into_iter().next().unwrap();
    bytes[200] ^= 4;
    fs::write(directory.join("out/s/tiles").join(name), bytes).unwrap();
    assert_eq!(squealmap(directory, &["verify", "out/s"]).code, Some(1));
}

#[test]
fn tiles_of_the_first_format_give_the_table_of_their_day() {
    // Its manifest has no checksums, which is said and is not damage.
    give_the_table_of_their_day(copied("format1").path(), "it is of a version that wrote no checksums");
}

#[test]
fn tiles_of_the_second_format_give_the_table_of_their_day() {
    give_the_table_of_their_day(copied("format2").path(), "`map.png` cannot be read");
}

#[test]
fn its_sweep_is_not_gone_on_with_by_a_version_that_computes_otherwise() {
    let directory = copied("format1");
    let before = tiles(directory.path());
    for (command, words) in [
        (
            &["run", "s.toml", "--backend", "cpu", "--tile", "5"][..],
            "of another sweep, program version or engine",
        ),
        (&["verify", "out/s", "--repair"], "was computed by another version of the program"),
    ] {
        let refused = squealmap(directory.path(), command);
        assert_eq!(refused.code, Some(2), "{command:?}: {}", refused.out);
        assert!(unwrapped(&refused.err).contains(words), "{command:?}: {}", refused.err);
        assert!(tiles(directory.path()) == before, "{command:?}");
    }
}
