//! The curves of a study that has just been computed.

use std::f64::consts::TAU;

use squealmap_fem::study::{Outcome, Study, grows, in_band};
use squealmap_fem::sweep;

use crate::study::fem::curves::{Curve, Curves, State, Transition};

impl Curves {
    /// The modes of a study in its band.
    #[must_use]
    pub fn of(study: &Study, outcome: &Outcome) -> Curves {
        let transitions = outcome.transitions.iter().map(|t| Transition {
            event: t.event.name().to_owned(),
            mu: t.mu,
            frequency: t.frequency,
            modes: t.modes.iter().map(|mode| mode + 1).collect(),
        });
        Curves {
            title: study.document.title.clone(),
            over: None,
            at: None,
            mus: study.mus.clone(),
            damped: outcome.damped,
            modes: curves(study, &outcome.modes, outcome.damped),
            transitions: transitions.collect(),
        }
    }

    /// Those over another parameter, where one is varied.
    #[must_use]
    pub fn varied(study: &Study, outcome: &Outcome) -> Option<Curves> {
        let (asked, found) = (study.document.vary.as_ref()?, outcome.variation.as_ref()?);
        Some(Curves {
            title: study.document.title.clone(),
            over: Some(asked.words()),
            at: Some(asked.mu),
            mus: found.values.clone(),
            damped: found.damped,
            modes: curves(study, &found.modes, found.damped),
            transitions: Vec::new(),
        })
    }
}

fn curves(study: &Study, modes: &[sweep::Mode], damped: bool) -> Vec<Curve> {
    let state = |state: &sweep::State| State {
        frequency: state.lambda.im / TAU,
        growth: state.lambda.re + 0.0,
        grows: grows(state.lambda, damped),
    };
    let shown = modes.iter().enumerate().filter(|(_, mode)| in_band(study, mode));
    shown.map(|(k, mode)| Curve { mode: k + 1, states: mode.states.iter().map(state).collect() }).collect()
}
