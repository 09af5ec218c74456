//! Maps made by hand: no engine, every value chosen.

use std::time::Duration;

use squealmap::engine::backend::Backend;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::{Duration as Time, StartKind};
use squealmap::engine::record::Record;
use squealmap::engine::reference::records::in_f64;
use squealmap::engine::regime::Regime;
use squealmap::model::friction::LawKind;
use squealmap::model::kind::InstabilityType;
use squealmap::model::linear::Linear;
use squealmap::model::motion::Motion;
use squealmap::model::status::Status;
use squealmap::model::{Param, Params};
use squealmap::sweep::grid::{Axis, AxisKey, Grid, Value};
use squealmap::sweep::map::{Map, Provenance};
use squealmap::sweep::spec::{Analysis, Pass, Spec, Starts};

/// A numeric axis.
pub(crate) fn axis(param: Param, values: &[f64]) -> Axis {
    let values = values.iter().map(|x| Value::Number(*x)).collect();
    Axis { key: AxisKey::Param(param), values, log: false }
}

/// An axis of `points` values from `from` to `to`.
pub(crate) fn span(param: Param, from: f64, to: f64, points: usize) -> Axis {
    let step = (to - from) / (points.max(2) - 1) as f64;
    axis(param, &(0..points).map(|i| from + step * i as f64).collect::<Vec<_>>())
}

/// A sweep over `grid` with Table 1 and the bilinear law.
pub(crate) fn spec(grid: Grid) -> Spec {
    Spec {
        title: "Stability map".to_owned(),
        analysis: Analysis {
            linear: true,
            response: true,
            until_settled: false,
            finds_cycles: false,
            checked: false,
            starts: Starts::One,
        },
        base: Params::default(),
        modal: None,
        impact_friction: true,
        law: LawKind::Bilinear,
        material: None,
        materials: Vec::new(),
        table: None,
        motion: Motion::Ramp,
        grid,
        start: StartKind::Kick,
        pass: Pass::Own,
        settle: Time::Seconds(6.0),
        settle_limit: None,
        measure: Time::Seconds(3.0),
        steps_per_period: 60,
        steps_given: None,
        refine: None,
    }
}

/// A map of `grid` with one record per instance, made from its coordinates.
pub(crate) fn map(grid: Grid, record: impl Fn(usize, &[&Value]) -> Record) -> Map {
    let records = (0..grid.len()).map(|i| record(i, &grid.coordinates(i))).collect();
    let provenance = Provenance {
        linear: Some(in_f64(Backend::Reference, "closed form".to_owned())),
        response: Some(in_f64(Backend::Reference, "rk4".to_owned())),
        threads: 2,
        elapsed: Duration::from_millis(2500),
    };
    Map { spec: spec(grid), records, stopped: None, provenance }
}

/// A finished record of this type and regime.
pub(crate) fn record(kind: InstabilityType, regime: Regime, settled: bool) -> Record {
    let linear = Linear {
        growth_rate: 4.338_989_74,
        frequency: Some(33.949_151_2),
        phase: Some(-40.738_935),
        growth_rate_flat: 4.3,
        growth_rate_frozen: -0.021_714_01,
    };
    let outcome =
        Outcome { status: Status::Ok, x2_mean: Some(1e-3), simulated_time: 9.0, ..Outcome::default() };
    Record {
        status: Status::Ok,
        kind: Some(kind),
        linear: Some(linear),
        regime: Some(regime),
        settled: Some(settled),
        outcome: Some(Box::new(outcome)),
        ..Record::default()
    }
}

/// An instance without any result.
pub(crate) fn failed(status: Status) -> Record {
    let outcome = Outcome { status, ..Outcome::default() };
    Record { status, outcome: Some(Box::new(outcome)), ..Record::default() }
}

/// A number of an instance's coordinates.
pub(crate) fn number(value: &Value) -> f64 {
    match value {
        Value::Number(x) => *x,
        Value::Text(text) => panic!("{text} is not a number"),
    }
}

/// Something with the look of the paper's map: regions over `mu_s`, `mu_d` and the belt velocity.
pub(crate) fn paper_like(mu_s: f64, mu_d: f64, v: f64) -> Record {
    use InstabilityType as I;
    use Regime as R;
    let mu = mu_s + (mu_d - mu_s) * (v / 5.0).min(1.0);
    let slope = if v < 5.0 { (mu_s - mu_d) / 5.0 } else { 0.0 };
    let (coupled, falling) = (mu > 0.2264, slope > 9e-5 * (1.0 - mu));
    let kind = match (coupled, falling) {
        (true, true) => I::Coexistence,
        (true, false) if slope < -0.07 => I::Interaction,
        (true, false) => I::ModeCoupling,
        (false, true) => I::NegativeSlope,
        (false, false) => I::Stable,
    };
    let regime = match kind {
        I::NegativeSlope if mu_s - mu_d < 0.02 * v => R::Slip,
        I::NegativeSlope => R::StickSlip,
        I::ModeCoupling | I::Coexistence | I::Interaction if v > 4.95 => R::Detaching,
        I::ModeCoupling | I::Coexistence | I::Interaction if mu < 0.25 => R::SlipReversal,
        I::ModeCoupling | I::Coexistence | I::Interaction => R::DetachingStickSlip,
        _ => R::Equilibrium,
    };
    let settled = (!coupled || (mu - 0.24).abs() >= 0.02) && (!falling || slope >= 0.004);
    let mut record = record(kind, regime, settled);
    if v > 5.5 && (mu_s - 0.5).hypot(mu_d - 0.1) < 0.07 {
        record = Record { regime: None, settled: None, ..record };
        record.status = Status::EventLimit;
    }
    record
}
