//! The pin on the block for CalculiX: writes its `.inp` file and prints the ten lowest frequencies that this program finds at μ = 0.
//!
//!     cargo run --release -p squealmap-fem --example calculix -- pin.inp 1
//!     ccx -i pin        # the ten frequencies of pin.dat are to be the same

#![allow(clippy::doc_markdown, reason = "CalculiX and symbols of equations are no code")]

#[path = "../tests/suite/cases/mod.rs"]
#[expect(dead_code, reason = "one of the models is used here")]
mod cases;

use squealmap_fem::assembly::assemble;
use squealmap_fem::elements::Kind;
use squealmap_fem::modes::{Factor, Ordering, lowest};
use squealmap_fem::output::inp;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let path =
        words.next().ok_or("give the path of the file to write, and into how many to cut each 5 mm")?;
    let model = cases::pin::model(Kind::Hex20, words.next().map_or(Ok(1), |word| word.parse())?)?;
    std::fs::write(path, inp(&model, 10))?;
    let (_, pencil) = assemble(&model)?;
    let ordering = Ordering::new(&pencil.stiffness.pattern)?;
    let factor = Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0)?;
    for frequency in lowest(&pencil, &factor, 10)?.frequencies() {
        println!("{frequency:.4}");
    }
    Ok(())
}
