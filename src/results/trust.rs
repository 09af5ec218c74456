//! Which numbers of a map cannot be trusted: those of a measuring window in which the response has not settled, or in which a vibration that ends in the
//! equilibrium has not died out.

use crate::engine::record::Record;
use crate::engine::regime::Regime;
use crate::results::number::NumberColumn;
use crate::sweep::columns::Window;
use crate::sweep::label::Label;

/// Whether a column is one of the large start of two.
pub(crate) fn is_of_large_start(column: &NumberColumn) -> bool {
    column.row().is_some_and(|row| row.is_of_large_start)
}

/// Whether the values of a column mean little where the response has not settled.
pub(crate) fn is_of_the_window(column: &NumberColumn) -> bool {
    column.row().is_some_and(|row| row.window != Window::Not)
}

/// Which values of a column are not those of a settled response.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Doubt<'a> {
    column: &'a NumberColumn,
    /// Size of a vibration above which an instance that ends in its equilibrium still decays; `None` for what is not one.
    decays: Option<f64>,
}

impl<'a> Doubt<'a> {
    /// Of a column.
    pub(crate) fn of(column: &'a NumberColumn) -> Doubt<'a> {
        /// The part of the largest value of the map.
        const LEFT: f64 = 0.01;
        let largest = || column.values.iter().flatten().fold(0.0, |most: f64, value| most.max(value.abs()));
        let is_vibration = column.row().is_some_and(|row| row.window == Window::Vibration);
        Doubt { column, decays: is_vibration.then(|| LEFT * largest()) }
    }

    /// Whether the value of an instance with this label, from the start that the column belongs to, is none.
    pub(crate) fn is_unsettled(&self, label: Label, value: Option<f64>) -> bool {
        let decays = || {
            let left = self.decays.zip(value).is_some_and(|(most, value)| value.abs() > most);
            left && label.regime() == Some(Regime::Equilibrium)
        };
        is_of_the_window(self.column) && (label.settled() == Some(false) || decays())
    }

    /// The same of a record.
    pub(crate) fn is_unsettled_in(&self, record: &Record, value: Option<f64>) -> bool {
        let of = if is_of_large_start(self.column) { record.large() } else { Some(record) };
        of.is_some_and(|of| self.is_unsettled(Label::from(of), value))
    }
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
