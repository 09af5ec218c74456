//! Measured signals: identification on synthetic strokes whose type and phase are known.

use std::io::{Cursor, Read};

use squealmap::Error;
use squealmap::classify::InstabilityType;
use squealmap::export::signals::signals_csv;
use squealmap::identify::{Identification, Kind, Settings, identify};

use crate::strokes::{Random, add_noise, stroke};

fn run(bytes: &[u8], settings: &Settings) -> Result<Identification, Error> {
    identify(|| Ok(Box::new(Cursor::new(bytes.to_vec())) as Box<dyn Read>), "signals.csv", settings)
}

#[test]
fn probe() {
    let types = [
        InstabilityType::Stable,
        InstabilityType::NegativeSlope,
        InstabilityType::ModeCoupling,
        InstabilityType::Coexistence,
        InstabilityType::Interaction,
    ];
    let mut random = Random::new(1);
    let start = std::time::Instant::now();
    for decibel in [40.0, 30.0, 20.0, 10.0, 0.0] {
        for kind in types {
            for rate in [200e3, 51.2e3] {
                for known in [true, false] {
                    let skew = 20e-6 * random.uniform();
                    let mut stroke = stroke(kind, rate, skew, &mut random);
                    add_noise(&mut stroke.samples, decibel, &mut random);
                    let bytes = signals_csv(&stroke.samples, None).expect("csv");
                    let settings = Settings { skew: if known { skew } else { 0.0 }, ..Settings::default() };
                    let l = stroke.linear;
                    print!("{decibel:4} {:14} {rate:7} {known:5} n={:6} s/w={:7.4} flat {:6.3} froz {:6.3} f={:6.0} phi={:6.1} | ", kind.name(), stroke.samples.len(), l.growth_rate / (6.283 * l.frequency), l.growth_rate_flat / l.growth_rate, l.growth_rate_frozen / l.growth_rate, l.frequency, l.phase.unwrap_or(0.0));
                    match run(&bytes, &settings) {
                        Ok(found) => {
                            println!("{:14} {:.2} ({:?}) windows {} episodes {}", found.verdict.kind.name(), found.verdict.confidence, found.verdict.leaning.map(Kind::name), found.windows.len(), found.episodes.len());
                            for e in &found.episodes {
                                println!("      {:.4}..{:.4} f={:.0} s/s0={:.3}±{:.3} gain {:.2} phi {:.1?} r {:.3?} slope {:.4?} dist {:.3} coh {:.3?} {:?}", e.time[0], e.time[1], e.frequency, e.growth.value / l.growth_rate, e.growth.error / l.growth_rate, e.gain, e.phase.map(|p| (p.value, p.error)), e.share.map(|p| (p.value, p.error)), e.slope.map(|p| (p.value, p.error)), e.distortion, e.coherence, e.verdict.kind);
                            }
                            for r in &found.verdict.reasons { println!("      {r}"); }
                        }
                        Err(error) => println!("{error}"),
                    }
                }
            }
        }
    }
    println!("{:?}", start.elapsed());
}
