//! The house has floors: an import points down, and no circle of imports ties folders or the files of a folder together.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The floors of `src`, from below; of two on one floor neither knows the other.
const FLOORS: [&[&str]; 9] = [
    &["disk", "version"],
    &["model"],
    &["engine"],
    &["sweep"],
    &["store", "cluster"],
    &["results"],
    &["study"],
    &["error"],
    &["cli"],
];

/// The crates beside, each with those that it may use.
const CRATES: [(&str, &str, &[&str]); 6] = [
    ("input", "squealmap_input", &[]),
    ("figure", "squealmap_figure", &[]),
    ("identify", "squealmap_identify", &["squealmap_input"]),
    ("fem", "squealmap_fem", &[]),
    ("explorer", "squealmap_explorer", &["squealmap"]),
    (
        "python",
        "squealmap_python",
        &["squealmap", "squealmap_fem", "squealmap_figure", "squealmap_identify", "squealmap_input"],
    ),
];

/// The path of a module; the crate's own root is empty.
type Module = Vec<String>;

/// The source texts of a crate by module.
type Texts = BTreeMap<Module, String>;

fn read(root: &Path) -> Texts {
    let (mut texts, mut folders) = (Texts::new(), vec![root.to_owned()]);
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("as the test has set it up") {
            let path = entry.expect("as the test has set it up").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                let module = path.strip_prefix(root).expect("as the test has set it up").with_extension("");
                let mut module: Module =
                    module.iter().map(|part| part.to_string_lossy().into_owned()).collect();
                if module.last().is_some_and(|last| last == "mod") || module == ["lib"] {
                    module.pop();
                }
                texts.insert(module, std::fs::read_to_string(&path).expect("as the test has set it up"));
            }
        }
    }
    texts
}

