//! The names that figures give to the columns of a map.

use crate::results::number::NumberColumn;
use crate::sweep::columns::LARGE_SUFFIX;
use squealmap_figure::scale::axis_unit;
use squealmap_figure::text::Text;

/// The name of a column within `room` points at this size, and its unit with a power of ten.
pub(crate) fn label(column: &NumberColumn, exponent: i32, room: f64, size: f64) -> Text {
    let unit = axis_unit(&column.unit.replace("deg", "°"), exponent);
    let (name, large) = match column.name.strip_suffix(LARGE_SUFFIX) {
        Some(name) => (name, ", large start"),
        None => (column.name.as_str(), ""),
    };
    let [long, short] = match column.row() {
        Some(row) => row.print.map(marked),
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
}
