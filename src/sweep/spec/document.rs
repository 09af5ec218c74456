//! Typed reading of TOML values, with errors that say where, what was expected and what was found.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use crate::model;
use crate::sweep::error::{Error, Result};
use crate::sweep::spec::names::unknown;
use squealmap_input::place::Source;
use squealmap_input::quote::quoted;

/// A value of the document with its byte range.
pub(super) type Node<'i> = Spanned<DeValue<'i>>;

/// One `key = value` of a table.
#[derive(Clone, Copy)]
pub(super) struct Entry<'a, 'i> {
    pub(super) key: &'a str,
    pub(super) node: &'a Node<'i>,
    key_start: usize,
    key_end: usize,
}

impl Entry<'_, '_> {
    /// Where the key stands.
    pub(super) fn key_span(&self) -> Range<usize> {
        self.key_start..self.key_end
    }
}

/// The entries of a table in the order of the file.
pub(super) fn entries<'a, 'i>(table: &'a DeTable<'i>) -> Vec<Entry<'a, 'i>> {
    let mut entries: Vec<_> = table
        .iter()
        .map(|(key, node)| Entry {
            key: key.get_ref(),
            node,
            key_start: key.span().start,
            key_end: key.span().end,
        })
        .collect();
    entries.sort_by_key(|entry| entry.key_start);
    entries
}

/// The value as written, shortened when it is long.
fn written(source: &Source, span: Range<usize>) -> String {
    let text = source.written(span);
    match text.split_once('\n') {
        Some((line, _)) => format!("{}…", quoted(line).trim_end_matches('…')),
        None => quoted(text),
    }
}

/// The error of a value of another type than `expected`.
pub(super) fn wrong_type(source: &Source, node: &Node, label: &str, expected: &str) -> Error {
    let text = written(source, node.span());
    let found = match node.get_ref() {
        DeValue::String(_) => format!("the string {text}"),
        DeValue::Integer(_) | DeValue::Float(_) => format!("the number {text}"),
        DeValue::Boolean(_) => format!("the boolean {text}"),
        DeValue::Datetime(_) => format!("the date {text}"),
        DeValue::Array(_) => "an array".to_owned(),
        DeValue::Table(_) => "a table".to_owned(),
    };
    let at = source.place(node.span());
    Error::WrongType { at, key: label.to_owned(), expected: expected.to_owned(), found }
}

/// The error of a value outside its limits.
pub(super) fn out_of_range(source: &Source, node: &Node, label: &str, limit: impl Into<String>) -> Error {
    out_of_range_at(source, node.span(), label, limit)
}

/// The error that the value at `span` is outside its limits.
pub(super) fn out_of_range_at(
    source: &Source,
    span: Range<usize>,
    label: &str,
    limit: impl Into<String>,
) -> Error {
    let (key, value) = (label.to_owned(), written(source, span.clone()));
    Error::OutOfRange { at: source.place(span), key, value, limit: limit.into() }
}

/// A number inside `range`; integers are numbers too.
pub(super) fn number(source: &Source, node: &Node, label: &str, range: model::Range) -> Result<f64> {
    let value = match node.get_ref() {
        DeValue::Float(float) => float.as_str().parse().unwrap_or(f64::NAN),
        // Every 64-bit integer of a sweep file is a legal float, rounded beyond 2^53.
        DeValue::Integer(integer) => i128::from_str_radix(integer.as_str(), integer.radix())
            .map_or(f64::INFINITY, |value| value as f64),
        _ => return Err(wrong_type(source, node, label, "a number")),
    };
    if range.contains(value) { Ok(value) } else { Err(out_of_range(source, node, label, range.to_string())) }
}

/// An integer between `low` and `high`.
pub(super) fn integer(source: &Source, node: &Node, label: &str, low: usize, high: usize) -> Result<usize> {
    let limit = format!("an integer between {low} and {high}");
    let DeValue::Integer(integer) = node.get_ref() else {
        return Err(wrong_type(source, node, label, &limit));
    };
    usize::from_str_radix(integer.as_str(), integer.radix())
        .ok()
        .filter(|value| (low..=high).contains(value))
        .ok_or_else(|| out_of_range(source, node, label, limit))
}

/// A string; `expected` says which.
pub(super) fn string<'a>(source: &Source, node: &'a Node, label: &str, expected: &str) -> Result<&'a str> {
    match node.get_ref() {
        DeValue::String(text) => Ok(text),
        _ => Err(wrong_type(source, node, label, expected)),
    }
}

/// A truth value.
pub(super) fn boolean(source: &Source, node: &Node, label: &str) -> Result<bool> {
    match node.get_ref() {
        DeValue::Boolean(value) => Ok(*value),
        _ => Err(wrong_type(source, node, label, "true or false")),
    }
}

/// A table; `expected` shows what it looks like.
pub(super) fn table<'a, 'i>(
    source: &Source,
    node: &'a Node<'i>,
    label: &str,
    expected: &str,
) -> Result<&'a DeTable<'i>> {
    match node.get_ref() {
        DeValue::Table(table) => Ok(table),
        _ => Err(wrong_type(source, node, label, expected)),
    }
}

/// An array; `expected` shows what it looks like.
pub(super) fn array<'a, 'i>(
    source: &Source,
    node: &'a Node<'i>,
    label: &str,
    expected: &str,
) -> Result<&'a DeArray<'i>> {
    match node.get_ref() {
        DeValue::Array(array) => Ok(array),
        _ => Err(wrong_type(source, node, label, expected)),
    }
}

/// One of a few names.
pub(super) fn choice<T: Copy>(
    source: &Source,
    node: &Node,
    label: &str,
    what: &'static str,
    choices: &[(&str, T)],
) -> Result<T> {
    let names: Vec<&str> = choices.iter().map(|(name, _)| *name).collect();
    let text = string(source, node, label, &format!("one of the strings {}", names.join(", ")))?;
    choices
        .iter()
        .find(|(name, _)| *name == text)
        .map(|(_, value)| *value)
        .ok_or_else(|| unknown(source, node.span(), what, text, &format!("as {label}"), &names))
}
