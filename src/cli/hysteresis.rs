//! `squealmap trace --sweep-up-down`: a motion followed while a parameter rises and falls.

use std::process::ExitCode;

use crate::cli::error::{Error, Result};
use crate::cli::failed::told;
use crate::cli::files::Files;
use crate::cli::output::list;
use crate::cli::pictures::png_of;
use crate::cli::talk;
use crate::cli::talk::print;
use squealmap::engine::plan::Plan;
use squealmap::model::status::Status;
use squealmap::model::{PARAMS, Param};
use squealmap::results::figure::heading::Heading;
use squealmap::results::figure::look::Look;
use squealmap::study::cycles::branch::{Branch, BranchPoint};
use squealmap::study::hysteresis::follow::{Direction, Hysteresis, can_follow};
use squealmap::study::hysteresis::table::{cycles_csv, document, hysteresis_csv, hysteresis_svg};
use squealmap::sweep::grid::spaced;
use squealmap::sweep::spec::Spec;
use squealmap::sweep::spec::names::advice;
use squealmap_input::quote::rounded;

/// The files that are written.
const FILES: [&str; 5] =
    ["cycles.csv", "hysteresis.csv", "hysteresis.json", "hysteresis.png", "hysteresis.svg"];

/// A parameter and its lowest and highest value.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Range {
    param: Param,
    from: f64,
    to: f64,
}

impl Range {
    /// Reads `mu_s=0.1..0.6`.
    pub(crate) fn parse(text: &str) -> std::result::Result<Range, String> {
        let syntax = || "write name=from..to, such as mu_s=0.1..0.6".to_owned();
        let (name, range) = text.split_once('=').ok_or_else(syntax)?;
        // A third dot would make `1...2` a range to 0.2.
        let (from, to) = range.split_once("..").filter(|(_, to)| !to.starts_with('.')).ok_or_else(syntax)?;
        let param = Param::from_name(name.trim()).ok_or_else(|| {
            let names: Vec<&str> = PARAMS.iter().map(|row| row.name).collect();
            let (name, advice) = (name.trim(), advice(name.trim(), &names));
            format!("`{name}` is no parameter of a sweep file with numbers as values; {advice}")
        })?;
        if !can_follow(param) {
            return Err(format!(
                "`{}` says how a motion starts or ends, and cannot be followed",
                param.info().name
            ));
        }
        let number = |text: &str| {
            let limits = param.info().range;
            let value = text.trim().parse().ok().filter(|value: &f64| limits.contains(*value));
            value.ok_or_else(|| {
                format!("`{}` is `{}`, but has to be {limits}", param.info().name, text.trim())
            })
        };
        let (from, to) = (number(from)?, number(to)?);
        if from < to {
            Ok(Range { param, from, to })
        } else {
            Err(format!("the range from {from} to {to} does not rise; write the lower value first"))
        }
    }

    /// The values of the sweep: `points` of them with equal steps and exact ends.
    fn values(&self, points: u32) -> Vec<f64> {
        let points = points as usize;
        (0..points).map(|at| spaced([self.from, self.to], points, false, at)).collect()
    }
}

