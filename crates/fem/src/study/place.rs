//! Where in a description an error stands.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::Error;

/// The bytes of a description that an error is about: what is no TOML, the value of a key, or the last key on the way to one that is not
/// there; nothing where it is about no key.
#[must_use]
pub fn place(text: &str, error: &Error) -> Option<Range<usize>> {
    match error {
        Error::Description { span, .. } => Some(span.clone()),
        Error::Key { key, .. } => Some(of_key(text, key)),
        Error::Free => Some(of_key(text, "supports")),
        Error::Material { name, .. } => Some(of_key(text, &format!("materials.{name}"))),
        _ => None,
    }
}

/// The key, as `parts.pin.cells`, whose value holds these bytes; nothing where no value does, as for the name of a key or a table.
pub(super) fn key_of(text: &str, span: &Range<usize>) -> Option<String> {
    let table = DeTable::parse(text).ok()?;
    within(table.get_ref(), span)
}

fn within(table: &DeTable<'_>, span: &Range<usize>) -> Option<String> {
    let holds = |outer: Range<usize>| !span.is_empty() && outer.start <= span.start && span.end <= outer.end;
    let of = |value: &Spanned<DeValue<'_>>| match value.get_ref() {
        DeValue::Table(table) => within(table, span).map(|inner| format!(".{inner}")),
        DeValue::Array(all) if all.iter().any(is_table) => {
            let inner = |(i, element): (usize, &Spanned<DeValue<'_>>)| match element.get_ref() {
                DeValue::Table(table) => within(table, span).map(|inner| format!("[{i}].{inner}")),
                _ => None,
            };
            all.iter().enumerate().find_map(inner)
        }
        _ => holds(value.span()).then(String::new),
    };
    table.iter().find_map(|(name, value)| of(value).map(|inner| format!("{}{inner}", name.get_ref())))
}

/// The bytes of the value of a key such as `parts.pin.cells` or `loads[1].force`.
fn of_key(text: &str, key: &str) -> Range<usize> {
    let Ok(table) = DeTable::parse(text) else { return 0..0 };
    let mut found = 0..0;
    let mut names = key.split(['.', '[', ']']).filter(|name| !name.is_empty());
    let Some(first) = names.next() else { return found };
    let mut value = table.get_ref().iter().find(|(name, _)| name.get_ref() == first);
    let mut inside: Option<&Spanned<DeValue<'_>>> = None;
    loop {
        let (at, next) = match (value, inside) {
            (Some((name, value)), _) => (if is_table(value) { name.span() } else { value.span() }, value),
            (None, Some(element)) => (element.span(), element),
            (None, None) => return found,
        };
        found = at;
        let Some(name) = names.next() else { return found };
        (value, inside) = match next.get_ref() {
            DeValue::Table(table) => (table.iter().find(|(known, _)| known.get_ref() == name), None),
            DeValue::Array(all) => (None, name.parse().ok().and_then(|i: usize| all.get(i))),
            _ => (None, None),
        };
    }
}

/// The span of a table is its header, of one that is not written as one, nothing.
fn is_table(value: &Spanned<DeValue<'_>>) -> bool {
    matches!(value.get_ref(), DeValue::Table(_))
}
