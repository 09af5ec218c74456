//! The verdict on one growing oscillation, with its confidence and its reasons.

use crate::attribution::{Bounds, Cause, Probabilities, probabilities};
use crate::feedback::{Feedback, folded};
use crate::settings::Settings;

/// From this confidence on a verdict is given; below it is undecided.
pub const CONFIDENT: f64 = 0.9;
/// Why nothing is said where the tangential acceleration shows nothing and the normal one much.
pub(super) const DEAD: &str = "the tangential acceleration shows no oscillation, and the normal one is more than 30 times as large: its sensor may be \
                               dead, check it or name another column with --tangential-acceleration";
/// Forces whose squared coherence with the acceleration is lower do not follow the oscillation.
const FORCES_FOLLOW: f64 = 0.5;
/// Friction that no noise and no linear feedback explains, relative to the power: from here on it may hide a slope.
const UNEXPLAINED: f64 = 0.2;
/// Degrees by which channels may disagree before they are called skewed.
const IN_STEP: f64 = 15.0;

/// The cause of an oscillation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// No oscillation grows.
    NoInstability,
    /// The falling friction-velocity slope, alone sufficient.
    NegativeSlope,
    /// Mode coupling, alone sufficient.
    ModeCoupling,
    /// Either alone would suffice.
    Both,
    /// The signals do not tell.
    Undecided,
}

impl Kind {
    /// Every kind, in the order of tables.
    pub const ALL: [Kind; 5] =
        [Kind::NoInstability, Kind::NegativeSlope, Kind::ModeCoupling, Kind::Both, Kind::Undecided];

    /// The name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Kind::NoInstability => "no_instability",
            Kind::NegativeSlope => "negative_slope",
            Kind::ModeCoupling => "mode_coupling",
            Kind::Both => "both",
            Kind::Undecided => "undecided",
        }
    }

    /// The words of figures and messages.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Kind::NoInstability => "no instability",
            Kind::NegativeSlope => "negative slope",
            Kind::ModeCoupling => "mode coupling",
            Kind::Both => "both",
            Kind::Undecided => "undecided",
        }
    }
}

/// A verdict.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// The kind that it names.
    pub kind: Kind,
    /// 0 to 1: probability of the leading kind, lowered by incoherence and non-linearity. Of an undecided
    /// verdict: that of the kind it leans to.
    pub confidence: f64,
    /// The leading kind, where one leads.
    pub leaning: Option<Kind>,
    /// Sentences: what speaks for it, or what keeps it undecided.
    pub reasons: Vec<String>,
    /// The probabilities that a mechanism alone would do, in the order of [`crate::testimony::Mechanism::ALL`], as far as the power of friction tells,
    /// also where that decides on none.
    pub each: Option<[f64; 2]>,
}

impl Verdict {
    /// The confidence to two decimals. A value below [`CONFIDENT`] is not rounded up to it.
    #[must_use]
    pub fn shown_confidence(&self) -> f64 {
        if self.confidence < CONFIDENT { self.confidence.min(CONFIDENT - 0.01) } else { self.confidence }
    }

    /// The signals do not tell, for one reason.
    pub(super) fn undecided(reason: impl Into<String>) -> Verdict {
        Verdict {
            kind: Kind::Undecided,
            confidence: 0.0,
            leaning: None,
            reasons: vec![reason.into()],
            each: None,
        }
    }
}

/// The facts that are known besides the feedback.
#[derive(Clone, Copy, Debug)]
pub(super) struct Setting<'a> {
    /// Whether both forces are recorded.
    pub(super) forces: bool,
    /// Whether the normal acceleration is recorded.
    pub(super) normal_acceleration: bool,
    /// What is known of the structure.
    pub(super) settings: &'a Settings,
    /// Harmonics relative to the fundamental.
    pub(super) distortion: f64,
    /// Whether it is an episode, on which the verdict on the record rests, and not one window.
    pub(super) episode: bool,
}

