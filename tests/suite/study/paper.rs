//! The paper's figures: what is computed for them, drawn and written.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::Path;

use crate::common::{close, near};
use crate::results::figure::draw as render;
use resvg::tiny_skia::{Pixmap, PremultipliedColorU8};
use squealmap::model::kind::InstabilityType;
use squealmap::study::paper::figures::{Drawn, draw, report};
use squealmap::study::paper::{
    Case, Evidence, Figure, LIMITS, PhaseCase, PhaseTrial, Settings, Source, Study, Trial, Verdict, Window,
    Witness, claims,
};
use squealmap_figure::png;

/// A figure, looked through by the picture library.
fn figure(figure: Figure) -> Drawn {
    let drawn = draw(figure, &Study::new(Settings::default())).unwrap();
    render(&drawn.svg, figure.name());
    drawn
}

/// The rows of a table as numbers, and its header.
fn table(csv: &[u8]) -> (Vec<String>, Vec<Vec<f64>>) {
    let mut reader = csv::Reader::from_reader(csv);
    let header = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let rows = reader.records().map(|row| row.unwrap().iter().map(|x| x.parse().unwrap()).collect());
    (header, rows.collect())
}

#[test]
fn figure_2_shows_the_critical_friction() {
    // physics.md, section 6: with the damping of Table 1.
    assert!(figure(Figure::Figure2).svg.contains(" = 0.2264"));
}

#[test]
fn figure_3_shows_the_laws_of_table_1() {
    let (header, rows) = table(&figure(Figure::Figure3).csv);
    assert_eq!(header, ["relative_velocity", "mu_figure4", "mu_figure5", "mu_figure6"]);
    assert_eq!((rows[0][0], rows[rows.len() - 1][0]), (0.0, 7.0));
    for row in rows {
        let below = (row[0] / 5.0).min(1.0);
        near("falling", row[1], 0.15 - 0.1 * below, 1e-15);
        near("constant", row[2], 0.4, 0.0);
        near("both", row[3], 0.4 - 0.1 * below, 1e-15);
    }
}

#[test]
fn ramps_are_reduced_without_losing_their_extremes() {
    let study = Study::new(Settings::default());
    for (figure, case) in [Figure::Figure4, Figure::Figure5, Figure::Figure6].into_iter().zip(Case::ALL) {
        let drawn = draw(figure, &study).unwrap();
        render(&drawn.svg, figure.name());
        assert!(drawn.svg.len() < 60_000 && drawn.csv.len() < 60_000, "{figure:?} grows with the ramp");
        let (header, rows) = table(&drawn.csv);
        let names = ["t", "belt_velocity", "ax2_low", "ax2_high", "ay1_low", "ay1_high", "stick", "free"];
        assert_eq!(header, names);
        // The peaks of the outcome come from the series of the steps, not from samples.
        let ramp = study.ramp(case).unwrap();
        for (column, peak) in [(2, ramp.outcome.ax_peak), (4, ramp.outcome.ay_peak)] {
            let drawn = rows.iter().map(|row| row[column + 1].max(-row[column])).fold(0.0, f64::max);
            close("largest acceleration", drawn, peak.unwrap(), 2e-3);
        }
        let share = |column: usize| rows.iter().map(|row| row[column]).sum::<f64>() / rows.len() as f64;
        close("stick", share(6), ramp.outcome.stick.unwrap(), 5e-3);
        near("free flight", share(7), ramp.outcome.free.unwrap(), 5e-4);
        assert!((rows[0][1] - 7.0).abs() < 0.02 && rows[rows.len() - 1][1] < 0.02, "from 7 m/s to rest");
    }
}

#[test]
fn short_ramps_show_the_waveform() {
    let settings = Settings { ramp_duration: Some(0.5), kick: Some(1e-3) };
    let study = Study::new(settings);
    let ramp = study.ramp(Case::ModeCoupling).unwrap();
    assert_eq!((ramp.duration, ramp.kick), (0.5, 1e-3));
    // 17 periods: columns are so narrow that the motion is seen inside them.
    let wide = ramp.columns.iter().filter(|column| column.tangential[1] - column.tangential[0] > 100.0);
    assert!(wide.count() * 10 < ramp.columns.len());
    render(&draw(Figure::Figure5, &study).unwrap().svg, "figure5_short");
}

