//! An engine with its arithmetic and steps per period: one way to compute a sweep.

use crate::engine::Engine;
use crate::engine::backend::Backend;
use crate::engine::method::Method;
use crate::engine::options::Options;
use crate::engine::precision::Precision;
use crate::model::friction::LawKind;
use crate::sweep::grid::{AxisKey, Grid, Value};
use crate::sweep::spec::Spec;
use std::fmt;

/// The least steps per period of the finer result; its truncation is then a thousandth of what f32 rounds.
const FINE_STEPS: u32 = 16;

/// One way to compute a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration {
    /// The backend, never [`Backend::Auto`].
    pub backend: Backend,
    /// The adapter of a GPU.
    pub adapter: Option<String>,
    /// The scalar.
    pub precision: Precision,
    /// Largest step: this many per period `2π/ω0`.
    pub steps_per_period: u32,
}

impl Configuration {
    /// The reference with so many steps per period.
    #[must_use]
    pub fn reference(steps_per_period: u32) -> Configuration {
        Configuration::scalar(Method::Taylor, steps_per_period)
    }

    /// One instance at a time by a method: the reference, or one to compare with.
    #[must_use]
    pub fn scalar(method: Method, steps_per_period: u32) -> Configuration {
        let backend = Backend::of_method(method);
        Configuration { backend, adapter: None, precision: Precision::F64, steps_per_period }
    }

    /// The CPU engine.
    #[must_use]
    pub fn cpu(precision: Precision, steps_per_period: u32) -> Configuration {
        Configuration { backend: Backend::Cpu, adapter: None, precision, steps_per_period }
    }

    /// What an engine computes with so many steps per period.
    #[must_use]
    pub fn of(engine: &dyn Engine, steps_per_period: u32) -> Configuration {
        Configuration {
            backend: engine.backend(),
            adapter: None,
            precision: engine.precision(),
            steps_per_period,
        }
    }

    /// The options that compute like this, everything else as in `options`.
    #[must_use]
    pub fn options<'a>(&'a self, options: &Options<'a>) -> Options<'a> {
        let adapters = self.adapter.as_slice();
        Options { backend: self.backend, precision: Some(self.precision), adapters, ..*options }
    }

    /// The sweep with the steps of this.
    #[must_use]
    pub fn sweep(&self, spec: &Spec) -> Spec {
        Spec { steps_per_period: self.steps_per_period, ..spec.clone() }
    }
}

impl fmt::Display for Configuration {
    /// `cpu f32, 5 steps per period`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.backend.name(), self.precision)?;
        if let Some(adapter) = &self.adapter {
            write!(f, " on {adapter}")?;
        }
        write!(f, ", {} steps per period", self.steps_per_period)
    }
}

/// The kinds of scenes of a sweep, on which speed and error depend most: the form of the friction law, and whether
/// an instance runs for a fixed time or until it is settled. Sorted, each once.
#[must_use]
pub fn scenes(spec: &Spec) -> Vec<String> {
    let form = |kind: LawKind| kind.form().name();
    let swept: Vec<&Value> = match &spec.grid {
        Grid::Axes(axes) => {
            axes.iter().filter(|axis| axis.key == AxisKey::Law).flat_map(|axis| &axis.values).collect()
        }
        Grid::Tuples { keys, rows } => match keys.iter().position(|key| *key == AxisKey::Law) {
            Some(column) => rows.iter().map(|row| &row[column]).collect(),
            None => Vec::new(),
        },
    };
    let kind_of = |value: &Value| match value {
        Value::Text(name) => LawKind::from_name(name),
        Value::Number(_) => None,
    };
    let mut forms: Vec<&str> = swept.into_iter().filter_map(kind_of).map(form).collect();
    if forms.is_empty() {
        forms.push(form(spec.law));
    }
    forms.sort_unstable();
    forms.dedup();
    let ending = if spec.settle_limit.is_some() { "until settled" } else { "fixed time" };
    forms.into_iter().map(|form| format!("{form}, {ending}")).collect()
}

/// The finer configuration that checks results of `configuration`.
#[must_use]
pub fn finer(configuration: &Configuration) -> Configuration {
    let steps = match configuration.precision {
        Precision::F32 => FINE_STEPS,
        Precision::F64 => FINE_STEPS.max(configuration.steps_per_period.saturating_mul(2)),
    };
    Configuration::cpu(Precision::F64, steps)
}
