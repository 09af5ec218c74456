//! `hysteresis.csv` and `hysteresis.json`: both branches of a parameter read back.

use crate::engine::outcome::Outcome;
use crate::engine::record::Record;
use crate::model::Param;
use crate::results::figure::heading::Heading;
use crate::results::read::folder::{Folder, Table, Why, headed};
use crate::results::read::map;
use crate::study::cycles::branch::{Branch, BranchPoint};
use crate::study::cycles::special::Special;
use crate::study::error::Result;
use crate::study::hysteresis::follow::{Direction, Hysteresis};
use crate::study::hysteresis::table::{Document, OF_CYCLES};

/// The files that are read.
pub(crate) const FILES: [&str; 2] = ["hysteresis.csv", "hysteresis.json"];

/// The branches of cycles, where there are any.
const CYCLES: &str = "cycles.csv";

/// Both branches and their heading; of the records type, regime, whether they are settled, `x2_std` and `ay_rms` are read.
pub(crate) fn read(folder: Folder<'_>) -> Result<(Hysteresis, Heading)> {
    let table = folder.table(FILES[0])?;
    let document = headed(folder.json(FILES[1])?).map_err(|why| folder.bad(FILES[1], why))?;
    let Document { heading, parameter } = document;
    let param = param(&parameter).map_err(|why| folder.bad(FILES[1], why))?;
    let mut hysteresis = branches(&table, param).map_err(|why| folder.bad(FILES[0], why))?;
    // Directories of earlier versions have no branches of cycles.
    if folder.0.join(CYCLES).is_file() {
        let table = folder.table(CYCLES)?;
        hysteresis.cycles = cycles(&table, param).map_err(|why| folder.bad(CYCLES, why))?;
    }
    Ok((hysteresis, heading))
}

fn cycles(table: &Table, param: Param) -> Why<Vec<Branch>> {
    let [number, _, special] = OF_CYCLES;
    let numbers = table.numbers([number, OF_CYCLES[1], param.info().name, "x2_std"])?;
    let mut branches: Vec<Branch> = Vec::new();
    for (row, [number, unstable, value, x2_std]) in table.rows.iter().zip(numbers) {
        if !value.is_finite() {
            return Err(format!("`{}` is {value}, which is no value of it", param.info().name));
        }
        let name = table.cell(row, special);
        let special = Special::of(name);
        if special.is_none() && !name.is_empty() {
            return Err(format!("`special` is `{name}`, which is nothing that a branch has"));
        }
        let [number, unstable] = [whole(number, "cycle_branch")?, whole(unstable, "unstable_multipliers")?];
        if number > branches.len() {
            return Err(format!("`cycle_branch` is {number} without the branches before it"));
        }
        if number == branches.len() {
            branches.push(Branch::default());
        }
        let record = with_sizes(map::record(table, row)?, [x2_std, f64::NAN]);
        branches[number].points.push(BranchPoint { value, unstable, special, record });
    }
    Ok(branches)
}

/// A number of things.
fn whole(value: f64, name: &str) -> Why<usize> {
    /// More than any table holds.
    const MOST: f64 = 1e6;
    let is_whole = (0.0..=MOST).contains(&value) && value.fract() == 0.0;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a whole number of the range"
    )]
    let whole = value as usize;
    if is_whole { Ok(whole) } else { Err(format!("`{name}` is {value}, which is no number of things")) }
}

/// A record with a standard deviation of `x2` and an rms value of `ÿ1`, which tell oscillations apart.
fn with_sizes(record: Record, sizes: [f64; 2]) -> Record {
    let [x2_std, ay_rms] = sizes.map(|size| size.is_finite().then_some(size));
    let outcome = Outcome { status: record.status, x2_std, ay_rms, ..Outcome::default() };
    Record { outcome: Some(Box::new(outcome)), ..record }
}

fn param(name: &str) -> Why<Param> {
    Param::from_name(name).ok_or_else(|| format!("`parameter` is `{name}`, which is no parameter"))
}

fn branches(table: &Table, param: Param) -> Why<Hysteresis> {
    let numbers = table.numbers([param.info().name, "x2_std", "ay_rms"])?;
    let branch = |direction: Direction| -> Why<Vec<(f64, Record)>> {
        let of_branch =
            table.rows.iter().zip(&numbers).filter(|(row, _)| table.cell(row, "branch") == direction.name());
        of_branch
            .map(|(row, [value, x2_std, ay_rms])| {
                Ok((*value, with_sizes(map::record(table, row)?, [*x2_std, *ay_rms])))
            })
            .collect()
    };
    let [up, mut down] = [branch(Direction::Up)?, branch(Direction::Down)?];
    down.reverse();
    let values: Vec<f64> = up.iter().map(|(value, _)| *value).collect();
    let same = |[a, b]: [f64; 2]| a.to_bits() == b.to_bits();
    if values.is_empty()
        || values.len() != down.len()
        || !values.iter().zip(&down).all(|(a, (b, _))| same([*a, *b]))
    {
        return Err("does not hold the same values on the way up and on the way down".to_owned());
    }
    let records = |branch: Vec<(f64, Record)>| branch.into_iter().map(|(_, record)| record).collect();
    Ok(Hysteresis { param, values, up: records(up), down: records(down), cycles: Vec::new() })
}
