//! Text with italic symbols, subscripts and superscripts, and its width.

use std::fmt::Write as _;

use crate::glyphs;
use crate::tex::{escaped, formula};
use crate::words::{escape, number};

/// The families of every text: metric-compatible, the last embedded for PNG.
pub const FONT_FAMILY: &str = "Arial, Helvetica, Liberation Sans, sans-serif";

/// Size of sub- and superscripts relative to the text, ...
const SCRIPT_SIZE: f64 = 0.74;
/// ... and the least that journals print, points.
const LEAST_SCRIPT: f64 = 6.0;
/// Depth of a subscript below the base line, in ems of the text.
const SUB_SHIFT: f64 = 0.22;
/// Height of a superscript above the base line, in ems of the text.
const SUP_SHIFT: f64 = 0.36;
/// Bold letters are wider by about this factor.
const BOLD_WIDTH: f64 = 1.08;

/// Advances of the printable ASCII characters from the space on.
#[rustfmt::skip]
const ADVANCES: [u16; 95] = [
    569, 569, 727, 1139, 1139, 1821, 1366, 391, 682, 682, 797, 1196, 569, 682, 569, 569, 1139, 1139, 1139, 1139,
    1139, 1139, 1139, 1139, 1139, 1139, 569, 569, 1196, 1196, 1196, 1139, 2079, 1366, 1366, 1479, 1479, 1366, 1251,
    1593, 1479, 569, 1024, 1366, 1139, 1706, 1479, 1593, 1366, 1593, 1479, 1366, 1251, 1479, 1366, 1933, 1366, 1366,
    1251, 569, 569, 569, 961, 1139, 682, 1139, 1139, 1024, 1139, 1139, 569, 1139, 1139, 455, 455, 1024, 455, 1706,
    1139, 1139, 1139, 1139, 682, 1024, 569, 1139, 1024, 1479, 1024, 1024, 1024, 684, 532, 684, 1196,
];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Script {
    Base,
    Sub,
    Sup,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Span {
    text: String,
    italic: bool,
    script: Script,
}

/// A line of text made of spans.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Text(Vec<Span>);

impl From<&str> for Text {
    fn from(text: &str) -> Text {
        Text::default().plain(text)
    }
}

impl From<String> for Text {
    fn from(text: String) -> Text {
        Text::default().plain(&text)
    }
}

impl Text {
    fn span(mut self, text: &str, italic: bool, script: Script) -> Text {
        if let Some(last) = self.0.last_mut().filter(|last| last.italic == italic && last.script == script) {
            last.text.push_str(text);
        } else if !text.is_empty() {
            self.0.push(Span { text: text.to_owned(), italic, script });
        }
        self
    }

    /// Adds upright text.
    #[must_use]
    pub fn plain(self, text: &str) -> Text {
        self.span(text, false, Script::Base)
    }

    /// Adds a superscript.
    #[must_use]
    pub fn superscript(self, text: &str) -> Text {
        self.span(text, false, Script::Sup)
    }

    /// Adds a symbol such as `μ_s`: italic, with an upright subscript after `_`.
    #[must_use]
    pub fn symbol(self, symbol: &str) -> Text {
        let (base, sub) = symbol.split_once('_').unwrap_or((symbol, ""));
        self.span(base, true, Script::Base).span(sub, false, Script::Sub)
    }

    /// Adds a unit with superscripts after `^`, e.g. `m/s^2`.
    #[must_use]
    pub fn unit(self, unit: &str) -> Text {
        let mut pieces = unit.split('^');
        let text = self.plain(pieces.next().unwrap_or_default());
        pieces.fold(text, |text, piece| {
            let end = piece.find(|c: char| !c.is_ascii_digit() && c != '-').unwrap_or(piece.len());
            text.superscript(&piece[..end].replace('-', "−")).plain(&piece[end..])
        })
    }

    /// Adds another text.
    #[must_use]
    pub fn then(self, other: Text) -> Text {
        other.0.into_iter().fold(self, |text, span| text.span(&span.text, span.italic, span.script))
    }

    /// Its width at a size, in the unit of the size.
    #[must_use]
    pub fn width(&self, size: f64, bold: bool) -> f64 {
        let factor = if bold { BOLD_WIDTH } else { 1.0 };
        let span_width = |span: &Span| {
            let size = if span.script == Script::Base { size } else { script_size(size) };
            span.text.chars().map(advance).sum::<f64>() * size
        };
        self.0.iter().map(span_width).sum::<f64>() * factor
    }

    /// The text in lines of a width, each as many words as fit; a word that does not is a line.
    #[must_use]
    pub fn wrapped(&self, width: f64, size: f64) -> Vec<Text> {
        let mut words = vec![Text::default()];
        for span in &self.0 {
            for (number, part) in span.text.split(' ').enumerate() {
                let word = if number == 0 { words.pop().unwrap_or_default() } else { Text::default() };
                words.push(word.span(part, span.italic, span.script));
            }
        }
        let mut lines: Vec<Text> = Vec::new();
        for word in words {
            let longer = lines.last().map(|line| line.clone().plain(" ").then(word.clone()));
            if let Some(longer) = longer.filter(|line| line.width(size, false) <= width) {
                lines.pop();
                lines.push(longer);
            } else {
                lines.push(word);
            }
        }
        lines
    }

    /// The text as LaTeX writes it, symbols and scripts in formulas.
    #[must_use]
    pub fn tex(&self) -> String {
        let mut out = String::new();
        let mut inside = false;
        for span in &self.0 {
            if (span.italic || span.script != Script::Base) != inside {
                out.push('$');
                inside = !inside;
            }
            let _ = match span.script {
                Script::Sub => write!(out, r"_{{\mathrm{{{}}}}}", formula(&span.text)),
                Script::Sup => write!(out, "^{{{}}}", formula(&span.text)),
                Script::Base if inside => write!(out, "{}", formula(&span.text)),
                Script::Base => write!(out, "{}", escaped(&span.text)),
            };
        }
        if inside { out + "$" } else { out }
    }

    /// The content of an SVG `text` element.
    #[must_use]
    pub fn tspans(&self, size: f64) -> String {
        let mut out = String::new();
        let mut shift: f64 = 0.0;
        for span in &self.0 {
            let wanted = match span.script {
                Script::Base => 0.0,
                Script::Sub => SUB_SHIFT * size,
                Script::Sup => -SUP_SHIFT * size,
            };
            let mut attributes = String::new();
            if wanted.to_bits() != shift.to_bits() {
                let _ = write!(attributes, r#" dy="{}""#, number(wanted - shift));
                shift = wanted;
            }
            if span.script != Script::Base {
                let _ = write!(attributes, r#" font-size="{}""#, number(script_size(size)));
            }
            if span.italic {
                attributes.push_str(r#" font-style="italic""#);
            }
            let text = escape(&span.text);
            let _ = if attributes.is_empty() {
                write!(out, "{text}")
            } else {
                write!(out, "<tspan{attributes}>{text}</tspan>")
            };
        }
        out
    }
}

/// The size of a script of a text, points.
fn script_size(size: f64) -> f64 {
    (SCRIPT_SIZE * size).max(LEAST_SCRIPT).min(size)
}

/// Splits a title into lines that fit a width.
#[must_use]
pub fn wrap(text: &str, width: f64, size: f64, bold: bool) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace().flat_map(|word| parts(word, width, size, bold)) {
        match lines.last_mut() {
            Some(line) if glyphs::width(&format!("{line} {word}"), size, bold) <= width => {
                line.push(' ');
                line.push_str(&word);
            }
            _ => lines.push(word),
        }
    }
    lines
}

/// A word, in parts where it is wider than a line.
fn parts(word: &str, width: f64, size: f64, bold: bool) -> Vec<String> {
    let mut parts = vec![String::new()];
    for letter in word.chars() {
        match parts.last_mut() {
            Some(part)
                if part.is_empty() || glyphs::width(&format!("{part}{letter}"), size, bold) <= width =>
            {
                part.push(letter);
            }
            _ => parts.push(letter.to_string()),
        }
    }
    parts
}

/// Advance of a character in ems: Liberation Sans (and Arial, Helvetica).
fn advance(c: char) -> f64 {
    /// Units per em of the font.
    const UNITS: f64 = 2048.0;
    /// Letters outside ASCII: about a lower-case letter.
    const OTHER: u16 = 1139;
    let index = (c as usize).checked_sub(' ' as usize);
    let units = index.and_then(|i| ADVANCES.get(i)).copied().unwrap_or(OTHER);
    f64::from(units) / UNITS
}