/// The text without comments and the tests at its end.
fn code(text: &str) -> String {
    let body = text.split("\n#[cfg(test)]\nmod ").next().unwrap_or_default();
    // What a feature brings stands on its floor all the same.
    let lines = body.lines().filter(|line| !line.starts_with("#[cfg(feature"));
    lines.map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

/// The paths of a tree of imports: `a::{b, c::{d, e}}` is three.
fn leaves(tree: &str) -> Vec<String> {
    let tree = tree.trim();
    let Some((head, rest)) = tree.split_once('{') else {
        let path = tree.split(" as ").next().unwrap_or_default().trim();
        return vec![path.trim_end_matches("::self").trim_end_matches("::*").to_owned()];
    };
    let (mut depth, mut part, mut parts) = (0, String::new(), Vec::new());
    for letter in rest.chars() {
        match letter {
            '}' if depth == 0 => break,
            ',' if depth == 0 => parts.push(std::mem::take(&mut part)),
            letter => {
                depth += i32::from(letter == '{') - i32::from(letter == '}');
                part.push(letter);
            }
        }
    }
    parts.push(part);
    let parts = parts.iter().filter(|part| !part.trim().is_empty());
    parts.flat_map(|part| leaves(&format!("{head}{}", part.trim()))).collect()
}

/// The paths that a file names; of its imports with `pub use` the names alone, which point into its own folder.
fn paths(text: &str) -> Vec<String> {
    let (mut found, mut rest) = (Vec::new(), String::new());
    for statement in code(text).split_inclusive(';') {
        let lines = statement.trim_start();
        let opened = lines.rfind("\nuse ").map_or(lines, |at| &lines[at + 1..]);
        match opened.strip_prefix("use ") {
            Some(tree) => found
                .extend(leaves(&tree.trim_end_matches(';').split_whitespace().collect::<Vec<_>>().join(" "))),
            None if opened.starts_with("pub use ") || opened.starts_with("pub(crate) use ") => {}
            None => rest.push_str(statement),
        }
        if !std::ptr::eq(opened, lines) {
            rest.push_str(&lines[..lines.len() - opened.len()]);
        }
    }
    let is_word = |letter: char| letter.is_alphanumeric() || letter == '_' || letter == ':';
    found.extend(rest.split(|letter| !is_word(letter)).filter(|word| word.contains("::")).map(str::to_owned));
    found
}

/// The names that the folders give on with `pub use`, and where they stand.
fn given_on(texts: &Texts) -> BTreeMap<(Module, String), Module> {
    let mut all = BTreeMap::new();
    for (module, text) in texts {
        for statement in code(text).split(';') {
            let Some((_, tree)) =
                statement.split_once("pub use ").or_else(|| statement.split_once("pub(crate) use "))
            else {
                continue;
            };
            for path in leaves(&tree.split_whitespace().collect::<Vec<_>>().join(" ")) {
                let parts: Module = path.split("::").map(str::to_owned).collect();
                let child: Module = module.iter().chain(&parts[..1]).cloned().collect();
                let target = match parts[0].as_str() {
                    "crate" => parts[1..].to_vec(),
                    _ if texts.contains_key(&child) => module.iter().chain(&parts).cloned().collect(),
                    _ => continue,
                };
                if let Some(name) = parts.last() {
                    all.insert((module.clone(), name.clone()), target);
                }
            }
        }
    }
    all
}

/// Which file uses which: every edge with the path that makes it.
fn edges(texts: &Texts, name: &str) -> BTreeMap<(Module, Module), String> {
    let given_on = given_on(texts);
    let mut edges = BTreeMap::new();
    for (module, text) in texts {
        for path in paths(text) {
            let parts: Module = path.split("::").map(str::to_owned).collect();
            let child: Module = module.iter().chain(&parts[..1]).cloned().collect();
            let above = parts.iter().take_while(|part| *part == "super").count();
            let mut target: Module = match parts[0].as_str() {
                "crate" => parts[1..].to_vec(),
                one if one == name => parts[1..].to_vec(),
                "super" => module[..module.len().saturating_sub(above)]
                    .iter()
                    .chain(&parts[above..])
                    .cloned()
                    .collect(),
                "self" => module.iter().chain(&parts[1..]).cloned().collect(),
                _ if texts.contains_key(&child) => module.iter().chain(&parts).cloned().collect(),
                _ => continue,
            };
            for _ in 0..4 {
                let known = (0..=target.len()).rev().find(|length| texts.contains_key(&target[..*length]));
                let length = known.unwrap_or(0);
                let next = target
                    .get(length)
                    .and_then(|name| given_on.get(&(target[..length].to_vec(), name.clone())));
                let Some(next) = next else {
                    target.truncate(length);
                    break;
                };
                target = next.iter().chain(&target[length + 1..]).cloned().collect();
            }
            if target != *module {
                edges.insert((module.clone(), target), path);
            }
        }
    }
    edges
}

/// A circle among some nodes: what ties those that stand in one.
fn circle(ties: &BTreeMap<(String, String), String>) -> Option<String> {
    let mut left: BTreeSet<&str> = ties.keys().flat_map(|(from, to)| [from.as_str(), to.as_str()]).collect();
    loop {
        // What nothing leads into, or nothing out of, stands in no circle.
        let stays = |from: &str, to: &str| left.contains(from) && left.contains(to);
        let inside: Vec<_> = ties.keys().filter(|(from, to)| stays(from, to)).collect();
        let is_free = |node: &str| {
            !inside.iter().any(|(from, _)| from == node) || !inside.iter().any(|(_, to)| to == node)
        };
        match left.iter().copied().find(|node| is_free(node)) {
            Some(free) => left.remove(free),
            None => break,
        };
    }
    let ties =
        ties.iter().filter(|((from, to), _)| left.contains(from.as_str()) && left.contains(to.as_str()));
    let words: Vec<String> = ties.map(|((from, to), why)| format!("{from} → {to} ({why})")).collect();
    (!left.is_empty()).then(|| words.join(", "))
}

/// What is wrong with the folders of a crate.
fn circles(texts: &Texts, name: &str) -> Vec<String> {
    let edges = edges(texts, name);
    let folders: BTreeSet<&[String]> =
        texts.keys().flat_map(|module| (0..module.len()).map(|length| &module[..length])).collect();
    let node = |folder: &[String], module: &Module| {
        module.get(folder.len()).cloned().unwrap_or_else(|| "mod.rs".to_owned())
    };
    let mut wrong = Vec::new();
    for folder in folders {
        let inside =
            edges.iter().filter(|((from, to), _)| from.starts_with(folder) && to.starts_with(folder));
        let ties = inside
            .map(|((from, to), why)| {
                ((node(folder, from), node(folder, to)), format!("{}: {why}", from.join("/")))
            })
            .filter(|((from, to), _)| from != to)
            .collect();
        wrong.extend(circle(&ties).map(|words| format!("a circle in `{}`: {words}", folder.join("/"))));
    }
    wrong
}

/// The imports of `src` that point up.
fn upward(texts: &Texts) -> Vec<String> {
    let floor = |module: &Module| match module.first() {
        // What a user of the library sees, and the program, stand on top.
        None => FLOORS.len(),
        Some(name) if name == "main" => FLOORS.len(),
        Some(name) => FLOORS.iter().position(|floor| floor.contains(&name.as_str())).unwrap_or_else(|| {
            panic!("`{name}` stands on no floor; give it one in FLOORS of tests/suite/floors.rs")
        }),
    };
    let points_up =
        |from: &Module, to: &Module| from.first() != to.first() && !to.is_empty() && floor(to) >= floor(from);
    let edges = edges(texts, "squealmap").into_iter();
    let wrong = edges.filter(|((from, to), _)| points_up(from, to));
    wrong
        .map(|((from, _), path)| format!("{} imports {path}, which is not below it", from.join("/")))
        .collect()
}

#[test]
fn imports_point_down() {
    let texts = read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"));
    assert!(texts.len() > 250, "only {} files were seen", texts.len());
    let found = edges(&texts, "squealmap").len();
    assert!(found > 1500, "only {found} imports were seen");
    assert_eq!(upward(&texts), Vec::<String>::new());
}

#[test]
fn no_circle_ties_files_or_folders() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    assert_eq!(circles(&read(&here.join("src")), "squealmap"), Vec::<String>::new());
    for (folder, name, _) in CRATES {
        assert_eq!(
            circles(&read(&here.join(format!("crates/{folder}/src"))), name),
            Vec::<String>::new(),
            "{folder}"
        );
    }
}

