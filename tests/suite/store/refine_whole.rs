//! A refined directory says what its results are: what was damaged is seen, named and put right.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::{Path, PathBuf};

use serde_json::Value as Json;
use tempfile::TempDir;

use crate::cli::program::{squealmap, unwrapped};
use crate::store::refine_parts::{FILES, REFINE, SWEEP, arguments, parts, results, undisturbed, with};

/// All that the document names.
const NAMED: [&str; 4] = ["boundaries.csv", "points.csv", "refined.png", "refined.svg"];

fn verify(directory: &Path) -> crate::cli::program::Ended {
    squealmap(directory, &["verify", "out/s"])
}

fn repair(directory: &Path) -> crate::cli::program::Ended {
    squealmap(directory, &["verify", "out/s", "--repair", "--threads", "1"])
}

fn document(directory: &Path) -> Json {
    serde_json::from_slice(&std::fs::read(directory.join("out/s/refine.json")).unwrap()).unwrap()
}

/// What asked for the parts.
fn askers(directory: &Path) -> Vec<PathBuf> {
    let entries =
        std::fs::read_dir(directory.join("out/s/parts")).unwrap().flatten().map(|entry| entry.path());
    entries.filter(|path| path.extension().is_some_and(|end| end == "json")).collect()
}

/// Results, parts and what asked for them.
type All = (Vec<Vec<u8>>, Vec<(PathBuf, Vec<u8>)>, Vec<Vec<u8>>);

/// All that has to be the same whatever has happened.
fn all(directory: &Path) -> All {
    let askers = askers(directory).into_iter().map(|path| std::fs::read(path).unwrap()).collect();
    (results(directory), parts(directory), askers)
}

fn without_sweep(directory: &TempDir) -> &Path {
    std::fs::remove_file(directory.path().join("s.toml")).unwrap();
    directory.path()
}

#[test]
fn it_names_every_file_and_every_part() {
    let directory = undisturbed();
    let said = document(directory.path());
    // By the hash's own library, not by what wrote them.
    for name in NAMED {
        let bytes = std::fs::read(directory.path().join("out/s").join(name)).unwrap();
        assert_eq!(said["files"][name]["blake3"], blake3::hash(&bytes).to_hex().as_str(), "{name}");
        assert_eq!(said["files"][name]["bytes"], bytes.len(), "{name}");
    }
    assert_eq!(said["files"].as_object().unwrap().len(), NAMED.len());
    let there = parts(directory.path());
    assert_eq!(said["parts"].as_object().unwrap().len(), there.len());
    for (name, bytes) in &there {
        // The last 40 bytes are the checksum of those before, and 8 that end the file.
        let (content, _) = bytes.split_at(bytes.len() - 40);
        assert_eq!(said["parts"][name.to_str().unwrap()], blake3::hash(content).to_hex().as_str());
    }
    let good = verify(directory.path());
    assert_eq!(good.code, Some(0), "{}", good.out);
    let counted =
        format!("parts        {} of {} instances are there and good, 0 bad\n", there.len(), said["computed"]);
    assert!(good.out.contains(&counted), "{}", good.out);
    assert!(
        good.out.contains("results      good, and those of the parts that `refine.json` names\n"),
        "{}",
        good.out
    );
    assert!(!good.out.contains("tile"), "{}", good.out);
}

#[test]
fn every_damage_is_seen_named_and_healed() {
    let directory = undisturbed();
    let wanted = all(directory.path());
    let out = directory.path().join("out/s");
    let part = Path::new("parts").join(&wanted.1[7].0);
    let asker = Path::new("parts").join(askers(directory.path())[0].file_name().unwrap());
    let text = std::fs::read(directory.path().join("s.toml")).unwrap();
    let mut turn = 0;
    for name in FILES.iter().map(Path::new).chain([&*part, &*asker]) {
        let path = out.join(name);
        let whole = std::fs::read(&path).unwrap();
        let middle = whole.len() / 2;
        let mut flipped = whole.clone();
        flipped[middle] ^= 1;
        let damages = [
            ("cut", Some(&whole[..middle])),
            ("one bit", Some(&flipped)),
            ("empty", Some(&[])),
            ("lost", None),
        ];
        for (how, bytes) in damages {
            let name = name.display();
            bytes.map_or_else(|| std::fs::remove_file(&path), |bytes| std::fs::write(&path, bytes)).unwrap();
            // What compares below sees each of them, too.
            assert!(how == "lost" || all(directory.path()) != wanted, "{name}, {how}");
            let said = verify(directory.path());
            assert_eq!(said.code, Some(1), "{name}, {how}: {}", said.out);
            let bad =
                said.out.lines().find(|line| line.starts_with("bad ") && line.contains(&format!("`{name}`")));
            assert!(bad.is_some(), "{name}, {how}: {}", said.out);
            assert!(said.err.contains("with --repair to put out/s right"), "{name}, {how}: {}", said.err);
            // In turn by the two commands that put it right, one of which has no sweep file.
            turn += 1;
            let again = if turn % 2 == 0 {
                squealmap(directory.path(), &arguments(&REFINE))
            } else {
                std::fs::remove_file(directory.path().join("s.toml")).unwrap();
                repair(directory.path())
            };
            std::fs::write(directory.path().join("s.toml"), &text).unwrap();
            assert_eq!(again.code, Some(0), "{name}, {how}: {}", again.err);
            assert!(all(directory.path()) == wanted, "{name}, {how}");
            let healed = verify(directory.path());
            assert_eq!(healed.code, Some(0), "{name}, {how}: {}", healed.out);
        }
    }
    assert_eq!(turn, 28);
}

