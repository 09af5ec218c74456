//! How well `identify` does on strokes as a laboratory records them, per witness and jointly.
//!
//!     cargo bench --bench strokes                  # benches/results/strokes.csv and the error rates of the program
//!     cargo bench --bench strokes -- population    # the simulated population behind the probabilities of a phase

#[expect(dead_code, reason = "the tests use the rest")]
#[path = "../tests/suite/common.rs"]
mod common;
#[expect(dead_code, reason = "the tests use the rest")]
#[path = "../tests/suite/study"]
mod study {
    pub(crate) mod confusion;
    pub(crate) mod laboratory;
    pub(crate) mod strokes;
}
#[path = "strokes/population.rs"]
mod population;
#[path = "strokes/table.rs"]
mod table;

use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    if std::env::args().any(|argument| argument == "population") {
        population::write(&root.join("crates/identify/src/population.csv"))
    } else {
        table::write(root)
    }
}
