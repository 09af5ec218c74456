//! The figures of `paper`: each a table and a document of its own.

use serde_json::Value as Json;

use crate::model::kind::InstabilityType;
use crate::results::read::folder::{Folder, Table, Why, text};
use crate::study::error::Result;
use crate::study::modes;
use crate::study::paper::figures::{
    ACCELERATIONS, GROWTH, Growing, LAWS, Laws, PHASE, RAMP, Shown, Slowdown,
};
use crate::study::paper::{Figure, PhaseTrial, Stretch, Trial, Witness};

/// Reads a figure from its table and document.
pub(crate) fn read(folder: Folder<'_>, figure: Figure, files: [&str; 2]) -> Result<Shown> {
    if figure == Figure::Figure2 {
        let (spec, modes) = modes::read::read(folder, files)?;
        return Ok(Shown::Modes(Box::new(spec), modes));
    }
    let table = folder.table(files[0])?;
    let document = folder.json(files[1])?;
    let of_table = |why: String| folder.bad(files[0], why);
    match figure {
        Figure::Figure3 => Ok(laws(&table).map_err(of_table)?),
        Figure::Figure7 => Ok(growth(&table, &document).map_err(of_table)?),
        Figure::Accelerations => Ok(accelerations(&table, &document).map_err(of_table)?),
        Figure::Phase => Ok(phase(&table).map_err(of_table)?),
        _ => {
            let mut ramp = ramp(&document).map_err(|why| folder.bad(files[1], why))?;
            ramp.columns = columns(&table, &ramp).map_err(of_table)?;
            Ok(Shown::Ramp(ramp))
        }
    }
}

fn laws(table: &Table) -> Why<Shown> {
    Ok(Shown::Laws(Laws { rows: table.numbers(LAWS)? }))
}

/// A number that a document has to hold.
fn number(document: &Json, name: &str) -> Why<f64> {
    document[name].as_f64().ok_or_else(|| format!("its document has no number `{name}`"))
}

fn list<'a>(document: &'a Json, name: &str) -> Why<&'a [Json]> {
    document[name].as_array().map(Vec::as_slice).ok_or_else(|| format!("its document has no list `{name}`"))
}

/// A pair of numbers.
fn pair(json: &Json) -> Why<[f64; 2]> {
    match [&json[0], &json[1]].map(Json::as_f64) {
        [Some(a), Some(b)] => Ok([a, b]),
        _ => Err(format!("`{json}` is no pair of numbers")),
    }
}

/// A stretch with its time and its velocity, and nothing else.
fn stretch((time, velocity): ([f64; 2], [f64; 2])) -> Stretch {
    Stretch { time, velocity, tangential: [0.0; 2], normal: [0.0; 2], stick: 0.0, free: 0.0 }
}

fn ramp(document: &Json) -> Why<Slowdown> {
    let duration = number(document, "ramp_duration")?;
    let velocity = pair(&document["belt_velocity"])?;
    let shares = list(document, "stick_and_free")?;
    let part = |(k, share): (usize, &Json)| {
        let [stick, free] = pair(share)?;
        Ok(Stretch { stick, free, ..stretch(Stretch::place(duration, velocity, [k, shares.len()])) })
    };
    Ok(Slowdown {
        heading: text(&document["title"]),
        knee: document["knee_velocity"].as_f64(),
        duration,
        velocity,
        columns: Vec::new(),
        parts: shares.iter().enumerate().map(part).collect::<Why<_>>()?,
    })
}

fn columns(table: &Table, ramp: &Slowdown) -> Why<Vec<Stretch>> {
    let rows = table.numbers(RAMP)?;
    let column = |(k, [_, _, ax_low, ax_high, ay_low, ay_high, stick, free]): (usize, &[f64; 8])| Stretch {
        tangential: [*ax_low, *ax_high],
        normal: [*ay_low, *ay_high],
        stick: *stick,
        free: *free,
        ..stretch(Stretch::place(ramp.duration, ramp.velocity, [k, rows.len()]))
    };
    Ok(rows.iter().enumerate().map(column).collect())
}

fn growth(table: &Table, document: &Json) -> Why<Shown> {
    let rows = table.numbers([GROWTH[1], GROWTH[2], GROWTH[3], GROWTH[4]])?;
    let case = |case: &Json| {
        let name = text(&case["figure"]);
        let range = |name: &str| (!case[name].is_null()).then(|| pair(&case[name])).transpose();
        let of_case = table.rows.iter().zip(&rows).filter(|(row, _)| table.cell(row, GROWTH[0]) == name);
        Ok(Growing {
            words: text(&case["mechanism"]),
            friction: [number(case, "mu_s")?, number(case, "mu_d")?],
            phases: range("phase_measured")?.zip(range("phase_eigenvector")?).map(|(a, b)| [a, b]),
            samples: of_case.map(|(_, sample)| *sample).collect(),
        })
    };
    Ok(Shown::Growth(list(document, "cases")?.iter().map(case).collect::<Why<_>>()?))
}

fn accelerations(table: &Table, document: &Json) -> Why<Shown> {
    let rows = table.numbers(ACCELERATIONS)?;
    let disturbances = list(document, "disturbance")?;
    if disturbances.len() != rows.len() {
        return Err(format!("{} rows, but a disturbance of {}", rows.len(), disturbances.len()));
    }
    let trial = |([duration, kick, peaks @ ..], disturbance): (&[f64; 8], &Json)| {
        let peaks = [0, 2, 4].map(|k| [peaks[k], peaks[k + 1]]);
        Trial {
            duration: *duration,
            kick: *kick,
            disturbance: disturbance.as_f64().unwrap_or(f64::NAN),
            peaks: peaks.map(|pair| pair.iter().all(|peak| peak.is_finite()).then_some(pair)),
        }
    };
    Ok(Shown::Accelerations(rows.iter().zip(disturbances).map(trial).collect()))
}

fn phase(table: &Table) -> Why<Shown> {
    let [velocity, mu_s, mu_d, kind, phases @ ..] = PHASE;
    let [a, b, c] = phases;
    let numbers = table.numbers([velocity, mu_s, mu_d, a, b, c])?;
    let witness = |(row, [velocity, mu_s, mu_d, phases @ ..]): (&csv::StringRecord, &[f64; 6])| Witness {
        velocity: *velocity,
        friction: [*mu_s, *mu_d],
        kind: InstabilityType::ALL.into_iter().find(|one| one.name() == table.cell(row, kind)),
        phases: phases.map(|phase| phase.is_finite().then_some(phase)),
    };
    Ok(Shown::Phase(PhaseTrial { witnesses: table.rows.iter().zip(&numbers).map(witness).collect() }))
}
