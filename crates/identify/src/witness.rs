//! The three witnesses of a segment.

use crate::attribution::normal_below;
use crate::cross::Measured;
use crate::episode::Episode;
use crate::level::{Level, Reading, UNFIT};
use crate::population::{Damped, Level as Height, Seen, Source, Trend, UNCLEAR, bin, stated};
use crate::segment::{REVERSES, Segment, State};
use crate::settings::Settings;
use crate::testimony::{Chances, Testimony, Witness};
use crate::verdict::Kind;

/// Squared coherence of the accelerations below which they have no phase.
const COHERENT: f64 = 0.5;
/// Standard errors of a phase, degrees, that blur it over more than a bin.
const SHARP: f64 = 10.0;
/// How likely a slope begins only below the mean velocity, over the part of that to which the velocity swings down: of growths that
/// feed on both and swing by a third, one in six or seven.
const BEGINS_BELOW: f64 = 0.5;
/// A swing from which on that is said.
const WIDE: f64 = 0.1;

/// What is known of the structure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Structure {
    /// The friction coefficient at which its modes coalesce.
    pub(super) critical: Option<Measured>,
    /// How strongly it is damped.
    pub(super) damped: Option<Damped>,
}

impl Structure {
    pub(super) fn new(settings: &Settings) -> Structure {
        Structure { critical: settings.critical_friction, damped: Damped::bounded(settings.damping_ratio) }
    }
}

/// (a) The power of friction while it grows; `elsewhere`: in another segment at the same velocity.
pub(super) fn power(episode: Option<&Episode>, elsewhere: bool) -> Testimony {
    let silent = |why: String| Testimony::silent(Witness::Power, why);
    let Some(episode) = episode else { return silent("no growth in it".to_owned()) };
    let verdict = &episode.verdict;
    let reason = verdict.reasons.first().cloned().unwrap_or_default();
    if verdict.kind == Kind::Undecided {
        return silent(reason);
    }
    // What it is not sure of may be any other cause.
    let rest = (1.0 - verdict.confidence) / 4.0;
    let mut weights = [rest; 5];
    let place = Kind::ALL.iter().position(|kind| *kind == verdict.kind).unwrap_or_default();
    weights[place] = verdict.confidence;
    let mut evidence = if elsewhere {
        format!("at this velocity, from {:.4} s on, {reason}", episode.time[0])
    } else {
        reason
    };
    if let Some(reach) = episode.reach.filter(|_| verdict.kind == Kind::Both) {
        let [.., coupling, both, _] = &mut weights;
        let below = *both * BEGINS_BELOW * reach.min(1.0);
        (*coupling, *both) = (*coupling + below, *both - below);
        if reach > WIDE {
            let swing = 100.0 * reach;
            evidence = format!(
                "{evidence}; it swings by {swing:.0} % of the velocity, and the slope may begin below that"
            );
        }
    }
    Testimony { witness: Witness::Power, chances: Chances::from_weights(weights), evidence }
}

/// Where a segment shows a phase, and which.
pub(super) fn phase_seen(segment: &Segment, episode: Option<&Episode>) -> Result<(Source, Measured), String> {
    let (source, phase, coherence) = match segment.state {
        State::Quiet => return Err("nothing vibrates".to_owned()),
        State::Decaying => return Err("the vibration dies out".to_owned()),
        State::Growing => {
            let Some(episode) = episode.filter(|episode| !episode.wanders) else {
                return Err("the vibration becomes stronger, but not as one growing mode".to_owned());
            };
            (Source::Growth, episode.phase, episode.coherence)
        }
        State::Sustained => (segment.source(), segment.phase, segment.coherence),
    };
    let Some((phase, coherence)) = phase.zip(coherence) else {
        return Err("the normal acceleration is not recorded".to_owned());
    };
    if coherence < COHERENT || phase.error > SHARP {
        return Err(format!("the accelerations have no clear phase (squared coherence {coherence:.2})"));
    }
    if source != Source::Growth {
        match segment.reach {
            None => {
                return Err("without the sliding velocity a sustained vibration may be driven; record it (--velocity)".to_owned());
            }
            Some(reach) if reach < REVERSES => {
                return Err(format!(
                    "the vibration has {:.0} % of the sliding velocity: friction does not limit it there, it may be driven",
                    100.0 * reach
                ));
            }
            Some(_) => {}
        }
    }
    Ok((source, phase))
}

