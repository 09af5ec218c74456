//! The simulated population: vibrations whose cause is known, counted by what `identify` sees of them.

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

use crate::study::confusion::truth;
use crate::study::laboratory::{Drawn, RATE, Stroke, sensed, settings, stroke};
use crate::study::strokes::{Random, csv, run};
use rayon::prelude::*;
use squealmap_identify::population::{Damped, Level, Seen, Source, Trend};
use squealmap_identify::{Kind, Segment};

/// Source, bin of the phase, level, trend, damping: places in their lists.
type Place = [usize; 5];

/// Strokes of each kind; their seed is not one of the confusion table.
const STROKES: usize = 900;
const SEED: u64 = 20_260;

/// Draws the population and writes its counts.
pub(crate) fn write(path: &Path) -> Result<(), Box<dyn Error>> {
    let mut counts: BTreeMap<Place, [u32; 4]> = BTreeMap::new();
    let found: Vec<(Place, usize)> = (0..STROKES).into_par_iter().flat_map_iter(seen).collect();
    for (place, cause) in found {
        counts.entry(place).or_default()[cause] += 1;
    }
    let mut text = "source,phase,level,trend,damping,slope,coupling,both,interaction\n".to_owned();
    for ([source, bin, level, trend, damped], [slope, coupling, both, interaction]) in counts {
        let [source, level, trend] =
            [Source::ALL[source].name(), Level::ALL[level].name(), Trend::ALL[trend].name()];
        let damped = Damped::ALL[damped].name();
        writeln!(text, "{source},{bin},{level},{trend},{damped},{slope},{coupling},{both},{interaction}")?;
    }
    std::fs::write(path, text)?;
    println!("{} has the counts of {} records", path.display(), 6 * STROKES);
    Ok(())
}

/// What the segments of a few strokes show, and the place of their cause in a row.
fn seen(number: usize) -> Vec<(Place, usize)> {
    let mut random = Random::new(SEED + number as u64);
    let mut all = Vec::new();
    for drawn in [Drawn::Sustained, Drawn::Growing, Drawn::Late] {
        let stroke = stroke(drawn, *RATE, &mut random);
        let decibel = random.between(20.0, 40.0);
        for slow in [true, false] {
            let mut samples = stroke.samples.clone();
            sensed(&mut samples, slow, decibel, number % 2 == 1, &mut random);
            if let Ok(found) = run(&csv(&samples), &settings(stroke.critical, stroke.damping_ratio)) {
                // What fast forces do not read is what slow ones have seen already.
                let new =
                    |of: &&Segment| slow || of.seen.is_some_and(|seen| seen.source != Source::Sustained);
                all.extend(found.segments.iter().filter(new).filter_map(|segment| of(&stroke, segment)));
            }
        }
    }
    all
}

/// The place of a segment, and that of its cause.
fn of(stroke: &Stroke, segment: &Segment) -> Option<(Place, usize)> {
    let Seen { source, bin, level, trend, damped } = segment.seen?;
    let cause = match truth(stroke, segment.time)?.as_slice() {
        [Kind::NegativeSlope] => 0,
        [Kind::ModeCoupling] => 1,
        [Kind::Both] => 2,
        [] => 3,
        _ => return None,
    };
    let source = Source::ALL.iter().position(|other| *other == source)?;
    let level = Level::ALL.iter().position(|other| Some(*other) == level)?;
    let trend = Trend::ALL.iter().position(|other| Some(*other) == trend)?;
    let damped = damped.unwrap_or(Damped::Strongly);
    let damped = Damped::ALL.iter().position(|other| *other == damped)?;
    Some(([source, bin?, level, trend, damped], cause))
}
