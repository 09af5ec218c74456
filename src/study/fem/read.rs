//! `fem.csv` and `manifest.json` of a finite-element study read back: its modes over friction.

use serde::Deserialize;

use crate::results::read::folder::{Folder, Table, Why, text};
use crate::study::error::Result;
use crate::study::fem::curves::{Curve, Curves, State, Transition};

/// The files that are read.
pub(crate) const FILES: [&str; 2] = ["fem.csv", "manifest.json"];

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
    let (mus, modes) = curves(&table).map_err(|why| folder.bad(FILES[0], why))?;
    let transitions = document.transitions.into_iter().map(|one| Transition {
        event: one.event,
        mu: one.mu_c,
        frequency: one.frequency,
        modes: one.modes,
    });
    Ok(Curves {
        title: text(&json["title"]),
        over: None,
        mus,
        damped: document.damped,
        modes,
        transitions: transitions.collect(),
    })
}

/// Coefficients of friction and modes of a table, which has a row for each of both.
fn curves(table: &Table) -> Why<(Vec<f64>, Vec<Curve>)> {
    let (mut mus, mut modes): (Vec<f64>, Vec<Curve>) = (Vec::new(), Vec::new());
    for [mu, mode, frequency, growth, unstable] in
        table.numbers(["mu", "mode", "frequency", "growth_rate", "unstable"])?
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
            "mode {} has {} rows for {} coefficients of friction",
            one.mode,
            one.states.len(),
            mus.len()
        )),
        None if mus.len() < 2 => {
            Err("has one coefficient of friction, of which there are no curves".to_owned())
        }
        None => Ok((mus, modes)),
    }
}
