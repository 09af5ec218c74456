//! Episodes: windows in a row in which one oscillation grows.

use std::f64::consts::TAU;

use crate::cross::{INDEPENDENT, Measured, Sums};
use crate::feedback::{Feedback, Skews, folded};
use crate::settings::Settings;
use crate::verdict::{Setting, Verdict, judge};
use crate::window::{SHARED, Window};

/// Power over noise from which an oscillation stands out of one window: noise alone reaches about 5.
pub(super) const LOUD: f64 = 10.0;
/// Standard errors by which the growth rate of a window must exceed 0: a run of windows tells more than each.
const GROWS: f64 = 1.0;
/// Standard errors by which the growth rate of an episode must exceed 0.
const GROWS_CLEARLY: f64 = 4.0;
/// Squared coherence below which a window does not hold one oscillation.
const COHERENT: f64 = 0.8;
/// Harmonics above this are those of a motion that sticks, detaches or crosses a kink.
const LINEAR: f64 = 0.1;
/// Amplitude of a second mode, relative to the first, from which a window is a beat.
const SECOND_MODE: f64 = 0.05;
/// Amplitude of friction that follows neither the normal force nor the motion, relative to the whole: the small
/// part that the slope contributes is not to be blurred by it.
const NONLINEAR_FRICTION: f64 = 0.005;
/// Noise of sensors does not rise by this factor within a squeal; estimates of it from one window scatter by 2.
const NOISIER: f64 = 8.0;
/// Windows this strong, relative to the strongest, can be those in which friction departs.
const STRONG: f64 = 0.1;
/// The fewest windows of an episode for strong ones to be left out of it.
const LEAST_KEPT: usize = 3;
/// Windows of one episode have frequencies within this of each other, relative.
pub(super) const SAME: f64 = 0.05;
/// Least gain of an episode (factor e): below it a beat of two modes looks the same.
const LEAST_GAIN: f64 = 1.0;
/// A gain from which no beat is taken for growth (factor 20): it would need two modes equal within 10 %.
pub(super) const LASTING: f64 = 3.0;
/// Amplitude, relative to the one reached, that tells a beat before or after the growth.
const AGAIN: f32 = 0.7;
/// How far before and after an episode a beat is looked for, in lengths of the episode, and in windows (36 periods) at least.
const LOOK_AROUND: usize = 3;
const LOOK_AROUND_LEAST: usize = 12;
/// Degrees by which the phase of one mode may wander from the first to the second half.
const STEADY: f64 = 12.0;
/// Growth below this part of that of the beginning is growth that saturates.
const SLOWER: f64 = 0.9;
/// The growth of one mode in its second half is at least this part of that of the first.
const STEADY_GROWTH: f64 = 0.5;

/// A growing oscillation.
#[derive(Clone, Debug, PartialEq)]
pub struct Episode {
    /// Its first and last window.
    pub windows: [usize; 2],
    /// Start and end, s.
    pub time: [f64; 2],
    /// Mean frequency, Hz, weighted by power.
    pub frequency: f64,
    /// Mean friction coefficient.
    pub friction: Option<f64>,
    /// Growth rate, 1/s.
    pub growth: Measured,
    /// Natural logarithm of the gain in amplitude.
    pub gain: f64,
    /// Phase of the normal against the tangential acceleration, degrees, negative when the normal one lags.
    pub phase: Option<Measured>,
    /// Squared coherence of the two accelerations.
    pub coherence: Option<f64>,
    /// Share of the friction power that comes from the normal force.
    pub share: Option<Measured>,
    /// `dμ/dV` from the oscillation, s/m.
    pub slope: Option<Measured>,
    /// Largest distortion of its windows.
    pub distortion: f64,
    /// Its largest velocity over that of sliding, where that is recorded.
    pub reach: Option<f64>,
    /// The mechanism that caused it.
    pub verdict: Verdict,
    pub(super) feedback: Feedback,
    /// Whether it has two modes, or one that changes: that keeps it undecided whatever the feedback.
    pub(super) wanders: bool,
    /// Whether the oscillation was there before it grew.
    pub(super) preceded: bool,
}

