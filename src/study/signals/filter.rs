//! The filter before a recorder's samples: without it, jumps of friction show at frequencies that they do not have.
//!
//! A recorder samples often and keeps the mean of many samples, weighted so that what is above half of its rate is gone: here a sinc under
//! a Hann window with half of the amplitude at four fifths of that half, symmetric in time.

use std::f64::consts::PI;

use crate::engine::plan::Plan;
use crate::model::instance::Instance;
use crate::study::signals::sensors::{Recording, Sample, Signals, record};

/// Samples that are taken for each that is kept.
const OVER: usize = 4;
/// Kept samples on either side that a weight reaches.
const REACH: usize = 16;
/// Where the amplitude is halved, over the rate that is kept.
const CORNER: f64 = 0.4;

/// Records an instance as [`record`] does, through the filter of a recorder. The first and the last 16 samples are what the filter has of
/// them: less than there is.
#[must_use]
pub fn recorded(instance: &Instance, plan: &Plan, recording: &Recording) -> Signals {
    let often = Recording { rate: OVER as f64 * recording.rate, ..*recording };
    let Signals { samples, status } = record(instance, plan, &often);
    let weights = weights();
    let middle = OVER * REACH;
    let kept = |k: usize| {
        let mut sum =
            Sample { t: samples[k].t, belt_velocity: samples[k].belt_velocity, ..Sample::default() };
        let mut total = 0.0;
        let from = k.saturating_sub(middle);
        for (sample, place) in samples[from..].iter().zip(from..=k + middle) {
            let weight = weights[place + middle - k];
            total += weight;
            sum.tangential_acceleration += weight * sample.tangential_acceleration;
            sum.normal_acceleration += weight * sample.normal_acceleration;
            sum.tangential_force += weight * sample.tangential_force;
            sum.normal_force += weight * sample.normal_force;
        }
        for field in [
            &mut sum.tangential_acceleration,
            &mut sum.normal_acceleration,
            &mut sum.tangential_force,
            &mut sum.normal_force,
        ] {
            *field /= total;
        }
        sum
    };
    Signals { samples: (0..samples.len()).step_by(OVER).map(kept).collect(), status }
}

/// The weights of the samples around one that is kept.
fn weights() -> Vec<f64> {
    let reach = OVER * REACH;
    let weight = |k: usize| {
        let off = k as f64 - reach as f64;
        let angle = 2.0 * PI * CORNER * off / OVER as f64;
        let sinc = if off == 0.0 { 1.0 } else { angle.sin() / angle };
        sinc * (0.5 * PI * off / (reach as f64 + 1.0)).cos().powi(2)
    };
    (0..=2 * reach).map(weight).collect()
}
