//! Keyword cards of Abaqus and CalculiX.

use std::collections::BTreeMap;

use super::raw::number;
use crate::Error;

/// A keyword line with the lines of data after it.
pub(super) struct Card<'a> {
    pub(super) line: usize,
    pub(super) name: String,
    pub(super) parameters: BTreeMap<String, String>,
    pub(super) data: Vec<(usize, Vec<&'a str>)>,
    /// Whether it stands in a part, or in an instance that holds one.
    pub(super) of_part: bool,
}

impl Card<'_> {
    pub(super) fn parameter(&self, name: &str) -> Result<String, Error> {
        self.parameters.get(name).cloned().ok_or_else(|| Error::File {
            line: self.line,
            what: format!("*{} has no {name}=: give it one", self.name),
        })
    }

    /// Whether it has a parameter, which may be cut short.
    pub(super) fn has(&self, name: &str) -> bool {
        /// Letters that are enough.
        const ENOUGH: usize = 3;
        self.parameters.keys().any(|key| key.len() >= ENOUGH && name.starts_with(key.as_str()))
    }

    /// All entries as numbers.
    pub(super) fn values(&self) -> Result<Vec<f64>, Error> {
        self.data
            .iter()
            .flat_map(|(line, words)| {
                words.iter().filter(|w| !w.is_empty()).map(|w| number(w, *line, "number"))
            })
            .collect()
    }
}

pub(super) fn cards(text: &str) -> Vec<Card<'_>> {
    let mut cards: Vec<Card<'_>> = Vec::new();
    // A keyword line that ends with a comma goes on in the next one.
    let (mut goes_on, mut of_part) = (false, false);
    let parameter = |word: String| {
        let (key, value) = word.split_once('=').unwrap_or((&word, ""));
        (key.trim().to_owned(), value.trim().to_owned())
    };
    for (i, line) in text.lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.starts_with("**") {
            continue;
        }
        let keyword = line.strip_prefix('*');
        if keyword.is_some() || goes_on {
            let mut words = keyword.unwrap_or(line).split(',').map(|w| w.trim().to_uppercase());
            if keyword.is_some() {
                let name = words.next().unwrap_or_default();
                of_part = match name.as_str() {
                    "PART" | "INSTANCE" => true,
                    "END PART" | "END INSTANCE" => false,
                    _ => of_part,
                };
                cards.push(Card {
                    line: i + 1,
                    name,
                    parameters: BTreeMap::new(),
                    data: Vec::new(),
                    of_part,
                });
            }
            if let Some(card) = cards.last_mut() {
                card.parameters.extend(words.filter(|word| !word.is_empty()).map(parameter));
            }
            goes_on = line.ends_with(',');
        } else if let Some(card) = cards.last_mut() {
            card.data.push((i + 1, line.split(',').map(str::trim).collect()));
        }
    }
    cards
}

/// Lines and surfaces, which Gmsh writes beside the solids; they have no stiffness as long as no section names them.
pub(super) fn flat(card: &Card<'_>) -> bool {
    let kind = card.parameters.get("TYPE").map_or("", String::as_str);
    ["T3D", "CPS", "CPE"].iter().any(|start| kind.starts_with(start))
}
