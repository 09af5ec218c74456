//! From windows and episodes to the verdict on a record.

use super::attribution::normal_below;
use super::cross::{INDEPENDENT, Measured};
use super::episode::{Episode, LOUD, Recorded, is_linear};
use super::verdict::{Kind, Verdict};
use super::window::{SHARED, Window};

/// A trend counts from this many standard errors on.
const CLEAR: f64 = 3.0;
/// An oscillation that has lost this factor since it was loudest has decayed.
const DECAYED: f64 = 0.5;
/// The same where every window is linear.
const DECAYED_LINEAR: f64 = 0.85;
/// The loudest window of a decaying oscillation lies in this first part of the record.
const EARLY: f64 = 0.5;
/// Weight of incoherence in a decay: modes that beat decay as surely, but are seen less clearly.
const BEATING: f64 = 0.2;
/// Fewest samples in which the absence of an oscillation means something.
const LEAST_QUIET: u64 = 2048;
/// Without any oscillation the signals support stability, but a record may be too short or too quiet.
const QUIET_CONFIDENCE: f64 = 0.95;

/// Mean friction against mean velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// `dμ/dV`, s/m.
    pub slope: Measured,
    /// Lowest and highest velocity, m/s.
    pub velocity: [f64; 2],
}

/// The verdict on a record.
pub(super) fn conclude(
    windows: &[Window],
    episodes: &[Episode],
    recorded: Recorded,
    too_short: bool,
    samples: u64,
) -> Verdict {
    if too_short {
        return Verdict::undecided(
            "the record holds fewer than 12 periods of its oscillation; record longer, or look above it with --band",
        );
    }
    match episodes {
        [] => without_growth(windows, recorded, samples),
        episodes => together(episodes),
    }
}

/// All confident episodes have to agree.
fn together(episodes: &[Episode]) -> Verdict {
    let confident: Vec<&Episode> =
        episodes.iter().filter(|episode| episode.verdict.kind != Kind::Undecided).collect();
    // Without a confident one, the episode with the largest gain tells most about why.
    let weight =
        |episode: &Episode| if confident.is_empty() { episode.gain } else { episode.verdict.confidence };
    let candidates: Vec<&Episode> =
        if confident.is_empty() { episodes.iter().collect() } else { confident.clone() };
    let Some(best) = candidates.iter().copied().max_by(|a, b| weight(a).total_cmp(&weight(b))) else {
        return Verdict::undecided("no oscillation was analysed");
    };
    if candidates.iter().any(|episode| episode.verdict.kind != best.verdict.kind) {
        let list: Vec<String> = candidates
            .iter()
            .map(|episode| format!("{} at {:.4} s", episode.verdict.kind.words(), episode.time[0]))
            .collect();
        return Verdict::undecided(format!("the episodes differ: {}; see each", list.join(", ")));
    }
    let mut verdict = best.verdict.clone();
    if let Some(first) = verdict.reasons.first_mut() {
        *first =
            format!("from {:.4} to {:.4} s at {:.1} Hz {first}", best.time[0], best.time[1], best.frequency);
    }
    verdict
}

/// No oscillation grows: there is none, it decays, or it has been there from the start.
fn without_growth(windows: &[Window], recorded: Recorded, samples: u64) -> Verdict {
    let stable = |confidence: f64, reason: String| Verdict {
        kind: if confidence >= super::verdict::CONFIDENT { Kind::NoInstability } else { Kind::Undecided },
        confidence,
        leaning: Some(Kind::NoInstability),
        reasons: vec![reason],
    };
    let loud: Vec<&Window> = windows.iter().filter(|window| window.signal_to_noise >= LOUD).collect();
    let Some(loudest) = loud.iter().max_by(|a, b| a.sums.xx.total_cmp(&b.sums.xx)) else {
        return if samples < LEAST_QUIET {
            Verdict::undecided(format!(
                "no oscillation stands out of the noise, but in {samples} samples one may hide; record longer"
            ))
        } else {
            stable(QUIET_CONFIDENCE, "no oscillation stands out of the noise".to_owned())
        };
    };
    let amplitude = |window: &Window| (window.sums.xx - window.sums.noise[0]).max(0.0).sqrt();
    let last = windows.last().map_or(0.0, amplitude) / amplitude(loudest);
    let began = windows.first().map_or(0.0, |window| window.time[0]);
    let ended = windows.last().map_or(0.0, |window| window.time[1]);
    let trend = decay(&loud);
    let z = -trend.value / trend.error;
    // A decay that stays linear needs no halving: nothing but a free oscillation loses a part so steadily.
    let linear = loud.iter().all(|window| is_linear(window));
    let enough = if linear && z > 2.0 * CLEAR { DECAYED_LINEAR } else { DECAYED };
    let early = loudest.time[0] - began < EARLY * (ended - began);
    if early && z > CLEAR && last < enough {
        let clear = loud.iter().map(|window| clarity(window, recorded)).sum::<f64>() / loud.len() as f64;
        return stable(
            normal_below(z) * (1.0 - BEATING * (1.0 - clear)),
            format!(
                "the oscillation at {:.1} Hz decays by {:.2} ± {:.2} 1/s",
                loudest.frequency, -trend.value, trend.error
            ),
        );
    }
    Verdict::undecided(format!(
        "the oscillation at {:.1} Hz neither grows clearly nor decays: its beginning is not in the record, it has \
         saturated, or it is close to the threshold; record its onset",
        loudest.frequency
    ))
}

