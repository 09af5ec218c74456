//! The results of `refine`: put in place so that `refine.json` says what all of them are, and held against it.

use std::path::{Path, PathBuf};

use crate::cli::error::{Error, Result};
use crate::cli::output::{claim, fill, filled, publish_with};
use crate::cli::pictures::png_of;
use crate::cli::summed::unlike;
use serde_json::Value as Json;
use squealmap::disk;
use squealmap::results::boundary_lines::refined_lines;
use squealmap::results::figure::look::{AGAIN, Look};
use squealmap::results::manifest::Sum;
use squealmap::results::refined::{OfParts, document, figure, is_without_sums};
use squealmap::store::claim::Claim;
use squealmap::store::parts::{Found, PARTS, Parts};
use squealmap::store::refinement::Refinement;
use squealmap::store::seal::is_intact;
use squealmap::sweep::label::Tally;
use squealmap::sweep::refine::Refined;
use squealmap::sweep::spec::Spec;

/// How the lines were found; what says that the others are there.
pub(crate) const DOCUMENT: &str = "refine.json";

/// The files that are written: the table while instances come, the others at the end.
pub(crate) const FILES: [&str; 5] = ["points.csv", "boundaries.csv", DOCUMENT, "refined.png", "refined.svg"];

/// The files that the document names.
const NAMED: [&str; 4] = [FILES[0], FILES[1], FILES[3], FILES[4]];

/// A refinement that has come to its end, with the table of its points.
pub(crate) struct Ended<'a> {
    pub(crate) spec: &'a Spec,
    pub(crate) asked: &'a Refinement,
    pub(crate) refined: &'a Refined,
    pub(crate) parts: Vec<(String, String)>,
    pub(crate) table: Claim,
    pub(crate) table_sum: Sum,
}

impl Ended<'_> {
    /// Writes all files or none: first under temporary names, then renamed.
    pub(crate) fn write(self, directory: &Path) -> Result<(Vec<PathBuf>, Tally)> {
        let mut last = claim(&directory.join(DOCUMENT))?;
        let figure = figure(self.asked.description.sheet(), self.refined);
        let computed = self.refined.computed;
        let command =
            format!("squealmap refine, from {computed} computed instances; drawn again by: {AGAIN}");
        let svg = figure.look(&Look { command: Some(command), ..Look::default() });
        let lines = refined_lines(self.spec, self.refined)?;
        let mut files = vec![self.table];
        let mut of = OfParts { parts: self.parts, files: vec![(FILES[0], self.table_sum)] };
        for (name, bytes) in [(FILES[1], lines), (FILES[3], png_of(&svg)?), (FILES[4], svg.into_bytes())] {
            files.push(filled(&directory.join(name), &bytes)?);
            of.files.push((name, Sum::of(&bytes)));
        }
        fill(&mut last, &document(self.asked, self.refined, &of)?)?;
        Ok((publish_with(last, files, None)?, figure.tally().clone()))
    }
}

/// The content of a refined directory.
pub(crate) struct Checked {
    /// Its parts.
    pub(crate) found: Found,
    /// Whether results are there, or some of them.
    pub(crate) has_results: bool,
    /// A sentence for everything that is wrong.
    pub(crate) faults: Vec<String>,
    /// The refinement that the results are of, where `refine.json` is as it was written.
    of: Option<Refinement>,
}

impl Checked {
    /// Looks at a directory; `None` where nothing was refined in it.
    ///
    /// # Errors
    /// When its folder of parts cannot be read.
    pub(crate) fn read(directory: &Path) -> Result<Option<Checked>> {
        let parts = Parts::found(directory)?;
        let is_there = |name: &str| directory.join(name).exists();
        if parts.is_none() && !is_there(DOCUMENT) {
            return Ok(None);
        }
        let found = parts.unwrap_or_default();
        // `plot` of a map writes a table of lines, too.
        let has_results = FILES.iter().any(|name| *name != FILES[1] && is_there(name));
        let mut checked = Checked { faults: found.damaged(), found, has_results, of: None };
        if has_results {
            checked.results(directory);
        }
        Ok(Some(checked))
    }

    /// Holds the results against the document.
    fn results(&mut self, directory: &Path) {
        let bytes = disk::read(&directory.join(DOCUMENT)).unwrap_or_default();
        let document: Json = serde_json::from_slice(&bytes).unwrap_or_default();
        if !document.is_object() {
            self.faults.push(format!(
                "`{DOCUMENT}` is not there or no document: nothing says what the results are of"
            ));
            return;
        }
        if is_without_sums(&document) {
            self.faults.push(format!(
                "`{DOCUMENT}` is of an earlier version, which wrote no checksums: it cannot be told whether it is as it was \
                 written, nor {}, nor whether all of `{PARTS}` is there",
                NAMED.map(|name| format!("`{name}`")).join(", ")
            ));
            return;
        }
        let asked = Refinement::from_json(&document);
        let parts = OfParts::parts_in(&document);
        match (is_intact(&bytes), asked, parts) {
            (true, Ok(asked), Some(parts)) => {
                self.faults.extend(self.found.lacking(DOCUMENT, &parts, &asked));
                self.of = Some(asked);
            }
            (true, Err(why), _) => self.faults.push(format!("`{DOCUMENT}`: {why}")),
            (true, Ok(_), None) => self.faults.push(format!("`{DOCUMENT}` names no parts")),
            // What it names may be what was changed.
            (false, ..) => {
                self.faults.push(format!("`{DOCUMENT}`: its content does not have its checksum"));
                return;
            }
        }
        self.faults.extend(NAMED.iter().filter_map(|name| unlike(directory, name, DOCUMENT, &document)));
    }

    /// Whether the results are there, whole, and those of this refinement.
    pub(crate) fn is_current(&self, asked: &Refinement) -> bool {
        self.faults.is_empty() && self.of.as_ref().is_some_and(|of| of.is_same(asked))
    }

    /// The refinement that heals the directory: the one that its results are of, or else the only one that has parts.
    ///
    /// # Errors
    /// When neither says it.
    pub(crate) fn asked(&self, directory: &Path) -> Result<&Refinement> {
        match (&self.of, self.found.asked.as_slice()) {
            // Beside a damaged file a good one may be of another refinement.
            (Some(asked), _) | (None, [(_, Ok(asked))]) => Ok(asked),
            _ => Err(Error::NoRefinement { path: directory.to_owned() }),
        }
    }
}
