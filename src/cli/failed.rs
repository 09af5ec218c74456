//! Sweeps in which no instance has a result, and traces of an instance without one. Failures are data and are written; a
//! sentence and the exit code say that there is nothing else.

use std::path::Path;
use std::process::ExitCode;

use crate::cli::talk;
use serde_json::Value as Json;
use squealmap::disk;
use squealmap::model::status::Status;

/// The exit code of results that were written well: 1, with a sentence, where the document beside them counts no result.
pub(crate) fn judged(code: ExitCode, directory: &Path, document: &str) -> ExitCode {
    let bytes = disk::read(&directory.join(document)).unwrap_or_default();
    let document: Json = serde_json::from_slice(&bytes).unwrap_or_default();
    match sentence(&document["counts"]) {
        Some(why) if code == ExitCode::SUCCESS => {
            talk::error(&why);
            ExitCode::FAILURE
        }
        _ => code,
    }
}

/// A sentence that nothing has a result, and why; `None` where the counts of types, regimes and statuses show a result.
fn sentence(counts: &Json) -> Option<String> {
    let statuses = counts["status"].as_object()?;
    // A type is all that a linear analysis is asked for, and divergence is one.
    let asked_for_more = counts.get("regime").is_some();
    let has_types = counts["type"].as_object().is_some_and(|types| !types.is_empty());
    let count = |status: Status| statuses.get(status.name()).and_then(Json::as_u64).unwrap_or_default();
    let open = count(Status::Ok) + count(Status::NotComputed) > 0 || (has_types && !asked_for_more);
    (!open && !statuses.is_empty()).then(|| nothing(count))
}

/// A sentence that nothing has a result, and why: how many instances have which status.
pub(crate) fn nothing(count: impl Fn(Status) -> u64) -> String {
    format!("no instance has a result: {}", told(count))
}

/// How many instances failed how, and what to change.
pub(crate) fn told(count: impl Fn(Status) -> u64) -> String {
    let found = Status::ALL.into_iter().filter(|status| *status != Status::Ok && count(*status) > 0);
    let told = found.map(|status| format!("{} `{}`{}", count(status), status.name(), remedy(status)));
    told.collect::<Vec<_>>().join(", ")
}

/// A sentence that an instance has no result, and why.
#[must_use]
pub fn without_result(status: Status) -> String {
    format!("the instance has no result: `{}`{}", status.name(), remedy(status))
}

/// Why an instance ends like this and what to change.
pub(crate) fn remedy(status: Status) -> &'static str {
    match status {
        Status::Unwritten | Status::Ok | Status::NotComputed => "",
        Status::InvalidLaw => {
            " (the law `constant` needs `mu_s` of at least `mu_d`: change one of them, or `law`)"
        }
        Status::NoEquilibrium => {
            " (cos `theta` + mu sin `theta` has to be greater than 0: change `theta` or the friction)"
        }
        Status::Painleve => " (the motion is not unique: lower the friction or `theta`)",
        Status::EventLimit => " (events pile up: change `restitution` or the start)",
        Status::StepTooLarge => {
            " (more or shorter steps than an instance may take: shorten `settle_limit`, `measure` or a `settle` that is a time, or \
             look at the units of stiffnesses and masses)"
        }
        Status::NonFinite => " (values beyond the range of numbers: look at their units)",
    }
}
