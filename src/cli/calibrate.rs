//! `squealmap calibrate`: the two-mass model that has what was measured of a structure.

use std::path::PathBuf;

use crate::cli::error::{Error, Result};
use crate::cli::numbers::{number, positive};
use crate::cli::output::{Output, list};
use crate::cli::talk::print;
use clap::Args;
use squealmap::study::calibrate::sweep::{Plane, sweep_toml};
use squealmap::study::calibrate::{Measured, calibrate};
use squealmap_input::files;

/// The files that are written; the second with `--material` alone.
const FILES: [&str; 2] = ["calibrated.toml", "material.csv"];
/// Where they go.
const OUTPUT: &str = "out/calibrated";
/// The largest material that is read, bytes.
const MOST: u64 = 1 << 24;
/// `m2/m1` of Table 1 of the source paper.
const MASS_RATIO: f64 = 0.18 / 2.12;
/// The knee of the law over the fastest velocity: on a knee friction has no one slope.
const BEYOND: f64 = 1.25;

/// Arguments of `calibrate`.
#[derive(Debug, Args)]
pub(crate) struct Calibrate {
    /// The two frequencies of the structure without friction, Hz, the lower one first, from an impact test
    #[arg(long, value_name = "LOW,HIGH", value_parser = pair, required = true)]
    frequencies: [f64; 2],
    /// Their damping ratio, or one of each, from the same test
    #[arg(long, value_name = "RATIO[,RATIO]", value_parser = ratios, required = true)]
    damping_ratio: [f64; 2],
    /// The friction coefficient at which squeal began, at constant velocity
    #[arg(long, value_name = "MU", value_parser = positive, required = true)]
    critical_friction: f64,
    /// The load on the contact, N
    #[arg(long, value_name = "N", value_parser = positive, required = true)]
    load: f64,
    /// The moving mass, kg: how strongly a falling slope acts beside the damping depends on it
    #[arg(long, value_name = "KG", value_parser = positive, required = true)]
    mass: f64,
    /// The mass in contact over the one above the normal spring [default: that of Table 1]
    #[arg(long, value_name = "RATIO", default_value_t = MASS_RATIO, hide_default_value = true, value_parser = positive)]
    mass_ratio: f64,
    /// The upper mode is rather the tangential one; without it, the normal one
    #[arg(long)]
    tangential_above: bool,
    /// Sliding velocities of the map, m/s
    #[arg(long, value_name = "LOW,HIGH", value_parser = pair, required = true)]
    velocities: [f64; 2],
    /// A material from `fit`: the map is one of temperature and velocity then; else one of static and dynamic friction
    #[arg(long, value_name = "FILE")]
    material: Option<PathBuf>,
    /// Output directory [default: out/calibrated]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

impl Calibrate {
    pub(crate) fn execute(self) -> Result<()> {
        let measured = Measured {
            frequencies: self.frequencies,
            damping_ratios: self.damping_ratio,
            critical_friction: self.critical_friction,
            mass: self.mass,
            mass_ratio: self.mass_ratio,
            load: self.load,
            normal_above: !self.tangential_above,
        };
        let found = calibrate(&measured).map_err(|fault| Error::Calibrate { fault })?;
        let [slow, fast] = self.velocities;
        let (plane, material) = match &self.material {
            None => (
                Plane::Friction { knee: BEYOND * fast, velocities: vec![slow, (slow * fast).sqrt(), fast] },
                None,
            ),
            Some(path) => {
                let bad = |why: String| Error::NoMaterial { path: path.clone(), why };
                let bytes = files::text(path, MOST).map_err(bad)?.into_bytes();
                let nothing = || bad("has no column `temperature` of two or more rising numbers".to_owned());
                let (law, temperatures) = read(&bytes).ok_or_else(nothing)?;
                let file = FILES[1].to_owned();
                (Plane::Material { file, law, temperatures, velocities: self.velocities }, Some(bytes))
            }
        };
        let text = sweep_toml(&found, &measured, &plane);
        let output = Output::prepare(self.output.unwrap_or_else(|| PathBuf::from(OUTPUT)), &FILES)?;
        let mut written = vec![(FILES[0], text.clone().into_bytes())];
        written.extend(material.map(|bytes| (FILES[1], bytes)));
        let sweep = output.directory().join(FILES[0]);
        let paths = output.write(&written)?;
        let [lower, upper] = found.frequencies;
        let [first, second] = found.damping_ratios;
        print(&format!(
            "{text}\nits modes: {lower:.3} and {upper:.3} Hz with damping ratios of {first:.6} and {second:.6}, unstable with flat friction \
             from {:.6} on\n{}next: squealmap run {}\n",
            found.critical_friction,
            list(&paths),
            sweep.display()
        ));
        Ok(())
    }
}

/// The law of a material by its columns, and its lowest and highest temperature, °C.
fn read(bytes: &[u8]) -> Option<(String, [f64; 2])> {
    let text = String::from_utf8_lossy(bytes);
    let mut lines = text.lines().filter(|line| !line.starts_with('#') && !line.trim().is_empty());
    let header: Vec<&str> = lines.next()?.split(',').map(str::trim).collect();
    let column = header.iter().position(|name| *name == "temperature")?;
    let law =
        ["velocity", "stribeck_velocity", "decay", "mu_s"].iter().position(|name| header.contains(name));
    let law = ["table", "exponential", "rational", "bilinear", "constant"][law.unwrap_or(4)];
    let rows: Option<Vec<f64>> = lines.map(|line| line.split(',').nth(column)?.trim().parse().ok()).collect();
    let mut rows = rows?;
    // A table has several rows of each temperature.
    if law == "table" {
        rows.dedup();
    }
    let rises = rows.windows(2).all(|pair| pair[0] < pair[1]);
    let (first, last) = rows.first().zip(rows.last()).filter(|(first, last)| rises && first < last)?;
    Some((law.to_owned(), [*first, *last]))
}

/// Two positive numbers, the lower one first.
fn pair(text: &str) -> std::result::Result<[f64; 2], String> {
    const WORDS: &str = "two numbers greater than 0 with a comma between them, the lower one first";
    let (low, high) = text.split_once(',').ok_or_else(|| format!("must be {WORDS}"))?;
    let [low, high] = [low, high].map(|part| number(part.trim(), |x| x > 0.0, WORDS));
    match (low?, high?) {
        (low, high) if low < high => Ok([low, high]),
        _ => Err(format!("must be {WORDS}")),
    }
}

/// One damping ratio, or two.
fn ratios(text: &str) -> std::result::Result<[f64; 2], String> {
    const WORDS: &str = "one or two numbers from 0 to below 0.5, such as 0.01 or 0.01,0.012";
    let (first, second) = text.split_once(',').unwrap_or((text, text));
    let [first, second] = [first, second].map(|part| number(part.trim(), |x| (0.0..0.5).contains(&x), WORDS));
    Ok([first?, second?])
}
