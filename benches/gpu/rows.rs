//! The figures of every kernel by every compiler: as a table, and as rows of a file of which the newest of a case is kept.

use std::error::Error;
use std::path::PathBuf;

use squealmap::version::COMMIT;

use crate::date::date;
use crate::figures::Figures;

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
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("benches/results/gpu-pipelines.csv");
    let header: Vec<&str> =
        KEY.iter().chain(&["version", "date", "commit"]).chain(&Figures::NAMES).copied().collect();
    let mut kept: Vec<Vec<String>> = Vec::new();
    if path.exists() {
        let mut old = csv::Reader::from_path(&path)?;
        // Rows of other columns than today's are of no use beside them.
        if old.headers()?.iter().eq(header.iter().copied()) {
            for record in old.records() {
                kept.push(record?.iter().map(str::to_owned).collect());
            }
        }
    }
    for row in rows {
        let fields = row.fields();
        match kept.iter_mut().find(|old| old[..KEY.len()] == fields[..KEY.len()]) {
            Some(old) => *old = fields,
            None => kept.push(fields),
        }
    }
    let mut writer = csv::Writer::from_path(&path)?;
    writer.write_record(&header)?;
    for record in &kept {
        writer.write_record(record)?;
    }
    writer.flush()?;
    Ok(path)
}
