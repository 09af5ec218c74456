//! `figure.json` and `spectrogram.nc`: the figure of measured signals read back.

use crate::results::read::folder::Folder;
use crate::study::error::Result;
use crate::study::identify::report::Shown;
use crate::study::identify::spectrogram::filled_from;

/// The files that are read.
pub(crate) const FILES: [&str; 2] = ["spectrogram.nc", "figure.json"];

/// Reads everything that the figure shows.
pub(crate) fn read(folder: Folder<'_>) -> Result<Shown> {
    let document = folder.json(FILES[1])?;
    let shown: Shown = serde_json::from_value(document["figure"].clone())
        .map_err(|why| folder.bad(FILES[1], why.to_string()))?;
    let bytes = folder.bytes(FILES[0])?;
    let spectrogram = filled_from(&shown.spectrogram, &shown.title, &bytes);
    let spectrogram =
        spectrogram.ok_or_else(|| folder.bad(FILES[0], "does not belong to `figure.json` beside it"))?;
    Ok(Shown { spectrogram, ..shown })
}
