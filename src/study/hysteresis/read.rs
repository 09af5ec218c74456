//! `hysteresis.csv` and `hysteresis.json`: both branches of a parameter read back.

use crate::engine::outcome::Outcome;
use crate::engine::record::Record;
use crate::model::Param;
use crate::results::figure::heading::Heading;
use crate::results::read::folder::{Folder, Table, Why, headed};
use crate::results::read::map;
use crate::study::error::Result;
use crate::study::hysteresis::follow::{Direction, Hysteresis};
use crate::study::hysteresis::table::Document;

/// The files that are read.
pub(crate) const FILES: [&str; 2] = ["hysteresis.csv", "hysteresis.json"];

/// Both branches and their heading; of the records type, regime, whether they are settled and `x2_std` are read.
pub(crate) fn read(folder: Folder<'_>) -> Result<(Hysteresis, Heading)> {
    let table = folder.table(FILES[0])?;
    let document = headed(folder.json(FILES[1])?).map_err(|why| folder.bad(FILES[1], why))?;
    let Document { heading, parameter } = document;
    let param = param(&parameter).map_err(|why| folder.bad(FILES[1], why))?;
    let hysteresis = branches(&table, param).map_err(|why| folder.bad(FILES[0], why))?;
    Ok((hysteresis, heading))
}

fn param(name: &str) -> Why<Param> {
    Param::from_name(name).ok_or_else(|| format!("`parameter` is `{name}`, which is no parameter"))
}

fn branches(table: &Table, param: Param) -> Why<Hysteresis> {
    let numbers = table.numbers([param.info().name, "x2_std"])?;
    let branch = |direction: Direction| -> Why<Vec<(f64, Record)>> {
        let of_branch =
            table.rows.iter().zip(&numbers).filter(|(row, _)| table.cell(row, "branch") == direction.name());
        of_branch
            .map(|(row, [value, x2_std])| {
                let record = map::record(table, row)?;
                let outcome = Outcome {
                    status: record.status,
                    x2_std: x2_std.is_finite().then_some(*x2_std),
                    ..Outcome::default()
                };
                Ok((*value, Record { outcome: Some(Box::new(outcome)), ..record }))
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
    Ok(Hysteresis { param, values, up: records(up), down: records(down) })
}
