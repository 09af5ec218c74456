//! The witnesses of a segment together: its verdict, what that rests on, and what contradicts it.

use crate::episode::Episode;
use crate::instants::Instant;
use crate::level::Reading;
use crate::population::{Level as Height, Seen, Source, bin, chances};
use crate::segment::{Segment, State};
use crate::testimony::{CAUSES, Chances, Mechanism, Testimony, Witness};
use crate::verdict::{CONFIDENT, DEAD, Kind, Verdict};
use crate::witness::{
    Structure, driven, each, friction, friction_seen, phase, phase_seen, power, read_within,
};

/// A probability that a confident witness leaves to what another says with confidence: they contradict each other.
const LEAVES: f64 = 0.02;
/// Confidence that a stretch without vibration is stable: nothing shows what a stronger kick would do.
const QUIET: f64 = 0.95;
/// E-foldings of the growth that follows, for which a quiet stretch must last: from the smallest kick on, growth would show.
const FOLDS: f64 = 12.0;
/// Relative difference of velocities, and difference of temperatures (°C), that are one condition.
const SAME_VELOCITY: f64 = 0.03;
const SAME_TEMPERATURE: f64 = 10.0;
/// Relative difference of friction coefficients that are one, a vibration that blurs the one of them aside.
const SAME_FRICTION: f64 = 0.05;
/// Relative difference of velocities up to which a growth speaks for the vibration that it goes over into.
const SAME_VIBRATION: f64 = 0.1;
/// A probability below which the power at growth rather speaks against a mechanism.
const RATHER: f64 = 0.85;
/// A likelihood is never believed beyond this: every witness has errors that it does not know.
const BELIEVED: f64 = 0.995;

/// Judges every segment.
/// `course`: the velocity over time.
pub(super) fn judged(
    segments: &mut [Segment],
    episodes: &[Episode],
    course: &[Instant],
    structure: Structure,
) {
    let homes = homes(segments, episodes);
    let points: Vec<_> = episodes.iter().map(|episode| point(episode, course)).collect();
    for number in 0..segments.len() {
        let own: Vec<&Episode> =
            homes.iter().zip(episodes).filter(|(home, _)| **home == Some(number)).map(|(_, e)| e).collect();
        let best = own.iter().copied().max_by(|a, b| by_confidence(a, b));
        // What grew is unstable so at that velocity, not at all that its vibration goes through afterwards.
        let segment = &segments[number];
        let speaks = |point: &Option<(f64, Option<f64>)>| {
            segment.state == State::Growing || point.is_none_or(|point| alike(segment, point, SAME_VIBRATION))
        };
        let here = homes.iter().zip(episodes).zip(&points);
        let here = here.filter(|((home, _), point)| **home == Some(number) && speaks(point));
        let here = here.map(|((_, episode), _)| episode).max_by(|a, b| by_confidence(a, b));
        let told = here.or_else(|| elsewhere(&segments[number], episodes, &points));
        // What a quiet stretch goes over into, by way of other quiet ones.
        let goes_on = |k: &usize| segments[*k].state != State::Quiet || homes.contains(&Some(*k));
        let after = (number + 1..segments.len()).find(goes_on);
        let next = homes.iter().position(|home| home.is_some() && *home == after);
        let same = next.zip(after).is_some_and(|(next, after)| {
            let level = |number: usize| segments[number].friction.map(|friction| friction.level.value);
            let drift = level(number).zip(level(after)).map_or(0.0, |(here, then)| (then / here - 1.0).abs());
            drift <= SAME_FRICTION && points[next].is_some_and(|point| alike(segment, point, SAME_VELOCITY))
        });
        let next = next.map(|next| episodes[next].growth.value);
        let follows = after.is_some_and(|after| segments[after].state.vibrates());
        let until = after.map(|after| segments[after].time[0]);
        let grows = best.is_some_and(|episode| !episode.wanders);
        let segment = &mut segments[number];
        segment.seen = phase_seen(segment, best).ok().map(|(source, phase)| {
            let (level, trend) = friction_seen(segment, structure);
            Seen { source, bin: Some(bin(phase.value)), level, trend, damped: structure.damped }
        });
        segment.testimonies = vec![
            power(told, best.is_none()),
            phase(segment, best, structure),
            friction(segment, structure, grows),
        ];
        match segment.state {
            State::Quiet | State::Decaying => {
                (segment.verdict, segment.rests_on) =
                    calm(segment, (next, until), [follows, same], structure);
            }
            State::Growing | State::Sustained => {
                (segment.verdict, segment.rests_on, segment.shared) =
                    together(segment, best, told, structure);
            }
        }
        contradict(segment, &own);
    }
}

