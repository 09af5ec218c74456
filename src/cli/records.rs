//! Records of measurements: files, and what folders hold of them.

use crate::cli::error::{Error, Result};
use crate::cli::talk::note;
use squealmap::disk;
use squealmap_input::quote::one_line;
use std::collections::BTreeSet;
use std::path::PathBuf;

/// The records that are meant, each once, those of folders by name.
pub(crate) fn listed(given: &[PathBuf]) -> Result<Vec<PathBuf>> {
    const ENDINGS: [&str; 8] = ["csv", "tsv", "txt", "wav", "mat", "uff", "unv", "tdms"];
    let mut all = Vec::new();
    for path in given {
        if !path.exists() {
            return Err(Error::NoRecords {
                path: path.clone(),
                why: "does not exist; give records, or folders of records".to_owned(),
            });
        }
        if !path.is_dir() {
            all.push(path.clone());
            continue;
        }
        let unreadable = |why: std::io::Error| Error::NoRecords { path: path.clone(), why: why.to_string() };
        let mut inside = Vec::new();
        for name in disk::door().names(path).map_err(unreadable)? {
            let entry = path.join(name);
            let is_record = entry
                .extension()
                .is_some_and(|ending| ENDINGS.iter().any(|known| ending.eq_ignore_ascii_case(known)));
            if is_record && entry.is_file() {
                inside.push(entry);
            }
        }
        if inside.is_empty() {
            let why = format!("holds no record: no file that ends in .{}", ENDINGS.join(", ."));
            return Err(Error::NoRecords { path: path.clone(), why });
        }
        inside.sort();
        all.extend(inside);
    }
    let mut known = BTreeSet::new();
    all.retain(|path| {
        let is_new = known.insert(path.canonicalize().unwrap_or_else(|_| path.clone()));
        if !is_new {
            note(&format!(
                "warning: `{}` is given twice and counts once",
                one_line(&path.display().to_string())
            ));
        }
        is_new
    });
    Ok(all)
}
