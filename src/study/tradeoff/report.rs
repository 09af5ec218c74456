//! The results of `squealmap tradeoff`: the table, its summary as JSON, and the figure.

use std::fmt::Write as _;

use serde_json::{Value as Json, json};

use crate::engine::regime::Regime;
use crate::model::kind::InstabilityType;
use crate::study::error::Result;
use crate::sweep::accuracy::frontier::{MARGIN, is_comparison};
use crate::sweep::accuracy::level::{Level, NAMES};
use crate::sweep::accuracy::measure::{CHECK_STEPS, Measurement, TRUTH_STEPS};
use crate::sweep::accuracy::row::{Row, pace};
use crate::sweep::accuracy::sample::Stratum;
use crate::version::{COMMIT, VERSION};

pub use crate::study::tradeoff::figure::figure;

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
    let mut bytes =
        serde_json::to_vec_pretty(&document).map_err(crate::results::error::Error::WriteManifest)?;
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

/// A row as JSON; infinite numbers are null.
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
    /// The measurement.
    pub measured: &'a Measurement,
}

/// The begin of a report: what made it and how its tables are read. It holds no result.
#[must_use]
pub fn head(command: &str) -> String {
    format!(
        "# Speed against error\n\n\
         Made by one command, on the machine whose numbers it shows; do not edit:\n\n    {command}\n\n\
         Every engine that the command measures computes a sample of each sweep: of every status, type and regime some \
         instances, more near the borders between them, each weighed by the number of instances it stands for. The truth is the \
         reference at {TRUTH_STEPS} steps per period. Errors are relative; `worst` is the worst of `x2_std`, `ax_rms`, `ay_rms` \
         and `response_frequency` of an instance, p95 what 95 % of the settled oscillations are within. Chaotic motions and \
         those that have not settled differ between any two methods: they are compared by their labels alone. The scatter of \
         the truth is the difference of the two halves of its own window.\n\n\
         ## The fastest for each accuracy\n\n\
         Instances per second of a processor (with a GPU among them: of wall time), and the error that 95 % are within.\n\n"
    )
}

/// The report on some sweeps, made by a command: Markdown.
#[must_use]
pub fn to_markdown(sections: &[Section], command: &str) -> String {
    let mut text = head(command);
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

/// The summary for a terminal: the fastest configuration for each of the named accuracies.
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
