//! Measured signals: identification on synthetic strokes whose type and phase are known.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fmt::Write as _;
use std::io::{Cursor, Read};
use std::path::Path;

use squealmap::Error;
use squealmap::export::signals::signals_csv;
use squealmap::identify::{Fault, Identification, Kind, Settings, alone, identify};
use squealmap::signals::Sample;

use crate::common::near;
use crate::strokes::{FIELDS, Field, Random, Stroke, Wanted, add_noise, stroke};

/// The seed of the table: strokes, noise and skews follow from it.
const SEED: u64 = 1;
/// Signal-to-noise ratios, dB.
const RATIOS: [f64; 5] = [40.0, 30.0, 20.0, 10.0, 0.0];
/// From this ratio on verdicts are held to the requirements, dB.
const GOOD: f64 = 20.0;
/// Sampling rates, Hz.
const RATES: [f64; 2] = [200e3, 51.2e3];
/// How many strokes of each kind there are per ratio and rate.
const SHARES: [(Wanted, usize); 6] = [
    (Wanted::Stable, 6),
    (Wanted::Slope, 4),
    (Wanted::Coupling, 5),
    (Wanted::Both, 3),
    (Wanted::BothOneWeak, 1),
    (Wanted::Interaction, 1),
];
/// Largest skew of the normal acceleration, s.
const LARGEST_SKEW: f64 = 20e-6;
/// Bound on the damping ratio that the analysis is given: that of the strokes.
const DAMPING_RATIO: f64 = 1e-3;

fn run(bytes: &[u8], settings: &Settings) -> Result<Identification, Error> {
    identify(|| Ok(Box::new(Cursor::new(bytes.to_vec())) as Box<dyn Read>), "signals.csv", settings)
}

fn csv(samples: &[Sample]) -> Vec<u8> {
    signals_csv(samples, None).unwrap()
}

/// One stroke of the table and what was found.
struct Judged {
    wanted: Wanted,
    ratio: f64,
    skew_known: bool,
    /// `None`: named and not analysed.
    found: Option<Identification>,
    true_phase: f64,
}

impl Judged {
    fn kind(&self) -> Option<Kind> {
        self.found.as_ref().map(|found| found.verdict.kind)
    }

    /// Whether a confident verdict is wrong. Of two mechanisms of which one is weak the other is the cause, and both
    /// are named rightly, too.
    fn wrong(&self) -> bool {
        let right: &[Kind] = match self.wanted {
            Wanted::Stable => &[Kind::NoInstability],
            Wanted::Slope => &[Kind::NegativeSlope],
            Wanted::Coupling => &[Kind::ModeCoupling],
            Wanted::Both => &[Kind::Both],
            Wanted::BothOneWeak => &[Kind::NegativeSlope, Kind::ModeCoupling, Kind::Both],
            Wanted::Interaction => &[],
        };
        self.kind().is_some_and(|kind| kind != Kind::Undecided && !right.contains(&kind))
    }

    /// Error of the phase of the last episode, degrees, where the skew is known and the oscillation grows.
    fn phase_error(&self) -> Option<f64> {
        let episode = self.found.as_ref()?.episodes.last()?;
        let unstable = self.wanted != Wanted::Stable;
        let off = (episode.phase?.value - self.true_phase + 180.0).rem_euclid(360.0) - 180.0;
        (self.skew_known && unstable).then_some(off)
    }
}