#[test]
fn many_damages_at_once_are_healed_without_the_sweep_file() {
    let directory = undisturbed();
    let wanted = all(directory.path());
    let out = directory.path().join("out/s");
    // No part is there, nor what asked for them.
    std::fs::remove_dir_all(out.join("parts")).unwrap();
    std::fs::write(out.join("points.csv"), "instance\n").unwrap();
    let said = verify(without_sweep(&directory));
    assert_eq!(said.code, Some(1), "{}", said.out);
    assert_eq!(said.out.matches(".tile`, which `refine.json` names, is not there").count(), wanted.1.len());
    assert_eq!(repair(directory.path()).code, Some(0));
    assert!(all(directory.path()) == wanted);
    // As a refinement that was killed leaves it: half the parts, no results.
    for name in FILES {
        std::fs::remove_file(out.join(name)).unwrap();
    }
    for (name, _) in &wanted.1[..wanted.1.len() / 2] {
        std::fs::remove_file(out.join("parts").join(name)).unwrap();
    }
    let said = verify(directory.path());
    assert_eq!(said.code, Some(0), "{}", said.out);
    assert!(said.out.contains("results      none are written\n"), "{}", said.out);
    assert_eq!(repair(directory.path()).code, Some(0));
    assert!(all(directory.path()) == wanted);
    // A damaged part of another sweep, too, which no repair computes.
    std::fs::write(out.join("parts/12345678-0123456789abcdef.tile"), "no part").unwrap();
    assert_eq!(verify(directory.path()).code, Some(1));
    let repaired = repair(directory.path());
    assert!(unwrapped(&repaired.err).contains("it is no tile of this format"), "{}", repaired.err);
    assert_eq!(verify(directory.path()).code, Some(0));
}

#[test]
fn a_part_of_another_engine_is_not_the_one_that_is_named() {
    let directory = undisturbed();
    let wanted = all(directory.path());
    let folder = directory.path().join("out/s/parts");
    // A good part, but not this one.
    std::fs::write(folder.join(&wanted.1[3].0), &wanted.1[4].1).unwrap();
    let said = verify(directory.path());
    assert_eq!(said.code, Some(1), "{}", said.out);
    let name = wanted.1[3].0.display();
    assert!(
        said.out.contains(&format!("`parts/{name}` is another part than `refine.json` names")),
        "{}",
        said.out
    );
    assert_eq!(repair(directory.path()).code, Some(0));
    assert!(all(directory.path()) == wanted);
}

#[test]
fn sweeps_of_every_kind_are_refined_again_from_their_directory() {
    let small = SWEEP.replace("points = 65", "points = 9").replace("20 periods", "2 periods");
    let start = "box_displacement_from = -0.1\nbox_displacement_to = 0.1\nbox_velocity_from = 0\nbox_velocity_to = 1\n";
    for text in [
        small.replace("settle = \"2 periods\"", "settle = \"auto\"") + "[start]\nkind = \"both\"\n",
        format!("{small}[start]\nkind = \"box\"\nbox_samples = 3\n{start}"),
        format!("title = \"Lines\"\nanalysis = [\"linear\"]\n{}", small.split("[response]").next().unwrap()),
    ] {
        let directory = with(&text);
        let refine =
            ["refine", "s.toml", "--coarse", "4", "--sample", "5", "--backend", "cpu", "--precision", "f32"];
        let ended = squealmap(directory.path(), &refine);
        assert_eq!(ended.code, Some(0), "{text}: {}", ended.err);
        let wanted = all(directory.path());
        std::fs::remove_file(directory.path().join("out/s/parts").join(&wanted.1[0].0)).unwrap();
        std::fs::write(directory.path().join("out/s/refine.json"), "{}").unwrap();
        let repaired = repair(without_sweep(&directory));
        assert_eq!(repaired.code, Some(0), "{text}: {}", repaired.err);
        assert!(all(directory.path()) == wanted, "{text}");
    }
}

