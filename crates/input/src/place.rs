//! Where in a text an error stands.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use crate::quote::{SAID, clipped, one_line};

/// A text that errors can point into: the sweep file, or a file that it names.
#[derive(Clone, Debug)]
pub struct Source {
    /// The path as the user wrote it.
    pub name: String,
    /// The whole text, without a byte order mark, lone carriage returns as line feeds.
    pub text: Arc<str>,
    /// Whether the text is no file: a place is then named by its line.
    by_line: bool,
}

impl Source {
    /// A text and the name that errors give it.
    pub fn new(name: impl Into<String>, text: &str) -> Source {
        let text = line_ends(text.strip_prefix('\u{feff}').unwrap_or(text));
        Source { name: name.into(), text, by_line: false }
    }

    /// The calls of a builder in code, one a line: an error names the call.
    #[must_use]
    pub fn calls(text: &str) -> Source {
        Source { name: String::new(), text: line_ends(text), by_line: true }
    }

    /// The place of a byte range of the text.
    #[must_use]
    pub fn place(&self, span: Range<usize>) -> Place {
        let end = self.text.len();
        let mut start = span.start.min(end);
        while !self.text.is_char_boundary(start) {
            start -= 1;
        }
        let before = &self.text[..start];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        if self.by_line {
            // Without a line it is about all of them.
            let line = self.text[line_start..].lines().next().filter(|line| !line.is_empty());
            let line = line.unwrap_or("the sweep");
            return Place::argument(&clipped(line, SAID), &self.text, start..span.end.clamp(start, end));
        }
        Place(Box::new(Spot {
            source: self.name.clone(),
            text: Arc::clone(&self.text),
            span: start..span.end.clamp(start, end),
            position: Some((
                before.bytes().filter(|&byte| byte == b'\n').count() + 1,
                before[line_start..].chars().count() + 1,
            )),
        }))
    }

    /// The text in a byte range, as it is written.
    #[must_use]
    pub fn written(&self, span: Range<usize>) -> &str {
        self.text.get(span).unwrap_or_default()
    }
}

/// The text with every lone carriage return as a line feed: byte for byte, so that places stay what they are.
fn line_ends(text: &str) -> Arc<str> {
    if !text.contains('\r') {
        return Arc::from(text);
    }
    let mut rest = text.chars().peekable();
    let mut ended = String::with_capacity(text.len());
    while let Some(c) = rest.next() {
        let lone = c == '\r' && rest.peek() != Some(&'\n');
        ended.push(if lone { '\n' } else { c });
    }
    Arc::from(ended)
}

/// A place in a file (or in an argument): what an error message begins with and what is underlined.
///
/// Displays as `path:line:column`, both counted from 1, the column in characters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place(Box<Spot>);

#[derive(Clone, Debug, PartialEq, Eq)]
struct Spot {
    source: String,
    text: Arc<str>,
    span: Range<usize>,
    position: Option<(usize, usize)>,
}

impl Place {
    /// A place in a command-line argument.
    #[must_use]
    pub fn argument(name: &str, text: &str, span: Range<usize>) -> Place {
        Place(Box::new(Spot { source: name.to_owned(), text: Arc::from(text), span, position: None }))
    }

    /// The path as the user wrote it, or the name of the argument.
    #[must_use]
    pub fn source(&self) -> &str {
        &self.0.source
    }

    /// The whole text.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.0.text
    }

    /// The byte range to underline.
    #[must_use]
    pub fn span(&self) -> Range<usize> {
        self.0.span.clone()
    }

    /// Line and column of the start, from 1; `None` in an argument.
    #[must_use]
    pub fn position(&self) -> Option<(usize, usize)> {
        self.0.position
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let source = one_line(&self.0.source);
        match self.0.position {
            Some((line, column)) => write!(f, "{source}:{line}:{column}"),
            None => f.write_str(&source),
        }
    }
}
