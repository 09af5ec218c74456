//! A study from its file, and from the files that it names.

use std::path::Path;

use crate::disk;
use crate::study::error::{Error, Result};
use squealmap_fem::study::document::Document;
use squealmap_fem::study::{Study, place};
use squealmap_input::place::Source;

/// Reads a description of bodies in contact and builds its model; files that it names are relative to its directory. Gives
/// its text, too.
///
/// # Errors
/// When a file cannot be read, or anything in it is not valid.
pub fn open(path: &Path) -> Result<(Study, String)> {
    let text = text_of(path).map_err(|why| Error::Fem { path: path.to_owned(), at: None, why })?;
    let study = study(path, &text)?;
    Ok((study, text))
}

/// The study that a text describes, as if it stood in a file.
///
/// # Errors
/// Those of [`open`].
pub fn study(path: &Path, text: &str) -> Result<Study> {
    let wrong = |why: squealmap_fem::Error| of_study(path, text, &why);
    let beside = path.parent().unwrap_or(Path::new(""));
    let document = Document::read(text).map_err(wrong)?;
    Study::new(document, &|path| text_of(&beside.join(path))).map_err(wrong)
}

/// What is wrong with a description, and where.
#[must_use]
pub fn of_study(path: &Path, text: &str, why: &squealmap_fem::Error) -> Error {
    let source = Source::new(path.display().to_string(), text);
    let at = place(text, why).map(|span| source.place(span));
    let why = match why {
        squealmap_fem::Error::Description { what, .. } => what.clone(),
        other => other.to_string(),
    };
    Error::Fem { path: path.to_owned(), at, why }
}

/// The text of a file, or why there is none.
fn text_of(path: &Path) -> std::result::Result<String, String> {
    let bytes = disk::read(path).map_err(|why| format!("cannot read `{}`: {why}", path.display()))?;
    String::from_utf8(bytes).map_err(|_| format!("`{}` is no text in UTF-8", path.display()))
}
