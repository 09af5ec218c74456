//! Which columns a table, a tile or a reader has, from the one table.

use crate::sweep::columns::column::{Column, Group};
use crate::sweep::columns::table::{COMPUTED, LARGE};
use crate::sweep::columns::values::{Place, Share, Values};
use crate::sweep::grid::Grid;
use crate::sweep::spec::{Analysis, Starts};

/// The columns of a sweep's table in order; those of an analysis that was not asked for are left out.
#[must_use]
pub fn columns(grid: &Grid, analysis: Analysis) -> Vec<Column> {
    let swept = grid.keys().into_iter().enumerate().map(|(position, key)| Column::swept(position, key));
    let asked = |column: &&Column| column.group.is_asked(analysis);
    // What concerns both starts stands in the columns of the small one.
    let of_large = |column: &&Column| {
        analysis.starts == Starts::Both && !matches!(column.group, Group::Linear | Group::Starts)
    };
    let small = computed().filter(|column| !column.is_of_large_start);
    let large = computed().filter(|column| column.is_of_large_start).filter(of_large);
    let of_records = small.chain(large).filter(asked).copied();
    std::iter::once(Column::INSTANCE).chain(swept).chain(of_records).collect()
}

/// Every column of records that a table may have: those of the only or the small start, then those of the large one.
pub fn computed() -> impl Iterator<Item = &'static Column> {
    COMPUTED.iter().chain(LARGE).filter(|column| !column.is_hidden)
}

/// The column of records with this name.
#[must_use]
pub fn find(name: &str) -> Option<&'static Column> {
    computed().find(|column| column.name == name)
}

/// The numbers that tiles keep of one start, in their order: analysis by analysis, in each as in the table.
pub fn numbers(analysis: Analysis) -> impl Iterator<Item = Place> {
    [Group::Linear, Group::Response, Group::Settling, Group::Cycles, Group::Checks]
        .into_iter()
        .filter(move |group| group.is_asked(analysis))
        .flat_map(|group| COMPUTED.iter().filter(move |column| column.group == group))
        .filter_map(|column| column.values().and_then(Values::place))
}

/// The counts of the starts of a box, in order.
pub fn shares() -> impl Iterator<Item = Share> {
    COMPUTED.iter().filter_map(|column| match column.values() {
        Some(Values::Share(share)) => Some(share),
        _ => None,
    })
}
