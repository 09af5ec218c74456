//! What `identify` says of a laboratory's strokes, held against the eigenvalues: each witness, and all of them together.

use crate::study::laboratory::{Drawn, Sensors, Stroke, known, right, sensed, settings, stroke};
use crate::study::strokes::{Random, csv, run};
use rayon::prelude::*;
use squealmap_identify::{CONFIDENT, Kind, Mechanism, Segment, Settings};

/// Instants at which a segment is held against the eigenvalues.
const INSTANTS: usize = 20;
/// Part of the stroke by which a boundary may be off.
pub(crate) const TOLERANCE: f64 = 0.05;
/// Part of a segment in which its verdict has to be right.
const MOSTLY: f64 = 0.8;

/// The causes that are right in each of the instants of a segment (s of the record).
fn instants(stroke: &Stroke, [start, end]: [f64; 2]) -> Vec<Vec<Kind>> {
    let off = TOLERANCE * stroke.duration;
    let [start, end] =
        if end - start > 4.0 * off { [start + off, end - off] } else { [0.5 * (start + end); 2] };
    let at = |k: usize| start + (end - start) * (k as f64 + 0.5) / INSTANTS as f64;
    (0..INSTANTS).map(|k| right(&stroke.instance, at(k))).collect()
}

/// The causes that are right in most of a segment; `None` where these change.
pub(crate) fn truth(stroke: &Stroke, time: [f64; 2]) -> Option<Vec<Kind>> {
    let instants = instants(stroke, time);
    let count = |kinds: &Vec<Kind>| instants.iter().filter(|other| *other == kinds).count();
    let most = instants.iter().max_by_key(|kinds| count(kinds))?.clone();
    (count(&most) as f64 >= MOSTLY * INSTANTS as f64).then_some(most)
}

/// Whether one of these kinds is right in most of a segment.
pub(crate) fn is_right(stroke: &Stroke, time: [f64; 2], kinds: &[Kind]) -> bool {
    let instants = instants(stroke, time);
    let right = instants.iter().filter(|truth| kinds.iter().any(|kind| truth.contains(kind))).count();
    right as f64 >= MOSTLY * INSTANTS as f64
}

/// Who is judged: the three witnesses, all together, and these about a mechanism that acts in any case.
pub(crate) const JUDGES: [&str; 5] = ["power", "phase", "friction", "joint", "mechanism"];

/// The likeliest kind of a judge, or kinds that it leaves open, and its probability.
pub(crate) fn said(segment: &Segment, judge: usize) -> Option<(Vec<Kind>, f64)> {
    let verdict = &segment.verdict;
    match judge {
        0..3 => {
            let (kind, probability) = segment.testimonies[judge].chances?.leading();
            Some((vec![kind], probability))
        }
        3 => {
            let undecided = verdict.kind == Kind::Undecided;
            let stated =
                if undecided { verdict.confidence.min(CONFIDENT - 0.01) } else { verdict.confidence };
            Some((vec![verdict.leaning?], stated))
        }
        _ => {
            let alone = |mechanism| match mechanism {
                Mechanism::NegativeSlope => Kind::NegativeSlope,
                Mechanism::ModeCoupling => Kind::ModeCoupling,
            };
            if let Some((mechanism, probability)) = segment.shared {
                return Some((vec![alone(mechanism), Kind::Both], probability));
            }
            let decided = verdict.kind != Kind::Undecided;
            decided.then(|| (vec![verdict.kind], verdict.confidence))
        }
    }
}

/// A statement of one judge about one segment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Statement {
    pub(crate) judge: usize,
    pub(crate) probability: f64,
    pub(crate) right: bool,
}

/// One stroke and what was said about it; no segments where it was not analysed.
pub(crate) struct Judged {
    pub(crate) drawn: Drawn,
    pub(crate) sensors: Sensors,
    pub(crate) statements: Vec<Statement>,
}

/// What became of a stroke.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fate {
    /// Nothing was said with confidence.
    Undecided,
    /// All that was said with confidence is right.
    Right,
    /// Something of it is wrong.
    ConfidentlyWrong,
}

impl Judged {
    fn of(&self, judge: usize) -> impl Iterator<Item = &Statement> {
        self.statements.iter().filter(move |statement| statement.judge == judge)
    }