/// The 200 strokes.
fn table(seed: u64) -> Vec<Judged> {
    let mut random = Random::new(seed);
    let mut judged = Vec::new();
    for ratio in RATIOS {
        for rate in RATES {
            for wanted in SHARES.iter().flat_map(|(wanted, count)| std::iter::repeat_n(*wanted, *count)) {
                let skew_known = judged.len() % 2 == 0;
                let skew = LARGEST_SKEW * random.uniform();
                let Stroke { linear, mut samples } = stroke(wanted, rate, skew, &mut random);
                add_noise(&mut samples, ratio, &mut random);
                let settings = Settings {
                    skew: if skew_known { skew } else { 0.0 },
                    damping_ratio: DAMPING_RATIO,
                    ..Settings::default()
                };
                let found = run(&csv(&samples), &settings).ok();
                let true_phase = linear.phase.unwrap_or(f64::NAN);
                judged.push(Judged { wanted, ratio, skew_known, found, true_phase });
            }
        }
    }
    judged
}

/// The worst and the median error of the phase at this ratio, degrees, and how many there are.
fn phase_errors(judged: &[Judged], ratio: f64) -> (f64, f64, usize) {
    let at = judged.iter().filter(|stroke| stroke.ratio >= ratio && stroke.ratio < ratio + 1.0);
    let mut errors: Vec<f64> = at.filter_map(Judged::phase_error).map(f64::abs).collect();
    errors.sort_by(f64::total_cmp);
    let median = errors.get(errors.len() / 2).copied().unwrap_or(f64::NAN);
    (errors.last().copied().unwrap_or(f64::NAN), median, errors.len())
}

/// Confident verdicts among these strokes, in percent.
fn confident(strokes: &[&Judged]) -> usize {
    let count =
        strokes.iter().filter(|stroke| stroke.kind().is_some_and(|kind| kind != Kind::Undecided)).count();
    100 * count / strokes.len().max(1)
}

/// Whether the four verdicts can say what it is.
fn has_a_verdict(stroke: &Judged) -> bool {
    !matches!(stroke.wanted, Wanted::BothOneWeak | Wanted::Interaction)
}

#[test]
fn two_hundred_strokes() {
    let judged = table(SEED);
    assert_eq!(judged.len(), 200);
    let good: Vec<&Judged> = judged.iter().filter(|stroke| stroke.ratio >= GOOD).collect();
    for stroke in &good {
        let found = stroke.found.as_ref().map(|found| &found.verdict);
        assert!(!stroke.wrong(), "{:?} at {} dB called {found:?}", stroke.wanted, stroke.ratio);
    }
    let named: Vec<&Judged> = good.into_iter().filter(|stroke| has_a_verdict(stroke)).collect();
    assert!(confident(&named) >= 80, "{} % confident", confident(&named));
    for ratio in [40.0, 30.0, 20.0] {
        let (worst, _, count) = phase_errors(&judged, ratio);
        assert!(worst <= 2.0 && count >= 8, "{ratio} dB: phase off by {worst}° at worst of {count}");
    }
    // The judge itself turns red: a verdict against the truth, and a wrong phase.
    let right = judged.into_iter().find(|stroke| stroke.kind() == Some(Kind::ModeCoupling)).unwrap();
    assert!(!right.wrong());
    assert!(Judged { wanted: Wanted::Slope, ..right }.wrong());
}

/// `identify` of the phase must not be right by luck: an unknown skew shows in full.
#[test]
fn skew_turns_the_phase_and_is_named() {
    let mut random = Random::new(7);
    let stroke = stroke(Wanted::Coupling, 200e3, 10e-6, &mut random);
    let bytes = csv(&stroke.samples);
    let phase = |skew: f64| {
        let found = run(&bytes, &Settings { skew, ..Settings::default() }).unwrap();
        assert_eq!(found.verdict.kind, Kind::ModeCoupling, "the forces decide, whatever the skew");
        (found.episodes[0].phase.unwrap().value, found)
    };
    let (known, _) = phase(10e-6);
    near("phase with known skew", known, stroke.linear.phase.unwrap(), 1.0);
    let (unknown, found) = phase(0.0);
    let expected = 360.0 * found.episodes[0].frequency * 10e-6;
    near("phase lost to the skew", (known - unknown).rem_euclid(360.0), expected, 0.1);
    assert!(
        found.verdict.reasons.iter().any(|reason| reason.contains("--skew")),
        "{:?}",
        found.verdict.reasons
    );
}

