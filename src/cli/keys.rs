//! `squealmap keys`: every key of a sweep file and every column of its results, each from its one table.

use std::fmt::Write;

use crate::cli::error::Result;
use crate::cli::talk;
use clap::Args;
use serde_json::{Value as Json, json};
use squealmap::sweep::columns::{Column, Content, Values, Window, computed};
use squealmap::sweep::spec::keys::{Key, SECTIONS, all, named};

/// Arguments of `keys`.
#[derive(Debug, Args)]
pub(crate) struct KeysCommand {
    /// One key, or all of a section [default: every key]
    name: Option<String>,
    /// The columns of map.csv instead
    #[arg(long, conflicts_with = "name")]
    columns: bool,
    /// As tables in Markdown, of which docs/sweeps.md and docs/columns.md are made
    #[arg(long, conflicts_with = "name")]
    markdown: bool,
}

impl KeysCommand {
    pub(crate) fn execute(self) -> Result<()> {
        if self.columns {
            // Those of the large start are the same once more.
            let columns: Vec<&Column> = computed().filter(|column| !column.is_of_large_start).collect();
            talk::tell("columns", columns.iter().map(|column| column_to_json(column)).collect::<Json>());
            talk::product(&if self.markdown { column_table(&columns) } else { column_list(&columns) });
            return Ok(());
        }
        let keys = self.name.as_deref().map_or_else(|| Ok(all()), named)?;
        talk::tell("keys", keys.iter().map(to_json).collect::<Json>());
        talk::product(&match keys.as_slice() {
            [one] => card(one),
            _ if self.markdown => by_section(&keys, markdown),
            _ => {
                by_section(&keys, listed)
                    + "\n`squealmap keys NAME` says all of one; `[axes]` may vary what it says varies\n"
            }
        });
        Ok(())
    }
}

/// Section by section, those that have keys.
fn by_section(keys: &[Key], write: fn(&str, &str, &[&Key]) -> String) -> String {
    let section = |(name, about): &(&str, &str)| {
        let of: Vec<&Key> = keys.iter().filter(|key| key.section == *name).collect();
        (!of.is_empty()).then(|| write(name, about, &of))
    };
    SECTIONS.iter().filter_map(section).collect::<Vec<_>>().join("\n")
}

/// `[model]` as it is called in words.
fn heading(section: &str) -> String {
    if section.is_empty() { "top level".to_owned() } else { format!("[{section}]") }
}

/// The default in words.
fn default(key: &Key) -> &str {
    key.default.as_deref().unwrap_or("none")
}

/// A line of name, unit and meaning for each key.
fn listed(section: &str, about: &str, keys: &[&Key]) -> String {
    let width = |of: fn(&Key) -> &str| keys.iter().map(|key| of(key).chars().count()).max().unwrap_or(0);
    let (names, units, defaults) = (width(|key| key.name), width(|key| key.unit), width(default));
    let mut text = format!("{}: {about}\n", heading(section));
    for key in keys {
        let (name, unit, default) = (key.name, key.unit, default(key));
        let _ = writeln!(text, "  {name:names$}  {unit:units$}  {default:defaults$}  {}", key.meaning);
    }
    text
}

/// All that is known of one key, line by line.
fn card(key: &Key) -> String {
    let rows = [
        ("meaning", key.meaning),
        ("unit", if key.unit.is_empty() { "none" } else { key.unit }),
        ("default", default(key)),
        ("range", key.range.as_str()),
        ("read by", if key.read_by.is_empty() { "every sweep" } else { key.read_by.as_str() }),
        ("varies", if key.varies { "yes, in [axes] or as a column of `points`" } else { "no" }),
    ];
    let mut text = format!("{}, {}\n", key.name, heading(key.section));
    for (name, value) in rows {
        let _ = writeln!(text, "  {name:7}  {value}");
    }
    text
}

/// The keys of a section as a table in Markdown.
fn markdown(section: &str, about: &str, keys: &[&Key]) -> String {
    let heading = if section.is_empty() { "Top level".to_owned() } else { format!("`[{section}]`") };
    let mut text = format!("### {heading}: {about}\n\n");
    text += "| key | unit | meaning | default | range | read by | varies |\n|---|---|---|---|---|---|---|\n";
    for key in keys {
        let default = key.default.as_ref().map_or_else(String::new, |value| format!("`{value}`"));
        let name = format!("`{}`", key.name);
        let cells = [
            name.as_str(),
            key.unit,
            key.meaning,
            default.as_str(),
            key.range.as_str(),
            key.read_by.as_str(),
            if key.varies { "yes" } else { "" },
        ];
        let _ = writeln!(text, "| {} |", cells.join(" | "));
    }
    text
}

fn to_json(key: &Key) -> Json {
    json!({
        "section": key.section,
        "name": key.name,
        "unit": key.unit,
        "meaning": key.meaning,
        "default": key.default,
        "range": key.range,
        "read_by": key.read_by,
        "varies": key.varies,
    })
}

/// What the cells of a column hold, in words.
fn holds(column: &Column) -> String {
    match column.values() {
        Some(Values::Name(class)) => class.names().collect::<Vec<_>>().join(", "),
        Some(Values::Flag(_)) => "0, 1".to_owned(),
        _ if column.content() == Content::Count => "count".to_owned(),
        _ => "number".to_owned(),
    }
}

/// A line of name, unit, what asks for it and meaning for each column.
fn column_list(columns: &[&Column]) -> String {
    let width =
        |of: fn(&Column) -> &str| columns.iter().map(|one| of(one).chars().count()).max().unwrap_or(0);
    let widths = [width(|one| one.name), width(|one| one.unit), width(|one| one.group.asked_by())];
    let mut text = String::new();
    for column in columns {
        let Column { name, unit, meaning, group, .. } = column;
        let [names, units, groups] = widths;
        let _ = writeln!(text, "{name:names$}  {unit:units$}  {:groups$}  {meaning}", group.asked_by());
    }
    text
}

/// The columns as a table in Markdown.
fn column_table(columns: &[&Column]) -> String {
    let mut text = "| column | unit | meaning | holds | with |\n|---|---|---|---|---|\n".to_owned();
    for column in columns {
        let Column { name, unit, meaning, group, .. } = column;
        let (meaning, holds) = (meaning.replace('|', "\\|"), holds(column));
        let _ = writeln!(text, "| `{name}` | {unit} | {meaning} | {holds} | {} |", group.asked_by());
    }
    text
}

fn column_to_json(column: &Column) -> Json {
    json!({
        "name": column.name,
        "unit": column.unit,
        "meaning": column.meaning,
        "holds": holds(column),
        "asked_by": column.group.asked_by(),
        "of_the_window": column.window != Window::Not,
    })
}
