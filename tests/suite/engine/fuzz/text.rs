//! Shipped sweeps with lines removed, doubled, cut short, and values replaced by nonsense.

use std::path::Path;

use proptest::prelude::*;
use proptest::sample::{Index, select};

/// What may stand where a value is expected.
const NONSENSE: [&str; 36] = [
    "",
    "\"\"",
    "\"x\"",
    "-1",
    "0",
    "1",
    "1e999",
    "nan",
    "-inf",
    "1e-320",
    "true",
    "[]",
    "{}",
    "[1, 2]",
    "{ from = 0 }",
    "{ values = [] }",
    "{ values = [1, \"x\"] }",
    "{ from = 0, to = 1, points = 1000000000000 }",
    "{ from = 1, to = 1, points = 2 }",
    "{ from = -1, to = 1, points = 3, scale = \"log\" }",
    "{ values = [\"constant\", \"table\"] }",
    "'''",
    "1979-05-27",
    "0x1F",
    "9223372036854775807",
    "-9223372036854775808",
    "\"auto\"",
    "\"1 s\"",
    "\"nan s\"",
    "\"-1 periods\"",
    "\"1e9 periods\"",
    "\"\\u0000\"",
    "\"ä\"",
    "\"../../etc\"",
    "\"tuples.csv\"",
    "= 2",
];

/// One thing done to a text.
#[derive(Clone, Debug)]
enum Damage {
    Remove(Index),
    Double(Index),
    Replace(Index, &'static str),
    Rename(Index, String),
    Cut(Index),
    Insert(Index, String),
}

fn damage() -> impl Strategy<Value = Damage> {
    let index = any::<Index>;
    prop_oneof![
        3 => index().prop_map(Damage::Remove),
        1 => index().prop_map(Damage::Double),
        6 => (index(), select(&NONSENSE[..])).prop_map(|(at, value)| Damage::Replace(at, value)),
        2 => (index(), "[a-z_0-9\"\\[\\]. ]{0,12}").prop_map(|(at, key)| Damage::Rename(at, key)),
        1 => index().prop_map(Damage::Cut),
        1 => (index(), "\\PC{0,8}").prop_map(|(at, text)| Damage::Insert(at, text)),
    ]
}

/// A shipped sweep after one to four damages.
pub(crate) fn mutilated(directory: &Path) -> impl Strategy<Value = String> + use<> {
    let texts: Vec<String> = std::fs::read_dir(directory)
        .expect("the shipped sweeps")
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .map(|path| std::fs::read_to_string(path).expect("a shipped sweep"))
        .collect();
    assert!(texts.len() > 3, "the shipped sweeps are found");
    (select(texts), prop::collection::vec(damage(), 1..5))
        .prop_map(|(text, damages)| damages.iter().fold(text, |text, damage| apply(damage, &text)))
}

fn apply(damage: &Damage, text: &str) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    if lines.is_empty() {
        return String::new();
    }
    let count = lines.len();
    match damage {
        Damage::Remove(at) => drop(lines.remove(at.index(count))),
        Damage::Double(at) => lines.insert(at.index(count), lines[at.index(count)].clone()),
        Damage::Replace(at, value) => {
            let line = &mut lines[at.index(count)];
            let key = line.split('=').next().unwrap_or_default().trim_end().to_owned();
            *line = format!("{key} = {value}");
        }
        Damage::Rename(at, key) => {
            let line = &mut lines[at.index(count)];
            *line = format!("{key}{}", &line[line.find('=').unwrap_or(line.len())..]);
        }
        Damage::Cut(at) => {
            let whole = lines.join("\n");
            return whole.chars().take(at.index(whole.chars().count().max(1))).collect();
        }
        Damage::Insert(at, text) => lines.insert(at.index(count), text.clone()),
    }
    lines.join("\n")
}