#[test]
fn skewed_forces_are_never_confidently_wrong() {
    let mut random = Random::new(11);
    for delay in [1e-6, 3e-6, 8e-6, 20e-6] {
        for wanted in [Wanted::Slope, Wanted::Coupling, Wanted::Both] {
            let mut stroke = stroke(wanted, 200e3, 0.0, &mut random);
            // Whole samples: forces late against both accelerations.
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few samples")]
            let late = (delay * 200e3_f64).round() as usize;
            for k in (late..stroke.samples.len()).rev() {
                stroke.samples[k].tangential_force = stroke.samples[k - late].tangential_force;
                stroke.samples[k].normal_force = stroke.samples[k - late].normal_force;
            }
            let found = run(&csv(&stroke.samples[late..]), &Settings::default());
            let kind = found.as_ref().map_or(Kind::Undecided, |found| found.verdict.kind);
            let right = match wanted {
                Wanted::Slope => Kind::NegativeSlope,
                Wanted::Coupling => Kind::ModeCoupling,
                _ => Kind::Both,
            };
            assert!(kind == Kind::Undecided || kind == right, "{wanted:?} {delay} s late: {found:?}");
        }
    }
}

/// Each mechanism alone, against the eigenvalues of the model (docs/physics.md, section 6).
#[test]
fn two_modes_give_the_growth_of_each_mechanism() {
    // σ, share, ψ and flat and frozen growth of (0.4, 0.3) and (0.15, 0.05) at 3 m/s; share and ψ from the eigenvector.
    for (growth, share, psi, flat, frozen) in [
        (6.855_996_09, 0.369_150_50, 46.170_086_0, 3.506_818_02, 4.269_566_35),
        (4.734_497_34, 0.092_851_37, 62.060_172_8, -0.021_972_96, 4.280_319_75),
        (4.338_989_74, 1.0, 48.285_020_0, 4.338_989_74, -0.021_714_01),
    ] {
        let [coupling, slope] = alone(growth, share, f64::to_radians(psi), [0.022; 2]);
        // The two-mode picture is right within 1 % of the growth here.
        near("without the slope", coupling, flat, 0.01 * growth);
        near("without the normal feedback", slope, frozen, 0.01 * growth);
    }
}

/// A clean stroke for planting faults.
fn clean() -> Vec<Sample> {
    stroke(Wanted::Coupling, 200e3, 0.0, &mut Random::new(3)).samples
}

fn fault(bytes: &[u8]) -> Fault {
    match run(bytes, &Settings::default()) {
        Err(Error::Signals { fault, .. }) => *fault,
        other => panic!("analysed: {:?}", other.map(|found| found.verdict)),
    }
}

fn text(samples: &[Sample]) -> String {
    String::from_utf8(csv(samples)).unwrap()
}

#[test]
fn broken_files_are_named_and_not_analysed() {
    let samples = clean();
    assert!(run(&csv(&samples), &Settings::default()).is_ok(), "the clean one is analysed");
    let lines: Vec<String> = text(&samples).lines().map(str::to_owned).collect();
    let with = |line: usize, new: &str| {
        let mut lines = lines.clone();
        lines[line] = new.to_owned();
        lines.join("\n").into_bytes()
    };
    for (field, shown) in [("NaN", "NaN"), ("", ""), ("inf", "inf"), ("broken", "broken")] {
        let row = format!("{},{field},0,1,1,1", lines[100].split(',').next().unwrap());
        let found = fault(&with(100, &row));
        assert!(
            matches!(&found, Fault::NotANumber { line: 101, column, text } if column == "ax2" && text == shown),
            "{found}"
        );
    }
    assert!(matches!(fault(&with(50, "0,1")), Fault::Ragged { line: 51, fields: 2, columns: 6 }));
    let mut cut = lines.clone();
    cut.drain(60..63);
    let found = fault(cut.join("\n").as_bytes());
    assert!(matches!(&found, Fault::Gap { missing: 3, line: 61, .. }), "{found}");
    let mut back = lines.clone();
    back.swap(70, 71);
    assert!(matches!(fault(back.join("\n").as_bytes()), Fault::Gap { .. } | Fault::NotRising { .. }));
    let short = lines[..20].join("\n");
    assert!(matches!(fault(short.as_bytes()), Fault::TooShort { samples: 19, .. }));
    assert!(matches!(fault(b""), Fault::NoColumn { .. }));
    assert!(matches!(fault(b"t,ax2\n"), Fault::TooShort { samples: 0, .. }));
    assert!(matches!(fault(b"\xff\xfe\x00"), Fault::NoColumn { .. } | Fault::Unreadable { .. }));
}