/// The segment of each episode: where most of its second half lies that is not quiet.
fn homes(segments: &[Segment], episodes: &[Episode]) -> Vec<Option<usize>> {
    let home = |episode: &Episode| {
        let [start, end] = episode.time;
        let late = [0.5 * (start + end), end];
        let shared =
            |segment: &Segment| late[1].min(segment.time[1]) - late[0].max(segment.time[0]).min(late[1]);
        let loud =
            (0..segments.len()).filter(|k| segments[*k].state != State::Quiet && shared(&segments[*k]) > 0.0);
        if let Some(home) = loud.max_by(|a, b| shared(&segments[*a]).total_cmp(&shared(&segments[*b]))) {
            return Some(home);
        }
        let inside = segments.iter().position(|segment| end <= segment.time[1])?;
        // The end of a growth may lie a cell before what it grows into.
        let quiet = segments[inside].state == State::Quiet;
        Some(if quiet && inside + 1 < segments.len() { inside + 1 } else { inside })
    };
    episodes.iter().map(|episode| home(episode).or(segments.len().checked_sub(1))).collect()
}

/// Where an episode worked: velocity, m/s, and temperature, °C; `None` without the velocity.
fn point(episode: &Episode, course: &[Instant]) -> Option<(f64, Option<f64>)> {
    let middle = 0.5 * (episode.time[0] + episode.time[1]);
    let after = course.partition_point(|instant| instant.time < middle).min(course.len().checked_sub(1)?);
    let Instant { velocity, temperature, .. } = course[after];
    Some((velocity?, temperature))
}

/// The most confident growth elsewhere in the record at the velocity and the temperature of a segment: what is unstable
/// there is so here.
fn elsewhere<'a>(
    segment: &Segment,
    episodes: &'a [Episode],
    points: &[Option<(f64, Option<f64>)>],
) -> Option<&'a Episode> {
    let here = episodes
        .iter()
        .zip(points)
        .filter(|(_, point)| point.is_some_and(|point| alike(segment, point, SAME_VELOCITY)));
    let decided = here.map(|(episode, _)| episode).filter(|episode| episode.verdict.kind != Kind::Undecided);
    decided.max_by(|a, b| a.verdict.confidence.total_cmp(&b.verdict.confidence))
}

/// Whether a segment has this velocity (m/s), up to a relative difference, and this temperature (°C) throughout.
fn alike(segment: &Segment, (at, temperature): (f64, Option<f64>), apart: f64) -> bool {
    let heat = temperature.zip(segment.temperature).map_or(0.0, |(a, b)| (a - b).abs());
    let same = |velocity: &[f64; 2]| velocity.iter().all(|v| (v - at).abs() <= apart * at.abs());
    segment.swept.as_ref().is_some_and(same) && heat <= SAME_TEMPERATURE
}

/// Decided before undecided, then the more confident one.
fn by_confidence(a: &Episode, b: &Episode) -> std::cmp::Ordering {
    let of = |episode: &Episode| (episode.verdict.kind != Kind::Undecided, episode.verdict.confidence);
    of(a).partial_cmp(&of(b)).unwrap_or(std::cmp::Ordering::Equal)
}

