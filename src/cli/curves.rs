//! `squealmap curves`: where limit cycles meet, double their period, or are born, over the planes of a sweep.

use crate::cli::error::{Error, Result};
use crate::cli::files::Files;
use crate::cli::output::list;
use crate::cli::pictures::png_of;
use crate::cli::progress::Progress;
use crate::cli::talk::print;
use clap::Args;
use squealmap::results::figure::look::Look;
use squealmap::study::curves::figure::{curves_svg, overlays};
use squealmap::study::curves::seek::{PlaneCurves, count, seek};
use squealmap::study::curves::table::{curves_csv, document, named};
use squealmap::study::cycles::curve::{Curve, CurvePoint, End};
use squealmap::sweep::spec::Spec;
use squealmap_input::quote::rounded;

/// The files that are written.
const FILES: [&str; 4] = ["curves.csv", "curves.json", "curves.png", "curves.svg"];

/// Arguments of `curves`.
#[derive(Debug, Args)]
pub(crate) struct CurvesCommand {
    #[command(flatten)]
    files: Files,
    /// Lines across each plane, along either axis, on which curves are looked for; a curve between two of them may be missed
    #[arg(long, value_name = "N", default_value_t = 9, value_parser = clap::value_parser!(u16).range(2..=1001))]
    lines: u16,
}

impl CurvesCommand {
    pub(crate) fn execute(self) -> Result<()> {
        let spec = Spec::read(&self.files.sweep)?;
        spec.of_two_masses("`curves`")?;
        if let Some(motion) = spec.moving_belt() {
            return Err(Error::FollowsRamp { what: "`curves`", motion });
        }
        let output = self.files.prepare_beside(&FILES)?;
        let lines = usize::from(self.lines);
        let progress = Progress::new(count(&spec, lines)?, "lines");
        let planes = seek(&spec, lines, &|| progress.add(1));
        progress.finish();
        let planes = planes?;
        let svg = curves_svg(&spec, &overlays(&planes), &Look::default());
        let table = curves_csv(&spec, &planes)?;
        let files = [
            (FILES[1], document(&spec, &table)?),
            (FILES[0], table),
            (FILES[2], png_of(&svg)?),
            (FILES[3], svg.into_bytes()),
        ];
        let paths = output.write(&files)?;
        let said: String = planes.iter().map(said).collect();
        print(&format!("{said}{}", list(&paths)));
        Ok(())
    }
}

/// Sentences on the curves of a plane.
fn said(plane: &PlaneCurves) -> String {
    let at: Vec<String> =
        plane.others.iter().map(|(key, value)| format!("{} = {value}", key.name())).collect();
    let at = if at.is_empty() { String::new() } else { format!("at {}, ", at.join(", ")) };
    let names = plane.params.map(|param| param.info().name);
    let mut said: Vec<String> = plane.curves.iter().map(|curve| one(curve, names)).collect();
    if plane.curves.is_empty() {
        said.push(format!("over {} and {}: no curve", names[0], names[1]));
    }
    said.extend(plane.alone.iter().map(|(special, values)| {
        format!("{} at {}: no curve, what is near cannot be followed", special.name(), place(names, *values))
    }));
    let line = |words: String| [at.as_str(), words.as_str(), "\n"].concat();
    said.into_iter().map(line).collect()
}

/// A point of a plane.
fn place([x, y]: [&str; 2], values: [f64; 2]) -> String {
    let [a, b] = values.map(rounded);
    format!("{x} = {a}, {y} = {b}")
}

fn one(curve: &Curve, names: [&str; 2]) -> String {
    let at = |point: &CurvePoint| place(names, point.values);
    let [first, last] =
        [curve.points.first(), curve.points.last()].map(|end| end.map(at).unwrap_or_default());
    let which = |end: End| match curve.ends.map(|other| other == end) {
        [true, true] => Some("both"),
        [true, false] => Some("the first"),
        [false, true] => Some("the last"),
        [false, false] => None,
    };
    let ends = which(End::Lost).map(|which| format!("; it ends at {which}, inside the plane"));
    let stops = which(End::Limit)
        .map(|which| format!("; it goes on beyond {which}, no more points are followed in one direction"));
    let how = if which(End::Closed).is_some() {
        ", a closed one".to_owned()
    } else {
        ends.unwrap_or_default() + &stops.unwrap_or_default()
    };
    let (name, points) = (named(curve.special), curve.points.len());
    format!("a curve of {name}, {points} points, from {first} to {last}{how}")
}