#[test]
fn figure_7_shows_the_phases_of_the_ramp() {
    // A script of its own (RK4 with steps of 10 µs, eigenvalues by LAPACK): the lowest and highest phase, measured and of
    // the eigenvectors, and the belt velocity in the first and last window.
    let expected = [
        ([-16.256, -11.088], [-13.005, -12.750], [4.228, 3.385]),
        ([-56.573, -56.395], [-56.418, -56.418], [6.740, 6.493]),
    ];
    let study = Study::new(Settings::default());
    for (case, (measured, eigenvector, velocity)) in PhaseCase::ALL.into_iter().zip(expected) {
        let windows = &study.growth(case).unwrap().windows;
        let range = |phase: fn(&Window) -> f64| {
            let phases = windows.iter().map(phase);
            phases.fold([f64::MAX, f64::MIN], |[low, high], x| [low.min(x), high.max(x)])
        };
        for (k, (found, modes)) in
            range(|one| one.measured).into_iter().zip(range(|one| one.eigenvector.unwrap())).enumerate()
        {
            near("measured phase", found, measured[k], 0.05);
            near("phase of the eigenvector", modes, eigenvector[k], 0.005);
        }
        near("first window", windows[0].velocity, velocity[0], 0.005);
        near("last window", windows[windows.len() - 1].velocity, velocity[1], 0.005);
        // Ten times the acceleration of the kick, 4.348 m/s², and never below it again.
        assert!(windows.iter().all(|one| one.amplitude >= 43.47), "{case:?}");
        // What is shown is what is measured.
        let samples = &study.growth(case).unwrap().samples;
        assert!(samples[0][0] >= windows[0].time[0] && samples[0][0] < windows[0].time[0] + 1e-3);
    }
    let drawn = figure(Figure::Figure7);
    assert!(drawn.svg.contains("−16.3 to −11.1°, modes: −13.0 to −12.8°"), "the phases of (a)");
    assert!(drawn.svg.contains("−56.6 to −56.4°, modes: −56.4°"), "the phases of (b)");
}

#[test]
fn a_ramp_on_which_nothing_grows_shows_no_phase() {
    let study = Study::new(Settings { ramp_duration: Some(1.0), kick: Some(3e-6) });
    assert!(study.growth(PhaseCase::NegativeSlope).unwrap().windows.is_empty());
    let drawn = draw(Figure::Figure7, &study).unwrap();
    render(&drawn.svg, "figure7_still");
    assert!(drawn.svg.contains("Not grown: below 10 times what disturbs it"));
}

#[test]
fn figure_5_falls_on_a_line_and_keeps_its_normal_acceleration() {
    // The script again, 28 parts: sizes at the largest, at the end, and in the middle.
    let study = Study::new(Settings::default());
    let parts = &study.ramp(Case::ModeCoupling).unwrap().parts;
    for (part, [ax, ay]) in
        [(5, [1591.0, 577.0]), (6, [1576.0, 588.4]), (15, [1032.0, 521.0]), (27, [271.0, 487.0])]
    {
        close("ẍ2", parts[part].peaks()[0], ax, 5e-3);
        close("ÿ1", parts[part].peaks()[1], ay, 5e-3);
    }
}

#[test]
fn accelerations_on_another_ramp_are_those_of_the_equations() {
    // physics.md, section 6, last paragraph: a ramp of 2 s with a kick of 0.1 mm.
    let study = Study::new(Settings::default());
    let wanted = [2.0, 1e-4].map(f64::to_bits);
    let is_wanted = |trial: &&Trial| [trial.duration, trial.kick].map(f64::to_bits) == wanted;
    let trial = study.trials().iter().find(is_wanted).unwrap();
    for (peaks, expected) in trial.peaks.iter().zip([388.0, 658.0, 762.0]) {
        close("largest |ẍ2|", peaks.unwrap()[0], expected, 5e-3);
    }
    let (_, rows) = table(&draw(Figure::Accelerations, &study).unwrap().csv);
    assert_eq!(rows.len(), 8 * 7, "durations times kicks");
    assert!(rows.iter().all(|row| row.len() == 8));
    figure(Figure::Accelerations);
}

