//! The figures of every kernel by every compiler: as a table, and as rows of a file of which the newest of a case is kept.

use std::error::Error;
use std::path::PathBuf;

use squealmap::version::COMMIT;

use crate::date::date;
use crate::figures::Figures;
use crate::kept;

/// What one compiler says of one kernel.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Row {
    pub(crate) kernel: String,
    pub(crate) scalar: String,
    pub(crate) compiler: String,
    pub(crate) version: String,
    pub(crate) figures: Figures,
}

/// The columns that say which case a row is.
const KEY: [&str; 3] = ["kernel", "scalar", "compiler"];

impl Row {
    fn fields(&self) -> Vec<String> {
        let key = [&self.kernel, &self.scalar, &self.compiler].map(Clone::clone);
        let kept = [self.version.clone(), date(), COMMIT.unwrap_or("unknown").to_owned()];
        let figures =
            self.figures.values().map(|value| value.map(|value| value.to_string()).unwrap_or_default());
        key.into_iter().chain(kept).chain(figures).collect()
    }

    /// A line of the printed table.
    pub(crate) fn line(&self) -> String {
        let figures =
            self.figures.values().map(|value| value.map_or("–".to_owned(), |value| value.to_string()));
        format!("| {} | {} | {} | {} |", self.kernel, self.scalar, self.compiler, figures.join(" | "))
    }
}

/// The head of the printed table.
pub(crate) fn head() -> String {
    let columns = KEY.iter().chain(&Figures::NAMES).count();
    let names: Vec<&str> = KEY.iter().chain(&Figures::NAMES).copied().collect();
    format!("| {} |\n|{}", names.join(" | "), "---|".repeat(columns))
}

/// Keeps the rows; returns the file.
pub(crate) fn keep(rows: &[Row]) -> Result<PathBuf, Box<dyn Error>> {
    let header: Vec<&str> =
        KEY.iter().chain(&["version", "date", "commit"]).chain(&Figures::NAMES).copied().collect();
    kept::keep("gpu-pipelines.csv", &header, KEY.len(), rows.iter().map(Row::fields))
}
