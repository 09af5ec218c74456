//! The lines around a place as an error shows them: few and short, whatever the file holds.

use std::ops::Range;

use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};
use squealmap_input::place::Place;
use squealmap_input::quote::{is_obeyed, one_line};

/// The most characters of a line that are shown.
const WIDTH: usize = 120;

/// How many of these characters stand before the place.
const BEFORE: usize = 60;

/// Lines of a place that are shown.
const LINES: usize = 6;

/// A part of a text: the lines of a place, the one before and the one after.
#[derive(Debug)]
pub(crate) struct Excerpt {
    name: String,
    text: String,
    /// What is underlined in `text`.
    pub(crate) span: Range<usize>,
    /// Lines of the file before the first that is shown.
    above: usize,
    /// Characters that the line of the place has lost at its beginning.
    cut: usize,
}

impl Excerpt {
    pub(crate) fn new(place: &Place) -> Excerpt {
        let (text, span) = (place.text(), place.span());
        let begin = |at: usize| text[..at].rfind('\n').map_or(0, |newline| newline + 1);
        let line = begin(span.start);
        let first = begin(line.saturating_sub(1));
        let mut excerpt = Excerpt {
            name: one_line(place.source()),
            text: String::new(),
            span: 0..0,
            above: text[..first].bytes().filter(|byte| *byte == b'\n').count(),
            cut: 0,
        };
        if first < line {
            excerpt.push(&text[first..line], 0);
        }
        let mut start = line;
        for number in 0..LINES {
            let end = text[start..].find('\n').map_or(text.len(), |newline| start + newline + 1);
            let at = excerpt.text.len();
            let here = span.start.max(start) - start..span.end.clamp(start, end) - start;
            let cut = if number == 0 { cut(&text[start..end], here.start) } else { 0 };
            let shown = excerpt.push(&text[start..end], cut);
            let place = |byte: usize| {
                at + shown.iter().take_while(|(from, _)| *from < byte).map(|(_, size)| size).sum::<usize>()
            };
            if number == 0 {
                excerpt.cut = text[start..start + cut].chars().count();
                excerpt.span = place(here.start)..0;
            }
            excerpt.span.end = place(here.end).max(excerpt.span.start);
            start = end;
            if span.end <= end || start == text.len() {
                break;
            }
        }
        if start < text.len() {
            let end = text[start..].find('\n').map_or(text.len(), |newline| start + newline + 1);
            excerpt.push(&text[start..end], 0);
        }
        excerpt
    }

    /// Appends a line from its byte `cut` on; gives where each character of the line stood and how many bytes it has here.
    fn push(&mut self, line: &str, cut: usize) -> Vec<(usize, usize)> {
        let ended = line.ends_with('\n');
        let line = line.trim_end_matches(['\n', '\r']);
        let mut shown = Vec::new();
        let mut characters = line.get(cut..).unwrap_or_default().char_indices();
        for (at, c) in characters.by_ref().take(WIDTH) {
            let c = if is_obeyed(c) && c != '\t' { char::REPLACEMENT_CHARACTER } else { c };
            self.text.push(c);
            shown.push((cut + at, c.len_utf8()));
        }
        if characters.next().is_some() {
            self.text.push('…');
        }
        if ended {
            self.text.push('\n');
        }
        shown
    }
}

/// The byte from which a line is shown, where it is too long for the place to be seen from its beginning.
fn cut(line: &str, place: usize) -> usize {
    let place = place.min(line.len());
    if line[..place].chars().count() <= WIDTH / 2 + BEFORE / 2 {
        return 0;
    }
    line[..place].char_indices().nth_back(BEFORE - 1).map_or(0, |(at, _)| at)
}

impl SourceCode for Excerpt {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let found = self.text.read_span(span, before, after)?;
        // Without lines around it this is asked for the head of the excerpt, which names line and column of the file.
        let cut = if before == 0 && after == 0 { self.cut } else { 0 };
        Ok(Box::new(MietteSpanContents::new_named(
            self.name.clone(),
            found.data(),
            *found.span(),
            found.line() + self.above,
            found.column() + cut,
            found.line_count(),
        )))
    }
}
