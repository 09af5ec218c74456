//! A sweep built in code: the same [`Spec`] that a sweep file gives, by the same checks.

use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::sync::Arc;

use crate::engine::options::Options;
use crate::engine::plan::Duration;
use crate::model::Param;
use crate::model::friction::{FrictionLaw, LawKind};
use crate::model::material::Outside;
use crate::model::motion::Motion;
use crate::sweep::error::Result;
use crate::sweep::grid::{AxisKey, Value};
use crate::sweep::map::Map;
use crate::sweep::run;
use crate::sweep::spec::Spec;
use crate::sweep::spec::call::Call;
use crate::sweep::spec::refine::Settings;

pub use crate::sweep::spec::call::{Settle, Start};

/// A sweep built in code, call by call.
///
/// Nothing is checked before [`Sweep::spec`] or [`Sweep::run`]. Of two calls that say the same the last counts, and what
/// varies overrides the numbers of [`Sweep::friction`]. What no call says is as in a sweep file without that key.
///
/// ```
/// use squealmap::{FrictionLaw::Bilinear, Param, Settle, Sweep};
///
/// let map = Sweep::two_mass()
///     .friction(Bilinear { mu_s: 0.5, mu_d: 0.3, knee_velocity: 5.0 })
///     .set(Param::BeltVelocity, 3.0)
///     .axis(Param::MuS, 0.3..=0.6, 4)
///     .response(Settle::Auto)
///     .run()?;
/// assert_eq!(map.column("growth_rate")?.len(), 4);
/// # Ok::<(), squealmap::Error>(())
/// ```
///
/// What is wrong is said as of a sweep file, with the call as its place:
///
/// ```
/// use squealmap::{Param, Sweep};
///
/// let wrong = Sweep::two_mass().axis(Param::MuS, -0.1..=0.6, 8).spec();
/// assert_eq!(
///     wrong.unwrap_err().to_string(),
///     ".axis(Param::MuS, -0.1..=0.6, 8): `from` of axis `mu_s` is -0.1 but must be a finite number not below 0"
/// );
/// ```
#[derive(Clone, Debug)]
#[must_use = "a sweep is computed by its `run`"]
pub struct Sweep {
    calls: Vec<Call>,
    directory: PathBuf,
}

impl Sweep {
    /// The two-mass model on a belt, with the paper's parameters where no call says others.
    pub fn two_mass() -> Sweep {
        Sweep { calls: Vec::new(), directory: PathBuf::from(".") }
    }

    /// The modes of a structure in a file that `squealmap fem` writes; only its eigenvalues are computed.
    pub fn modal(file: impl Into<PathBuf>) -> Sweep {
        Sweep { calls: vec![Call::Modes(file.into())], directory: PathBuf::from(".") }
    }

    fn call(mut self, call: Call) -> Sweep {
        self.calls.push(call);
        self
    }

    /// Title of figures and manifest.
    pub fn title(self, title: impl Into<String>) -> Sweep {
        self.call(Call::Title(title.into()))
    }

    /// No eigenvalue analysis.
    pub fn without_eigenvalues(self) -> Sweep {
        self.call(Call::WithoutEigenvalues)
    }

    /// No time integration.
    pub fn without_response(self) -> Sweep {
        self.call(Call::WithoutResponse)
    }

    /// The value of a parameter, in its SI unit (°C for the temperature).
    pub fn set(self, param: Param, value: f64) -> Sweep {
        self.call(Call::Set(param, value))
    }

    /// Whether friction acts while the contact closes again after a detachment.
    pub fn impact_friction(self, acts: bool) -> Sweep {
        self.call(Call::ImpactFriction(acts))
    }

    /// The friction law with its parameters; of those that vary, the axis counts.
    pub fn friction(self, law: FrictionLaw) -> Sweep {
        self.call(Call::Friction(law))
    }

    /// The friction law alone: its parameters are set, vary, or come from a material.
    pub fn law(self, law: LawKind) -> Sweep {
        self.call(Call::Law(law))
    }

    /// The friction law of a CSV file with columns `velocity` and `mu`.
    pub fn friction_table(self, file: impl Into<PathBuf>) -> Sweep {
        self.call(Call::FrictionTable(file.into()))
    }

