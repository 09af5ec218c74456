//! One window read alone: what a table of windows shows.

use crate::cross::{INDEPENDENT, Measured};
use crate::episode::{LOUD, Recorded, grows};
use crate::feedback::{Feedback, Skews};
use crate::settings::Settings;
use crate::verdict::{Kind, Setting, Verdict, judge};
use crate::window::Window;

/// Standard errors by which a window must decay to be called stable.
const DECAYS: f64 = 3.0;

/// The result of one window.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Phase of the normal against the tangential acceleration, degrees, negative when the normal one lags.
    pub phase: Option<Measured>,
    /// Squared coherence of the two accelerations.
    pub coherence: Option<f64>,
    /// Squared coherence of normal force and tangential acceleration.
    pub force_coherence: Option<f64>,
    /// Share of the friction power that comes from the normal force.
    pub share: Option<Measured>,
    /// `dμ/dV` from the oscillation, s/m.
    pub slope: Option<Measured>,
    /// The verdict on the window alone.
    pub verdict: Verdict,
}

pub(super) fn reading(window: &Window, recorded: Recorded, settings: &Settings) -> Reading {
    let skews = Skews { acceleration: settings.skew, force: settings.force_skew };
    let friction = window.friction.unwrap_or(0.0);
    let feedback = Feedback::new(&window.sums, window.growth, window.frequency, friction, skews, INDEPENDENT)
        .of(settings.rig);
    Reading {
        phase: recorded.normal_acceleration.then(|| feedback.phase()),
        coherence: recorded.normal_acceleration.then_some(feedback.normal_acceleration.coherence),
        force_coherence: recorded.forces.then_some(feedback.normal_force.coherence),
        share: recorded.forces.then(|| feedback.share()),
        slope: window.normal_force.filter(|_| recorded.forces).map(|force| feedback.slope_of(force)),
        verdict: verdict(window, &feedback, recorded, settings),
    }
}

fn verdict(window: &Window, feedback: &Feedback, recorded: Recorded, settings: &Settings) -> Verdict {
    if window.signal_to_noise < LOUD {
        return Verdict::undecided("no oscillation stands out of the noise");
    }
    if grows(window, recorded) {
        let setting = Setting {
            forces: recorded.forces,
            normal_acceleration: recorded.normal_acceleration,
            settings,
            distortion: window.distortion,
            episode: false,
        };
        return judge(feedback, &setting);
    }
    if window.growth.value < -DECAYS * window.growth.error {
        // One decaying window may be half a beat: it leans to stability and decides nothing.
        return Verdict {
            leaning: Some(Kind::NoInstability),
            ..Verdict::undecided("the oscillation decays")
        };
    }
    Verdict::undecided("not one growing linear oscillation")
}