#[test]
fn thresholds_on_the_phase_are_counted_as_by_hand() {
    let witness = |kind, phase: f64| Witness {
        velocity: 1.0,
        friction: [0.4, 0.3],
        kind: Some(kind),
        phases: [Some(phase), None, Some(phase)],
    };
    let slope = [10.0, 30.0, 50.0, 60.0].map(|phase| witness(InstabilityType::NegativeSlope, phase));
    let coupling = [40.0, 70.0].map(|phase| witness(InstabilityType::ModeCoupling, phase));
    // Neither of these counts.
    let others = [InstabilityType::Coexistence, InstabilityType::Stable].map(|kind| witness(kind, 1.0));
    let trial = PhaseTrial { witnesses: slope.into_iter().chain(coupling).chain(others).collect() };
    let score = trial.score(Source::Eigenvector, 45.0).unwrap();
    assert_eq!((score.slope, score.coupling, score.balanced()), (0.5, 0.5, 0.5));
    // A phase on the threshold is called mode coupling.
    near("slope", trial.score(Source::Cycle, 50.0).unwrap().slope, 0.5, 0.0);
    // From 60.5° on: all slopes, half of mode coupling; from 30.5° to 40°: half of the slopes, all of mode coupling.
    let best = trial.best(Source::Eigenvector).unwrap();
    near("balanced", best.balanced(), 0.75, 0.0);
    assert!(trial.score(Source::Growth, 45.0).is_none() && trial.best(Source::Growth).is_none());
    let (spread, count) = trial.spread(Source::Cycle, InstabilityType::NegativeSlope).unwrap();
    assert_eq!((spread, count), ([10.0, 50.0, 60.0], 4));
    assert!(trial.spread(Source::Cycle, InstabilityType::Interaction).is_none());
}

#[test]
fn the_limit_cycle_tells_the_mechanism_where_its_growth_does_not() {
    let study = Study::new(Settings::default());
    let trial = study.phase_trial().unwrap();
    assert_eq!(trial.witnesses.len(), 41 * 41 * 3);
    // Time integration against eigenvectors, which it knows nothing of.
    let mut differences: Vec<f64> =
        trial.witnesses.iter().filter_map(|one| Some((one.phases[1]? - one.phases[0]?).abs())).collect();
    differences.sort_by(f64::total_cmp);
    assert!(differences.len() > 4500 && differences[differences.len() * 95 / 100] < 0.5);
    let right = |source| trial.best(source).unwrap().balanced();
    let [mode, growth, cycle] = Source::ALL.map(right);
    assert!(cycle > 0.98 && mode < 0.8 && (mode - growth).abs() < 0.02, "{mode} {growth} {cycle}");
    let drawn = figure(Figure::Phase);
    assert_eq!(String::from_utf8(drawn.csv).unwrap().lines().count(), 1 + 41 * 41 * 3);
}

#[test]
fn a_ramp_of_a_user_is_judged_as_those_of_the_map() {
    // Vibrations of 10 and 8 m/s² are alike, but nothing has grown; with the other settings only some have.
    for (duration, kick) in [(1.0, 3e-6), (2.0, 1e-5)] {
        let study = Study::new(Settings { ramp_duration: Some(duration), kick: Some(kick) });
        let evidence = Evidence::gather(&study).unwrap();
        let is_this = |trial: &&Trial| {
            [trial.duration, trial.kick].map(f64::to_bits) == [duration, kick].map(f64::to_bits)
        };
        let trial = evidence.trials.iter().find(is_this).unwrap();
        let all_grown = evidence.ramps.iter().all(squealmap::study::paper::RampFacts::grown);
        assert_eq!(all_grown, LIMITS.grown(trial), "{duration} {kick}");
        for (ramp, peaks) in evidence.ramps.iter().zip(trial.peaks) {
            close("the same ramp", ramp.peaks()[0], peaks.unwrap()[0], 2e-3);
        }
        for claim in claims(&evidence) {
            let compares = claim.figure == "6" || claim.figure == "4a, 5a";
            assert!(
                !compares || all_grown || claim.verdict != Verdict::Reproduced,
                "{}: {}",
                claim.says,
                claim.found
            );
            assert_eq!(
                claim.found.contains("not grown on this ramp"),
                compares && !all_grown,
                "{}",
                claim.found
            );
        }
        let text = report(&evidence, "paper", "squealmap paper");
        assert!(!text.contains("-0.0") && !text.contains("−0.0"), "a zero with a sign");
    }
}

