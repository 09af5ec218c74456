//! What `squealmap tradeoff` writes: the table, its summary as JSON and the figure.

use std::fmt::Write as _;

use serde_json::{Value as Json, json};

use crate::accuracy::frontier::MARGIN;
use crate::accuracy::level::{Level, NAMES};
use crate::accuracy::measure::{CHECK_STEPS, Measurement, TRUTH_STEPS};
use crate::accuracy::row::Row;
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
    rows.iter()
        .filter(|row| MARGIN * row.worst_p95 <= bound)
        .max_by(|a, b| a.per_second.total_cmp(&b.per_second))
}

/// The summary as text for a terminal and for docs: Markdown.
#[must_use]
pub fn to_markdown(title: &str, measured: &Measurement) -> String {
    let truth = &measured.truth;
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let mut text = format!(
        "{title} ({}): {} instances judged, {} of the sweep oscillate, {} settled ({} in the sample); {} did not come \
         to their end. The truth, the reference at {TRUTH_STEPS} steps per period, differs from {CHECK_STEPS} steps by \
         {:.1e} / {:.1e} / {:.1e} (p50 / p95 / largest of {}); the halves of its own windows by {:.1e} / {:.1e} / \
         {:.1e} (p50 / p95 / p99).\n\n",
        measured.scene,
        measured.sample.indices.len(),
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
    text += "| engine | steps per period | instances/s | per CPU-second | worst of four, p50 / p95 / p99 | x2_std p95 | \
             ax_rms p95 | ay_rms p95 | frequency p95 | stick p95 | types, regimes, statuses that differ, % | \
             frontier |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for row in &measured.rows {
        let per_cpu = row.per_cpu_second.map_or("–".to_owned(), |rate| format!("{rate:.0}"));
        let _ = writeln!(
            text,
            "| {} {} | {} | {:.0} | {per_cpu} | {:.1e} / {:.1e} / {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | \
             {:.2}, {:.2}, {:.2} | {} |",
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
            if row.frontier { "yes" } else { "" },
        );
    }
    text
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
    for (name, level) in NAMES {
        let Level::Within(bound) = level else { continue };
        let found = match fastest(&measured.rows, bound) {
            Some(row) => format!(
                "{} {}, {} steps per period: {:.0} instances/s, 95 % within {:.1e}",
                row.backend, row.precision, row.steps_per_period, row.per_second, row.worst_p95
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