    /// The material of a CSV file with a column `temperature` and parameters of the law, or for [`LawKind::Table`] with columns
    /// `velocity` and `mu`.
    pub fn material(self, file: impl Into<PathBuf>) -> Sweep {
        self.call(Call::Material(file.into()))
    }

    /// How the belt moves; its times are parameters, such as [`Param::RampDuration`].
    pub fn motion(self, motion: Motion) -> Sweep {
        self.call(Call::Motion(motion))
    }

    /// What a temperature beyond the rows of a material is.
    pub fn outside(self, outside: Outside) -> Sweep {
        self.call(Call::Outside(outside))
    }

    /// The directory that files are relative to; without it, the one the program runs in.
    pub fn files_in(mut self, directory: impl Into<PathBuf>) -> Sweep {
        self.directory = directory.into();
        self
    }

    /// An axis of `points` values in equal steps, both ends included. The first axis varies slowest.
    pub fn axis(self, param: Param, ends: RangeInclusive<f64>, points: usize) -> Sweep {
        self.call(Call::Axis(param, [*ends.start(), *ends.end()], points, false))
    }

    /// An axis of `points` values in equal ratios, both ends included.
    pub fn log_axis(self, param: Param, ends: RangeInclusive<f64>, points: usize) -> Sweep {
        self.call(Call::Axis(param, [*ends.start(), *ends.end()], points, true))
    }

    /// An axis of these values.
    pub fn values(self, param: Param, values: impl IntoIterator<Item = f64>) -> Sweep {
        self.call(Call::Values(AxisKey::Param(param), values.into_iter().map(Value::Number).collect()))
    }

    /// An axis of friction laws.
    pub fn laws(self, laws: impl IntoIterator<Item = LawKind>) -> Sweep {
        let names = laws.into_iter().map(|law| Value::Text(Arc::new(law.name().to_owned())));
        self.call(Call::Values(AxisKey::Law, names.collect()))
    }

    /// An axis of materials, by their files.
    pub fn materials(self, files: impl IntoIterator<Item = impl Into<String>>) -> Sweep {
        let names = files.into_iter().map(|file| Value::Text(Arc::new(file.into())));
        self.call(Call::Values(AxisKey::Material, names.collect()))
    }

    /// Instances one by one instead of axes: the values of `params` in each.
    pub fn points<const N: usize>(
        self,
        params: [Param; N],
        rows: impl IntoIterator<Item = [f64; N]>,
    ) -> Sweep {
        self.call(Call::Points(params.to_vec(), rows.into_iter().map(Vec::from).collect()))
    }

    /// The instances of a CSV file, one a row.
    pub fn points_file(self, file: impl Into<PathBuf>) -> Sweep {
        self.call(Call::PointsFile(file.into()))
    }

    /// Where transients start.
    pub fn start(self, start: Start) -> Sweep {
        self.call(Call::Start(start))
    }

    /// When the motion is measured.
    pub fn response(self, settle: Settle) -> Sweep {
        self.call(Call::Response(settle))
    }

    /// Length of the measuring window.
    pub fn measure(self, window: Duration) -> Sweep {
        self.call(Call::Measure(window))
    }

    /// Steps of integration per period `2π/ω0` of an instance, at least.
    pub fn steps_per_period(self, steps: u32) -> Sweep {
        self.call(Call::StepsPerPeriod(steps))
    }

    /// Whether a few instances are computed again to measure the error of the others.
    pub fn check(self, check: bool) -> Sweep {
        self.call(Call::Check(check))
    }

    /// How the map is refined where only its lines are computed, see [`crate::sweep::refine`].
    pub fn refine(self, settings: Settings) -> Sweep {
        self.call(Call::Refine(settings))
    }

    /// The sweep, checked as a sweep file is.
    ///
    /// # Errors
    /// As [`Spec::parse`], with the call as the place.
    pub fn spec(&self) -> Result<Spec> {
        Spec::of_calls(&self.calls, &self.directory)
    }

    /// Computes the sweep in memory, on the best engine of this machine; see [`run::run`].
    ///
    /// # Errors
    /// When the sweep is refused, see [`Sweep::spec`], or does not come to its end.
    pub fn run(&self) -> Result<Map> {
        self.run_with(&Options::default())
    }

    /// Computes the sweep as the options say.
    ///
    /// # Errors
    /// As [`Sweep::run`].
    pub fn run_with(&self, options: &Options) -> Result<Map> {
        run::run(self.spec()?, options, &|_| {})
    }
}
