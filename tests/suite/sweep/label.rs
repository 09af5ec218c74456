//! Labels in two bytes, their counts, and figures that hold labels only.

use crate::results::figure::{colour, draw, frames};
use crate::synthetic::{failed, map, number, record, span};
use squealmap::engine::record::{Basin, Others, Record};
use squealmap::engine::regime::Regime;
use squealmap::model::Param;
use squealmap::model::kind::InstabilityType;
use squealmap::model::status::Status;
use squealmap::results::figure::map::map_svg;
use squealmap::sweep::grid::Grid;
use squealmap::sweep::label::{Label, Tally};

/// Every combination of what a label holds.
fn all() -> Vec<Record> {
    let with_none = |count: usize| (0..count).map(Some).chain([None]).collect::<Vec<_>>();
    let mut all = Vec::new();
    for status in Status::IN_MAP.into_iter().chain([Status::Unwritten]) {
        for kind in with_none(7) {
            for regime in with_none(7) {
                for settled in [None, Some(false), Some(true)] {
                    let kind = kind.map(|k| InstabilityType::ALL[k]);
                    let regime = regime.map(|k| Regime::ALL[k]);
                    all.push(Record { status, kind, regime, settled, ..Record::default() });
                }
            }
        }
    }
    all
}

#[test]
fn a_label_holds_what_the_record_says() {
    let records = all();
    assert_eq!(records.len(), 9 * 8 * 8 * 3);
    for record in &records {
        let label = Label::from(record);
        let found = (label.status(), label.kind(), label.regime(), label.settled());
        assert_eq!(found, (record.status, record.kind, record.regime, record.settled));
    }
    assert_eq!(Label::from(&Record::NOT_COMPUTED), Label::NOT_COMPUTED);
}

#[test]
fn a_tally_counts_in_any_order_and_in_parts() {
    let records = all();
    let mut tally = Tally::default();
    tally.add_missing(5);
    for part in records.chunks(7).rev() {
        tally.add(part);
    }
    assert_eq!(tally.total(), records.len() + 5);
    // A ninth of them has each status.
    assert_eq!(tally.computed(), records.len() / 9 * 8);
    assert_eq!(tally.count(|label| label.kind() == Some(InstabilityType::Stable)), records.len() / 8);
    assert_eq!(tally.count(|label| label.settled() == Some(false)), records.len() / 3);
    let mut whole = Tally::of(&records);
    whole.add_missing(5);
    assert_eq!(whole, tally);
}

/// Of starts beside the small one those that failed are counted, and no others.
#[test]
fn a_tally_counts_the_starts_that_failed() {
    let small = || record(InstabilityType::Stable, Regime::Equilibrium, true);
    let large = |large| Record { others: Some(Others::Large(Box::new(large))), ..small() };
    let boxed = |basin| Record { others: Some(Others::Basin(basin)), ..small() };
    let basin = Basin { equilibrium: 1, oscillation: 2, other: 3, failed: 4 };
    let tally = Tally::of(&[
        large(small()),
        large(failed(Status::Painleve)),
        large(failed(Status::EventLimit)),
        large(failed(Status::Painleve)),
        boxed(basin),
        boxed(Basin { failed: 0, ..basin }),
        boxed(basin),
        failed(Status::Painleve),
    ]);
    let counted: Vec<_> = tally.failed().collect();
    assert_eq!(counted, [("event_limit", 1), ("painleve", 2)]);
    assert_eq!(tally.failed_in_boxes(), 8);
}

#[test]
fn more_values_than_a_print_resolves_are_selected_evenly() {
    // Stable up to 0.25, failed from 0.75 on, of 10001 values.
    let sweep = map(Grid::Axes(vec![span(Param::MuD, 0.0, 1.0, 10_001)]), |_, at| match number(at[0]) {
        ..0.25 => record(InstabilityType::Stable, Regime::Equilibrium, true),
        ..0.75 => record(InstabilityType::ModeCoupling, Regime::Slip, true),
        _ => failed(Status::Painleve),
    });
    let svg = map_svg(&sweep).expect("a complete map");
    let words: String = svg.split(['<', '>']).skip(1).collect::<Vec<_>>().join(" ");
    assert!(words.contains("4096 of 10001 values of mu_d shown; the table holds all instances."), "{words}");
    // The counts are those of all.
    assert_eq!(svg.matches(">stable 25.0 %<").count(), 1, "{words}");
    let picture = draw(&svg, "selected");
    let frame = frames(&svg)[0];
    for (left, right) in [(0.245, 0.255), (0.745, 0.755)] {
        assert_ne!(colour(&picture, frame, (left, 0.5)), colour(&picture, frame, (right, 0.5)));
    }
    assert_eq!(colour(&picture, frame, (0.05, 0.5)), colour(&picture, frame, (0.24, 0.5)));
    assert_eq!(colour(&picture, frame, (0.26, 0.5)), colour(&picture, frame, (0.74, 0.5)));
}