    pub(crate) fn fate(&self, judge: usize) -> Fate {
        let confident = || self.of(judge).filter(|statement| statement.probability >= CONFIDENT);
        if confident().any(|statement| !statement.right) {
            Fate::ConfidentlyWrong
        } else if confident().count() > 0 {
            Fate::Right
        } else {
            Fate::Undecided
        }
    }

    /// Whether anything that it leans to is wrong.
    #[allow(dead_code, reason = "the benchmark shows it")]
    pub(crate) fn wrong(&self, judge: usize) -> bool {
        self.of(judge).any(|statement| !statement.right)
    }
}

/// Judges one stroke. Segments shorter than what boundaries may be off by are not judged.
pub(crate) fn judged(drawn: Drawn, stroke: &Stroke, sensors: Sensors, by: &Settings) -> Judged {
    let found = run(&csv(&stroke.samples), by);
    let segments = found.map(|found| found.segments).unwrap_or_default();
    let long = |segment: &&Segment| segment.time[1] - segment.time[0] > TOLERANCE * stroke.duration;
    let mut statements = Vec::new();
    for segment in segments.iter().filter(long) {
        for judge in 0..JUDGES.len() {
            if let Some((kinds, probability)) =
                said(segment, judge).filter(|(kinds, _)| *kinds != [Kind::Undecided])
            {
                let right = is_right(stroke, segment.time, &kinds);
                statements.push(Statement { judge, probability, right });
            }
        }
    }
    Judged { drawn, sensors, statements }
}

/// `each` strokes of every kind, with these sensors of the forces, at 40 and at 20 dB, in both directions.
pub(crate) fn table(seed: u64, each: usize, sensors: &[Sensors]) -> Vec<Judged> {
    let drawn = Drawn::ALL.into_iter().flat_map(|drawn| sensors.iter().map(move |by| (drawn, *by)));
    let asked: Vec<(Drawn, Sensors, f64, usize)> = drawn
        .flat_map(|(drawn, by)| [40.0, 20.0].map(|decibel| (drawn, by, decibel)))
        .flat_map(|(drawn, by, decibel)| (0..each).map(move |number| (drawn, by, decibel, number)))
        .collect();
    let one = |(place, (drawn, by, decibel, number)): (usize, (Drawn, Sensors, f64, usize))| {
        // Each stroke has a seed of its own: they do not depend on their number.
        let mut random = Random::new(seed.wrapping_mul(1_000_003).wrapping_add(place as u64));
        let mut stroke = stroke(drawn, by.rate(), &mut random);
        let backwards = number % 2 == 1;
        sensed(&mut stroke.samples, by != Sensors::Fast, decibel, backwards, &mut random);
        let mut settings = settings(stroke.critical, stroke.damping_ratio);
        if by == Sensors::Model {
            let rig = known(&stroke.instance, backwards, &mut random);
            let (damping_ratio, inclination) = (rig.damping_ratio(), rig.theta.abs());
            settings = Settings { damping_ratio, inclination, rig: Some(rig), ..settings };
        }
        let judged = judged(drawn, &stroke, by, &settings);
        if std::env::var_os("SQUEALMAP_SHOW_WRONG").is_some() {
            show(&judged, &stroke, decibel, &settings);
        }
        judged
    };
    asked.into_par_iter().enumerate().map(one).collect()
}

/// Prints a stroke about which something wrong was said.
fn show(judged: &Judged, stroke: &Stroke, decibel: f64, by: &Settings) {
    let wrong = |judge: &usize| judged.fate(*judge) == Fate::ConfidentlyWrong;
    let judges: Vec<&str> = (0..JUDGES.len()).filter(wrong).map(|judge| JUDGES[judge]).collect();
    if judges.is_empty() {
        return;
    }
    println!(
        "{:?} {:?} {decibel} dB, wrong: {judges:?}, critical {:.3}",
        judged.drawn, judged.sensors, stroke.critical
    );
    if let Ok(found) = run(&csv(&stroke.samples), by) {
        for s in &found.segments {
            println!(
                "  {:.4} to {:.4} {:?} reach {:?} phase {:?} {:?}\n    truth {:?}, verdict {:?} {:.3} {:?}",
                s.time[0],
                s.time[1],
                s.state,
                s.reach,
                s.phase.map(|p| p.value),
                s.friction,
                truth(stroke, s.time),
                s.verdict.kind,
                s.verdict.confidence,
                s.verdict.leaning
            );
            for t in &s.testimonies {
                println!("    {:?} {:?} {}", t.witness, t.chances.map(|c| c.leading()), t.evidence);
            }
        }
    }
}