/// Follows the instance `at` over the range and writes both branches.
pub(crate) fn execute(spec: &Spec, files: &Files, at: &str, range: &Range, points: u32) -> Result<ExitCode> {
    let name = range.param.info().name;
    let is_named = |pair: &str| pair.split_once('=').is_some_and(|(other, _)| other.trim() == name);
    if at.split(',').any(is_named) {
        return Err(Error::FollowedAndFixed { name });
    }
    let instance = |value: f64| {
        let comma = if at.trim().is_empty() { "" } else { "," };
        spec.instance_at(&format!("{at}{comma}{name}={value}"))
    };
    let first = instance(range.from)?;
    if let Some(motion) = first.motion.moves(&first.params) {
        return Err(Error::FollowsRamp { what: "`--sweep-up-down`", motion });
    }
    let output = files.prepare_beside(&FILES)?;
    let found = Hysteresis::follow(range.param, range.values(points), &Plan::new(spec), instance)?;
    let heading = Heading::new(&spec.title, at);
    let svg = hysteresis_svg(&found, &heading, &Look::default());
    let files = [
        (FILES[0], cycles_csv(spec, &found)?),
        (FILES[1], hysteresis_csv(spec, &found)?),
        (FILES[2], document(&found, &heading)?),
        (FILES[3], png_of(&svg)?),
        (FILES[4], svg.into_bytes()),
    ];
    let paths = output.write(&files)?;
    let branches = Direction::ALL.map(|direction| {
        let between = |[a, b]: &[f64; 2]| format!("{} and {}", shown(*a), shown(*b));
        let all = |jumps: Vec<[f64; 2]>| jumps.iter().map(between).collect::<Vec<_>>().join(", ");
        let [ends, cycles] = [all(found.jumps(direction)), all(found.jumps_of_amplitude(direction))];
        let ends = if ends.is_empty() {
            "no jump between sliding and oscillation".to_owned()
        } else {
            format!("a jump between {ends}")
        };
        let cycles = if cycles.is_empty() {
            String::new()
        } else {
            format!("; from one oscillation to another between {cycles}")
        };
        format!("{name} {}: {ends}{cycles}\n", direction.name())
    });
    let records = || Direction::ALL.iter().flat_map(|direction| found.branch(*direction));
    let unsettled = records().filter(|record| record.settled == Some(false)).count();
    let of = |status: Status| records().filter(|record| record.status == status).count() as u64;
    let total = 2 * found.values.len();
    let failed = total as u64 - of(Status::Ok);
    let told = told(of);
    let apart: Vec<String> = found.apart().iter().map(|range| place(*range)).collect();
    let apart = if apart.is_empty() {
        "the branches end alike at every value\n".to_owned()
    } else {
        format!("the branches end differently {}\n", apart.join(", "))
    };
    let cycles: String = found.cycles.iter().map(|branch| said(branch, name)).collect();
    let is_plain = |branch: &Branch| branch.points.iter().all(|point| point.special.is_none());
    let stays = found.cycles.iter().all(is_plain)
        && Direction::ALL.iter().all(|direction| found.jumps(*direction).is_empty());
    let hint = if stays && found.apart().is_empty() {
        "no branch leaves the state in which it begins: inside a bistable band the other one is never met; \
         begin outside of it (a wider range), or with a larger start\n"
    } else {
        ""
    };
    let warning = match unsettled {
        0 => String::new(),
        some => format!("{some} of {total} values had not settled\n"),
    };
    let failures = match failed {
        0 => String::new(),
        some => format!("{some} of {total} values have no result: {told}\n"),
    };
    if failed == total as u64 {
        print(&list(&paths));
        talk::error(&format!("no value has a result: {told}"));
        return Ok(ExitCode::FAILURE);
    }
    print(&format!("{}{apart}{cycles}{hint}{warning}{failures}{}", branches.concat(), list(&paths)));
    Ok(ExitCode::SUCCESS)
}

/// Where a range of values is, in words.
fn place([from, to]: [f64; 2]) -> String {
    let [first, last] = [from, to].map(|value| shown(value).to_string());
    if first == last { format!("at {first}") } else { format!("from {first} to {last}") }
}

/// A sentence on a branch of cycles: where it is stable, and what is special about it.
fn said(branch: &Branch, name: &str) -> String {
    let special: Vec<String> = branch
        .points
        .iter()
        .filter_map(|point| Some((point.special?, point.value)))
        .map(|(special, value)| format!("{} at {value:.9}", special.name()))
        .collect();
    let special = if special.is_empty() { String::new() } else { format!(": {}", special.join(", ")) };
    let end = |end: Option<&BranchPoint>| end.map_or(f64::NAN, |end| rounded(end.value));
    let (from, to) = (end(branch.points.first()), end(branch.points.last()));
    let to = if from.to_bits() == to.to_bits() { "and back".to_owned() } else { format!("to {to}") };
    format!("a branch of cycles from {name} = {from} {to}{special}\n")
}

/// A value without the rounding of its place on an axis.
fn shown(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}
