//! `squealmap check`: validate, describe, estimate.

use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use crate::cli::error::Result;
use crate::cli::failed::{nothing, told};
use crate::cli::onset::onset;
use crate::cli::progress::seconds;
use crate::cli::talk;
use crate::cli::talk::{note, print};
use clap::Args;
use rayon::prelude::*;
use serde_json::json;
use squealmap::engine::judged::refused;
use squealmap::engine::plan::StartKind;
use squealmap::model::Param;
use squealmap::model::status::Status;
use squealmap::store::cut::tile_of;
use squealmap::store::space::{MOST_ROWS, Need, bytes};
use squealmap::store::tiling::Tiling;
use squealmap::sweep::estimate::{Estimate, estimate};
use squealmap::sweep::grid::{Axis, AxisKey, Grid, Value};
use squealmap::sweep::refine::planes_of;
use squealmap::sweep::spec::refine::Settings;
use squealmap::sweep::spec::{Spec, Starts};

/// Arguments of `check`.
#[derive(Debug, Args)]
pub(crate) struct Check {
    /// Sweep file (TOML)
    sweep: PathBuf,
}

impl Check {
    pub(crate) fn execute(self) -> Result<ExitCode> {
        let spec = Spec::read(&self.sweep)?;
        if spec.refine.is_some() {
            planes_of(&spec.grid)?;
        }
        let text = format!(
            "{} is valid: {} instance(s)\n{}",
            self.sweep.display(),
            spec.grid.len(),
            describe(&spec)
        );
        print(&text);
        talk::tell("valid", true);
        talk::tell("title", spec.title.clone());
        talk::tell("instances", spec.grid.len());
        talk::tell("analysis", json!({ "linear": spec.analysis.linear, "response": spec.analysis.response }));
        talk::tell("varies", spec.grid.keys().iter().map(|key| key.name()).collect::<Vec<_>>());
        spec.beyond_its_modes().iter().for_each(|why| note(&format!("warning: {why}")));
        print(&materials(&spec));
        print(&disk(&spec));
        let estimate = estimate(&spec);
        print(&cost(&spec, &estimate));
        if let Some(why) = hopeless(&spec) {
            talk::error(&why);
            return Ok(ExitCode::FAILURE);
        }
        if let Some(why) = doubtful(&estimate) {
            note(&format!("warning: {why}"));
        }
        if let Some(onset) = onset(&spec) {
            print(&format!("grows     {onset}\n"));
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// That no instance of the sweep has a result, where that can be told without computing any.
fn hopeless(spec: &Spec) -> Option<String> {
    let why = |index: usize| refused(spec, &spec.instance(index));
    let all = 0..spec.grid.len();
    // Ends at the first one that may have a result: mostly at once.
    if all.clone().into_par_iter().any(|index| why(index).is_none()) {
        return None;
    }
    let found: Vec<Status> = all.filter_map(why).collect();
    Some(nothing(|status| count(&found, status)))
}

fn count(found: &[Status], wanted: Status) -> u64 {
    found.iter().filter(|status| **status == wanted).count() as u64
}

/// That none of the instances that were measured came to its end.
fn doubtful(estimate: &Estimate) -> Option<String> {
    let Estimate { sampled, failed, .. } = estimate;
    (failed.len() == *sampled).then(|| {
        let told = told(|status| count(failed, status));
        format!("none of the {sampled} instance(s) that were measured has a result: {told}")
    })
}

/// Title, analyses and what varies.
fn describe(spec: &Spec) -> String {
    let mut text = String::new();
    if !spec.title.is_empty() {
        let _ = writeln!(text, "title     {}", spec.title);
    }
    if let Some(modal) = &spec.modal {
        let (name, modes, size) = (&modal.name, modal.modes(), modal.size());
        let _ = writeln!(text, "model     {name}: {modes} mode(s) in the space of {size} vector(s)");
    }
    if spec.analysis.linear {
        let _ = writeln!(text, "computes  complex eigenvalues, growth rates and the type of instability");
    }
    if spec.analysis.response {
        let start = match spec.start {
            StartKind::Kick => "a kick at the sliding equilibrium",
            StartKind::Mode => "the most unstable mode",
        };
        let start = match spec.analysis.starts {
            Starts::Box(_) if spec.refine.is_some() => {
                format!("{start}, not from a box, which [refine] leaves out")
            }
            Starts::One => start.to_owned(),
            Starts::Both => format!("{start} and from a large start"),
            Starts::Box(samples) => format!("{start} and from {samples} start(s) of a box"),
        };
        let _ = writeln!(
            text,
            "computes  the response from {start}: settle {}, measure {}, at least {} steps per period",
            settle(spec),
            spec.measure,
            spec.steps_per_period
        );
    }
    if let Some(Settings { coarse, sample, .. }) = spec.refine {
        let _ = writeln!(
            text,
            "refines   from {coarse} cells along each side, and {sample} drawn at random: disk and cost are of the whole \
             grid, of which it computes a part"
        );
    }
    match &spec.grid {
        Grid::Axes(axes) => {
            for axis in axes {
                let _ = writeln!(text, "axis      {}", describe_axis(axis));
            }
        }
        Grid::Tuples { keys, rows } => {
            let names: Vec<&str> = keys.iter().map(|key| key.name()).collect();
            let _ = writeln!(text, "points    {} row(s) of {}", rows.len(), names.join(", "));
        }
    }
    text
}

/// The temperatures of each material, and how many of the sweep it does not have.
fn materials(spec: &Spec) -> String {
    let number = |value: &Value| if let Value::Number(number) = value { Some(*number) } else { None };
    let is_temperature = |key: &AxisKey| *key == AxisKey::Param(Param::Temperature);
    let varied: Vec<f64> = match &spec.grid {
        Grid::Axes(axes) => {
            let axis = axes.iter().find(|axis| is_temperature(&axis.key));
            axis.map_or(Vec::new(), |axis| axis.values.iter().filter_map(number).collect())
        }
        Grid::Tuples { keys, rows } => keys
            .iter()
            .position(is_temperature)
            .map_or(Vec::new(), |column| rows.iter().filter_map(|row| number(&row[column])).collect()),
    };
    let temperatures =
        if varied.is_empty() { spec.base.get(Param::Temperature).into_iter().collect() } else { varied };
    let mut text = String::new();
    for material in spec.material.iter().chain(&spec.materials) {
        let (low, high) = material.temperatures();
        let _ = write!(text, "material  {}: {low} to {high} °C", material.name);
        let beyond = temperatures.iter().filter(|value| !(low..=high).contains(*value)).count();
        if beyond > 0 {
            let of = temperatures.len();
            let _ = write!(
                text,
                "; {beyond} of {of} temperature(s) of the sweep lie outside and take the nearest row"
            );
        }
        text.push('\n');
    }
    text
}

/// The time before the measuring window.
fn settle(spec: &Spec) -> String {
    match spec.settle_limit {
        Some(limit) => format!("until settled (at most {limit})"),
        None => spec.settle.to_string(),
    }
}

/// `mu_s: 41 values from 0 to 0.6`.
fn describe_axis(axis: &Axis) -> String {
    let (name, count) = (axis.key.name(), axis.values.len());
    let unit = match axis.key {
        AxisKey::Param(param) => param.info().unit,
        AxisKey::Law | AxisKey::Material => "",
    };
    let scale = if axis.log { ", logarithmic" } else { "" };
    let listed = |values: &[Value]| values.iter().map(Value::to_string).collect::<Vec<_>>().join(", ");
    match axis.values.as_slice() {
        [one] => format!("{name} = {one} {unit}").trim_end().to_owned(),
        values if values.iter().any(|value| matches!(value, Value::Text(_))) => {
            format!("{name}: {}", listed(values))
        }
        [first, .., last] => {
            format!("{name}: {count} values from {first} to {last} {unit}").trim_end().to_owned() + scale
        }
        [] => name.to_owned(),
    }
}

/// What the sweep would take of the disk.
fn disk(spec: &Spec) -> String {
    let tiling = Tiling { instances: spec.grid.len(), tile: tile_of(spec, false) };
    let need = Need::new(tiling, spec.analysis);
    talk::tell("disk_bytes", json!({ "tiles": need.tiles, "table": need.table }));
    let table = need.table.map_or_else(
        || format!("no map.csv by itself, of more than {MOST_ROWS} rows"),
        |table| format!("{} of map.csv", bytes(table)),
    );
    format!("disk      about {} of tiles, {table}\n", bytes(need.tiles))
}

/// What the sweep would cost, measured on a few of its instances.
fn cost(spec: &Spec, estimate: &Estimate) -> String {
    let threads = rayon::current_num_threads();
    let total = estimate.cpu_time.as_secs_f64();
    talk::tell(
        "cost",
        json!({ "cpu_seconds": total, "threads": threads, "steps": estimate.steps, "sampled": estimate.sampled }),
    );
    let steps =
        if spec.analysis.response { format!("{:.1e} steps, ", estimate.steps) } else { String::new() };
    let [about, cut_short] = match estimate.cut_short {
        0 => ["about", ""].map(str::to_owned),
        cut => [
            "at least".to_owned(),
            format!(", {cut} of them only in part, as their steps are too many: more if they become stiffer"),
        ],
    };
    format!(
        "cost      {about} {steps}{} on {threads} thread(s), {} on one (measured on {} of the instances{cut_short})\n",
        seconds(total / threads as f64),
        seconds(total),
        estimate.sampled
    )
}
