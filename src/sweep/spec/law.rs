//! The laws by what they read, for messages.

use crate::model::Param;
use crate::model::friction::LawKind;

/// The names of all laws.
pub(super) fn names() -> [&'static str; LawKind::ALL.len()] {
    LawKind::ALL.map(LawKind::name)
}

/// The first parameter that a law cannot do without and that `has` does not know.
pub(super) fn missing(kind: LawKind, has: impl Fn(Param) -> bool) -> Option<Param> {
    kind.needs().iter().copied().find(|&param| !has(param))
}

/// The names of the laws that read `param`.
pub(super) fn users(param: Param) -> Vec<&'static str> {
    named(|kind| kind.reads(param))
}

/// The names of the laws that a material serves.
pub(super) fn of_material() -> Vec<&'static str> {
    named(|kind| !kind.reads_table())
}

/// The names of the laws that are read from a table.
pub(super) fn of_table() -> Vec<&'static str> {
    named(LawKind::reads_table)
}

fn named(is: impl Fn(LawKind) -> bool) -> Vec<&'static str> {
    LawKind::ALL.into_iter().filter(|kind| is(*kind)).map(LawKind::name).collect()
}