/// Says what the file records.
#[derive(Clone, Copy, Debug)]
pub(super) struct Recorded {
    pub(super) normal_acceleration: bool,
    pub(super) forces: bool,
}

/// Whether an oscillation grows in the window.
pub(super) fn grows(window: &Window, recorded: Recorded) -> bool {
    let coherence = coherence(&window.sums, recorded);
    window.signal_to_noise >= LOUD
        && window.growth.value > GROWS * window.growth.error
        && coherence >= COHERENT
        && window.sums.second_mode() < SECOND_MODE
        && is_linear(window)
}

/// Whether nothing sticks, detaches or crosses a kink.
pub(super) fn is_linear(window: &Window) -> bool {
    window.distortion < LINEAR && window.sums.nonlinear_friction() < NONLINEAR_FRICTION
}

/// The best squared coherence with the tangential acceleration that the file offers.
fn coherence(sums: &Sums, recorded: Recorded) -> f64 {
    let force = sums.normal_force(INDEPENDENT).coherence;
    let acceleration = sums.normal_acceleration(INDEPENDENT).coherence;
    match (recorded.forces, recorded.normal_acceleration) {
        (true, true) => force.max(acceleration),
        (true, false) => force,
        (false, true) => acceleration,
        (false, false) => 1.0,
    }
}

/// Whether the oscillation was as strong shortly before, or soon gives back what it gained, in windows that are still
/// linear.
pub(super) fn beats(briefs: &[Brief], first: usize, length: usize) -> bool {
    let end = first + length;
    let again = AGAIN * AGAIN * briefs[end - 1].power;
    let near = (LOOK_AROUND * length).max(LOOK_AROUND_LEAST);
    let mut before = briefs[first.saturating_sub(near)..first].iter();
    let linear = |brief: &&Brief| f64::from(brief.distortion) < LINEAR;
    let mut after = briefs[end..].iter().take(near).take_while(linear);
    before.any(|brief| brief.power > again) || after.any(|brief| brief.power < again)
}

/// Whether an oscillation was there before window `first`, from which on it grows at this rate (1/s): whether it was nearly
/// as strong two e-foldings earlier, or at the beginning of the record.
pub(super) fn preceded(briefs: &[Brief], first: usize, window: &Window, growth: f64) -> bool {
    /// Windows that far apart share no sample.
    const APART: usize = 4;
    /// E-foldings over which growth and no growth differ clearly, and that are enough.
    const LEAST: f64 = 0.5;
    const MOST: f64 = 2.0;
    let folds = growth * (window.time[1] - window.time[0]) / APART as f64;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a positive number of windows"
    )]
    let apart = ((MOST / folds).ceil() as usize).max(APART).min(first);
    let before = briefs[first - apart];
    // Half-way between what stands still and what grows at the same rate.
    let grown = folds * apart as f64;
    let nearly = 0.5 * (1.0 + (-grown).exp());
    let strong = f64::from(before.power) > nearly * nearly * f64::from(briefs[first].power);
    apart >= APART && grown >= LEAST && before.loud && strong
}

/// The episode of a run of growing windows; `None` when it gains too little.
pub(super) fn episode(
    run: &[Window],
    first: usize,
    recorded: Recorded,
    settings: &Settings,
) -> Option<Episode> {
    // The accelerations stay in their ratio when friction begins to depart.
    let accelerations = Part::new(run).feedback(settings);
    let run = &run[..linear(run)];
    let whole = Part::new(run);
    let gain = whole.growth.value * (run[run.len() - 1].time[1] - run[0].time[0]);
    if gain < LEAST_GAIN || whole.growth.value < GROWS_CLEARLY * whole.growth.error {
        return None;
    }
    let distortion = run.iter().fold(0.0, |worst: f64, window| worst.max(window.distortion));
    let feedback = whole.feedback(settings);
    let setting = Setting {
        forces: recorded.forces,
        normal_acceleration: recorded.normal_acceleration,
        settings,
        distortion,
        episode: true,
    };
    let mut verdict = judge(&feedback, &setting);
    let reason = wanders(run, recorded, settings);
    let wanders = reason.is_some();
    if let Some(reason) = reason {
        verdict = Verdict::undecided(reason);
    }
    let normal_force = whole.weighted(run, |window| window.normal_force);
    let mut episode = Episode {
        windows: [first, first + run.len() - 1],
        time: [run[0].time[0], run[run.len() - 1].time[1]],
        frequency: whole.frequency,
        friction: whole.friction,
        growth: whole.growth,
        gain,
        phase: None,
        coherence: None,
        share: None,
        slope: None,
        distortion,
        reach: reach(run),
        verdict,
        feedback,
        wanders,
        preceded: false,
    };
    episode.measured(recorded, normal_force);
    episode.phase = recorded.normal_acceleration.then(|| accelerations.phase());
    episode.coherence = recorded.normal_acceleration.then_some(accelerations.normal_acceleration.coherence);
    Some(episode)
}

