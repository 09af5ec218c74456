//! Text and numbers of a file within a sentence: short, and without what a terminal would obey.

/// The most characters that a sentence quotes of a name or a value; the place beside it says where the rest stands.
const LONGEST: usize = 40;

/// The most characters of what a parser says, which may quote the input.
pub const SAID: usize = 300;

/// A name or a value as a sentence quotes it: on one line, control characters by their escapes, and no more than 40 characters.
#[must_use]
pub fn quoted(text: &str) -> String {
    clipped(text, LONGEST)
}

/// A text as a sentence quotes it, see [`quoted`], with at most `most` characters.
#[must_use]
pub fn clipped(text: &str, most: usize) -> String {
    let end = text.char_indices().nth(most).map_or(text.len(), |(end, _)| end);
    let mut line = one_line(&text[..end]);
    if end < text.len() {
        line.push('…');
    }
    line
}

/// The whole text on one line, with control characters by their escapes: for paths, which may not be shortened.
#[must_use]
pub fn one_line(text: &str) -> String {
    escaped(text, is_obeyed)
}

/// A whole message as a terminal may get it, whatever names it holds: its lines, with all other control characters by their
/// escapes.
#[must_use]
pub fn message(text: &str) -> String {
    escaped(text, |c| c != '\n' && is_obeyed(c))
}

/// A text with some of its characters by their escapes.
fn escaped(text: &str, which: impl Fn(char) -> bool) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        if which(c) {
            escaped.extend(c.escape_default());
        } else {
            escaped.push(c);
        }
    }
    escaped
}

/// A number as a sentence says it: six digits, and no more than it has.
#[must_use]
pub fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// Whether a terminal or a page would obey the character and not show it: controls, and marks that turn the direction of
/// what follows.
#[must_use]
pub fn is_obeyed(c: char) -> bool {
    c.is_control() || matches!(c, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// `a, b and c`.
#[must_use]
pub fn list(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [rest @ .., last] => format!("{} and {last}", rest.join(", ")),
    }
}
