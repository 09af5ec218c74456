//! A stability map built in code: where the two masses squeal, how strongly, and the figure of it.
//!
//!     cargo run --release --example map

use squealmap::FrictionLaw::Bilinear;
use squealmap::results::figure::map::map_svg;
use squealmap::{Param, Settle, Sweep};

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let map = Sweep::two_mass()
        .title("Static against dynamic friction")
        .friction(Bilinear { mu_s: 0.5, mu_d: 0.3, knee_velocity: 5.0 })
        .set(Param::BeltVelocity, 3.0)
        .axis(Param::MuS, 0.0..=0.6, 9)
        .axis(Param::MuD, 0.0..=0.6, 7)
        .response(Settle::Auto)
        .run()?;

    // A column by its name, over the axes: here along mu_s, where mu_d is 0.3.
    let amplitude = map.array("x2_std")?;
    let along = amplitude.at("mu_d", 3).ok_or("mu_d has 7 values")?;
    for (mu_s, std) in amplitude.along("mu_s").unwrap_or_default().iter().zip(&along.values) {
        println!("mu_s = {mu_s:.3}: x2 varies by {std:.2e} m");
    }

    let file = std::env::temp_dir().join("squealmap-map.svg");
    std::fs::write(&file, map_svg(&map)?)?;
    println!("the map: {}", file.display());
    Ok(())
}
