//! The curves of a study that has just been computed.

use std::f64::consts::TAU;

use squealmap_fem::study::{Outcome, Study, in_band};
use squealmap_fem::sweep;

use crate::study::fem::curves::{Curve, Curves, State, Transition};

impl Curves {
    /// The modes of a study in its band.
    #[must_use]
    pub fn of(study: &Study, outcome: &Outcome) -> Curves {
        let state = |mode: usize, (i, state): (usize, &sweep::State)| State {
            frequency: state.lambda.im / TAU,
            growth: state.lambda.re + 0.0,
            grows: outcome.grows(mode, i),
        };
        let shown = outcome.modes.iter().enumerate().filter(|(_, mode)| in_band(study, mode));
        let curve = |(k, mode): (usize, &sweep::Mode)| Curve {
            mode: k + 1,
            states: mode.states.iter().enumerate().map(|at| state(k, at)).collect(),
        };
        let transitions = outcome.transitions.iter().map(|t| Transition {
            event: t.event.name().to_owned(),
            mu: t.mu,
            frequency: t.frequency,
            modes: t.modes.iter().map(|mode| mode + 1).collect(),
        });
        Curves {
            title: study.document.title.clone(),
            mus: study.mus.clone(),
            damped: outcome.damped,
            modes: shown.map(curve).collect(),
            transitions: transitions.collect(),
        }
    }
}