/// The words of a picture alone.
fn words(svg: &str) -> String {
    let kept = |line: &&str| ["<?xml", "<svg", "<text", "</svg"].iter().any(|begin| line.starts_with(begin));
    svg.lines().filter(kept).collect::<Vec<_>>().join("\n")
}

/// What differs between a picture as it is shipped and as it is drawn now; nothing where they are the same.
fn stale(shipped: &Pixmap, svg: &str) -> Option<String> {
    let drawn = Pixmap::decode_png(&png::render(svg).unwrap()).unwrap();
    if [shipped.width(), shipped.height()] != [drawn.width(), drawn.height()] {
        return Some("its size".to_owned());
    }
    let level = |pixel: &PremultipliedColorU8| [pixel.red(), pixel.green(), pixel.blue()];
    let differs = |(a, b): &(&PremultipliedColorU8, &PremultipliedColorU8)| {
        level(a).into_iter().zip(level(b)).any(|(a, b)| a.abs_diff(b) > 64)
    };
    let pairs = || shipped.pixels().iter().zip(drawn.pixels());
    let share = pairs().filter(differs).count() as f64 / shipped.pixels().len() as f64;
    // Chaotic motions are those of one processor; a curve in another place is more.
    if share > 0.01 {
        return Some(format!("{:.1} % of its pixels", 100.0 * share));
    }
    let words = Pixmap::decode_png(&png::render(&words(svg)).unwrap()).unwrap();
    let pairs = shipped.pixels().iter().zip(words.pixels());
    let missing = pairs.filter(|(shipped, word)| word.green() < 25 && shipped.green() > 128).count();
    (missing > 0).then(|| format!("{missing} pixels of its words"))
}

#[test]
fn the_shipped_pictures_are_those_the_command_draws() {
    let study = Study::new(Settings::default());
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/paper");
    for figure in Figure::ALL {
        let path = directory.join(figure.name()).with_extension("png");
        let shipped = Pixmap::decode_png(&std::fs::read(&path).unwrap()).unwrap();
        let svg = draw(figure, &study).unwrap().svg;
        assert_eq!(stale(&shipped, &svg), None, "{}: run `squealmap paper -o docs`", path.display());
        // Another word is seen, and another curve.
        let why = match figure {
            Figure::Figure2 => stale(&shipped, &svg.replace("Hz", "1/s")),
            Figure::Figure6 => stale(&shipped, &draw(Figure::Figure4, &study).unwrap().svg),
            _ => continue,
        };
        assert!(why.unwrap().contains(if figure == Figure::Figure2 { "words" } else { "%" }));
    }
}

/// The figure, claim and verdict of every line of a report's table, and its headings and pictures.
fn skeleton(report: &str) -> Vec<String> {
    let cell = |line: &str, k: usize| line.split('|').nth(k).unwrap().trim().to_owned();
    let of = |line: &str| match line {
        line if line.ends_with("** |") => Some([1, 2, 4].map(|k| cell(line, k)).join(" | ")),
        line if line.starts_with('#') || line.starts_with("![") => Some(line.to_owned()),
        _ => None,
    };
    report.lines().filter_map(of).collect()
}

#[test]
fn the_shipped_report_is_what_the_command_makes() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let shipped = std::fs::read_to_string(root.join("docs/paper.md")).unwrap();
    let mut evidence = Evidence::gather(&Study::new(Settings::default())).unwrap();
    let made = report(&evidence, "paper", "squealmap paper -o docs");
    // Numbers of chaotic motions are those of one processor; verdicts and pictures are not.
    assert_eq!(skeleton(&shipped), skeleton(&made));
    assert!(made.contains("```sh\nsquealmap paper -o docs\n```") && made.contains("10 s"));
    evidence.critical_friction = None;
    let other = report(&evidence, "paper", "squealmap paper -o docs");
    assert_ne!(skeleton(&shipped), skeleton(&other), "another verdict is seen");
    let mut bytes = 0;
    for figure in Figure::ALL {
        let picture = root.join("docs/paper").join(figure.name()).with_extension("png");
        bytes += std::fs::metadata(picture).unwrap().len();
    }
    assert!(bytes < 1_500_000, "{bytes} bytes of pictures");
}