impl Episode {
    /// Sets phase, coherence, share and slope from the feedback, with the mean normal force (N) where it is recorded.
    pub(super) fn measured(&mut self, recorded: Recorded, normal_force: Option<f64>) {
        let feedback = self.feedback;
        self.phase = recorded.normal_acceleration.then(|| feedback.phase());
        self.coherence = recorded.normal_acceleration.then_some(feedback.normal_acceleration.coherence);
        self.share = recorded.forces.then(|| feedback.share());
        self.slope = normal_force.filter(|_| recorded.forces).map(|force| feedback.slope_of(force));
    }
}

/// The largest velocity of windows over that of sliding.
fn reach(run: &[Window]) -> Option<f64> {
    let of = |window: &Window| Some(window.amplitude / (TAU * window.frequency * window.velocity?.abs()));
    run.iter().map(of).try_fold(0.0, |most: f64, reach| Some(most.max(reach?)))
}

/// How many windows of a run are still linear. They end at the first strong window whose friction departs from that of all
/// windows before, and at the first whose growth falls: it and all later ones are left out, although they weigh most.
fn linear(run: &[Window]) -> usize {
    let strongest = run.iter().map(|window| window.sums.xx).fold(0.0, f64::max);
    let mut before = Sums::default();
    let mut early = Growth::default();
    for (kept, window) in run.iter().enumerate() {
        // The first half of the windows before this one.
        if kept % 2 == 1 {
            early.add(&run[kept / 2]);
        }
        if kept >= LEAST_KEPT && saturates(&early.measured(), &run[..kept], window) {
            return kept;
        }
        let strong = window.sums.xx > STRONG * STRONG * strongest;
        let departs = window.sums.friction_departs(&before) > NONLINEAR_FRICTION;
        if kept >= LEAST_KEPT && strong && (departs || window.sums.noisier(&before) > NOISIER) {
            return kept;
        }
        before.add(&window.sums);
    }
    run.len()
}

/// Whether a window grows clearly less than the early ones before, which have grown too long for a beat.
fn saturates(early: &Measured, before: &[Window], window: &Window) -> bool {
    let gain = early.value * (before[before.len() - 1].time[1] - before[0].time[0]);
    let fallen = SLOWER * early.value - window.growth.value;
    gain >= LASTING && fallen > 2.0 * (SLOWER * early.error).hypot(window.growth.error)
}

/// Two modes that beat also grow for a while, but their phase and growth change meanwhile.
fn wanders(run: &[Window], recorded: Recorded, settings: &Settings) -> Option<String> {
    /// Fewer windows have no halves.
    const HALVES: usize = 4;
    if run.len() < HALVES {
        return None;
    }
    let (early, late) = run.split_at(run.len() / 2);
    let [early, late] =
        [early, late].map(|half| (Part::new(half).growth, Part::new(half).feedback(settings)));
    let phases = [early.1, late.1]
        .map(|feedback| if recorded.forces { feedback.force_phase() } else { feedback.phase() });
    let off = folded(phases[1].value - phases[0].value);
    let error = phases[0].error.hypot(phases[1].error);
    if off.abs() > STEADY + 2.0 * error {
        return Some(format!(
            "the phase between the directions wanders by {off:.0}° while it grows: two modes beat, or the mode changes"
        ));
    }
    let slower = STEADY_GROWTH * early.0.value - late.0.value;
    (slower > 2.0 * late.0.error.hypot(early.0.error)).then(|| {
        format!(
            "the growth falls from {:.1} to {:.1} 1/s while it grows: two modes beat, or it saturates",
            early.0.value, late.0.value
        )
    })
}