#[test]
fn broken_channels_are_named_and_not_analysed() {
    let planted = |change: &dyn Fn(usize, &mut Sample)| {
        let mut samples = clean();
        samples.iter_mut().enumerate().for_each(|(k, sample)| change(k, sample));
        fault(&csv(&samples))
    };
    let names = ["ax2", "ay1", "T", "N"];
    for (field, name) in FIELDS.into_iter().zip(names) {
        let found = planted(&|_, sample| *field(sample) = 3.5);
        assert!(matches!(&found, Fault::Constant { column, .. } if column == name), "{found}");
        // Clipped at 60 % of the way from the mean to the largest value.
        let top = level(field, 0.6);
        let found = planted(&|_, sample| *field(sample) = field(sample).min(top));
        assert!(matches!(&found, Fault::Clipped { column, .. } if column == name), "{found}");
    }
    let found = planted(&|_, s| std::mem::swap(&mut s.tangential_force, &mut s.normal_force));
    assert!(matches!(found, Fault::SwappedForces { .. }), "{found}");
    let found = planted(&|_, s| std::mem::swap(&mut s.tangential_acceleration, &mut s.normal_acceleration));
    assert!(matches!(found, Fault::SwappedAccelerations { .. }), "{found}");
    let found = planted(&|_, s| std::mem::swap(&mut s.tangential_acceleration, &mut s.normal_force));
    assert!(matches!(found, Fault::Offset { .. } | Fault::NotPressing { .. }), "{found}");
    let found = planted(&|_, s| s.normal_force = -s.normal_force);
    assert!(matches!(found, Fault::NotPressing { .. }), "{found}");
    let found = planted(&|_, s| s.tangential_force = -s.tangential_force);
    assert!(matches!(found, Fault::NegativeFriction { .. }), "{found}");
}

/// The value at `part` of the way from the mean of a channel to its largest value.
fn level(field: Field, part: f64) -> f64 {
    let values: Vec<f64> = clean().iter_mut().map(|sample| *field(sample)).collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let top = values.iter().copied().fold(f64::MIN, f64::max);
    mean + part * (top - mean)
}

#[test]
fn a_constant_velocity_is_remarked_and_analysed() {
    let mut samples = clean();
    for sample in &mut samples {
        sample.belt_velocity = 3.0;
    }
    let found = run(&csv(&samples), &Settings::default()).unwrap();
    assert_eq!(found.verdict.kind, Kind::ModeCoupling);
    assert!(
        found.notes.iter().any(|note| note.contains("`V`") && note.contains("constant")),
        "{:?}",
        found.notes
    );
}

