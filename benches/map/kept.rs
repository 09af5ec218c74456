//! Rows of a bench in `benches/results/`: the newest of every case.

use std::error::Error;
use std::path::PathBuf;

/// Keeps rows in the file of a name, in place of those with the same first `key` fields; returns the file. Rows of other columns
/// than `header` are of no use beside them, and go.
pub(crate) fn keep(
    name: &str,
    header: &[&str],
    key: usize,
    rows: impl IntoIterator<Item = Vec<String>>,
) -> Result<PathBuf, Box<dyn Error>> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("benches/results");
    let path = folder.join(name);
    let mut kept: Vec<Vec<String>> = Vec::new();
    if path.exists() {
        let mut old = csv::Reader::from_path(&path)?;
        if old.headers()?.iter().eq(header.iter().copied()) {
            for record in old.records() {
                kept.push(record?.iter().map(str::to_owned).collect());
            }
        }
    }
    for fields in rows {
        match kept.iter_mut().find(|old| old[..key] == fields[..key]) {
            Some(old) => *old = fields,
            None => kept.push(fields),
        }
    }
    std::fs::create_dir_all(&folder)?;
    let mut writer = csv::Writer::from_path(&path)?;
    writer.write_record(header)?;
    for record in &kept {
        writer.write_record(record)?;
    }
    writer.flush()?;
    Ok(path)
}
