//! The names that figures give to the columns of a map.

use crate::results::number::NumberColumn;
use squealmap_figure::scale::axis_unit;
use squealmap_figure::text::Text;

/// Columns and their names in print, a long one and one for narrow places; symbols stand in braces.
const NAMES: [(&str, &str, &str); 29] = [
    ("growth_rate", "Growth rate {σ}", "{σ}"),
    ("growth_rate_flat", "Growth rate without the friction slope", "{σ}, no slope"),
    ("growth_rate_frozen", "Growth rate at constant normal force", "{σ}, constant {N}"),
    ("growth_rate_measured", "Growth rate before the first event", "{σ}, measured"),
    ("frequency", "Frequency of the least stable mode", "{f}"),
    ("frequency_measured", "Frequency before the first event", "{f}, measured"),
    ("response_frequency", "Response frequency", "{f}, response"),
    ("phase", "Phase of {ÿ_1} against {ẍ_2} in the mode", "{φ}, mode"),
    ("phase_measured", "Phase of {ÿ_1} against {ẍ_2} before the first event", "{φ}, measured"),
    ("phase_cycle", "Phase of {ÿ_1} against {ẍ_2} in the response", "{φ}, response"),
    ("x2_mean", "Mean of {x_2}", "Mean of {x_2}"),
    ("x2_std", "Standard deviation of {x_2}", "Std. of {x_2}"),
    ("y1_mean", "Mean of {y_1}", "Mean of {y_1}"),
    ("y1_std", "Standard deviation of {y_1}", "Std. of {y_1}"),
    ("ax_rms", "Root mean square of {ẍ_2}", "Rms of {ẍ_2}"),
    ("ay_rms", "Root mean square of {ÿ_1}", "Rms of {ÿ_1}"),
    ("ax_peak", "Largest |{ẍ_2}|", "Largest |{ẍ_2}|"),
    ("ay_peak", "Largest |{ÿ_1}|", "Largest |{ÿ_1}|"),
    ("friction_mean", "Mean friction coefficient {T}/{N}", "Mean {T}/{N}"),
    ("n_peak", "Largest normal force {N}", "Largest {N}"),
    ("stick", "Fraction of time in stick", "Stick"),
    ("free", "Fraction of time in free flight", "Free flight"),
    ("reverse", "Fraction of time in reversed slip", "Reversed slip"),
    ("impacts_per_second", "Impacts per second", "Impacts"),
    ("check_error", "Relative error that a check found", "Error"),
    ("basin_equilibrium", "Starts in a box that end in sliding", "Sliding"),
    ("basin_oscillation", "Starts in a box that end in oscillation", "Oscillation"),
    ("basin_other", "Starts in a box that end otherwise", "Otherwise"),
    ("basin_failed", "Starts in a box that failed", "Failed"),
];

/// The end of the name of a column of the large start.
const LARGE: &str = "_large";

/// The name of a column within `room` points at this size, and its unit with a power of ten.
pub(crate) fn label(column: &NumberColumn, exponent: i32, room: f64, size: f64) -> Text {
    let unit = column.unit.replace("deg", "°");
    let unit = if unit.is_empty() && exponent == 0 { Text::default() } else { axis_unit(&unit, exponent) };
    let (name, large) = match column.name.strip_suffix(LARGE) {
        Some(name) => (name, ", large start"),
        None => (column.name.as_str(), ""),
    };
    let found = NAMES.iter().find(|(column, ..)| *column == name);
    let [long, short] = match found {
        Some((_, long, short)) => [marked(long), marked(short)],
        None => [(); 2].map(|()| Text::from(capital(&name.replace('_', " ")))),
    };
    let long = long.plain(large).then(unit.clone());
    if long.width(size, false) <= room { long } else { short.plain(large).then(unit.clone()) }
}

/// A text whose symbols stand in braces.
fn marked(words: &str) -> Text {
    words.split('{').enumerate().fold(Text::default(), |text, (place, part)| match part.split_once('}') {
        Some((symbol, rest)) if place > 0 => text.symbol(symbol).plain(rest),
        _ => text.plain(part),
    })
}

/// A phrase with a capital letter.
pub(crate) fn capital(phrase: &str) -> String {
    let mut letters = phrase.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(name: &str) -> NumberColumn {
        let text = |text: &str| text.to_owned();
        NumberColumn { name: text(name), unit: text("m"), meaning: String::new(), values: Vec::new() }
    }

    #[test]
    fn columns_have_names_in_print() {
        let x2 = Text::from("Standard deviation of ").symbol("x_2");
        assert_eq!(label(&column("x2_std"), 0, 500.0, 8.0), x2.clone().plain(" (m)"));
        assert_eq!(label(&column("x2_std_large"), 0, 500.0, 8.0), x2.plain(", large start (m)"));
        let short = Text::from("Std. of ").symbol("x_2").plain(" (m)");
        assert_eq!(label(&column("x2_std"), 0, 60.0, 8.0), short);
        assert_eq!(label(&column("simulated_time"), 0, 500.0, 8.0), Text::from("Simulated time (m)"));
        let force = Text::from("Largest normal force ").symbol("N").plain(" (m)");
        assert_eq!(label(&column("n_peak"), 0, 500.0, 8.0), force);
    }

    #[test]
    fn every_name_is_that_of_a_column() {
        use crate::results::columns::columns;
        use crate::sweep::grid::Grid;
        use crate::sweep::spec::{Analysis, Starts};
        let asked =
            |starts| Analysis { linear: true, response: true, until_settled: true, checked: true, starts };
        let grid = Grid::Axes(Vec::new());
        let mut known: Vec<&str> = Vec::new();
        for starts in [Starts::One, Starts::Box(3)] {
            known.extend(columns(&grid, asked(starts)).iter().map(|column| column.name));
        }
        for (name, ..) in NAMES {
            assert!(known.contains(&name), "{name}");
        }
    }
}
