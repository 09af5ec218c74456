//! Errors as the user sees them: one sentence, then the place underlined.

use std::error::Error as _;
use std::fmt::{self, Write as _};
use std::io::{IsTerminal, Write as _};

use crate::cli::error::Error;
use crate::cli::excerpt::Excerpt;
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, SourceCode};
use squealmap_input::place::Place;
use squealmap_input::quote::message;

/// Prints the error, its causes and the place in the input that it is about.
pub(crate) fn report(error: &Error) {
    let mut text = format!("error: {}\n", message(&error.to_string()));
    let mut cause = error.source();
    while let Some(error) = cause {
        let _ = writeln!(text, "caused by: {}", message(&error.to_string()));
        cause = error.source();
    }
    if let Some(place) = error.place() {
        text.push_str(&snippet(place));
    }
    // Without standard error there is nobody to tell.
    let _ = std::io::stderr().lock().write_all(text.as_bytes());
}

/// The lines around a place with the place underlined.
fn snippet(place: &Place) -> String {
    let terminal = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let theme = if terminal { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
    let diagnostic = Underlined(Excerpt::new(place));
    let mut text = String::new();
    let rendered = GraphicalReportHandler::new_themed(theme)
        .with_context_lines(1)
        .render_report(&mut text, &diagnostic)
        .map(|()| text);
    // The first line is for a message, which stands above in full.
    rendered.ok().and_then(|text| text.split_once('\n').map(|(_, rest)| rest.to_owned())).unwrap_or_default()
}

/// A part of a source text with one range underlined.
#[derive(Debug)]
struct Underlined(Excerpt);

impl fmt::Display for Underlined {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("here")
    }
}

impl std::error::Error for Underlined {}

impl Diagnostic for Underlined {
    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&self.0)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let span = LabeledSpan::new(None, self.0.span.start, self.0.span.len());
        Some(Box::new(std::iter::once(span)))
    }
}