#[test]
fn other_columns_separators_and_a_rate() {
    let table = text(&clean());
    let renamed = table.replacen("t,ax2,ay1,T,N,V", "n;a_t;a_n;F_t;F_n;v", 1);
    let (header, rows) = renamed.split_once('\n').unwrap();
    let bytes = format!("# a rig\n{header}\n{}", rows.replace(',', ";")).into_bytes();
    let named = |names: [&str; 5]| {
        let mut settings = Settings { rate: Some(200e3), ..Settings::default() };
        names.iter().enumerate().for_each(|(k, name)| settings.columns[k] = Some((*name).to_owned()));
        run(&bytes, &settings)
    };
    let found = named(["a_t", "a_n", "F_t", "F_n", "v"]).unwrap();
    assert_eq!(found.verdict.kind, Kind::ModeCoupling);
    near("rate", found.rate, 200e3, 0.0);
    let message = named(["a_t", "a_x", "F_t", "F_n", "v"]).unwrap_err().to_string();
    assert!(
        message.contains("`a_x`") && message.contains("`a_n`") && message.contains("--normal-acceleration"),
        "{message}"
    );
    let message = named(["a_t", "a_t", "F_t", "F_n", "v"]).unwrap_err().to_string();
    assert!(message.contains("the tangential acceleration and for the normal acceleration"), "{message}");
}

#[test]
fn without_forces_nothing_is_attributed() {
    let samples = clean();
    let table: String = std::iter::once("t,ax2,ay1\n".to_owned())
        .chain(
            samples
                .iter()
                .map(|s| format!("{},{},{}\n", s.t, s.tangential_acceleration, s.normal_acceleration)),
        )
        .collect();
    let found = run(table.as_bytes(), &Settings::default()).unwrap();
    assert_eq!(found.verdict.kind, Kind::Undecided);
    assert!(found.verdict.reasons[0].contains("forces"), "{:?}", found.verdict.reasons);
    assert!(!found.episodes.is_empty(), "growth and phase are still measured");
}

#[test]
fn noise_alone_is_no_instability_and_a_steady_tone_is_undecided() {
    let mut random = Random::new(5);
    let mut rows = |tone: f64| {
        let mut table = "t,ax2,ay1,T,N\n".to_owned();
        for k in 0..8000 {
            let t = f64::from(k) / 20e3;
            let swing = tone * (std::f64::consts::TAU * 1500.0 * t).sin();
            let mut noise = || random.normal();
            let (x, y, f, n) = (noise() + swing, noise() + 0.5 * swing, noise(), noise() + 0.3 * swing);
            writeln!(table, "{t},{x},{y},{},{}", 40.0 + f, 100.0 + n).unwrap();
        }
        run(table.as_bytes(), &Settings::default()).unwrap().verdict
    };
    assert_eq!(rows(0.0).kind, Kind::NoInstability);
    assert_eq!(rows(10.0).kind, Kind::Undecided);
}

/// A record may hold more than one squeal: the second one is no echo of the first.
#[test]
fn two_squeals_are_two_episodes() {
    let mut random = Random::new(4);
    let mut table = "ax2,ay1,T,N\n".to_owned();
    for _ in 0..2 {
        for k in 0..20_000 {
            let t = f64::from(k) / 100e3;
            // Grows from 0.02 s with 60 1/s for 0.08 s, holds, dies.
            let envelope = (60.0 * (t.min(0.1) - 0.1)).exp() * (-80.0 * (t - 0.15).max(0.0)).exp();
            let (sin, lag) = (7000.0 * std::f64::consts::TAU * t).sin_cos();
            let (x, y) = (100.0 * envelope * sin, 60.0 * envelope * (0.8 * sin - 0.6 * lag));
            let mut noise = || random.normal();
            let normal = 1000.0 + 5.0 * y;
            let row =
                [x + 0.1 * noise(), y + 0.1 * noise(), 0.4 * normal + 0.1 * noise(), normal + 0.1 * noise()];
            writeln!(table, "{},{},{},{}", row[0], row[1], row[2], row[3]).unwrap();
        }
    }
    let found = run(table.as_bytes(), &Settings { rate: Some(100e3), ..Settings::default() }).unwrap();
    let causes: Vec<Kind> = found.episodes.iter().map(|episode| episode.verdict.kind).collect();
    assert_eq!(causes, [Kind::ModeCoupling; 2]);
    for episode in &found.episodes {
        near("growth", episode.growth.value, 60.0, 2.0);
        near("phase", episode.phase.unwrap().value, -36.87, 0.5);
    }
}

