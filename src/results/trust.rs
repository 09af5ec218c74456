//! Which numbers of a map cannot be trusted: those of a measuring window in which the response has not settled.

use crate::engine::record::Record;
use crate::results::number::NumberColumn;

/// Whether a column is one of the large start of two.
pub(crate) fn is_of_large_start(column: &NumberColumn) -> bool {
    column.row().is_some_and(|row| row.is_of_large_start)
}

/// Whether the values of a column mean little where the response has not settled.
pub(crate) fn is_of_the_window(column: &NumberColumn) -> bool {
    column.row().is_some_and(|row| row.is_of_the_window)
}

/// Whether the value of this record in a column is that of a response that has not settled.
pub(crate) fn is_unsettled(column: &NumberColumn, record: &Record) -> bool {
    let settled = if is_of_large_start(column) {
        record.large().and_then(|large| large.settled)
    } else {
        record.settled
    };
    is_of_the_window(column) && settled == Some(false)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::columns::{Content, Group, columns};
    use crate::sweep::grid::Grid;
    use crate::sweep::spec::{Analysis, Starts};

    /// Every number of the response is of the window or is named here.
    #[test]
    fn every_number_of_the_response_is_of_the_window_or_not() {
        const OTHERS: [&str; 4] =
            ["growth_rate_measured", "frequency_measured", "phase_measured", "simulated_time"];
        let asked = Analysis {
            linear: true,
            response: true,
            until_settled: true,
            finds_cycles: true,
            checked: true,
            starts: Starts::Both,
        };
        let all = columns(&Grid::Axes(Vec::new()), asked);
        let numbers =
            all.iter().filter(|one| one.group == Group::Response && one.content() == Content::Number);
        let mut seen = 0;
        for one in numbers {
            let column = NumberColumn {
                name: one.name.to_owned(),
                unit: String::new(),
                meaning: String::new(),
                values: Vec::new(),
            };
            assert_ne!(is_of_the_window(&column), OTHERS.contains(&one.quantity()), "{}", one.name);
            assert_eq!(is_of_large_start(&column), one.name != one.quantity(), "{}", one.name);
            seen += 1;
        }
        assert!(seen >= 40, "only {seen} were seen");
    }
}
