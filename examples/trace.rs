//! One instance followed in time: does the contact stick, and how large does the vibration become?
//!
//!     cargo run --release --example trace

use squealmap::FrictionLaw::Exponential;
use squealmap::model::contact::ContactState;
use squealmap::study::trace::run::trace;
use squealmap::{Duration, Param, Settle, Sweep};

pub(crate) fn main() -> Result<(), squealmap::Error> {
    let spec = Sweep::two_mass()
        .friction(Exponential { mu_s: 0.5, mu_d: 0.3, stribeck_velocity: 1.0 })
        .set(Param::BeltVelocity, 0.5)
        .response(Settle::After(Duration::Seconds(0.0)))
        .measure(Duration::Seconds(2.0))
        .spec()?;
    let trace = trace(&spec, &spec.instance(0), 40);

    let largest = trace.rows.iter().map(|row| row.acceleration[0].abs()).fold(0.0, f64::max);
    let first_stick = trace.rows.iter().find(|row| row.state == ContactState::Stick);
    println!("{} samples, largest acceleration {largest:.0} m/s²", trace.rows.len());
    match first_stick {
        Some(row) => println!("the contact sticks for the first time at {:.3} s", row.t),
        None => println!("the contact never sticks"),
    }
    Ok(())
}
