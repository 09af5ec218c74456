//! Scales of maps that are read otherwise than by differences: by ratios, as half a turn, as counts.

use crate::results::angles::{attribute, drawn, sweep};
use squealmap::results::number::NumberColumn;
use squealmap::sweep::columns::find;

/// The figure of two by two values of a column, and the places of their colours in its bar, 0 to 1; white, which the paper is, is 0.
fn shown(name: &str, values: [f64; 4]) -> (String, Vec<f64>) {
    let row = find(name).expect("a column of maps");
    let values = values.map(Some).to_vec();
    let column =
        NumberColumn { name: name.to_owned(), unit: row.unit.to_owned(), meaning: String::new(), values };
    let (svg, bar) = drawn(&sweep(2, 2), &column);
    let fills =
        svg.lines().filter(|line| line.starts_with("<path")).filter_map(|line| attribute(line, "fill"));
    let place = |fill: &str| bar.iter().position(|step| step == fill).map(|at| at as f64 / bar.len() as f64);
    let mut places: Vec<f64> = fills.filter_map(place).collect();
    places.sort_by(f64::total_cmp);
    (svg, places)
}

fn ticks(svg: &str) -> Vec<&str> {
    svg.lines().filter_map(|line| line.split_once('>')?.1.strip_suffix("</text>")).collect()
}

/// Memories of 1 to 1000 periods are a decade apart, each a third of the bar.
#[test]
fn memories_are_read_by_their_ratios() {
    let (svg, places) = shown("disturbance_periods", [1.0, 10.0, 100.0, 1000.0]);
    assert!(["10", "100"].iter().all(|tick| ticks(&svg).contains(tick)), "{:?}", ticks(&svg));
    let [.., third, two_thirds, last] = places[..] else { panic!("{places:?}") };
    let near = |place: f64, to: f64| (place - to).abs() < 0.04;
    assert!(near(third, 1.0 / 3.0) && near(two_thirds, 2.0 / 3.0) && near(last, 1.0), "{places:?}");
}

/// The angle of a multiplier has no other side: its scale goes from a fold to a doubling, whatever the map has.
#[test]
fn the_angle_of_a_multiplier_is_half_a_turn() {
    let (svg, places) = shown("floquet_angle", [90.0; 4]);
    assert!(ticks(&svg).contains(&"150") && !svg.contains("−180"), "{:?}", ticks(&svg));
    assert!(matches!(places[..], [middle] if (middle - 0.5).abs() < 0.04), "{places:?}");
}

/// Returns are counted in whole numbers.
#[test]
fn small_counts_have_whole_ticks() {
    let (svg, _) = shown("cycle_returns", [1.0, 1.0, 2.0, 4.0]);
    let of_bar: Vec<&str> = ticks(&svg).into_iter().filter(|tick| tick.len() == 1).collect();
    assert!(["0", "1", "2", "3", "4"].iter().all(|tick| of_bar.contains(tick)), "{of_bar:?}");
    assert!(!ticks(&svg).iter().any(|tick| tick.ends_with(".5")), "{:?}", ticks(&svg));
}
