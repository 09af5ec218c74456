//! How well `identify` does on 200 synthetic strokes, at every ratio of signal to noise and for other seeds: the tables of
//! `docs/identify.md`, which `cargo bench --bench identify` writes anew between the marks of that page.

#[expect(dead_code, reason = "the tests use the rest")]
#[path = "../tests/suite/common.rs"]
mod common;
#[expect(dead_code, reason = "the tests use the rest")]
#[path = "../tests/suite/study"]
mod study {
    pub(crate) mod bound;
    pub(crate) mod judged;
    pub(crate) mod strokes;
}

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

use squealmap_identify::{Kind, Measured};
use study::judged::{GOOD, Judged, RATIOS, SEED, confident, phase_errors, table, within};
use study::strokes::Wanted;

/// The page, and the marks around its tables.
const PAGE: &str = "docs/identify.md";
const MARKS: [&str; 2] = ["<!-- table -->\n", "<!-- end of table -->"];

/// All kinds of strokes, in the order of the tables.
const ALL: [Wanted; 6] =
    [Wanted::Stable, Wanted::Slope, Wanted::Coupling, Wanted::Both, Wanted::BothOneWeak, Wanted::Interaction];

fn main() -> Result<(), Box<dyn Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(PAGE);
    let document = std::fs::read_to_string(&path)?;
    let [begin, end] = MARKS;
    let parts = document.split_once(begin).and_then(|(before, rest)| Some((before, rest.split_once(end)?.1)));
    let (before, after) = parts.ok_or("docs/identify.md has no marks around its tables")?;
    let table = markdown()?;
    std::fs::write(&path, format!("{before}{begin}{table}{end}{after}"))?;
    println!("{PAGE} has the tables of this run");
    Ok(())
}

/// The name of a kind in the tables.
fn words(wanted: Wanted) -> &'static str {
    match wanted {
        Wanted::Stable => "stable",
        Wanted::Slope => "negative slope",
        Wanted::Coupling => "mode coupling",
        Wanted::Both => "both",
        Wanted::BothOneWeak => "both, one of them weak",
        Wanted::Interaction => "only both together",
    }
}

/// The strokes whose cause could be told if they were free of noise.
fn only_decidable<'a>(strokes: &[&'a Judged]) -> Vec<&'a Judged> {
    strokes.iter().copied().filter(|stroke| stroke.decidable).collect()
}

/// Every undecided stroke at 20 dB and better, and why.
fn undecided(judged: &[Judged]) -> Result<String, std::fmt::Error> {
    let mut text = "\n### The undecided ones, 20 dB and better\n\n| truth | signal to noise | rate | growth, 1/s | share of the normal force | leaning | confidence | decidable without noise |\n|---|---|---|---|---|---|---|---|\n".to_owned();
    for stroke in judged.iter().filter(|stroke| stroke.ratio >= GOOD && !stroke.is_confident()) {
        let Judged { wanted, ratio, rate, .. } = stroke;
        let found = stroke.found.as_ref();
        let episode = found.and_then(|found| found.episodes.last());
        let number = |measured: Option<Measured>, digits: usize| {
            measured.map_or("–".to_owned(), |m| m.text(1.0, digits))
        };
        let verdict = found.map(|found| &found.verdict);
        writeln!(
            text,
            "| {} | {ratio} dB | {} kHz | {} | {} | {} | {:.2} | {} |",
            words(*wanted),
            rate / 1e3,
            number(episode.map(|episode| episode.growth), 0),
            number(episode.and_then(|episode| episode.share), 3),
            verdict.and_then(|verdict| verdict.leaning).map_or("–", Kind::words),
            verdict.map_or(0.0, |verdict| verdict.confidence),
            if stroke.decidable { "yes" } else { "no" },
        )?;
    }
    Ok(text)
}

/// Confusion tables, phases and the spread over seeds.
fn markdown() -> Result<String, std::fmt::Error> {
    /// Other draws, to show what the fixed seed is worth.
    const OTHERS: std::ops::RangeInclusive<u64> = 2..=36;
    let judged = table(SEED);
    let mut text = String::new();
    for (heading, good) in [("20 dB and better", true), ("10 and 0 dB", false)] {
        writeln!(
            text,
            "### {heading}\n\n| truth | no instability | negative slope | mode coupling | both | undecided | strokes |"
        )?;
        writeln!(text, "|---|---|---|---|---|---|---|")?;
        for wanted in ALL {
            let of: Vec<&Judged> =
                judged.iter().filter(|s| s.wanted == wanted && (s.ratio >= GOOD) == good).collect();
            write!(text, "| {} |", words(wanted))?;
            for kind in Kind::ALL {
                let count = of.iter().filter(|s| s.kind().unwrap_or(Kind::Undecided) == kind).count();
                write!(text, " {} |", if count == 0 { String::new() } else { count.to_string() })?;
            }
            writeln!(text, " {} |", of.len())?;
        }
        text.push('\n');
    }
    writeln!(
        text,
        "### Per ratio\n\n| signal to noise | confident | of the decidable | confidently wrong | phase: median error | worst | least possible, median | within two standard errors | strokes with a phase |"
    )?;
    writeln!(text, "|---|---|---|---|---|---|---|---|---|")?;
    for ratio in RATIOS {
        let at: Vec<&Judged> = judged.iter().filter(|s| (s.ratio - ratio).abs() < 0.5).collect();
        let wrong = at.iter().filter(|s| s.wrong()).count();
        let (worst, median, count) = phase_errors(&judged, ratio);
        let (all, named) = (confident(&at), confident(&only_decidable(&at)));
        let mut bounds: Vec<f64> =
            at.iter().filter(|s| s.phase().is_some()).map(|s| 0.6745 * s.bound).collect();
        bounds.sort_by(f64::total_cmp);
        let least = bounds.get(bounds.len() / 2).copied().unwrap_or(f64::NAN);
        let two = 100.0 * within(at.iter().copied(), 2.0).0;
        writeln!(
            text,
            "| {ratio} dB | {all} % | {named} % | {wrong} | {median:.2}° | {worst:.2}° | {least:.2}° | {two:.0} % | {count} |"
        )?;
    }
    text.push_str(&undecided(&judged)?);
    writeln!(
        text,
        "\n### Other seeds, 20 dB and better\n\n| seed | confident | of the decidable | confidently wrong | decidable | within two standard errors | worst phase at 40, 30, 20 dB |"
    )?;
    writeln!(text, "|---|---|---|---|---|---|---|")?;
    for seed in OTHERS {
        let judged = table(seed);
        let good: Vec<&Judged> = judged.iter().filter(|s| s.ratio >= GOOD).collect();
        let named = only_decidable(&good);
        let share = 100 * named.len() / good.len();
        let two = 100.0 * within(good.iter().copied(), 2.0).0;
        let wrong = good.iter().filter(|s| s.wrong()).count();
        let worst =
            [40.0, 30.0, 20.0].map(|ratio| format!("{:.2}°", phase_errors(&judged, ratio).0)).join(", ");
        let (all, of_decidable) = (confident(&good), confident(&named));
        writeln!(
            text,
            "| {seed} | {all} % | {of_decidable} % | {wrong} | {share} % | {two:.0} % | {worst} |"
        )?;
    }
    Ok(text)
}