/// The verdict on an oscillation that grows.
pub(super) fn judge(feedback: &Feedback, setting: &Setting<'_>) -> Verdict {
    if !setting.forces {
        return Verdict::undecided(
            "without both forces the power that friction feeds in is unknown, and a phase alone fits every mechanism; \
             record tangential and normal force",
        );
    }
    let force_coherence = feedback.normal_force.coherence;
    if force_coherence < FORCES_FOLLOW {
        return Verdict::undecided(format!(
            "the normal force does not follow the oscillation (squared coherence {force_coherence:.2}); \
             use faster force sensors"
        ));
    }
    if let Some(off) = feedback.asynchrony().filter(|off| off.value.abs() > IN_STEP + 2.0 * off.error) {
        if feedback.aside.is_some() {
            return Verdict::undecided(format!(
                "by --model the friction coefficient is {:.0}° out of step with the velocity: it is another rig (masses, stiffnesses), \
                 or the normal acceleration is late (--skew)",
                off.value
            ));
        }
        return Verdict::undecided(format!(
            "the friction coefficient is {:.0}° out of step with the velocity: forces and accelerations are skewed \
             (by about {:.2e} s), or the acceleration columns are swapped; set --force-skew",
            off.value,
            -off.value.to_radians() / feedback.omega
        ));
    }
    let unexplained = feedback.unexplained / (feedback.normal.0 + feedback.slope.0).re.abs();
    if unexplained > UNEXPLAINED {
        return Verdict::undecided(format!(
            "friction follows neither the normal force nor the velocity ({:.0} % of its power): it is not linear any more; \
             record the onset with less noise",
            100.0 * unexplained
        ));
    }
    let bounds = Bounds {
        dampings: setting.settings.decays(feedback.omega),
        tilt: setting.settings.inclination.tan() / feedback.friction.abs().max(f64::MIN_POSITIVE),
    };
    let likely = probabilities(feedback, &bounds, setting.episode);
    let (kind, probability) = leading(&likely);
    // Lowered by what is not one linear mode.
    let mut coherence = force_coherence;
    let mut reasons = Vec::new();
    if setting.normal_acceleration {
        coherence = coherence.min(feedback.normal_acceleration.coherence);
        reasons.extend(skewed(feedback));
    }
    let confidence = probability * coherence * (1.0 - 0.5 * setting.distortion).clamp(0.0, 1.0);
    let decided = kind.filter(|_| confidence >= CONFIDENT);
    reasons.insert(0, evidence(feedback, decided.is_some(), &likely));
    let each = [Cause::Slope, Cause::Coupling].map(|cause| likely.mean(cause) + likely.mean(Cause::Both));
    let told = decided.unwrap_or(Kind::Undecided);
    Verdict { kind: told, confidence, leaning: kind, reasons, each: Some(each) }
}

/// The most probable kind (`None` where it is none of them) and how sure it is.
fn leading(likely: &Probabilities) -> (Option<Kind>, f64) {
    let by_mean = |a: &Cause, b: &Cause| likely.mean(*a).total_cmp(&likely.mean(*b));
    let cause = Cause::ALL.into_iter().max_by(by_mean).unwrap_or(Cause::None);
    let kind = match cause {
        Cause::None => Some(Kind::NoInstability),
        Cause::Slope => Some(Kind::NegativeSlope),
        Cause::Coupling => Some(Kind::ModeCoupling),
        Cause::Both => Some(Kind::Both),
        Cause::Interaction | Cause::Contradiction => None,
    };
    (kind, likely.least(cause))
}

/// Sentences about what the signals show, and about the probabilities when no kind has enough of it.
fn evidence(feedback: &Feedback, decided: bool, likely: &Probabilities) -> String {
    let share = feedback.share();
    let mut text = format!(
        "it grows by {} 1/s; {} of the power comes from the normal force, which is {} away from the velocity",
        feedback.growth.text(1.0, 1),
        share.text(100.0, 0) + " %",
        format_args!("{:.0}°", feedback.normal.0.arg().to_degrees().abs()),
    );
    if !decided {
        /// Probabilities below this are not listed.
        const LISTED: f64 = 0.05;
        let parts: Vec<String> = Cause::ALL
            .into_iter()
            .filter(|cause| likely.mean(*cause) > LISTED)
            .map(|cause| format!("{} {:.0} %", words(cause), 100.0 * likely.mean(cause)))
            .collect();
        text = format!("{text}; within errors and unknown damping that is {}", parts.join(", "));
    }
    text
}

fn words(cause: Cause) -> &'static str {
    match cause {
        Cause::None => "no growth",
        Cause::Slope => "negative slope",
        Cause::Coupling => "mode coupling",
        Cause::Both => "both",
        Cause::Interaction => "only both together",
        Cause::Contradiction => "friction taking power out, a contradiction",
    }
}

/// A remark where the two normal channels disagree. The verdict rests on the force.
fn skewed(feedback: &Feedback) -> Option<String> {
    let (acceleration, force) = (feedback.phase(), feedback.force_phase());
    let off = folded(acceleration.value - force.value);
    let error = acceleration.error.hypot(force.error);
    (off.abs() > IN_STEP + 2.0 * error).then(|| {
        format!(
            "the normal acceleration is {off:.0}° out of step with the normal force: it is skewed (by about {:.2e} s), \
             or a resonance lies between them; its phase is not used (set --skew)",
            -off.to_radians() / feedback.omega
        )
    })
}
