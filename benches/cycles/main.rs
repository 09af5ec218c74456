//! `cargo bench --bench cycles [-- options]`: limit cycles found by shooting beside runs that wait for them.
//!
//! Three questions: what does it save (two maps, `settle = "cycle"` beside `"auto"` in close turn), how exact is it (a sample of
//! both beside runs of 5000 periods, measured over whole ones), and does any run end elsewhere than it says (random
//! instances from small and large starts beside runs of up to 4000 periods). The rows go to `benches/results/cycles.csv`.

mod drawn;
mod exact;
mod maps;
mod save;

use std::error::Error;

use clap::Parser;

/// What is measured.
#[derive(Debug, Parser)]
struct Options {
    /// Random instances of the third question.
    #[arg(long, default_value_t = 2000)]
    instances: usize,
    /// Instances of each map that the second question is asked of.
    #[arg(long, default_value_t = 200)]
    sample: usize,
    /// Times that each map is computed.
    #[arg(long, default_value_t = 9)]
    rounds: usize,
    /// Writes no file.
    #[arg(long)]
    dry: bool,
    /// Given by cargo.
    #[arg(long, hide = true)]
    bench: bool,
}

/// One number that was measured.
pub(crate) struct Row {
    pub(crate) of: String,
    pub(crate) quantity: String,
    pub(crate) value: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let options = Options::parse();
    let mut rows = Vec::new();
    for map in maps::all()? {
        rows.extend(save::rows(&map, options.rounds));
        rows.extend(exact::rows(&map, options.sample));
    }
    rows.extend(drawn::rows(options.instances));
    for Row { of, quantity, value } in &rows {
        println!("{of:40} {quantity:44} {value:.4e}");
    }
    if !options.dry {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/results/cycles.csv");
        let mut table = csv::Writer::from_path(path)?;
        table.write_record(["of", "quantity", "value"])?;
        for Row { of, quantity, value } in &rows {
            table.write_record([of, quantity, &format!("{value:e}")])?;
        }
        table.flush()?;
    }
    Ok(())
}