#[test]
fn results_of_an_earlier_version_are_not_called_good() {
    let directory = undisturbed();
    let wanted = all(directory.path());
    let out = directory.path().join("out/s");
    let mut old = document(directory.path());
    for key in ["sweep", "parts", "files", "checksum"] {
        old.as_object_mut().unwrap().remove(key).unwrap();
    }
    std::fs::write(out.join("refine.json"), format!("{old:#}\n")).unwrap();
    std::fs::remove_file(&askers(directory.path())[0]).unwrap();
    let said = verify(directory.path());
    assert_eq!(said.code, Some(1), "{}", said.out);
    let line = said.out.lines().find(|line| line.contains("of an earlier version")).unwrap_or_default();
    assert!(
        NAMED.iter().all(|name| line.contains(&format!("`{name}`"))) && line.contains("`parts`"),
        "{}",
        said.out
    );
    // Nothing in it says how it was refined.
    let command = "`squealmap refine SWEEP.toml -o out/s` again";
    assert!(unwrapped(&said.err).contains(command), "{}", said.err);
    let refused = repair(directory.path());
    assert_eq!(refused.code, Some(2), "{}", refused.out);
    assert!(unwrapped(&refused.err).contains(command), "{}", refused.err);
    assert_eq!(squealmap(directory.path(), &["plot", "out/s"]).code, Some(0), "it is drawn all the same");
    assert_eq!(squealmap(directory.path(), &arguments(&REFINE)).code, Some(0));
    assert!(all(directory.path()) == wanted);
}

#[test]
fn no_figure_is_drawn_of_damaged_points() {
    let directory = undisturbed();
    let out = directory.path().join("out/s");
    let points = std::fs::read_to_string(out.join("points.csv")).unwrap();
    let lines = std::fs::read_to_string(out.join("refine.json")).unwrap();
    let plot = || squealmap(directory.path(), &["plot", "out/s"]);
    // Tables and documents like any other, but for their checksums.
    for (name, whole, bad, says) in [
        (
            "points.csv",
            &points,
            points.replacen(",slip,", ",stick_slip,", 1),
            "it is not the file that refine.json names",
        ),
        ("refine.json", &lines, lines.replacen("0.6", "0.7", 1), "its content does not have its checksum"),
    ] {
        assert!(bad != *whole, "{name}");
        std::fs::write(out.join(name), bad).unwrap();
        let refused = plot();
        assert_eq!(refused.code, Some(2), "{name}: {}", refused.err);
        let err = unwrapped(&refused.err);
        assert!(err.contains(name) && err.contains(says), "{err}");
        assert!(!out.join("plot.svg").exists(), "{name}");
        std::fs::write(out.join(name), whole).unwrap();
    }
    assert_eq!(plot().code, Some(0));
}

#[test]
fn a_directory_of_both_is_verified_and_repaired_as_both() {
    let small = SWEEP.replace("points = 65", "points = 9").replace("20 periods", "2 periods");
    let directory = with(&small);
    for command in [&["run", "s.toml", "--backend", "cpu"][..], &REFINE] {
        assert_eq!(squealmap(directory.path(), command).code, Some(0));
    }
    let good = verify(directory.path());
    assert_eq!(good.code, Some(0), "{}", good.out);
    assert!(good.out.contains("results      good, and those of all tiles\n"), "{}", good.out);
    assert!(good.out.contains("results      good, and those of the parts"), "{}", good.out);
    let damaged = ["map.csv", "points.csv"].map(|name| directory.path().join("out/s").join(name));
    let before = damaged.each_ref().map(|path| std::fs::read(path).unwrap());
    for path in &damaged {
        std::fs::write(path, "instance\n").unwrap();
    }
    let said = verify(directory.path());
    assert!(said.out.contains("`map.csv`") && said.out.contains("`points.csv`"), "{}", said.out);
    assert_eq!(repair(without_sweep(&directory)).code, Some(0));
    assert!(damaged.each_ref().map(|path| std::fs::read(path).unwrap()) == before);
    assert_eq!(verify(directory.path()).code, Some(0));
}