/// A stretch without growth, the rate (1/s) of the growth that follows, and when it does, s; whether a vibration follows, and whether it grew at
/// the velocity, the temperature and the friction of this stretch.
fn calm(
    segment: &Segment,
    (next, until): (Option<f64>, Option<f64>),
    [follows, same]: [bool; 2],
    structure: Structure,
) -> (Verdict, Vec<Witness>) {
    let length = until.unwrap_or(segment.time[1]) - segment.time[0];
    let unstable = segment.testimonies[0].chances.map(|chances| chances.leading());
    if let Some((kind, confidence)) =
        unstable.filter(|_| segment.state == State::Quiet && (follows || next.is_some()))
    {
        let reason = "the vibration has not become visible yet; what grows at this velocity is unstable here";
        let decided = confidence >= CONFIDENT;
        let verdict = Verdict {
            kind: if decided { kind } else { Kind::Undecided },
            confidence,
            leaning: Some(kind),
            reasons: vec![reason.to_owned()],
            each: None,
        };
        return (verdict, vec![Witness::Power]);
    }
    if let Some(growth) = next.filter(|growth| growth * length < FOLDS) {
        let reason = format!("it is too short to tell from the growth of {growth:.1} 1/s that follows");
        return (Verdict::undecided(reason), Vec::new());
    }
    if same && segment.state == State::Quiet {
        let reason = "what follows grows at this velocity, so the contact is unstable here; the vibration has not become visible yet";
        return (Verdict::undecided(reason), Vec::new());
    }
    if follows && next.is_none() {
        let reason = "a vibration follows whose growth was not seen: when it began is not known";
        return (Verdict::undecided(reason), Vec::new());
    }
    let [above, _] = each(segment, structure);
    if above.is_some_and(|above| above > CONFIDENT) {
        return (
            Verdict::undecided("friction lies above the coalescence of the modes, yet nothing grows"),
            Vec::new(),
        );
    }
    if let Some(part) = segment.weak {
        let reason = format!(
            "a vibration goes on with {:.1} % of the largest amplitude of the record: too weak beside that to be judged; cut the record \
             before it, or give its band (--band)",
            100.0 * part
        );
        return (Verdict::undecided(reason), Vec::new());
    }
    if segment.unlike {
        return (Verdict::undecided(DEAD), Vec::new());
    }
    let reason = match segment.state {
        State::Decaying => "the oscillation decays",
        _ => "nothing grows",
    };
    let verdict = Verdict {
        kind: Kind::NoInstability,
        confidence: QUIET,
        leaning: Some(Kind::NoInstability),
        reasons: vec![reason.to_owned()],
        each: None,
    };
    (verdict, Vec::new())
}

