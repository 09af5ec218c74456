//! What `squealmap tradeoff` writes: the table, its summary as JSON and the figure.

use std::fmt::Write as _;

use serde_json::{Value as Json, json};

use crate::accuracy::frontier::{MARGIN, is_comparison};
use crate::accuracy::level::{Level, NAMES};
use crate::accuracy::measure::{CHECK_STEPS, Measurement, TRUTH_STEPS};
use crate::accuracy::row::{Row, pace};
use crate::accuracy::sample::Stratum;
use crate::classify::{InstabilityType, Regime};
use crate::error::{Error, Result};
use crate::export::manifest::{COMMIT, VERSION};

pub use super::tradeoff_figure::figure;

/// The summary: UTF-8 JSON, indented.
///
/// # Errors
/// When it cannot be written as JSON.
pub fn to_json(title: &str, measured: &Measurement) -> Result<Vec<u8>> {
    let truth = &measured.truth;
    let quantiles = |[p50, p95, p99]: [f64; 3]| json!({ "p50": p50, "p95": p95, "p99": p99 });
    let [p50, p95, largest] = truth.convergence;
    let document = json!({
        "title": title,
        "program": { "name": env!("CARGO_PKG_NAME"), "version": VERSION, "git_commit": COMMIT },
        "scene": measured.scene,
        "settings": {
            "sample": measured.settings.sample,
            "seed": measured.settings.seed,
            "threads": measured.settings.threads,
            "software": measured.settings.software,
        },
        "truth": {
            "method": format!("reference, {TRUTH_STEPS} steps per period"),
            "against": format!("reference, {CHECK_STEPS} steps per period"),
            "checked": truth.checked,
            "difference": { "p50": p50, "p95": p95, "largest": largest },
            "scatter": quantiles(truth.scatter),
            "oscillating": truth.oscillating,
            "settled": truth.settled,
            "judged": truth.judged,
            "failed": truth.failed,
        },
        "sample": {
            "instances": measured.sample.indices.len(),
            "candidates": measured.sample.candidates,
            "strata": measured.sample.strata.iter().map(stratum).collect::<Vec<_>>(),
        },
        "levels": levels(&measured.rows),
        "configurations": measured.rows.iter().map(finite).collect::<Vec<_>>(),
        "left_out": measured.left_out,
    });
    let mut bytes = serde_json::to_vec_pretty(&document).map_err(Error::WriteManifest)?;
    bytes.push(b'\n');
    Ok(bytes)
}

fn stratum(stratum: &Stratum) -> Json {
    json!({
        "status": stratum.label.status().name(),
        "type": stratum.label.kind().map(InstabilityType::name),
        "regime": stratum.label.regime().map(Regime::name),
        "settled": stratum.label.settled(),
        "near_a_border": stratum.near,
        "candidates": stratum.candidates,
        "taken": stratum.taken,
    })
}

/// A row; what is infinite is null.
fn finite(row: &Row) -> Json {
    serde_json::to_value(row).unwrap_or_default()
}

/// The fastest row that keeps each of the named accuracies.
fn levels(rows: &[Row]) -> Json {
    let of = |level: Level| match level {
        Level::Reference => Json::Null,
        Level::Within(bound) => {
            let best = fastest(rows, bound);
            best.map_or(Json::Null, |row| json!({
                "backend": row.backend, "precision": row.precision, "steps_per_period": row.steps_per_period,
                "per_second": row.per_second, "worst_p95": row.worst_p95,
            }))
        }
    };
    NAMES
        .into_iter()
        .map(|(name, level)| (name.to_owned(), of(level)))
        .collect::<serde_json::Map<_, _>>()
        .into()
}

/// The fastest row that is chosen for a bound: its 95th percentile is within it with a margin.
#[must_use]
pub fn fastest(rows: &[Row], bound: f64) -> Option<&Row> {
    let pace = pace(rows.iter());
    let enough = rows.iter().filter(|row| MARGIN * row.worst_p95 <= bound && !is_comparison(row));
    enough.max_by(|a, b| pace(a).total_cmp(&pace(b)))
}

/// Whether a GPU is among them, so that speed is that of wall time.
#[must_use]
pub fn on_gpu(rows: &[Row]) -> bool {
    rows.iter().any(|row| row.per_cpu_second.is_none())
}

/// A sweep of a report.
#[derive(Clone, Debug)]
pub struct Section<'a> {
    /// Its title.
    pub title: &'a str,
    /// The path of its figure, relative to the report.
    pub figure: String,
    /// What was measured.
    pub measured: &'a Measurement,
}

/// The begin of a report.
const INTRODUCTION: &str = "# Speed against error

