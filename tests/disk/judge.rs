//! What may be left when an operation has failed, and what the same command makes of it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::faulty::Fault;
use crate::scenario::{Scenario, call, operations, place};

/// Every file below a directory with its bytes.
type Files = BTreeMap<PathBuf, Vec<u8>>;

fn files(directory: &Path) -> Files {
    let mut found = Files::new();
    let mut folders = vec![directory.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                found.insert(path.strip_prefix(directory).unwrap().to_owned(), std::fs::read(path).unwrap());
            }
        }
    }
    found
}

fn copy(from: &Files, to: &Path) {
    for (path, bytes) in from {
        let path = to.join(path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    }
}

/// What of a file has to be the same in every run: all but the time of a manifest.
fn lasting(path: &Path, bytes: &[u8]) -> Vec<u8> {
    let is_document = path.extension().is_some_and(|end| end == "json");
    match serde_json::from_slice::<serde_json::Value>(bytes) {
        Ok(mut document) if is_document && document.get("computation").is_some() => {
            let computation = document["computation"].as_object_mut().unwrap();
            for time in ["elapsed_seconds", "instances_per_second", "threads"] {
                computation.remove(time);
            }
            document.as_object_mut().unwrap().remove("checksum");
            serde_json::to_vec(&document).unwrap()
        }
        _ => bytes.to_vec(),
    }
}

/// Why what is left may not be left; `None` where it may.
fn lie(left: &Files, before: &Files, end: &Files) -> Option<String> {
    for (path, bytes) in before {
        let name = path.to_string_lossy();
        if name.ends_with(".tile") && left.get(path) != Some(bytes) {
            return Some(format!("`{name}`, a finished tile, is lost or altered"));
        }
    }
    let same = |path: &Path, of: &Files| {
        let [one, two] = [left.get(path), of.get(path)].map(|bytes| bytes.map(|bytes| lasting(path, bytes)));
        one.is_some() && one == two
    };
    // Files of a trace are those of one call.
    let only = |of: &Files, other: &Files| {
        let is_only =
            |path: &&PathBuf| is_of_trace(path) && same(path, of) && of.get(*path) != other.get(*path);
        left.keys().find(is_only)
    };
    if let (Some(now), Some(then)) = (only(end, before), only(before, end)) {
        return Some(format!(
            "`{}` of this call stands beside `{}` of another",
            now.display(),
            then.display()
        ));
    }
    for (path, bytes) in left {
        let name = path.to_string_lossy();
        if name.contains("/bad/") {
            return Some(format!("`{name}` was set aside"));
        }
        // What has the name of a file is that file, whole: of this run, or of before.
        let is_half = name.ends_with(".part")
            || name.ends_with(".some")
            || name.contains(".part/")
            || name.contains(".old/");
        let is_zarr = name.contains(".zarr/");
        if !is_half && !is_zarr && !same(path, end) && !same(path, before) {
            // Results of a part of the tiles say so.
            let manifest = serde_json::from_slice::<serde_json::Value>(bytes).unwrap_or_default();
            if manifest["complete"] != false {
                return Some(format!(
                    "`{name}` is neither what it is in the end nor what it was ({} bytes)",
                    bytes.len()
                ));
            }
        }
        // What was there before the command is none of its lies.
        if name.ends_with("manifest.json") && before.get(path) != Some(bytes) {
            let manifest: serde_json::Value = serde_json::from_slice(bytes).unwrap_or_default();
            let folder = path.parent().unwrap();
            for file in ["map.csv", "map.svg", "map.png"] {
                if manifest["complete"] == true && same(path, end) && !same(&folder.join(file), end) {
                    return Some(format!(
                        "the manifest says complete, and `{file}` is not what it is in the end"
                    ));
                }
            }
        }
        // A document of before that did not fit then is none of its lies.
        let was_unlike = || before.get(path) == Some(bytes) && unlike(path, bytes, before).is_some();
        if name.ends_with("refine.json")
            && !was_unlike()
            && let Some(why) = unlike(path, bytes, left)
        {
            return Some(why);
        }
        // The metadata of a group say that all of it is there.
        if name.ends_with(".zarr/zarr.json") && !is_half {
            let group = path.parent().unwrap();
            if let Some((lost, _)) =
                end.iter().find(|(path, bytes)| path.starts_with(group) && left.get(*path) != Some(bytes))
            {
                return Some(format!(
                    "`{name}` is there, and `{}` is not what it is in the end",
                    lost.display()
                ));
            }
        }
    }
    None
}

fn is_of_trace(path: &Path) -> bool {
    path.file_stem().is_some_and(|stem| stem == "trace")
}

/// Why files and parts beside a `refine.json` are not those that it names.
fn unlike(path: &Path, bytes: &[u8], left: &Files) -> Option<String> {
    let document: serde_json::Value = serde_json::from_slice(bytes).unwrap_or_default();
    let (Some(files), Some(parts)) = (document["files"].as_object(), document["parts"].as_object()) else {
        return Some("`refine.json` names no files or no parts".to_owned());
    };
    let folder = path.parent().unwrap();
    let file = |(name, said): (&String, &serde_json::Value)| {
        let found = left.get(&folder.join(name));
        let is_named = found.is_some_and(|found| {
            said["bytes"] == found.len() && said["blake3"] == blake3::hash(found).to_hex().as_str()
        });
        (!is_named).then(|| format!("`{name}` is not the file that `refine.json` names"))
    };
    // A part ends with its checksum and 8 bytes more.
    let part = |(name, said): (&String, &serde_json::Value)| {
        let found = left.get(&folder.join("parts").join(name));
        let content = found.and_then(|found| found.get(..found.len().checked_sub(40)?));
        let is_named = content.is_some_and(|content| *said == blake3::hash(content).to_hex().as_str());
        (!is_named).then(|| format!("`{name}` is not the part that `refine.json` names"))
    };
    files.iter().find_map(file).or_else(|| parts.iter().find_map(part))
}

/// Whether two directories hold the same.
fn difference(found: &Files, wanted: &Files) -> Option<String> {
    let name = |path: &PathBuf| path.display().to_string();
    if let Some(path) = wanted.keys().find(|path| !found.contains_key(*path)) {
        return Some(format!("`{}` is not there", name(path)));
    }
    if let Some(path) = found.keys().find(|path| !wanted.contains_key(*path)) {
        return Some(format!("`{}` is left", name(path)));
    }
    let differs =
        |(path, bytes): &(&PathBuf, &Vec<u8>)| lasting(path, bytes) != lasting(path, &wanted[*path]);
    found.iter().find(differs).map(|(path, _)| format!("`{}` differs", name(path)))
}

/// Makes every operation of a command fail, in one way each or in all.
pub(crate) fn judge(scenario: Scenario, all: bool) -> Result<(), String> {
    let command = scenario.command();
    let prepared = place();
    scenario.prepare(prepared.path());
    let before = files(prepared.path());
    let count = operations(prepared.path(), command);
    let end = files(prepared.path());
    let (mut injected, mut ended_well) = (0, 0);
    for at in 1..=count {
        let turn = usize::try_from(at).unwrap() % Fault::ALL.len();
        for (number, fault) in Fault::ALL.into_iter().enumerate() {
            if !all && number != turn {
                continue;
            }
            let directory = place();
            copy(&before, directory.path());
            let ended = call(directory.path(), command, fault, at);
            injected += 1;
            let left = files(directory.path());
            let err = String::from_utf8_lossy(&ended.stderr).into_owned();
            let said = |why: String| format!("{command}, {fault:?} at {at} of {count}: {why}\n{err}");
            let code = ended.status.code();
            if code.is_none_or(|code| code == 101) || err.contains("panicked") {
                return Err(said(format!("it ended with {:?}", ended.status)));
            }
            if let Some(why) = lie(&left, &before, &end) {
                return Err(said(why));
            }
            if code == Some(0) {
                ended_well += 1;
                if let Some(why) = difference(&left, &end) {
                    return Err(said(format!("exit code 0, and {why}")));
                }
            }
            let again = call(directory.path(), command, Fault::None, 0);
            if !again.status.success() {
                return Err(said(format!("again: {}", String::from_utf8_lossy(&again.stderr))));
            }
            if let Some(why) = difference(&files(directory.path()), &end) {
                return Err(said(format!("after the same command again {why}")));
            }
        }
    }
    println!("{}: {injected} faults at {count} operations; {ended_well} times it went on", scenario.name());
    Ok(())
}

/// A check of a check.
type Plant = fn() -> Result<(), String>;

/// The judge turns red on planted faults.
pub(crate) const PLANTED: [(&str, Plant); 2] =
    [("lies_are_seen", lies_are_seen), ("a_crash_forgets_what_was_not_synced", a_crash_forgets)];

fn lies_are_seen() -> Result<(), String> {
    let of = |entries: &[(&str, &str)]| -> Files {
        entries.iter().map(|(path, bytes)| (PathBuf::from(path), bytes.as_bytes().to_vec())).collect()
    };
    let end = of(&[
        ("out/s/tiles/1.tile", "tile"),
        ("out/s/map.csv", "a,b"),
        ("out/s/map.svg", "<svg>"),
        ("out/s/map.png", "png"),
        ("out/s/manifest.json", "{\"complete\":true}"),
        ("out/s/map.zarr/zarr.json", "{}"),
        ("out/s/map.zarr/c/0", "12"),
    ]);
    let none = Files::new();
    assert_eq!(lie(&end, &none, &end), None);
    assert_eq!(difference(&end, &end), None);
    let plants: [(&str, Option<&str>); 8] = [
        ("out/s/tiles/1.tile", Some("ti")),
        ("out/s/map.csv", Some("a,")),
        ("out/s/map.csv", None),
        ("out/s/map.png", None),
        ("out/s/manifest.json", Some("{\"complete\":tr")),
        ("out/s/map.zarr/c/0", None),
        ("out/s/map.zarr/c/0", Some("1")),
        ("out/s/tiles/bad/1.tile", Some("tile")),
    ];
    for (path, bytes) in plants {
        let mut left = end.clone();
        match bytes {
            Some(bytes) => drop(left.insert(path.into(), bytes.as_bytes().to_vec())),
            None => drop(left.remove(Path::new(path))),
        }
        if lie(&left, &none, &end).is_none() || difference(&left, &end).is_none() {
            return Err(format!("`{path}` as {bytes:?} was not seen"));
        }
    }
    let [then, mixed, now] = [["a", "a"], ["b", "a"], ["b", "b"]]
        .map(|[table, figure]| of(&[("out/s/trace.csv", table), ("out/s/trace.svg", figure)]));
    assert_eq!(lie(&now, &then, &now), None);
    if lie(&mixed, &then, &now).is_none() {
        return Err("a figure beside the table of another trace was not seen".to_owned());
    }
    let none_named = unlike(Path::new("out/s/refine.json"), b"{}", &none);
    if none_named.is_none() {
        return Err("a `refine.json` that names nothing was not seen".to_owned());
    }
    let sum = |bytes: &str| blake3::hash(bytes.as_bytes()).to_hex().to_string();
    let document = serde_json::json!({
        "files": { "points.csv": { "bytes": 3, "blake3": sum("a,b") } }, "parts": { "1.tile": sum("part") },
    });
    let part = format!("part{}", "-".repeat(40));
    let refined = of(&[
        ("out/s/points.csv", "a,b"),
        ("out/s/parts/1.tile", &part),
        ("out/s/refine.json", &document.to_string()),
    ]);
    assert_eq!(lie(&refined, &none, &refined), None);
    // Each is what it was before: only what the document says of it does not fit.
    for (path, bytes) in
        [("out/s/points.csv", "a,c"), ("out/s/parts/1.tile", "tarp"), ("out/s/points.csv", "a,")]
    {
        let mut left = refined.clone();
        left.insert(path.into(), bytes.as_bytes().to_vec());
        let before = of(&[(path, bytes)]);
        if lie(&left, &before, &refined).is_none() {
            return Err(format!("`{path}` as {bytes:?} was not seen"));
        }
    }
    let lost = of(&[("out/s/map.csv", "a,b")]);
    lie(&lost, &end, &end).map(drop).ok_or_else(|| "a lost tile was not seen".to_owned())
}

/// The disk itself: of a file that was renamed before it was synced, nothing is left.
fn a_crash_forgets() -> Result<(), String> {
    use squealmap::disk::Disk;

    let directory = tempfile::tempdir().unwrap();
    let disk = crate::faulty::Faulty::watching();
    let (one, two) = (directory.path().join("one"), directory.path().join("two"));
    std::fs::write(&two, "before").unwrap();
    let file = disk.open(&one, squealmap::disk::How::Write).unwrap();
    disk.write(&file, &one, b"after").unwrap();
    disk.rename(&one, &two).unwrap();
    disk.forget(true);
    let found = std::fs::read_to_string(&two).unwrap();
    if found != "before" || one.exists() {
        return Err(format!("`two` is {found:?}, and `one` is there: {}", one.exists()));
    }
    let file = disk.open(&one, squealmap::disk::How::Write).unwrap();
    disk.write(&file, &one, b"after").unwrap();
    disk.sync(&file, &one).unwrap();
    disk.rename(&one, &two).unwrap();
    disk.sync_folder(directory.path()).unwrap();
    disk.forget(true);
    let found = std::fs::read_to_string(&two).unwrap();
    if found == "after" { Ok(()) } else { Err(format!("what was synced is lost: {found:?}")) }
}