/// A vibration: population, friction and power of friction multiplied. `episode` is the growth in it, `told` the one whose power holds here.
fn together(
    segment: &Segment,
    episode: Option<&Episode>,
    told: Option<&Episode>,
    structure: Structure,
) -> (Verdict, Vec<Witness>, Option<(Mechanism, f64)>) {
    let undecided = |reason: String| (Verdict::undecided(reason), Vec::new(), None);
    let reads = each(segment, structure);
    let by_power = segment.testimonies[0].chances;
    let seen = phase_seen(segment, episode);
    let grows = episode.is_some_and(|episode| !episode.wanders);
    if !segment.goes_by_itself(grows) && by_power.is_none() {
        return undecided(seen.err().unwrap_or_else(|| "the vibration may be driven".to_owned()));
    }
    if let Some(why) = driven(segment, structure) {
        return undecided(why);
    }
    if segment.testimonies.iter().all(|testimony| testimony.chances.is_none()) {
        return undecided("no witness speaks".to_owned());
    }
    let source = segment.source();
    let binned = seen.as_ref().ok().map(|(_, phase)| bin(phase.value));
    let within = read_within(segment, structure);
    let mean = segment.friction.is_none_or(|friction| friction.reading == Reading::Mean);
    let read = mean || within.is_some();
    let (level, trend) = if read { (None, None) } else { friction_seen(segment, structure) };
    // A level that is read needs no counts.
    let level = if reads[0].is_some() { None } else { level };
    let (population, number) = chances(Seen { source, bin: binned, level, trend, damped: structure.damped });
    let weights = multiplied(population, within, reads, by_power);
    let Some(joint) = Chances::from_weights(weights) else { return undecided("nothing fits".to_owned()) };
    let (kind, probability) = joint.leading();
    // What counted vibrations leave open; what is read does not rest on them.
    let direct = by_power.is_some() || within.is_some() || reads.iter().all(Option::is_some);
    let sure = |probability: f64| {
        let p = probability.clamp(0.0, 1.0);
        let spread =
            if direct { 0.0 } else { (p * (1.0 - p) / (number + 1.0)).sqrt() + 0.5 / (number + 1.0) };
        (p - spread).clamp(0.0, BELIEVED)
    };
    // A level that is read has the last word on whether it reaches the coalescence: what counted vibrations say of it is of others.
    let above = reads[0].filter(|_| source == Source::Within);
    let by_level = |couples: bool| above.map_or(1.0, |above| if couples { above } else { 1.0 - above });
    // And so has a slope that is read, or that the power at growth shows, on whether it feeds: that coupling cannot be does not make it do so,
    // nor do counts alone show that it does not.
    let by_slope = |feeds: bool| {
        let shown = within.map(|[_, exceeds]| exceeds).into_iter().chain(by_power.map(|power| power.slope()));
        if source == Source::Within { by_shown(feeds, shown.reduce(f64::max)) } else { 1.0 }
    };
    // The power at growth may be too unsure to speak, and yet say that a mechanism rather would not do.
    let [slope, coupling] = told.and_then(|episode| episode.verdict.each).unwrap_or([1.0; 2]);
    let by_growth = |share: f64| if share < RATHER { CONFIDENT - 0.01 } else { 1.0 };
    // Modes as close as their damping is wide give a slope alone any phase: where friction lies far below the coalescence, that alone does not
    // exclude it.
    let by_phase =
        if level == Some(Height::Far) && structure.damped.is_none() { CONFIDENT - 0.01 } else { 1.0 };
    let most = |mechanism| match mechanism {
        Mechanism::ModeCoupling => by_level(true).min(by_growth(coupling)).min(by_phase),
        Mechanism::NegativeSlope => by_slope(true).min(by_growth(slope)),
    };
    let couples = matches!(kind, Kind::ModeCoupling | Kind::Both);
    let feeds = matches!(kind, Kind::NegativeSlope | Kind::Both);
    let of_coupling = if couples { most(Mechanism::ModeCoupling) } else { by_level(false) };
    let of_slope = if feeds { most(Mechanism::NegativeSlope) } else { by_slope(false) };
    let confidence = sure(probability).min(of_coupling).min(of_slope);
    let parts: Vec<String> =
        [(1, "negative slope"), (2, "mode coupling"), (3, "both"), (4, "only both together")]
            .into_iter()
            .filter(|(k, _)| joint.0[*k] > 0.02)
            .map(|(k, words)| format!("{words} {:.0} %", 100.0 * joint.0[k]))
            .collect();
    let reason = format!(
        "mode coupling would do with {:.0} %, the slope with {:.0} %: {}",
        100.0 * joint.coupling(),
        100.0 * joint.slope(),
        parts.join(", ")
    );
    // Phases of growth overlap too much: without a direct reading they only lean.
    let tells = direct || source != Source::Growth;
    let confidence = if tells { confidence } else { confidence.min(CONFIDENT - 0.01) };
    let decided = confidence >= CONFIDENT && kind != Kind::Undecided;
    let verdict = Verdict {
        kind: if decided { kind } else { Kind::Undecided },
        confidence,
        leaning: (kind != Kind::Undecided).then_some(kind),
        reasons: vec![reason],
        each: None,
    };
    let suffices = |mechanism| (mechanism, sure(joint.suffices(mechanism)).min(most(mechanism)));
    let shared = Mechanism::ALL.map(suffices).into_iter().find(|(_, p)| *p >= CONFIDENT && !decided && tells);
    let agrees =
        |testimony: &&Testimony| testimony.chances.is_some_and(|chances| chances.of(kind) >= CONFIDENT);
    let mut rests: Vec<Witness> =
        segment.testimonies.iter().filter(agrees).map(|testimony| testimony.witness).collect();
    if rests.is_empty() {
        let speaks = |testimony: &&Testimony| testimony.chances.is_some();
        rests = segment.testimonies.iter().filter(speaks).map(|testimony| testimony.witness).collect();
    }
    (verdict, rests, shared)
}