#[test]
fn crates_know_only_what_is_below_them() {
    for (folder, own, allowed) in CRATES {
        let texts = read(&Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("crates/{folder}/src")));
        for (module, text) in &texts {
            let words = paths(text).into_iter().filter_map(|path| path.split("::").next().map(str::to_owned));
            for word in words.filter(|word| word.starts_with("squealmap")) {
                let known = word == own || allowed.contains(&word.as_str());
                assert!(known, "crates/{folder}: {} imports {word}", module.join("/"));
            }
        }
    }
}

/// Texts as they would stand in a house.
fn house(files: &[(&str, &str)]) -> Texts {
    files
        .iter()
        .map(|(path, text)| (path.split('/').map(str::to_owned).collect(), (*text).to_owned()))
        .collect()
}

#[test]
fn what_is_planted_is_found() {
    let sound = [
        (
            "model/linear",
            "use crate::disk::{self, file::{read, write}};\nfn f() { crate::version::program(); }",
        ),
        ("disk/file", "pub fn read() {}"),
        ("version", "//! crate::study is only named here"),
        (
            "sweep/grid",
            "use crate::model::linear;\n\n#[cfg(test)]\nmod tests {\n    use crate::study::trace;\n}",
        ),
        ("study/trace", "use crate::sweep::grid::Grid;"),
        ("store/tile", "pub struct Tile;"),
    ];
    assert_eq!(upward(&house(&sound)), Vec::<String>::new());
    assert_eq!(circles(&house(&sound), "squealmap"), Vec::<String>::new());
    let with = |path: &'static str, text: &'static str| house(&[&sound[..], &[(path, text)]].concat());
    for text in [
        "use crate::sweep::grid::Grid;",
        "use crate::{disk, sweep::{grid, label}};",
        "fn f() -> usize { crate::sweep::grid::len() }",
        "use super::super::sweep::grid;",
        "use crate::model::linear;\nuse crate::study::trace;",
    ] {
        assert_eq!(upward(&with("model/status", text)).len(), 1, "{text}");
    }
    // Two rooms of one floor.
    assert_eq!(upward(&with("cluster/slurm", "use crate::store::tile::Tile;")).len(), 1);
    // A circle of three files, one by `super`, one by a name that the folder gives on.
    let three = [
        ("engine", "pub mod a;\npub use c::Third;"),
        ("engine/a", "use super::b::Second;"),
        ("engine/b", "use crate::engine::Third;"),
        ("engine/c", "fn f(first: crate::engine::a::First) {}"),
    ];
    let found = circles(&house(&three), "squealmap");
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(
        found[0].contains("a → b") && found[0].contains("b → c") && found[0].contains("c → a"),
        "{found:?}"
    );
    assert_eq!(circles(&house(&three[..3]), "squealmap"), Vec::<String>::new());
    // A circle of two folders.
    let folders = [("store/one", "use crate::sweep::two;"), ("sweep/two", "use crate::store::one;")];
    assert_eq!(circles(&house(&folders), "squealmap").len(), 1);
}