/// Squared coherence of one oscillation with the other channels, 1 without any.
fn clarity(window: &Window, recorded: Recorded) -> f64 {
    let force = window.sums.normal_force(INDEPENDENT).coherence;
    let acceleration = window.sums.normal_acceleration(INDEPENDENT).coherence;
    match (recorded.forces, recorded.normal_acceleration) {
        (false, false) => 1.0,
        (true, false) => force,
        (false, true) => acceleration,
        (true, true) => force.max(acceleration),
    }
}

/// Slope of the logarithm of the amplitude over the windows, 1/s.
fn decay(windows: &[&Window]) -> Measured {
    let points = windows.iter().map(|window| {
        let middle = 0.5 * (window.time[0] + window.time[1]);
        [middle, 0.5 * (window.sums.xx - window.sums.noise[0]).max(f64::MIN_POSITIVE).ln()]
    });
    line(&points.collect::<Vec<_>>())
}

/// Least squares line through points; windows overlap, which the error accounts for.
fn line(points: &[[f64; 2]]) -> Measured {
    let n = points.len() as f64;
    let mean = |of: usize| points.iter().map(|point| point[of]).sum::<f64>() / n;
    let (x0, y0) = (mean(0), mean(1));
    let spread: f64 = points.iter().map(|[x, _]| (x - x0).powi(2)).sum();
    let independent = n / SHARED - 2.0;
    if spread.is_nan() || spread <= 0.0 || independent < 1.0 {
        return Measured { value: 0.0, error: f64::INFINITY };
    }
    let value = points.iter().map(|[x, y]| (x - x0) * (y - y0)).sum::<f64>() / spread;
    let residual: f64 = points.iter().map(|[x, y]| (y - y0 - value * (x - x0)).powi(2)).sum();
    Measured { value, error: (residual / independent / spread).sqrt() }
}

/// Slope of the mean friction coefficient against the velocity over the windows before the first growth has ended in
/// which the motion is small: large oscillations change the mean, and stick and flight make it another quantity.
pub(super) fn quasi_static_slope(windows: &[Window], episodes: &[Episode]) -> Option<Friction> {
    /// Windows below this part of the largest oscillation are quiet.
    const QUIET: f64 = 0.1;
    /// Fewest windows of a slope.
    const LEAST: usize = 8;
    /// Relative range of velocities below which there is no slope to speak of.
    const RANGE: f64 = 0.02;
    let loudest = windows.iter().map(|window| window.rms).fold(0.0, f64::max);
    let end = episodes.first().map_or(windows.len(), |episode| episode.windows[1] + 1);
    let quiet = windows[..end].iter().filter(|window| window.rms <= QUIET * loudest);
    let points: Vec<[f64; 2]> =
        quiet.filter_map(|window| Some([window.velocity?, window.friction?])).collect();
    let low = points.iter().map(|point| point[0]).fold(f64::INFINITY, f64::min);
    let high = points.iter().map(|point| point[0]).fold(f64::NEG_INFINITY, f64::max);
    let usable = points.len() >= LEAST && high - low > RANGE * high.abs().max(low.abs());
    let slope = usable.then(|| line(&points)).filter(|slope| slope.error.is_finite());
    slope.map(|slope| Friction { slope, velocity: [low, high] })
}
