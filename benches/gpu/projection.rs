//! How long a sweep that fills a cube would take on a GPU that is not at hand, part by part: from the counts of this bench and
//! the data sheets of cards. The parts overlap, so that the longest is the whole.
//!
//! Kernel: operations of warps of 32 (`gpu-lockstep.csv`), one for each issue slot that is not empty, as many as on the card that
//! was measured.
//! Host and bus: processor time and bytes of an instance (`gpu-host.csv`), on the cores beside the card. Disk: bytes of a tile
//! with all columns.

use std::error::Error;
use std::path::PathBuf;

use crate::kept::keep;

/// Instances of the sweep, and their periods.
const INSTANCES: f64 = 1024.0 * 1024.0 * 1024.0;
const PERIODS: f64 = 140.0;

/// The time that is aimed at, s.
const AIM: f64 = 60.0;

/// The adapter beside which the host was measured.
const MEASURED: &str = "NVIDIA H100 80GB HBM3";

/// Issue slots of that card that held one of those operations: 4e6 transients at 4 steps per period took 2.17 s by its clock
/// (`gpu-host.csv`).
const FILLED: f64 = 0.26;

/// Bytes of an instance in a tile with all columns of both analyses (`du` of the tiles of 14 400 instances).
const ON_DISK: f64 = 229.0;

/// A card and the machine around it.
struct Card {
    name: &'static str,
    /// Warp instructions issued per second: multiprocessors, schedulers of each, boost clock.
    issued: f64,
    /// Bytes per second over the bus, each way: 85 % of the data sheet's.
    bus: f64,
    /// Cores of the host.
    cores: f64,
    /// Bytes per second to the disk.
    disk: f64,
}

const CARDS: [Card; 2] = [
    Card {
        name: "H100 SXM, 16 cores",
        issued: 132.0 * 4.0 * 1.98e9,
        bus: 0.85 * 63e9,
        cores: 16.0,
        disk: 6e9,
    },
    Card {
        name: "RTX 4090, 16 cores",
        issued: 128.0 * 4.0 * 2.52e9,
        bus: 0.85 * 31.5e9,
        cores: 16.0,
        disk: 6e9,
    },
];

const HEADER: [&str; 8] =
    ["card", "steps_per_period", "part", "of_an_instance", "unit", "seconds", "for_60_s", "limit"];

/// A row of a file of results whose first columns are `key`.
fn found(name: &str, key: &[(&str, &str)], column: &str) -> Result<f64, Box<dyn Error>> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("benches/results").join(name);
    let mut reader = csv::Reader::from_path(&path)?;
    let header = reader.headers()?.clone();
    let place = |name: &str| header.iter().position(|one| one == name).ok_or(format!("no column {name}"));
    let wanted: Vec<(usize, &str)> =
        key.iter().map(|(name, value)| Ok((place(name)?, *value))).collect::<Result<_, String>>()?;
    let column = place(column)?;
    for record in reader.records() {
        let record = record?;
        if wanted.iter().all(|(place, value)| &record[*place] == *value) {
            return Ok(record[column].parse()?);
        }
    }
    Err(format!("{} has no row of {key:?}: run the bench that makes it", path.display()).into())
}

/// Prints and keeps the rows.
pub(crate) fn run() -> Result<(), Box<dyn Error>> {
    println!("| {} |\n|{}", HEADER.join(" | "), "---|".repeat(HEADER.len()));
    let host = |column| {
        let key = [("adapter", MEASURED), ("case", "140 periods"), ("chunk", "own")];
        found("gpu-host.csv", &key, column)
    };
    let [host_us, up, back] = [host("host_us")?, host("bytes_up")?, host("bytes_back")?];
    let mut rows = Vec::new();
    for card in &CARDS {
        for steps in ["4", "12"] {
            let key = [("part", "all"), ("lanes", "32"), ("steps_per_period", steps)];
            let lanes = found("gpu-lockstep.csv", &key, "warp_operations_per_period")?;
            let parts = [
                ("kernel", lanes / 32.0 * PERIODS, "warp instructions", FILLED * card.issued),
                ("host", host_us, "µs", card.cores * 1e6),
                ("bus", up.max(back), "bytes one way", card.bus),
                ("disk", ON_DISK, "bytes", card.disk),
            ];
            let seconds = parts.map(|(_, size, _, rate)| size * INSTANCES / rate);
            let longest = seconds.iter().copied().fold(0.0, f64::max);
            for ((part, size, unit, rate), seconds) in parts.into_iter().zip(seconds) {
                let fields = vec![
                    card.name.to_owned(),
                    steps.to_owned(),
                    part.to_owned(),
                    format!("{size:.0}"),
                    unit.to_owned(),
                    format!("{seconds:.0}"),
                    format!("{:.2}", AIM * rate / INSTANCES),
                    if seconds >= longest { "limit".to_owned() } else { String::new() },
                ];
                println!("| {} |", fields.join(" | "));
                rows.push(fields);
            }
        }
    }
    println!("kept in {}", keep("gpu-projection.csv", &HEADER, 3, rows)?.display());
    Ok(())
}