/// (b) The phase, judged by a simulated population.
pub(super) fn phase(segment: &Segment, episode: Option<&Episode>, structure: Structure) -> Testimony {
    match phase_seen(segment, episode) {
        Err(why) => Testimony::silent(Witness::Phase, why),
        Ok((source, phase)) => {
            let (chances, number) = stated(Seen {
                source,
                bin: Some(bin(phase.value)),
                level: None,
                trend: None,
                damped: structure.damped,
            });
            let when = if source == Source::Growth { "while it grows" } else { "of the sustained vibration" };
            let evidence =
                format!("{}° {when}; {number:.0} simulated vibrations had such a phase", phase.text(1.0, 0));
            Testimony { witness: Witness::Phase, chances: Some(chances), evidence }
        }
    }
}

/// The level and the trend of friction of a vibration that reverses the sliding, as the population has them.
pub(super) fn friction_seen(segment: &Segment, structure: Structure) -> (Option<Height>, Option<Trend>) {
    /// Standard errors by which a level is above or below.
    const CLEAR: f64 = 2.0;
    /// Part of the coalescence below which a level is far below.
    const FAR: f64 = 0.8;
    let Some(friction) = segment.friction else { return (None, None) };
    let height = structure.critical.map(|critical| {
        let off = (friction.level.value - critical.value) / friction.level.error.hypot(critical.error);
        match off {
            off if off > CLEAR => Height::Above,
            off if off < -CLEAR && friction.level.value < FAR * critical.value => Height::Far,
            off if off < -CLEAR => Height::Below,
            _ => Height::Near,
        }
    });
    let trend = friction.slope.zip(segment.swept).map_or(Trend::Unknown, |(slope, [low, high])| {
        let unit = 0.5 * (low + high) / friction.level.value;
        Trend::of(Measured { value: slope.value * unit, error: slope.error * unit })
    });
    (height, Some(trend))
}

/// The probabilities that friction lies above the coalescence, which is read within an oscillation too, and that it falls with the
/// velocity, where no vibration disturbs it; `None` for what is not known.
pub(super) fn each(segment: &Segment, structure: Structure) -> [Option<f64>; 2] {
    let Some(friction) = segment.friction.filter(|friction| friction.reading != Reading::Bound) else {
        return [None; 2];
    };
    let above = structure.critical.map(|critical| {
        normal_below((friction.level.value - critical.value) / friction.level.error.hypot(critical.error))
    });
    let disturbed = friction.reading != Reading::Mean;
    let falls = friction.slope.filter(|_| !disturbed).map(|slope| normal_below(-slope.value / slope.error));
    [above, falls]
}

/// The probabilities that friction lies above the coalescence, and that it falls by more than the damping takes, where both are
/// read within the oscillation: each alone would do then. `None` where slopes are not clear.
pub(super) fn read_within(segment: &Segment, structure: Structure) -> Option<[f64; 2]> {
    /// Standard errors from which on a rise is one.
    const RISES: f64 = 3.0;
    let Level { level, slope, extremes, damping, .. } =
        segment.friction.filter(|friction| friction.reading == Reading::Within)?;
    let (critical, damping, ends) =
        (structure.critical?, damping?, extremes.or(slope.map(|slope| [slope; 2]))?);
    let [low, high] = segment.swept?;
    let error = slope.map_or(ends[0].error.max(ends[1].error), |slope| slope.error);
    let relative = error * 0.5 * (low + high).abs() / level.value.abs();
    if relative.is_nan() || relative > UNCLEAR {
        return None;
    }
    let above = (level.value - critical.value) / level.error.hypot(critical.error);
    // A rise that is not clear is none: friction hardly rises where it reaches the coalescence.
    let exceeds = |slope: Measured| {
        let value = if slope.value < RISES * slope.error { slope.value.min(0.0) } else { slope.value };
        normal_below((-value - damping.value) / slope.error.hypot(damping.error))
    };
    // What does so, or does not, in all but a part of the segment is in doubt, no less and no more.
    let [least, most] = ends.map(exceeds);
    // A law that bends has no slope in the middle: what holds at both ends holds.
    let exceeds = slope.map_or(if least > 0.5 { most } else { least }, exceeds);
    let told = if exceeds > 0.5 { exceeds.min(least.max(0.5)) } else { exceeds.max(most.min(0.5)) };
    Some([normal_below(above), told])
}