Made by one command, on the machine whose numbers it shows:

    squealmap tradeoff sweeps/accuracy/*.toml -o out/accuracy --report docs/accuracy.md --store src/accuracy/default.csv

Every engine of the machine computes a sample of each sweep: of every status, type and regime that a cheap run finds some
instances, more near the borders between them, each weighed by the number of instances it stands for. The truth is
the reference at 24 steps per period. Errors are relative; `worst` is the worst of `x2_std`, `ax_rms`, `ay_rms` and
`response_frequency` of an instance, p95 what 95 % of the settled oscillations are within. Chaotic motions and those that
have not settled differ between any two methods: they are counted and compared by their labels only. The scatter of
the truth is the difference of the two halves of its own window.

`run --accuracy` takes the fastest row whose p95 is within half of what is asked for: another sweep has other instances.
Before it computes the sweep it tries that row on 192 or more of the sweep's own instances, against the CPU engine in f64
with fine steps; as long as more than 2.5 % of the settled oscillations among them break what is asked for (and the truth's
own scatter), it goes on to the next more accurate row. Far from the sweeps below the table alone is not enough: with
m2 = 2 g at an angle of 0.3 its first choice keeps 1e-3 in 91 % of the oscillations, what the trial takes in 97 %.
The same command without `--store` measures any sweep on any machine and keeps the rows in the user's cache directory
(`accuracy.csv`); they then come before the table that is shipped, which is the one below. A software GPU is left out, since
the CPU engine is faster at every accuracy: [accuracy_software.md](accuracy_software.md) has its numbers.

Whether that is kept on sweeps that were not measured here (a rational law with rebounding impacts, a belt ramp, an
exponential law run until it is settled) is a test: `cargo test --release --test suite promise -- --nocapture` computes all
of their instances, and those of two sweeps far from the table's, by `--accuracy 1e-3` and by the reference. At least 95 % of the settled oscillations must be within
1e-3 and the truth's own scatter, and at least 80 % of the oscillations settled. With `--include-ignored` it also compares the error
that a map of 14 400 instances states of itself with the error of every instance: within a factor of 2.

## What a map says of itself

Every run with a response computes a few instances again, chosen by their index alone, so that threads, tiles, shards and a
run that goes on give the same bytes. 3 % of the time go to the CPU engine in f64 with at least 16 steps per period (some
1 % of the instances of a run in f32), 1 % to the reference (some 3 in 10 000). Their numbers follow from the speeds below, not
from a clock. With that budget the reference alone could say little of a map below a million instances, so the first draw
gives the quantiles and the second the independent witness. Of the instances near a border between labels only those
that were drawn take the finer result; to have all of them in f64 takes a run in f64.

Measured: 129 600 instances of the first sweep below (140 periods) at `standard` take 5.32 s of a processor instead of 5.15 s
with `--no-check`, the mean of three runs each, on a machine with other work: 3 %.

## What it is compared with

Two more methods are measured and drawn, to compare with; `--accuracy` never takes them. `located RK4` takes Runge–Kutta
steps of order 4, half as long in flight, in the reference's place: its dense output of degree 5 goes the way of the Taylor
series through the same location of events, transitions and observables. `fixed step` takes the same steps at one length and
changes the contact state only where they end, as codes with a fixed step do; the source paper's has 294 in a period.
They are slow: only every eighth instance of the sample is judged, and their speed is taken from few.

Measured on a whole sample of the bilinear law's sweep, p95 and instances per second of a processor: `located RK4` 1.6e-3 and 168 with 20 steps,
7.9e-5 and 88 with 40, 2.8e-7 and 21 with 160; `fixed step` 2.9e-2 and 53 with 80 steps, 7.4e-3 and 14 with 294. At 12 steps
the reference has 3.6e-9 and 179, the CPU engine in f32 with 6 has 3.3e-5 and 10 280. So for 1e-4 the engine is 120 times as
fast as RK4 one instance at a time, and the reference, at the speed that RK4 has for 1.6e-3, is five orders better: a step of
RK4 costs two thirds of one of the reference, since events and observables of a step cost the same. Without location more
steps are of little use: what twice as many make 15 times smaller with it they halve without. Under the exponential law (160
instances of the sweep) it is the same: 6.3e-5 with 40 steps of RK4, 7.1e-3 with a fixed step and 294.

What f32 loses is to a third the bound on truncation and not at all the state that is carried on. On the shipped map,
settled oscillations, p50 / p95 / p99 of the worst: 8.7e-7 / 2.4e-6 / 3.5e-6. In f64 with the bound of f32 it is 1.6e-7 /
8.6e-7 / 1.9e-6, with the constants of the instances rounded to f32 as well 5.4e-7 / 1.3e-6 / 2.2e-6. Positions and
velocities in f32 with their lost parts carried along (compensated sums) leave it at 8.7e-7 / 2.3e-6 / 3.5e-6, at the same
speed: the engine does without.

## What is chosen

Instances per second of a processor (with a GPU among them: of wall time), and the error that 95 % are within.

";

/// The begin of a report with a software GPU.
const WITH_SOFTWARE: &str = "# Speed against error with a software GPU

Made by

    squealmap tradeoff sweeps/accuracy/pieces.toml --software --no-store --report docs/accuracy_software.md

as [accuracy.md](accuracy.md) says; all rows of the GPU are shown, efficient or not.

Instances per second of wall time, and the error that 95 % are within.

";

/// The report on some sweeps: Markdown.
#[must_use]
pub fn to_markdown(sections: &[Section]) -> String {
    let software = sections.iter().any(|section| section.measured.settings.software);
    let mut text = if software { WITH_SOFTWARE } else { INTRODUCTION }.to_owned();
    text += "| scene | ";
    let bounds = NAMES.into_iter().filter_map(|(name, level)| match level {
        Level::Within(bound) => Some((name, bound)),
        Level::Reference => None,
    });
    let bounds: Vec<(&str, f64)> = bounds.collect();
    for (name, bound) in &bounds {
        let _ = write!(text, "`{name}` ({bound:e}) | ");
    }
    let _ = writeln!(text, "`reference` |\n|---{}|---|", "|---".repeat(bounds.len()));
    for section in sections {
        let pace = pace(section.measured.rows.iter());
        let _ = write!(text, "| {} | ", section.measured.scene);
        for (_, bound) in &bounds {
            let found = fastest(&section.measured.rows, *bound).map_or("–".to_owned(), |row| {
                format!(
                    "{} {}, {} steps: {:.0} /s, p95 {:.1e}",
                    row.backend,
                    row.precision,
                    row.steps_per_period,
                    pace(row),
                    row.worst_p95
                )
            });
            let _ = write!(text, "{found} | ");
        }
        let reference = section.measured.rows.iter().find(|row| row.backend == "reference");
        let _ =
            writeln!(text, "{} |", reference.map_or("–".to_owned(), |row| format!("{:.0} /s", pace(row))));
    }
    for section in sections {
        section_of(&mut text, section);
    }
    text
}

fn section_of(text: &mut String, section: &Section) {
    let (measured, truth) = (section.measured, &section.measured.truth);
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let _ = write!(
        text,
        "\n## {}\n\n![Instances per second against error]({})\n\n\
         {} instances judged, {} threads. {} of the sweep oscillate, {} settled; those of the sample are {}. {} did not \
         come to their end. The truth differs from that at {CHECK_STEPS} steps per period by {:.1e} / {:.1e} / {:.1e} \
         (p50 / p95 / largest of {}); its scatter is {:.1e} / {:.1e} / {:.1e} (p50 / p95 / p99). The efficient frontier, \
         the reference, and the methods to compare with:\n\n",
        section.title,
        section.figure,
        measured.sample.indices.len(),
        measured.settings.threads,
        percent(truth.oscillating),
        percent(truth.settled),
        truth.judged,
        percent(truth.failed),
        truth.convergence[0],
        truth.convergence[1],
        truth.convergence[2],
        truth.checked,
        truth.scatter[0],
        truth.scatter[1],
        truth.scatter[2],
    );
    *text += "| engine | steps per period | instances/s | per CPU-second | worst, p50 / p95 / p99 | x2_std | ax_rms | ay_rms | \
              response_frequency | stick (absolute) | other types, regimes, statuses, % |\n\
              |---|---|---|---|---|---|---|---|---|---|---|\n";
    let shown = |row: &&Row| {
        row.frontier || is_comparison(row) || ["reference", "gpu"].contains(&row.backend.as_str())
    };
    for row in measured.rows.iter().filter(shown) {
        let per_cpu = row.per_cpu_second.map_or("–".to_owned(), |rate| format!("{rate:.0}"));
        let _ = writeln!(
            text,
            "| {} {} | {} | {:.0} | {per_cpu} | {:.1e} / {:.1e} / {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | \
             {:.2}, {:.2}, {:.2} |",
            row.backend,
            row.precision,
            row.steps_per_period,
            row.per_second,
            row.worst_p50,
            row.worst_p95,
            row.worst_p99,
            row.x2_std_p95,
            row.ax_rms_p95,
            row.ay_rms_p95,
            row.response_frequency_p95,
            row.stick_p95,
            100.0 * row.types,
            100.0 * row.regimes,
            100.0 * row.statuses,
        );
    }
}

/// What a terminal shows: the fastest configuration for each of the named accuracies.
#[must_use]
pub fn summary(measured: &Measurement) -> String {
    let truth = &measured.truth;
    let mut text = format!(
        "{} settled oscillations of {} instances judged; the truth is converged to {:.1e} (95 % of {})\n",
        truth.judged,
        measured.sample.indices.len(),
        truth.convergence[1],
        truth.checked
    );
    let rows = &measured.rows;
    let pace = pace(rows.iter());
    let of = if on_gpu(rows) { "" } else { " of a processor" };
    for (name, level) in NAMES {
        let Level::Within(bound) = level else { continue };
        let found = match fastest(&measured.rows, bound) {
            Some(row) => format!(
                "{} {}, {} steps per period: {:.0} instances/s{}, 95 % within {:.1e}",
                row.backend,
                row.precision,
                row.steps_per_period,
                pace(row),
                of,
                row.worst_p95
            ),
            None => "nothing keeps it".to_owned(),
        };
        let _ = writeln!(text, "{name:<9} {bound:<6e} {found}");
    }
    for left_out in &measured.left_out {
        let _ = writeln!(text, "left out: {left_out}");
    }
    text
}
