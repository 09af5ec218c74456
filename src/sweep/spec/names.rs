//! Names that do not exist, and what the user may have meant.

use std::ops::Range;

use crate::sweep::error::Error;
use squealmap_input::place::Source;
use squealmap_input::quote::list;

/// From this similarity (0..1) on, a name is suggested; below, all names are listed.
const SUGGEST: f64 = 0.7;

/// Names of more bytes are not compared.
pub(super) const LONGEST_NAME: usize = 100;

/// The candidate most similar to `name`, if any is similar; the shorter one when two are equally so.
#[must_use]
pub fn nearest<'a>(name: &str, candidates: &[&'a str]) -> Option<&'a str> {
    // What is far longer than every name is like none of them, and comparing it would take its length squared.
    if name.len() > LONGEST_NAME {
        return None;
    }
    let name = name.to_lowercase();
    // A common beginning counts (Jaro-Winkler), and so does the number of edits (Levenshtein).
    let prefix = |candidate: &str| strsim::jaro_winkler(&name, candidate);
    let edits = |candidate: &str| strsim::normalized_damerau_levenshtein(&name, candidate);
    candidates
        .iter()
        .copied()
        .filter(|candidate| prefix(candidate).max(edits(candidate)) >= SUGGEST)
        .max_by(|a, b| (prefix(a) + edits(a)).total_cmp(&(prefix(b) + edits(b))).then(b.len().cmp(&a.len())))
}

/// "did you mean", or the list of what there is.
#[must_use]
pub fn advice(name: &str, candidates: &[&str]) -> String {
    match nearest(name, candidates) {
        Some(candidate) => format!("did you mean `{candidate}`?"),
        None if candidates.is_empty() => "there is none to choose from".to_owned(),
        None => format!("choose from {}", list(candidates)),
    }
}

/// The error of a name that is none of the candidates.
pub(super) fn unknown(
    source: &Source,
    span: Range<usize>,
    what: &'static str,
    name: &str,
    within: &str,
    candidates: &[&str],
) -> Error {
    Error::Unknown {
        at: source.place(span),
        what,
        name: name.to_owned(),
        within: within.to_owned(),
        advice: advice(name, candidates),
    }
}