/// `docs/identify.md` holds the table between two marks; this writes it anew.
#[test]
#[ignore = "rewrites docs/identify.md: cargo test --release --test suite -- --ignored identify_table"]
fn identify_table() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/identify.md");
    let document = std::fs::read_to_string(&path).unwrap();
    let (before, rest) = document.split_once("<!-- table -->\n").unwrap();
    let (_, after) = rest.split_once("<!-- end of table -->").unwrap();
    let table = markdown();
    std::fs::write(&path, format!("{before}<!-- table -->\n{table}<!-- end of table -->{after}")).unwrap();
}

/// Confusion tables, phases and the spread over seeds.
fn markdown() -> String {
    /// Other draws, to show what the fixed seed is worth.
    const OTHERS: std::ops::RangeInclusive<u64> = 2..=24;
    let judged = table(SEED);
    let mut text = String::new();
    for (heading, good) in [("20 dB and better", true), ("10 and 0 dB", false)] {
        writeln!(text, "### {heading}\n\n| truth | no instability | negative slope | mode coupling | both | undecided | strokes |").unwrap();
        writeln!(text, "|---|---|---|---|---|---|---|").unwrap();
        for wanted in Wanted::ALL {
            let of: Vec<&Judged> =
                judged.iter().filter(|s| s.wanted == wanted && (s.ratio >= GOOD) == good).collect();
            write!(text, "| {} |", wanted.words()).unwrap();
            for kind in Kind::ALL {
                let count = of.iter().filter(|s| s.kind().unwrap_or(Kind::Undecided) == kind).count();
                write!(text, " {} |", if count == 0 { String::new() } else { count.to_string() }).unwrap();
            }
            writeln!(text, " {} |", of.len()).unwrap();
        }
        text.push('\n');
    }
    writeln!(text, "### Per ratio\n\n| signal to noise | confident | of those with a verdict | confidently wrong | phase: median error | worst | strokes with a phase |").unwrap();
    writeln!(text, "|---|---|---|---|---|---|---|").unwrap();
    for ratio in RATIOS {
        let at: Vec<&Judged> = judged.iter().filter(|s| (s.ratio - ratio).abs() < 0.5).collect();
        let named: Vec<&Judged> = at.iter().copied().filter(|s| has_a_verdict(s)).collect();
        let wrong = at.iter().filter(|s| s.wrong()).count();
        let (worst, median, count) = phase_errors(&judged, ratio);
        let (all, named) = (confident(&at), confident(&named));
        writeln!(
            text,
            "| {ratio} dB | {all} % | {named} % | {wrong} | {median:.2}° | {worst:.2}° | {count} |"
        )
        .unwrap();
    }
    writeln!(text, "\n### Other seeds, 20 dB and better\n\n| seed | confident | of those with a verdict | confidently wrong | worst phase at 40, 30, 20 dB |").unwrap();
    writeln!(text, "|---|---|---|---|---|").unwrap();
    for seed in OTHERS {
        let judged = table(seed);
        let good: Vec<&Judged> = judged.iter().filter(|s| s.ratio >= GOOD).collect();
        let named: Vec<&Judged> = good.iter().copied().filter(|s| has_a_verdict(s)).collect();
        let wrong = good.iter().filter(|s| s.wrong()).count();
        let worst =
            [40.0, 30.0, 20.0].map(|ratio| format!("{:.2}°", phase_errors(&judged, ratio).0)).join(", ");
        writeln!(text, "| {seed} | {} % | {} % | {wrong} | {worst} |", confident(&good), confident(&named))
            .unwrap();
    }
    text
}