/// Windows taken together.
struct Part {
    sums: Sums,
    growth: Measured,
    frequency: f64,
    friction: Option<f64>,
}

impl Part {
    fn new(run: &[Window]) -> Part {
        let mut sums = Sums::default();
        for window in run {
            sums.add(&window.sums);
        }
        let mut part = Part { sums, growth: growth(run), frequency: 0.0, friction: None };
        part.frequency = part.weighted(run, |window| Some(window.frequency)).unwrap_or_default();
        part.friction = part.weighted(run, |window| window.friction);
        part
    }

    /// The mean of a quantity over the windows, weighted by the power of the oscillation.
    fn weighted(&self, run: &[Window], of: impl Fn(&Window) -> Option<f64>) -> Option<f64> {
        let sum: Option<f64> = run.iter().map(|window| of(window).map(|x| x * window.sums.xx)).sum();
        sum.map(|sum| sum / self.sums.xx)
    }

    fn feedback(&self, settings: &Settings) -> Feedback {
        let skews = Skews { acceleration: settings.skew, force: settings.force_skew };
        let share = INDEPENDENT / SHARED;
        Feedback::new(&self.sums, self.growth, self.frequency, self.friction.unwrap_or(0.0), skews, share)
            .of(settings.rig)
    }
}

/// The growth rate of a run: the mean of its windows, weighted by their errors, which overlap.
fn growth(run: &[Window]) -> Measured {
    let mut growth = Growth::default();
    for window in run {
        growth.add(window);
    }
    growth.measured()
}

/// Growth rates of windows as they come: their number, and sums of weights and
/// weighted squares about the mean.
#[derive(Default)]
struct Growth {
    count: usize,
    weight: f64,
    mean: f64,
    square: f64,
}

impl Growth {
    fn add(&mut self, window: &Window) {
        let weight = window.growth.error.max(f64::MIN_POSITIVE).powi(-2);
        let off = window.growth.value - self.mean;
        self.count += 1;
        self.weight += weight;
        self.mean += off * weight / self.weight;
        self.square += weight * off * (window.growth.value - self.mean);
    }

    fn measured(&self) -> Measured {
        let scatter = self.square / self.weight;
        let independent = (self.count as f64 / SHARED).max(1.0);
        let error = (self.count as f64 / independent / self.weight + scatter / independent).sqrt();
        Measured { value: self.mean, error }
    }
}

/// The first episode whose forces feed the normal column but not the tangential one: when it begins, s.
pub(super) fn swapped(episodes: &[Episode], recorded: Recorded) -> Option<f64> {
    /// Power factor below which nothing is fed.
    const NOTHING: f64 = 0.1;
    /// Power factor from which something is.
    const SOMETHING: f64 = 0.3;
    if !(recorded.forces && recorded.normal_acceleration) {
        return None;
    }
    let swapped = |episode: &&Episode| {
        let feedback = &episode.feedback;
        // δT/ẋ, and δT/ẏ = δT/ẋ · ẍ/ÿ up to a positive factor.
        let fed = feedback.normal.0 + feedback.slope.0;
        let other = fed * feedback.normal_acceleration.value.conj();
        let error = 2.0 * feedback.normal.1.hypot(feedback.slope.1) / fed.norm();
        let factors = [fed, other].map(|feed| feed.re / feed.norm());
        factors[0] < NOTHING - error && factors[1] > SOMETHING + error
    };
    episodes.iter().find(swapped).map(|episode| episode.time[0])
}

/// The little that is kept of a window to recognise a beat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Brief {
    /// Power of the tangential acceleration at the dominant frequency.
    pub(super) power: f32,
    /// Harmonics relative to the fundamental.
    pub(super) distortion: f32,
    /// Whether an oscillation stands out of the noise.
    pub(super) loud: bool,
}
