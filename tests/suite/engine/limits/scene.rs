//! A scene at an extreme: an instance, how it is run, and what has to come out, from elsewhere.

use std::f64::consts::TAU;

use crate::common::{instance, plan};
use crate::engine::exact;
use crate::engines::Engine;
use nalgebra::Vector4;
use squealmap::engine::outcome::Outcome;
use squealmap::engine::plan::{Duration, Plan};
use squealmap::model::Param;
use squealmap::model::equilibrium::Units;
use squealmap::model::friction::FrictionLaw;
use squealmap::model::instance::Instance;
use squealmap::model::status::Status;

/// A number of an outcome; undefined where the outcome has none.
pub(crate) type Number = fn(&Outcome) -> Option<f64>;

/// What has to come out.
pub(crate) enum Expected {
    /// Numbers, each with what is read from an outcome.
    Numbers(Vec<(Number, f64)>),
    /// This status, from every engine.
    Ends(Status),
}

/// One row of the table of limits.
pub(crate) struct Scene {
    /// What is at its extreme, as it stands in the table.
    pub(crate) name: String,
    pub(crate) instance: Instance,
    pub(crate) plan: Plan,
    pub(crate) expected: Expected,
}

/// Rows that belong together, with a sentence on where their expected values come from.
pub(crate) struct Group {
    pub(crate) title: &'static str,
    pub(crate) source: &'static str,
    pub(crate) scenes: Vec<Scene>,
}

pub(crate) fn periods(settle: f64, measure: f64, steps_per_period: u32) -> Plan {
    Plan {
        settle: Duration::Periods(settle),
        measure: Duration::Periods(measure),
        ..plan(0.0, 1.0, steps_per_period)
    }
}

/// Friction without a slope, the same at rest.
fn flat(mu: f64) -> FrictionLaw {
    FrictionLaw::Constant { mu_s: mu, mu_d: mu }
}

/// A small kick of steady sliding, expected from the matrix exponential; `periods` before the window and in it.
pub(crate) fn sliding(name: &str, mu: f64, length: f64, values: &[(Param, f64)]) -> Scene {
    sliding_under(name, flat(mu), [mu, 0.0], length, values)
}

/// The same under a law with μ and slope (s/m) at the belt's velocity, 1 m/s unless it is among the values; a slope is
/// that of all velocities only for the smallest kicks.
pub(crate) fn sliding_under(
    name: &str,
    law: FrictionLaw,
    [mu, slope]: [f64; 2],
    length: f64,
    values: &[(Param, f64)],
) -> Scene {
    let mut one =
        instance(law, &[(Param::Theta, 0.1), (Param::BeltVelocity, 1.0), (Param::StartVelocity, 1e-3)]);
    for &(param, value) in values {
        one.params.set(param, value);
    }
    let value = |param| one.params.get(param).expect("a value");
    let time = length * Units::new(&one.params).period();
    let start = Vector4::new(value(Param::StartDisplacement), 0.0, value(Param::StartVelocity), 0.0);
    let window = exact::window(&exact::sliding(&one, mu, slope), start, time, time);
    let numbers: [(Number, f64); 4] = [
        (|outcome| outcome.x2_std, window.x2_std),
        (|outcome| outcome.y1_std, window.y1_std),
        (|outcome| outcome.ax_rms, window.ax_rms),
        (|outcome| outcome.ay_rms, window.ay_rms),
    ];
    Scene {
        name: name.to_owned(),
        instance: one,
        plan: periods(length, length, 12),
        expected: Expected::Numbers(numbers.to_vec()),
    }
}

/// The single mass on a belt, undamped: stick from `−d` to `d` at the belt's speed `V`, `k d = (μ_s − μ_d) N`, and an arc
/// of the circle in slip, `2π − 2 atan(ω d/V)`. It starts in stick.
pub(crate) fn stick_slip(name: &str, velocity: f64, force: f64, margin: f64) -> Scene {
    let law = FrictionLaw::Constant { mu_s: 0.3 + margin, mu_d: 0.3 };
    let (mass, k1) = (2.3, 1e5);
    let omega = f64::sqrt(k1 / mass);
    let reach = margin * force / k1;
    let phase = (omega * reach).atan2(velocity);
    let (slip, stick) = (TAU - 2.0 * phase, 2.0 * reach * omega / velocity);
    let amplitude = reach.hypot(velocity / omega);
    let period = slip + stick;
    let square = (amplitude * omega * omega).powi(2) * 0.5 * (slip + (2.0 * phase).sin()) / period;
    let one = instance(
        law,
        &[
            (Param::Theta, 0.0),
            (Param::C1, 0.0),
            (Param::C2, 0.0),
            (Param::FExt, force),
            (Param::BeltVelocity, velocity),
            (Param::StartVelocity, velocity),
            (Param::StartDisplacement, 0.5 * reach),
        ],
    );
    // Whole cycles, so that the ends of the window count for nothing; few of those that stick for most of their time.
    let cycles = if stick > 100.0 * slip { 4.0 } else { 16.0 } * period / TAU;
    let mut numbers: Vec<(Number, f64)> = vec![
        (|outcome| outcome.stick, stick / period),
        (|outcome| outcome.response_frequency, omega / period),
    ];
    numbers.push((|outcome| outcome.ax_rms, square.sqrt()));
    Scene {
        name: name.to_owned(),
        instance: one,
        plan: periods(cycles, cycles, 12),
        expected: Expected::Numbers(numbers),
    }
}

/// A scene that every engine has to end as the reference does with five times as many steps per period.
pub(crate) fn as_reference(name: &str, law: FrictionLaw, values: &[(Param, f64)]) -> Scene {
    as_reference_over([30.0, 20.0], name, law, values)
}

/// The same with so many periods before the window and in it.
pub(crate) fn as_reference_over(
    [settle, measure]: [f64; 2],
    name: &str,
    law: FrictionLaw,
    values: &[(Param, f64)],
) -> Scene {
    let numbers: [Number; 6] = [
        |outcome| outcome.x2_std,
        |outcome| outcome.y1_std,
        |outcome| outcome.ax_rms,
        |outcome| outcome.ay_rms,
        |outcome| outcome.free,
        |outcome| outcome.n_peak,
    ];
    in_these(name, instance(law, values), periods(settle, measure, 12), &numbers)
}

/// One in which friction changes near rest, where the accelerations show it.
pub(crate) fn layer(name: &str, law: FrictionLaw, values: &[(Param, f64)]) -> Scene {
    let numbers: [Number; 4] = [
        |outcome| outcome.x2_std,
        |outcome| outcome.ax_rms,
        |outcome| outcome.ax_peak,
        |outcome| outcome.impacts_per_second,
    ];
    in_these(name, instance(law, values), periods(30.0, 20.0, 12), &numbers)
}

/// One that the reference tells these numbers of.
fn in_these(name: &str, instance: Instance, plan: Plan, numbers: &[Number]) -> Scene {
    let outcome = Engine::Reference.run(&instance, &Plan { steps_per_period: 60, ..plan });
    let told = |number: &Number| (*number, number(&outcome).expect("the reference computes it"));
    let expected = Expected::Numbers(numbers.iter().map(told).collect());
    Scene { name: name.to_owned(), instance, plan, expected }
}

/// A scene that every engine has to refuse.
pub(crate) fn ends(name: &str, status: Status, law: FrictionLaw, values: &[(Param, f64)]) -> Scene {
    Scene {
        name: name.to_owned(),
        instance: instance(law, values),
        plan: periods(30.0, 20.0, 12),
        expected: Expected::Ends(status),
    }
}