/// Why a vibration is driven from elsewhere, where the forces show it: friction takes power out of it, and yet it goes on; or friction
/// lies below the coalescence and does not fall, and yet it vibrates.
pub(super) fn driven(segment: &Segment, structure: Structure) -> Option<String> {
    /// Standard errors from which on a damping is negative.
    const NEGATIVE: f64 = 3.0;
    let damping = segment.friction.and_then(|friction| friction.damping);
    if let Some(damping) = damping.filter(|damping| damping.value < -NEGATIVE * damping.error) {
        return Some(format!(
            "friction takes power out of the vibration (damping {} s/m), and yet it goes on: it is driven from elsewhere, or the forces \
             are late (--force-skew)",
            damping.text(1.0, 3)
        ));
    }
    let [above, falls] = each(segment, structure);
    let stable = (1.0 - above?) * (1.0 - falls?);
    (stable > 0.5).then(|| {
        "by level and slope of friction sliding is rather stable, and yet it vibrates: it may be driven"
            .to_owned()
    })
}

/// (c) Level and slope of friction.
pub(super) fn friction(segment: &Segment, structure: Structure, grows: bool) -> Testimony {
    let silent = |why: &str| Testimony::silent(Witness::Friction, why);
    let Some(friction) = segment.friction else { return silent("the forces are not recorded") };
    if let Some(why) = driven(segment, structure).filter(|_| segment.state.vibrates()) {
        return silent(&why);
    }
    let level = friction.level.text(1.0, 3);
    let slope = friction.slope.map_or(String::new(), |slope| format!(", dμ/dv {} s/m", slope.text(1.0, 3)));
    let against = structure
        .critical
        .map_or(String::new(), |critical| format!(", coalescence at {}", critical.text(1.0, 3)));
    let misfit = friction.misfit.filter(|misfit| *misfit >= UNFIT).map_or(String::new(), |misfit| {
        format!(
            ", the forces of --model differ by {:.0} % while the velocity rises and while it falls: it does not fit the record (masses, \
             stiffnesses, the sign of theta, --skew)",
            100.0 * misfit
        )
    });
    let evidence = format!("μ {level}{against}{slope}{misfit}");
    let spoken = |chances: Option<Chances>, evidence: String| Testimony {
        witness: Witness::Friction,
        chances,
        evidence,
    };
    if let Some([coupling, slope]) = read_within(segment, structure) {
        let damping = friction.damping.map_or(String::new(), |damping| damping.text(1.0, 3));
        let evidence = format!("{evidence}, damping {damping} s/m; read within the oscillation");
        return spoken(Some(Chances::of_each(coupling, slope)), evidence);
    }
    if friction.reading != Reading::Mean {
        let reverses =
            if segment.reach.is_some_and(|reach| reach < 1.0) { "all but reverses" } else { "reverses" };
        let why = if friction.misfit.is_some_and(|misfit| misfit >= UNFIT) {
            ""
        } else {
            " (the force sensors do not follow it, or there are fewer than 12 samples per period, or 15 where the contact opens)"
        };
        let how = if friction.reading == Reading::Within {
            "read within the oscillation".to_owned()
        } else {
            format!(
                "the vibration {reverses} the sliding and hides the law{why}: the mean is a lower bound, its slope is not that of the law"
            )
        };
        let (level, trend) = friction_seen(segment, structure);
        let tells = level.is_some() || (trend != Some(Trend::Unknown) && friction.reading == Reading::Within);
        let seen = Seen { source: segment.source(), bin: None, level, trend, damped: structure.damped };
        return spoken(tells.then(|| stated(seen).0), format!("{evidence}; {how}"));
    }
    match each(segment, structure) {
        [Some(coupling), Some(slope)] if !segment.goes_by_itself(grows) => {
            // How much of a falling slope the damping takes is not known.
            let chances = Chances::of_each(coupling, slope);
            let tells = chances.leading().0 == Kind::NoInstability;
            let evidence = if tells {
                evidence
            } else {
                format!("{evidence}; nothing grows, so damping may outweigh it")
            };
            spoken(tells.then_some(chances), evidence)
        }
        [Some(coupling), Some(slope)] => spoken(Some(Chances::of_each(coupling, slope)), evidence),
        [None, _] => spoken(None, format!("{evidence}; the coalescence is not known (--critical-friction)")),
        [_, None] => {
            spoken(None, format!("{evidence}; the velocity does not change, or the slope is not clear"))
        }
    }
}
