//! Instances built by hand.

use squealmap::engine::method::Method;
use squealmap::engine::method::taylor::REFERENCE_ORDER;
use squealmap::engine::plan::{Duration, Plan, STEP_TOLERANCE, StartKind};
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::motion::Motion;
use squealmap::model::{Param, Params};

/// Table 1 with the given values and law.
pub(crate) fn instance(law: FrictionLaw, values: &[(Param, f64)]) -> Instance {
    let mut params = Params::default();
    for &(param, value) in values {
        params.set(param, value);
    }
    Instance { params, law, impact_friction: true, motion: Motion::Ramp, heating: None, modal: None }
}

/// Table 1 with the paper's bilinear law.
pub(crate) fn paper(mu_s: f64, mu_d: f64, belt_velocity: f64) -> Instance {
    instance(bilinear(mu_s, mu_d), &[(Param::BeltVelocity, belt_velocity)])
}

pub(crate) fn bilinear(mu_s: f64, mu_d: f64) -> FrictionLaw {
    FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity: 5.0 }
}

pub(crate) fn constant(mu: f64) -> FrictionLaw {
    FrictionLaw::Constant { mu_s: mu, mu_d: mu }
}

/// A kick start with the reference's resolution.
pub(crate) fn plan(settle: f64, measure: f64, steps_per_period: u32) -> Plan {
    Plan {
        start: StartKind::Kick,
        settle: Duration::Seconds(settle),
        settle_limit: None,
        hunts: false,
        measure: Duration::Seconds(measure),
        steps_per_period,
        method: Method::Taylor,
        order: REFERENCE_ORDER,
        tolerance: STEP_TOLERANCE,
    }
}

/// `|a − b| ≤ tolerance |b|`, with both printed.
#[track_caller]
pub(crate) fn close(what: &str, actual: f64, expected: f64, relative: f64) {
    assert!(
        (actual - expected).abs() <= relative * expected.abs(),
        "{what}: {actual:.12e} instead of {expected:.12e}, relative difference {:.2e} above {relative:.0e}",
        ((actual - expected) / expected).abs()
    );
}

/// `|a − b| ≤ tolerance`, with both printed.
#[track_caller]
pub(crate) fn near(what: &str, actual: f64, expected: f64, absolute: f64) {
    assert!(
        (actual - expected).abs() <= absolute,
        "{what}: {actual:.15e} instead of {expected:.15e}, difference {:.2e} above {absolute:.0e}",
        (actual - expected).abs()
    );
}

/// Whether the summary of `identify` names mode coupling, and no other cause.
pub(crate) fn says_mode_coupling(out: &str) -> bool {
    let summary = out.lines().next().unwrap_or_default();
    let open = |part: &&str| part.contains("undecided") || part.contains("mode coupling, with or without");
    let decided: Vec<&str> = summary.split(", to ").filter(|part| !open(part)).collect();
    !decided.is_empty() && decided.iter().all(|part| part.ends_with("s mode coupling"))
}
