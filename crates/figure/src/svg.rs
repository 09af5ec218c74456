//! A small SVG writer: lengths in points, fixed number formatting, so the same picture is the same text.

use crate::text::{FONT_FAMILY, Text};
use crate::words::{escape, number};
use std::fmt::Write as _;

/// Points per millimetre.
pub const MM: f64 = 72.0 / 25.4;

/// Where the given point of a text lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// At the start.
    Start,
    /// In the middle.
    Middle,
    /// At the end.
    End,
}

/// How a text is set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Size in points.
    pub size: f64,
    /// Which point of the text the given point is.
    pub anchor: Anchor,
    /// Bold letters.
    pub bold: bool,
    /// Reads from bottom to top.
    pub upwards: bool,
}

impl Style {
    /// Regular horizontal text of this size.
    #[must_use]
    pub fn new(size: f64, anchor: Anchor) -> Style {
        Style { size, anchor, bold: false, upwards: false }
    }

    /// This style in bold.
    #[must_use]
    pub fn bold(self) -> Style {
        Style { bold: true, ..self }
    }

    /// This style reading from bottom to top.
    #[must_use]
    pub fn upwards(self) -> Style {
        Style { upwards: true, ..self }
    }
}

/// A picture under construction; `y` grows downwards.
#[derive(Clone, Debug, Default)]
pub struct Svg {
    definitions: String,
    body: String,
}

impl Svg {
    /// An empty picture.
    #[must_use]
    pub fn new() -> Svg {
        Svg::default()
    }

    /// Adds a definition (pattern, clip path) as written.
    pub fn define(&mut self, definition: &str) {
        self.definitions.push_str(definition);
        self.definitions.push('\n');
    }

    /// Opens a group with these attributes.
    pub fn open(&mut self, attributes: &str) {
        let _ = writeln!(self.body, "<g {attributes}>");
    }

    /// Closes the innermost group.
    pub fn close(&mut self) {
        self.body.push_str("</g>\n");
    }

    /// Adds a rectangle.
    pub fn rect(&mut self, [x, y, width, height]: [f64; 4], attributes: &str) {
        let [x, y, width, height] = [x, y, width, height].map(number);
        let _ =
            writeln!(self.body, r#"<rect x="{x}" y="{y}" width="{width}" height="{height}" {attributes}/>"#);
    }

    /// Adds a path; nothing for an empty one.
    pub fn path(&mut self, data: &str, attributes: &str) {
        if !data.is_empty() {
            let _ = writeln!(self.body, r#"<path d="{data}" {attributes}/>"#);
        }
    }

    /// Adds an embedded picture.
    pub fn image(&mut self, attributes: &str) {
        let _ = writeln!(self.body, "<image {attributes}/>");
    }

    /// Adds a circle.
    pub fn circle(&mut self, x: f64, y: f64, radius: f64, attributes: &str) {
        let [x, y, radius] = [x, y, radius].map(number);
        let _ = writeln!(self.body, r#"<circle cx="{x}" cy="{y}" r="{radius}" {attributes}/>"#);
    }

    /// Adds a text.
    pub fn text(&mut self, x: f64, y: f64, text: &Text, style: Style) {
        let content = text.tspans(style.size);
        if content.is_empty() {
            return;
        }
        let [x, y, size] = [x, y, style.size].map(number);
        let anchor = match style.anchor {
            Anchor::Start => "",
            Anchor::Middle => r#" text-anchor="middle""#,
            Anchor::End => r#" text-anchor="end""#,
        };
        let weight = if style.bold { r#" font-weight="bold""# } else { "" };
        let turn = if style.upwards { format!(r#" transform="rotate(-90 {x} {y})""#) } else { String::new() };
        let _ = writeln!(
            self.body,
            r#"<text x="{x}" y="{y}" font-size="{size}"{anchor}{weight}{turn} xml:space="preserve">{content}</text>"#
        );
    }

    /// The finished document of this size in points, on white.
    #[must_use]
    pub fn finish(self, width: f64, height: f64, title: &str, metadata: &str) -> String {
        self.finish_enlarged(1.0, [width, height], title, metadata)
    }

    /// The finished document, drawn in this size in points and shown so many times as large, on white.
    #[must_use]
    pub fn finish_enlarged(
        self,
        times: f64,
        [width, height]: [f64; 2],
        title: &str,
        metadata: &str,
    ) -> String {
        let [mm_width, mm_height] = [width / MM, height / MM].map(|mm| number(times * mm));
        let [width, height] = [width, height].map(number);
        let title = escape(title);
        let metadata = escape(metadata);
        format!(
            r##"<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" version="1.1" width="{mm_width}mm" height="{mm_height}mm" viewBox="0 0 {width} {height}" font-family="{FONT_FAMILY}" fill="#000000">
<title>{title}</title>
<metadata>{metadata}</metadata>
<defs>
{definitions}</defs>
<rect width="{width}" height="{height}" fill="#FFFFFF"/>
{body}</svg>
"##,
            definitions = self.definitions,
            body = self.body,
        )
    }
}

/// A polyline as path data; the points are `(x, y)` in points.
#[must_use]
pub fn polyline(points: impl IntoIterator<Item = (f64, f64)>) -> String {
    let mut data = String::new();
    for (i, (x, y)) in points.into_iter().enumerate() {
        let letter = if i == 0 { 'M' } else { 'L' };
        let _ = write!(data, "{letter}{} {}", number(x), number(y));
    }
    data
}
