//! `fem.csv`, `vary.csv` and `manifest.json` of a finite-element study read back: its modes over friction, or another parameter.

use serde::Deserialize;

use crate::results::read::folder::{Folder, Table, Why, text};
use crate::study::error::Result;
use crate::study::fem::curves::{Curve, Curves, State, Transition};

/// The files that modes over friction are read from,
pub(crate) const FILES: [&str; 2] = ["fem.csv", "manifest.json"];
/// those over another parameter,
pub(crate) const VARIED: [&str; 2] = ["vary.csv", "manifest.json"];
/// and the mesh with its shapes.
pub(crate) const BODIES: [&str; 2] = ["shapes.vtu", "manifest.json"];

/// What the manifest says of the modes.
#[derive(Deserialize)]
struct Document {
    damped: bool,
    transitions: Vec<Met>,
}

#[derive(Deserialize)]
struct Met {
    event: String,
    mu_c: f64,
    frequency: f64,
    modes: Vec<usize>,
}

/// The modes in a table and a manifest.
pub(crate) fn read(folder: Folder<'_>) -> Result<Curves> {
    let table = folder.table(FILES[0])?;
    let json = folder.json(FILES[1])?;
    let document = Document::deserialize(&json).map_err(|why| folder.bad(FILES[1], why.to_string()))?;
    let (mus, modes) = curves(&table, "mu").map_err(|why| folder.bad(FILES[0], why))?;
    let transitions = document.transitions.into_iter().map(|one| Transition {
        event: one.event,
        mu: one.mu_c,
        frequency: one.frequency,
        modes: one.modes,
    });
    Ok(Curves {
        title: text(&json["title"]),
        over: None,
        at: None,
        mus,
        damped: document.damped,
        modes,
        transitions: transitions.collect(),
    })
}

/// What the manifest says of another parameter.
#[derive(Deserialize)]
struct Varied {
    parameter: String,
    quantity: String,
    unit: String,
    mu: f64,
    damped: bool,
}

/// The modes over another parameter in a table and a manifest.
pub(crate) fn read_varied(folder: Folder<'_>) -> Result<Curves> {
    let table = folder.table(VARIED[0])?;
    let json = folder.json(VARIED[1])?;
    let varied = Varied::deserialize(&json["varied"]).map_err(|why| {
        folder.bad(VARIED[1], format!("`varied`: {why}; `squealmap fem` of this version writes it anew"))
    })?;
    let (mus, modes) = curves(&table, &varied.parameter).map_err(|why| folder.bad(VARIED[0], why))?;
    Ok(Curves {
        title: text(&json["title"]),
        over: Some([varied.quantity, varied.unit]),
        at: Some(varied.mu),
        mus,
        damped: varied.damped,
        modes,
        transitions: Vec::new(),
    })
}

/// Values of a parameter and modes of a table, which has a row for each of both.
fn curves(table: &Table, over: &str) -> Why<(Vec<f64>, Vec<Curve>)> {
    let (mut mus, mut modes): (Vec<f64>, Vec<Curve>) = (Vec::new(), Vec::new());
    for [mu, mode, frequency, growth, unstable] in
        table.numbers([over, "mode", "frequency", "growth_rate", "unstable"])?
    {
        if mus.last().is_none_or(|last| *last < mu) {
            mus.push(mu);
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of a mode")]
        let mode = mode as usize;
        let state = State { frequency, growth, grows: unstable > 0.5 };
        match modes.iter_mut().find(|known| known.mode == mode) {
            Some(known) => known.states.push(state),
            None => modes.push(Curve { mode, states: vec![state] }),
        }
    }
    match modes.iter().find(|one| one.states.len() != mus.len()) {
        Some(one) => Err(format!(
            "mode {} has {} rows for {} values of `{over}`",
            one.mode,
            one.states.len(),
            mus.len()
        )),
        None if mus.len() < 2 => Err(format!("has one value of `{over}`, over which there are no curves")),
        None => Ok((mus, modes)),
    }
}