/// The weights of the causes by the population, what is read, and the power at growth.
fn multiplied(
    Chances(mut weights): Chances,
    within: Option<[f64; 2]>,
    reads: [Option<f64>; 2],
    by_power: Option<Chances>,
) -> [f64; CAUSES] {
    // Index: none, slope, coupling, both, interaction.
    let believed = |p: f64| p.clamp(1.0 - BELIEVED, BELIEVED);
    if let Some([above, exceeds]) = within.map(|each| each.map(believed)) {
        let [below, less] = [1.0 - above, 1.0 - exceeds];
        let each = [below * less, below * exceeds, above * less, above * exceeds, below * less];
        weights.iter_mut().zip(each).for_each(|(weight, p)| *weight *= p);
    } else {
        let [above, falls] = reads;
        if let Some(p) = above.map(believed) {
            for (cause, weight) in weights.iter_mut().enumerate() {
                *weight *= if cause == 2 || cause == 3 { p } else { 1.0 - p };
            }
        }
        if let Some(p) = falls.map(believed) {
            for (cause, weight) in weights.iter_mut().enumerate() {
                *weight *= if cause == 2 { 1.0 - p } else { p };
            }
        }
    }
    if let Some(power) = by_power {
        weights.iter_mut().zip(power.0).for_each(|(weight, p)| *weight *= p.max(1.0 - BELIEVED));
    }
    weights
}

/// The most that may be said of whether the slope feeds, by the probability that it is shown to, if any is.
fn by_shown(feeds: bool, shown: Option<f64>) -> f64 {
    match shown {
        None => CONFIDENT - 0.01,
        Some(most) if feeds => most,
        Some(_) => 1.0,
    }
}

/// Names what contradicts the verdict, which is then undecided.
fn contradict(segment: &mut Segment, own: &[&Episode]) {
    let mut found = Vec::new();
    let loud: Vec<(&Testimony, Kind)> = segment
        .testimonies
        .iter()
        .filter_map(|testimony| {
            let (kind, probability) = testimony.chances?.leading();
            (probability >= CONFIDENT && kind != Kind::Undecided).then_some((testimony, kind))
        })
        .collect();
    if segment.state.vibrates() {
        for (k, (one, kind)) in loud.iter().enumerate() {
            for (other, differs) in &loud[k + 1..] {
                let leaves = other.chances.map_or(0.0, |chances| chances.of(*kind));
                let left = one.chances.map_or(0.0, |chances| chances.of(*differs));
                if kind != differs && leaves < LEAVES && left < LEAVES {
                    found.push(format!(
                        "{} says {}, {} says {}",
                        one.witness.words(),
                        kind.words(),
                        other.witness.words(),
                        differs.words()
                    ));
                }
            }
        }
    }
    let decided: Vec<&&Episode> =
        own.iter().filter(|episode| episode.verdict.kind != Kind::Undecided).collect();
    if let Some(first) = decided.first()
        && let Some(other) = decided.iter().find(|episode| episode.verdict.kind != first.verdict.kind)
    {
        found.push(format!(
            "the growth at {:.4} s says {}, that at {:.4} s {}",
            first.time[0],
            first.verdict.kind.words(),
            other.time[0],
            other.verdict.kind.words()
        ));
    }
    if !found.is_empty() {
        segment.shared = None;
    }
    if !found.is_empty() && segment.verdict.kind != Kind::Undecided {
        segment.verdict.kind = Kind::Undecided;
        segment.verdict.confidence = segment.verdict.confidence.min(0.5);
    }
    segment.contradictions = found;
}
