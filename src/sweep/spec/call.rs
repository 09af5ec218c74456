//! A sweep as the calls that build it in code, and the text of them, into which errors point.

use std::ops::Range;
use std::path::PathBuf;

use crate::engine::plan::Duration;
use crate::model::Param;
use crate::model::friction::{FrictionLaw, LawKind};
use crate::model::material::Outside;
use crate::model::motion::Motion;
use crate::sweep::grid::{AxisKey, Value};
use crate::sweep::spec::refine::Settings;
use squealmap_input::place::Source;
use squealmap_input::quote::quoted;

/// Where transients start; the amplitudes are parameters, such as [`Param::StartVelocity`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// A kick of the sliding equilibrium.
    Kick,
    /// Its most unstable mode.
    Mode,
    /// A kick, and a large start.
    Both,
    /// A kick, and starts drawn from a box between its four bounds, such as [`Param::BoxVelocityFrom`].
    Box {
        /// How many are drawn.
        samples: u32,
    },
}

/// When an instance is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Settle {
    /// When the windows of its motion agree.
    Auto,
    /// When its limit cycle is found by shooting, or else as [`Settle::Auto`].
    Cycle,
    /// Until settled, but no longer than this.
    AutoWithin(Duration),
    /// After this time.
    After(Duration),
}

/// One call of the builder.
#[derive(Clone, Debug)]
pub(crate) enum Call {
    Title(String),
    WithoutEigenvalues,
    WithoutResponse,
    /// The model; the first call, if it is one.
    Modes(PathBuf),
    ImpactFriction(bool),
    Set(Param, f64),
    Friction(FrictionLaw),
    FrictionTable(PathBuf),
    Law(LawKind),
    Material(PathBuf),
    Motion(Motion),
    Outside(Outside),
    /// From, to, points, and whether the steps are equal ratios.
    Axis(Param, [f64; 2], usize, bool),
    Values(AxisKey, Vec<Value>),
    /// One row per instance.
    Points(Vec<Param>, Vec<Vec<f64>>),
    PointsFile(PathBuf),
    Start(Start),
    Response(Settle),
    Measure(Duration),
    StepsPerPeriod(u32),
    Check(bool),
    Refine(Settings),
}

/// Values of an axis that its call shows.
const SHOWN: usize = 4;

impl Call {
    /// The method and its arguments, each behind what separates it from the one before.
    fn words(&self) -> (&'static str, Vec<(&'static str, String)>) {
        let one = |name, value: String| (name, vec![("", value)]);
        let path = |path: &PathBuf| format!("\"{}\"", path.display());
        match self {
            Call::Title(title) => one("title", format!("\"{}\"", quoted(title))),
            Call::WithoutEigenvalues => ("without_eigenvalues", Vec::new()),
            Call::WithoutResponse => ("without_response", Vec::new()),
            Call::Modes(file) => one("modal", path(file)),
            Call::ImpactFriction(acts) => one("impact_friction", acts.to_string()),
            Call::Set(param, value) => ("set", vec![("", named(*param)), (", ", value.to_string())]),
            Call::Friction(FrictionLaw::Table(_)) => one("friction", "Table(…)".to_owned()),
            Call::Friction(law) => one("friction", format!("{law:?}")),
            Call::FrictionTable(file) => one("friction_table", path(file)),
            Call::Law(kind) => one("law", format!("LawKind::{kind:?}")),
            Call::Material(file) => one("material", path(file)),
            Call::Motion(Motion::Table(_)) => one("motion", "Motion::Table(…)".to_owned()),
            Call::Motion(motion) => one("motion", format!("Motion::{motion:?}")),
            Call::Outside(outside) => one("outside", format!("Outside::{outside:?}")),
            Call::Axis(param, [from, to], points, log) => (
                if *log { "log_axis" } else { "axis" },
                vec![
                    ("", named(*param)),
                    (", ", from.to_string()),
                    ("..=", to.to_string()),
                    (", ", points.to_string()),
                ],
            ),
            Call::Values(key, values) => {
                let mut shown: Vec<String> = values.iter().take(SHOWN).map(ToString::to_string).collect();
                shown.extend((values.len() > SHOWN).then(|| "…".to_owned()));
                let shown = format!("[{}]", shown.join(", "));
                match key {
                    AxisKey::Param(param) => ("values", vec![("", named(*param)), (", ", shown)]),
                    AxisKey::Law => one("laws", shown),
                    AxisKey::Material => one("materials", shown),
                }
            }
            Call::Points(params, _) => {
                let names: Vec<String> = params.iter().map(|param| named(*param)).collect();
                ("points", vec![("", format!("[{}]", names.join(", "))), (", ", "…".to_owned())])
            }
            Call::PointsFile(file) => one("points_file", path(file)),
            Call::Start(start) => one("start", format!("Start::{start:?}")),
            Call::Response(settle) => one("response", format!("Settle::{settle:?}")),
            Call::Measure(duration) => one("measure", format!("Duration::{duration:?}")),
            Call::StepsPerPeriod(steps) => one("steps_per_period", steps.to_string()),
            Call::Check(check) => one("check", check.to_string()),
            Call::Refine(settings) => one("refine", format!("{settings:?}")),
        }
    }
}

fn named(param: Param) -> String {
    format!("Param::{param:?}")
}

/// Where a call stands in the text of all, and where each of its arguments.
#[derive(Clone, Debug)]
pub(super) struct Stands {
    pub(super) whole: Range<usize>,
    pub(super) arguments: Vec<Range<usize>>,
}

/// The calls as a text of one line each, and where each stands.
pub(super) fn text(calls: &[Call]) -> (Source, Vec<Stands>) {
    let mut text = String::new();
    let mut all = Vec::with_capacity(calls.len());
    if !matches!(calls.first(), Some(Call::Modes(_))) {
        text.push_str("Sweep::two_mass()");
    }
    for call in calls {
        let before = if text.is_empty() { "Sweep::" } else { "\n." };
        text.push_str(before.trim_end_matches('.'));
        let start = text.len();
        let (name, words) = call.words();
        text.push_str(if before == "\n." { "." } else { "" });
        text.push_str(name);
        text.push('(');
        let mut arguments = Vec::with_capacity(words.len());
        for (separator, word) in words {
            text.push_str(separator);
            let start = text.len();
            // One line a call, whatever is in a name.
            text.extend(word.chars().map(|c| if c.is_control() { ' ' } else { c }));
            arguments.push(start..text.len());
        }
        text.push(')');
        all.push(Stands { whole: start..text.len(), arguments });
    }
    (Source::calls(&text), all)
}
