//! Eigenvalues against the friction coefficient: where do two modes merge, and which one then grows?
//!
//!     cargo run --release --example eigenvalues

use squealmap::study::modes::follow::modes_of;
use squealmap::{LawKind, Param, Sweep};

pub(crate) fn main() -> Result<(), squealmap::Error> {
    let spec = Sweep::two_mass()
        .law(LawKind::Constant)
        .set(Param::BeltVelocity, 3.0)
        .axis(Param::MuD, 0.0..=0.6, 61)
        .without_response()
        .spec()?;
    for branch in modes_of(&spec)?.branches {
        for (mu, modes) in branch.values.iter().zip(&branch.modes).step_by(10) {
            let Some([one, other]) = modes.as_deref() else { continue };
            let [f, g] = [one.frequency(), other.frequency()];
            println!("mu = {mu:.1}: {f:5.1} Hz and {g:5.1} Hz, growth {:+.2} 1/s", one.growth_rate());
        }
        println!("unstable from mu = {:?} on", branch.critical);
    }
    Ok(())
}
