//! One instance: its eigenvalues with and without either mechanism, its motion, its friction law, its record.

use crate::engine::plan::Duration;
use crate::model::equilibrium::{Equilibrium, Units};
use crate::model::instance::Instance;
use crate::model::kind::InstabilityType;
use crate::model::{Param, linear, quartic};
use crate::study::trace::run::{TraceRow, trace};
use crate::sweep::spec::Spec;
use serde::Deserialize;
use serde_json::{Map, Value as Json, json};

use crate::study::explore::answer::Answer;
use crate::study::explore::opened::Opened;
use crate::study::explore::place::At;

/// The longest motion that is shown, and how finely at most.
const MOST_PERIODS: f64 = 2000.0;
const MOST_SAMPLES: u32 = 200;

/// Points of the friction law.
const OF_LAW: usize = 129;

/// The arrays of a motion, in their order.
pub const MOTION: [&str; 12] = ["t", "x2", "y2", "y1", "vx2", "vy2", "vy1", "ax2", "ay2", "N", "T", "state"];

/// The instance that is wanted.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wanted {
    /// Every axis of the sweep, and any parameter.
    pub at: At,
    /// Periods `2π/ω0` before the motion that is shown.
    #[serde(default)]
    pub skipped: f64,
    /// Periods that are shown; 0: no motion.
    pub periods: f64,
    /// Samples in a period.
    pub samples: u32,
}

impl Wanted {
    /// The answer: `eigenvalues` (`full`, `flat`, `frozen`: pairs of real and imaginary part, 1/s), `equilibrium`, `law` (as
    /// many velocities, then friction coefficients, as it says), and the arrays [`MOTION`].
    ///
    /// # Errors
    /// A sentence that names what is wrong.
    pub fn answer(&self, opened: &Opened) -> Result<Answer, String> {
        let Wanted { skipped, periods, samples, .. } = *self;
        let total = skipped + periods;
        if !(skipped >= 0.0 && periods >= 0.0 && total <= MOST_PERIODS) {
            return Err(format!(
                "{skipped} and {periods} periods have to be between 0 and {MOST_PERIODS} together"
            ));
        }
        if !(1..=MOST_SAMPLES).contains(&samples) {
            return Err(format!("`samples` is {samples}, and has to be 1 to {MOST_SAMPLES}"));
        }
        let spec = &opened.spec;
        let pairs = self.at.iter().map(|(name, value)| match value {
            Json::String(text) => format!("{name}={text}"),
            other => format!("{name}={other}"),
        });
        let pairs: Vec<String> = pairs.collect();
        let instance = spec.instance_at(&pairs.join(",")).map_err(|why| why.to_string())?;
        let mut head = Map::new();
        head.insert("eigenvalues".to_owned(), eigenvalues(&instance));
        let mut numbers = Vec::new();
        if instance.modal.is_none() {
            if let Ok(at) = Equilibrium::new(&instance) {
                let Equilibrium { mu, slope, normal_force, x2, y1, .. } = at;
                let known =
                    json!({ "mu": mu, "slope": slope, "normal_force": normal_force, "x2": x2, "y1": y1 });
                head.insert("equilibrium".to_owned(), known);
            }
            let fastest = 2.5 * instance.params.require(Param::BeltVelocity).max(0.1);
            let velocity = |k: usize| fastest * k as f64 / (OF_LAW - 1) as f64;
            numbers.extend((0..OF_LAW).map(velocity));
            numbers.extend((0..OF_LAW).map(|k| instance.law.mu(velocity(k))));
            head.insert("law".to_owned(), json!(OF_LAW));
            head.insert("period".to_owned(), json!(Units::new(&instance.params).period()));
            if periods > 0.0 {
                let rows = motion(spec, &instance, [skipped, periods], samples);
                head.insert("rows".to_owned(), json!(rows.len()));
                head.insert("arrays".to_owned(), json!(MOTION));
                for of in ARRAYS {
                    numbers.extend(rows.iter().map(of));
                }
            }
        }
        Ok(Answer { head: Json::Object(head), numbers, ..Answer::default() })
    }
}

/// The samples of a motion behind what is skipped.
fn motion(spec: &Spec, instance: &Instance, [skipped, periods]: [f64; 2], samples: u32) -> Vec<TraceRow> {
    let shown = Spec {
        settle: Duration::Periods(skipped),
        settle_limit: None,
        measure: Duration::Periods(periods),
        ..spec.clone()
    };
    let mut rows = trace(&shown, instance, samples).rows;
    let from = skipped * Units::new(&instance.params).period();
    let first = rows.partition_point(|row| row.t < from);
    rows.drain(..first);
    rows
}

/// How each of [`MOTION`] is read.
const ARRAYS: [fn(&TraceRow) -> f64; 12] = [
    |row| row.t,
    |row| row.position[0],
    |row| row.position[1],
    |row| row.position[2],
    |row| row.velocity[0],
    |row| row.velocity[1],
    |row| row.velocity[2],
    |row| row.acceleration[0],
    |row| row.acceleration[1],
    |row| row.normal_force,
    |row| row.tangential_force,
    |row| f64::from(row.state as u32),
];

/// With both mechanisms, without the slope of friction, without the feedback of the normal force.
fn eigenvalues(instance: &Instance) -> Json {
    let pairs =
        |all: &[num_complex::Complex64]| -> Json { all.iter().map(|z| json!([z.re, z.im])).collect() };
    if instance.modal.is_some() {
        return json!({ "full": linear::spectrum(instance).map(|all| pairs(&all)) });
    }
    match linear::prepare(instance) {
        Ok(prepared) => {
            let of = |polynomial| pairs(&quartic::roots(polynomial));
            json!({ "full": of(prepared.full), "flat": of(prepared.flat), "frozen": of(prepared.frozen) })
        }
        Err(kind) => json!({ "none": kind.map(InstabilityType::name) }),
    }
}