/// The files of some folders, by their paths from the root.
fn files(folders: &[&str]) -> BTreeMap<String, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut all = BTreeMap::new();
    let mut left: Vec<_> = folders.iter().map(|folder| root.join(folder)).collect();
    while let Some(path) = left.pop() {
        if path.ends_with("node_modules") {
            // What others wrote, fetched beside the page of the explorer.
            continue;
        }
        if path.is_dir() {
            left.extend(
                std::fs::read_dir(&path).expect("a folder").map(|entry| entry.expect("an entry").path()),
            );
        } else if path.extension().is_some_and(|end| ["rs", "wgsl", "md"].iter().any(|one| end == *one)) {
            let name = path.strip_prefix(root).expect("a path below").to_string_lossy().replace('\\', "/");
            all.insert(name, std::fs::read_to_string(&path).expect("text"));
        }
    }
    all
}

/// The source files that comments and pages name and that are not there.
fn named_in_vain(files: &BTreeMap<String, String>) -> Vec<String> {
    let is_part = |letter: char| letter.is_ascii_alphanumeric() || "_./-".contains(letter);
    let mut wrong = Vec::new();
    for (path, text) in files {
        let is_page = Path::new(path).extension().is_some_and(|end| end == "md");
        for line in text.lines().filter(|line| is_page || line.trim_start().starts_with("//")) {
            let words = line.split(|letter| !is_part(letter)).map(|word| word.trim_start_matches(['.', '/']));
            let sources = words
                .filter(|word| Path::new(word).extension().is_some_and(|end| end == "rs" || end == "wgsl"));
            let is_there =
                |word: &&str| files.keys().any(|one| one == word || one.ends_with(&format!("/{word}")));
            wrong.extend(sources.filter(|word| !is_there(word)).map(|word| format!("{path} names {word}")));
        }
    }
    wrong
}

#[test]
fn files_that_are_named_are_there() {
    let all = files(&["src", "crates", "tests", "benches", "examples", "shaders", "docs"]);
    assert!(all.len() > 400, "only {} files were seen", all.len());
    assert_eq!(named_in_vain(&all), Vec::<String>::new());
    let planted = |text: &str| BTreeMap::from([("src/a.rs".to_owned(), text.to_owned())]);
    assert!(named_in_vain(&planted("//! As in `a.rs`.\nlet b = \"b.rs\";")).is_empty());
    assert_eq!(named_in_vain(&planted("    // See src/b.rs, and `a.rs`.")), ["src/a.rs names src/b.rs"]);
}
