//! Sets of an `.inp` file, by the numbers of their nodes and elements.

use std::collections::{BTreeMap, HashSet};

use super::cards::Card;
use super::raw::{Raw, number};
use crate::Error;

/// The sets of a file, by numbers, names in capitals.
pub(super) type Sets = BTreeMap<String, Vec<u64>>;

/// A set by its name.
pub(super) fn known<'a>(set: &str, sets: &'a Sets, line: usize) -> Result<&'a Vec<u64>, Error> {
    sets.get(set).ok_or_else(|| Error::File {
        line,
        what: format!(
            "there is no set {set}; there are: {}",
            sets.keys().cloned().collect::<Vec<_>>().join(", ")
        ),
    })
}

/// The numbers of lines and surfaces: they have no stiffness as long as no section names them.
pub(super) fn read_flat(card: &Card<'_>, flats: &mut HashSet<u64>, sets: &mut Sets) {
    let numbers = card.data.iter().filter_map(|(_, words)| words.first()?.parse::<u64>().ok());
    let numbers: Vec<u64> = numbers.collect();
    if let Some(set) = card.parameters.get("ELSET") {
        sets.entry(set.clone()).or_default().extend(&numbers);
    }
    flats.extend(numbers);
}

/// A sentence on a parameter of a set that is not known.
pub(super) fn unknown_of_set(card: &Card<'_>) -> Option<String> {
    const KNOWN: [&str; 6] = ["NSET", "ELSET", "GENERATE", "INSTANCE", "INTERNAL", "UNSORTED"];
    let unknown =
        card.parameters.keys().find(|key| !KNOWN.iter().any(|known| known.starts_with(key.as_str())))?;
    Some(format!("line {}: {unknown} of *{} is not known here and is left out", card.line, card.name))
}

/// The members of a set of nodes or elements; `known_sets` are those of nodes and of elements before it.
pub(super) fn members(card: &Card<'_>, raw: &Raw, known_sets: [&Sets; 2]) -> Result<Vec<u64>, Error> {
    let of_nodes = card.name == "NSET";
    let mut members = listed(card, known_sets[usize::from(!of_nodes)])?;
    // The nodes of elements.
    if let Some(elements) = card.parameters.get("ELSET").filter(|_| of_nodes) {
        let elements: HashSet<u64> = known(elements, known_sets[1], card.line)?.iter().copied().collect();
        let of_set = raw.elements.iter().filter(|element| elements.contains(&element.number));
        members.extend(of_set.flat_map(|element| &element.nodes));
    }
    Ok(members)
}

fn listed(card: &Card<'_>, sets: &Sets) -> Result<Vec<u64>, Error> {
    /// No mesh has more nodes than this, and a set of them still fits into memory.
    const MOST: u64 = 100_000_000;
    let mut members = Vec::new();
    for (line, words) in &card.data {
        let words: Vec<&str> = words.iter().copied().filter(|w| !w.is_empty()).collect();
        if card.has("GENERATE") {
            let at = |i: usize| words.get(i).map_or(Ok(1), |w| number::<u64>(w, *line, "number"));
            let (first, last, step) = (at(0)?, at(1)?, at(2)?.max(1));
            let count = last.saturating_sub(first) / step + 1;
            if count > MOST {
                let what = format!(
                    "the set would have {count} members, at most {MOST} are possible: check the range"
                );
                return Err(Error::File { line: *line, what });
            }
            members.extend((first..=last).step_by(usize::try_from(step).unwrap_or(usize::MAX)));
            continue;
        }
        for word in words {
            // A set may take in others by name.
            match word.parse() {
                Ok(member) => members.push(member),
                Err(_) => members.extend(known(&word.to_uppercase(), sets, *line)?),
            }
        }
    }
    Ok(members)
}
