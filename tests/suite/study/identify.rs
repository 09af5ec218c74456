//! Measured signals: identification on synthetic strokes whose type and phase are known.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::fmt::Write as _;

use crate::common::{near, paper, plan};
use crate::study::strokes::{FIELDS, Field, Random, Wanted, add_noise, csv, run, stroke};
use squealmap::model::kind::InstabilityType;
use squealmap::model::{Param, linear};
use squealmap::study::signals::sensors::{Recording, Sample, record};
use squealmap_identify::{Fault, INCLINATION, Kind, Place, Settings, Unfit, Unread, alone};

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
        Err(Unfit { fault, .. }) => *fault,
        other => panic!("analysed: {:?}", other.map(|found| found.verdict)),
    }
}

fn text(samples: &[Sample]) -> String {
    String::from_utf8(csv(samples)).unwrap()
}

/// Empty lines and comments count, whatever ends a line, and whether the last one has an end or not.
#[test]
fn a_fault_has_the_line_that_an_editor_shows() {
    for end in ["\n", "\r\n"] {
        for lines in [
            &["t,ax2", "0,1", "1e-3,x"][..],
            &["t,ax2", "0,1", "", "", "# nothing", "1e-3,x"],
            &["# first", "", "t,ax2", "", "0,1", "", "1e-3,x"],
        ] {
            for after in [String::new(), end.to_owned(), format!("{end}{end}2e-3,1{end}")] {
                let text = lines.join(end) + &after;
                let found = fault(text.as_bytes());
                let line = lines.len() as u64;
                assert!(
                    matches!(found, Fault::NotANumber { line: at, .. } if at == line),
                    "{text:?}: {found}"
                );
            }
        }
    }
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
    assert!(matches!(
        fault(&with(50, "0,1")),
        Fault::Ragged { line: 51, fields: 2, columns: 6, because: "" }
    ));
    let mut cut = lines.clone();
    cut.drain(60..63);
    let found = fault(cut.join("\n").as_bytes());
    assert!(matches!(&found, Fault::Gap { missing: 3, place: Place::Line(61), .. }), "{found}");
    let mut back = lines.clone();
    back.swap(70, 71);
    assert!(matches!(fault(back.join("\n").as_bytes()), Fault::Gap { .. } | Fault::NotRising { .. }));
    let short = lines[..20].join("\n");
    assert!(matches!(fault(short.as_bytes()), Fault::TooShort { samples: 19, .. }));
    assert!(matches!(fault(b""), Fault::Unreadable { why } if why.contains("no header")));
    assert!(matches!(fault(b"t,ax2\n"), Fault::TooShort { samples: 0, .. }));
    assert!(matches!(fault(b"\xff\xfe\x00"), Fault::Unread(Unread::Kind { .. })));
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

/// A comma before the decimals is read as one where it can be told from what separates the fields.
#[test]
fn decimal_commas_are_read_or_named() {
    let table = text(&clean());
    let points = run(table.as_bytes(), &Settings::default()).unwrap();
    let commas = run(table.replace(',', ";").replace('.', ",").as_bytes(), &Settings::default()).unwrap();
    assert_eq!(commas.verdict, points.verdict);
    assert_eq!(commas.episodes, points.episodes);
    // Both in one file, or both in one number, are not guessed at.
    let mixed = table.replace(',', ";").replacen("0.", "0,", 20_000);
    let found = fault(mixed.as_bytes());
    assert!(matches!(&found, Fault::TwoMarks { text, .. } if text.contains('.')), "{found}");
    let (header, _) = table.split_once('\n').unwrap();
    let thousands = format!("{}\n0,0;1.234,5;0;1;1;3\n", header.replace(',', ";"));
    assert!(matches!(fault(thousands.as_bytes()), Fault::NotANumber { line: 2, .. }));
    // Commas for both: fields that the header has no names for.
    let doubled = format!("{header}\n0,0,0,5,0,25,1,5,2,5,3,0\n");
    let found = fault(doubled.as_bytes()).to_string();
    assert!(found.contains("decimal commas") && found.contains("12 field(s)"), "{found}");
}

/// Where a rising law takes power out, a few per cent of coupling by the inclination decide: Table 1 of the source paper.
#[test]
fn a_rising_law_that_interacts_is_no_mode_coupling() {
    let judged = |mu_s: f64, mu_d: f64, belt_velocity: f64, inclination: f64| {
        let mut instance = paper(mu_s, mu_d, belt_velocity);
        let (kind, linear) = linear::analyse(&instance);
        let growth = linear.unwrap().growth_rate;
        instance.params.set(Param::StartVelocity, 3e-3 * belt_velocity);
        let duration = 1.2 * 300_f64.ln() / growth;
        let recording = Recording { rate: 1000.0, duration, skew: 0.0, force_skew: 0.0 };
        let samples = record(&instance, &plan(1.0, 1.0, 12), &recording).samples;
        let settings = Settings { inclination, ..Settings::default() };
        (kind.unwrap(), run(&csv(&samples), &settings).unwrap().verdict)
    };
    let interacting =
        [(0.06, 0.6, 0.5), (0.1, 0.6, 1.0), (0.05, 0.6, 1.0), (0.15, 0.6, 0.5), (0.1, 0.5, 1.0)];
    for (mu_s, mu_d, belt_velocity) in interacting {
        let (truth, verdict) = judged(mu_s, mu_d, belt_velocity, INCLINATION);
        assert_eq!(truth, InstabilityType::Interaction);
        assert_eq!(verdict.kind, Kind::Undecided, "({mu_s}, {mu_d}, {belt_velocity}): {verdict:?}");
    }
    // What would be said of a structure without inclination, and where the coupling is strong enough.
    assert_eq!(judged(0.06, 0.6, 0.5, 0.0).1.kind, Kind::ModeCoupling);
    for (mu_s, mu_d, belt_velocity) in [(0.5, 0.6, 1.0), (0.4, 0.6, 3.0)] {
        let (truth, verdict) = judged(mu_s, mu_d, belt_velocity, INCLINATION);
        assert_eq!(truth, InstabilityType::ModeCoupling);
        assert_eq!(verdict.kind, Kind::ModeCoupling, "({mu_s}, {mu_d}, {belt_velocity}): {verdict:?}");
    }
}

/// A channel that stops and goes on is remarked, one that decays below its resolution is not.
#[test]
fn a_dropout_is_remarked() {
    let notes = |samples: &[Sample]| run(&csv(samples), &Settings::default()).unwrap().notes;
    let still = |notes: &[String]| notes.iter().filter(|note| note.contains("stands still")).count();
    let mut random = Random::new(11);
    let mut noisy = clean();
    let _ = add_noise(&mut noisy, 40.0, &mut random);
    assert_eq!(still(&notes(&noisy)), 0);
    let mut frozen = noisy.clone();
    let (from, held) = (frozen.len() / 2, frozen[frozen.len() / 2].tangential_acceleration);
    frozen[from..from + 200].iter_mut().for_each(|sample| sample.tangential_acceleration = held);
    let found = notes(&frozen);
    let note = found.iter().find(|note| note.contains("stands still")).unwrap();
    for part in ["`ax2`", "200 samples", &format!("{:.6} s", frozen[from].t)] {
        assert!(note.contains(part), "{note}");
    }
    // Rounded to a resolution in which its beginning is lost.
    let mut coarse = clean();
    let unit = level(FIELDS[0], 0.02);
    for sample in &mut coarse {
        sample.tangential_acceleration = (sample.tangential_acceleration / unit).round() * unit;
    }
    assert_eq!(still(&notes(&coarse)), 0);
}

/// A band beside the squeal does not make a record free of it.
#[test]
fn a_band_without_the_oscillation_is_named() {
    let samples = clean();
    let squeal = run(&csv(&samples), &Settings::default()).unwrap().frequency.unwrap();
    let looked = |samples: &[Sample], band: [f64; 2]| {
        run(&csv(samples), &Settings { band: Some(band), ..Settings::default() }).unwrap().verdict
    };
    let inside = looked(&samples, [0.8 * squeal, 1.2 * squeal]);
    assert_eq!(inside.kind, Kind::ModeCoupling);
    // The foot of its peak is no oscillation of the band.
    for band in [[0.3 * squeal, 0.96 * squeal], [1.04 * squeal, 1.6 * squeal]] {
        let foot = looked(&samples, band);
        assert_eq!(foot.kind, Kind::Undecided, "{foot:?}");
    }
    // Noise in which nothing is seen at other frequencies.
    let mut random = Random::new(11);
    let mut noisy = samples.clone();
    let _ = add_noise(&mut noisy, 40.0, &mut random);
    let beside = looked(&noisy, [0.3 * squeal, 0.4 * squeal]);
    assert_eq!(beside.kind, Kind::Undecided, "{beside:?}");
    let reason = &beside.reasons[0];
    assert!(reason.contains("--band") && reason.contains(&format!("{squeal:.0}")[..3]), "{reason}");
    for sample in &mut noisy {
        for field in FIELDS {
            *field(sample) = random.normal();
        }
        sample.normal_force += 1000.0;
        sample.tangential_force += 400.0;
    }
    let quiet = looked(&noisy, [0.3 * squeal, 0.4 * squeal]);
    assert_eq!(quiet.kind, Kind::NoInstability, "{quiet:?}");
    assert!(quiet.reasons[0].contains(&format!("{} and {} Hz", 0.3 * squeal, 0.4 * squeal)), "{quiet:?}");
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
