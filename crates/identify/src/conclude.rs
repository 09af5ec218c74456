//! From windows and episodes to the verdict on a record.

use crate::attribution::normal_below;
use crate::episode::Episode;
use crate::overview::Overview;
use crate::verdict::{DEAD, Kind, Verdict};

/// A trend counts from this many standard errors on.
const CLEAR: f64 = 3.0;
/// An oscillation that has lost this factor since it was loudest has decayed.
const DECAYED: f64 = 0.5;
/// That factor where every window is linear.
const DECAYED_LINEAR: f64 = 0.85;
/// The loudest window of a decaying oscillation lies in this first part of the record.
const EARLY: f64 = 0.5;
/// Weight of incoherence in a decay: modes that beat decay as surely, but are seen less clearly.
const BEATING: f64 = 0.2;
/// Fewest samples in which the absence of an oscillation means something.
const LEAST_QUIET: u64 = 2048;
/// Without any oscillation the signals support stability, but a record may be too short or too quiet.
const QUIET_CONFIDENCE: f64 = 0.95;

/// Where an oscillation was looked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Looked {
    /// Samples of the record.
    pub(super) samples: u64,
    /// Whether there is an oscillation, but not one window of it.
    pub(super) too_short: bool,
    /// The frequencies asked for, Hz; `None` for all.
    pub(super) band: Option<[f64; 2]>,
    /// The strongest oscillation of the record where these do not hold it, Hz.
    pub(super) outside: Option<f64>,
    /// Whether the normal acceleration is much larger than the tangential one most of the time.
    pub(super) unlike: bool,
}

/// The verdict on a record.
pub(super) fn conclude(overview: &Overview, episodes: &[Episode], looked: &Looked) -> Verdict {
    if looked.too_short {
        return Verdict::undecided(
            "the record holds fewer than 12 periods of its oscillation; record longer, or look above it with --band",
        );
    }
    match episodes {
        [] => without_growth(overview, looked),
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
fn without_growth(overview: &Overview, looked: &Looked) -> Verdict {
    let stable = |confidence: f64, reason: String| Verdict {
        kind: if confidence >= crate::verdict::CONFIDENT { Kind::NoInstability } else { Kind::Undecided },
        confidence,
        leaning: Some(Kind::NoInstability),
        reasons: vec![reason],
        each: None,
    };
    if overview.loud == 0 {
        let Looked { samples, band, outside, .. } = *looked;
        let between =
            band.map_or(String::new(), |[low, high]| format!(" between {low} and {high} Hz (--band)"));
        let nothing = format!("no oscillation{between} stands out of the noise");
        return match outside {
            Some(frequency) => Verdict::undecided(format!(
                "{nothing}; the strongest one of the record, at {frequency:.1} Hz, was not looked at: widen --band"
            )),
            None if looked.unlike => Verdict::undecided(DEAD),
            None if samples < LEAST_QUIET => {
                Verdict::undecided(format!("{nothing}, but in {samples} samples one may hide; record longer"))
            }
            None => stable(QUIET_CONFIDENCE, nothing),
        };
    }
    let [power, start, frequency] = overview.loudest;
    let [began, ended] = overview.time;
    let trend = overview.trend();
    let z = -trend.value / trend.error;
    // A decay that stays linear needs no halving: nothing but a free oscillation loses a part so steadily.
    let enough = if overview.linear && z > 2.0 * CLEAR { DECAYED_LINEAR } else { DECAYED };
    let early = start - began < EARLY * (ended - began);
    if early && z > CLEAR && overview.last < enough * power.sqrt() {
        return stable(
            normal_below(z) * (1.0 - BEATING * (1.0 - overview.clarity())),
            format!("the oscillation at {frequency:.1} Hz decays by {} 1/s", trend.text(-1.0, 2)),
        );
    }
    Verdict::undecided(format!(
        "the oscillation at {frequency:.1} Hz neither grows clearly nor decays: its beginning is not in the record, it has \
         saturated, or it is close to the threshold; record its onset"
    ))
}
