//! Sets of an `.inp` file, by the numbers of their nodes and elements.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::cards::Card;
use super::raw::{Raw, number};
use crate::Error;

/// The sets of a file, by numbers, names in capitals: those of a part and all others, such as those of the assembly, which may have the same names.
#[derive(Default)]
pub(super) struct Sets {
    part: BTreeMap<String, Vec<u64>>,
    others: BTreeMap<String, Vec<u64>>,
}

impl Sets {
    /// Puts members into a set that is made in a part or elsewhere.
    pub(super) fn add(&mut self, of_part: bool, name: &str, members: impl IntoIterator<Item = u64>) {
        let sets = if of_part { &mut self.part } else { &mut self.others };
        sets.entry(name.to_owned()).or_default().extend(members);
    }

    /// The set that a name means in a part or elsewhere: the own one first. `INSTANCE.NAME` is that of the part.
    fn find(&self, of_part: bool, name: &str) -> Option<&Vec<u64>> {
        let [own, other] = if of_part { [&self.part, &self.others] } else { [&self.others, &self.part] };
        own.get(name).or_else(|| other.get(name)).or_else(|| self.of_instance(name))
    }

    /// What `INSTANCE.NAME` means.
    pub(super) fn of_instance(&self, name: &str) -> Option<&Vec<u64>> {
        name.rsplit_once('.').and_then(|(_, name)| self.part.get(name))
    }

    /// A set by its name.
    pub(super) fn known(&self, of_part: bool, name: &str, line: usize) -> Result<&Vec<u64>, Error> {
        self.find(of_part, name).ok_or_else(|| {
            let all: Vec<&str> = self.all().map(|(name, _)| name.as_str()).collect();
            let what = format!("there is no set {name}; there are: {}", all.join(", "));
            Error::File { line, what }
        })
    }

    /// All of them; of a name that a part has as well it is the other one.
    pub(super) fn all(&self) -> impl Iterator<Item = (&String, &Vec<u64>)> {
        let hidden = |name: &String| self.others.contains_key(name);
        self.part.iter().filter(move |(name, _)| !hidden(name)).chain(&self.others)
    }
}

/// Lines and surfaces by their numbers, with their nodes.
pub(super) type Flats = HashMap<u64, Vec<u64>>;

/// Lines and surfaces, which have no stiffness as long as no section names them.
pub(super) fn read_flat(card: &Card<'_>, flats: &mut Flats, sets: &mut Sets) {
    for (_, words) in &card.data {
        let mut numbers = words.iter().filter_map(|word| word.parse().ok());
        let Some(number) = numbers.next() else { continue };
        flats.insert(number, numbers.collect());
        if let Some(set) = card.parameters.get("ELSET") {
            sets.add(card.of_part, set, [number]);
        }
    }
}

/// A sentence on a parameter of a set that is not known.
pub(super) fn unknown_of_set(card: &Card<'_>) -> Option<String> {
    const KNOWN: [&str; 6] = ["NSET", "ELSET", "GENERATE", "INSTANCE", "INTERNAL", "UNSORTED"];
    let unknown =
        card.parameters.keys().find(|key| !KNOWN.iter().any(|known| known.starts_with(key.as_str())))?;
    Some(format!("line {}: {unknown} of *{} is not known here and is left out", card.line, card.name))
}

/// The members of a set of nodes or elements; `known_sets` are those of nodes and of elements before it.
pub(super) fn members(
    card: &Card<'_>,
    (raw, flats): (&Raw, &Flats),
    known_sets: [&Sets; 2],
) -> Result<Vec<u64>, Error> {
    let of_nodes = card.name == "NSET";
    let mut members = listed(card, known_sets[usize::from(!of_nodes)])?;
    // The nodes of elements.
    if let Some(elements) = card.parameters.get("ELSET").filter(|_| of_nodes) {
        let elements: HashSet<u64> =
            known_sets[1].known(card.of_part, elements, card.line)?.iter().copied().collect();
        let of_set = raw.elements.iter().filter(|element| elements.contains(&element.number));
        members.extend(of_set.flat_map(|element| &element.nodes));
        members.extend(elements.iter().filter_map(|number| flats.get(number)).flatten());
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
                Err(_) => members.extend(sets.known(card.of_part, &word.to_uppercase(), *line)?),
            }
        }
    }
    Ok(members)
}
