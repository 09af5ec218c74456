//! The bar that says which value has which colour, and below it what hatching and dots mean.

use crate::engine::record::Basin;
use crate::results::figure::field::Field;
use crate::results::figure::panels::Panels;
use crate::results::figure::quantity::UNDEFINED;
use crate::results::figure::tones::Tones;
use squealmap_figure::cyclic;
use squealmap_figure::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room};
use squealmap_figure::key::{self, Sample};
use squealmap_figure::scale::{Scale, Tick};
use squealmap_figure::svg::{Anchor, Style, Svg, polyline};
use squealmap_figure::text::Text;

/// Height of the bar, points.
const BAR: f64 = 7.0;
/// The bar is no longer than this, points.
const LONGEST: f64 = 220.0;
/// The sample of what has not settled.
const DOTTED: &str = r##"fill="url(#dots-on-light)" stroke="#000000" stroke-width="0.4""##;
/// A mark in the bar: as a line of equal value, on a light casing.
const MARKS: [&str; 2] = [
    r##"fill="none" stroke="#FFFFFF" stroke-width="1.5""##,
    r##"class="level" fill="none" stroke="#000000" stroke-width="0.6""##,
];

/// Draws the bar from `(x, y)` downwards, and below it what hatching and dots mean. Returns the height of both.
pub(crate) fn draw(field: &Field<'_>, panels: &Panels, svg: &mut Svg, [x, y]: [f64; 2], width: f64) -> f64 {
    if let Tones::Named(names) = field.tones {
        return named(field, names, panels, svg, [x, y], width);
    }
    let beside = Text::from(field.label);
    let room = beside.width(TICK_SIZE, false) + 6.0;
    let frame = Frame { x, y, width: (width - room).min(LONGEST), height: BAR };
    let tones = field.tones;
    let wide = frame.width / tones.steps() as f64;
    svg.open(r#"shape-rendering="crispEdges""#);
    for number in 0..tones.steps() {
        // Each reaches to the end and is covered by those that follow: no seams.
        let left = number as f64 * wide;
        svg.rect([x + left, y, frame.width - left, BAR], &format!(r#"fill="{}""#, tones.fill(number)));
    }
    svg.close();
    let levels = field.levels.iter().map(|level| field.scale.position(*level));
    let marks = levels.filter(|at| (0.0..=1.0).contains(at)).map(|at| {
        let x = frame.across(at);
        polyline([(x, y), (x, y + BAR)])
    });
    let marks: String = marks.collect();
    for stroke in MARKS {
        svg.path(&marks, stroke);
    }
    frame.border(svg);
    let ticks = if field.is_angle() { cyclic::ticks(&field.scale) } else { None };
    frame.x_ticks(svg, &ticks.unwrap_or_else(|| bar_ticks(&field.scale, frame.width)), true);
    svg.text(x + frame.width + 3.0, y + BAR - 1.0, &beside, Style::new(TICK_SIZE, Anchor::Start));
    let height = BAR + x_tick_room() + 3.0;
    height + key::rows(svg, [x, y + height], width, TICK_SIZE, &remarks(field, panels))
}

/// The ticks of a bar of this length, as many as have room for their words.
fn bar_ticks(scale: &Scale, width: f64) -> Vec<Tick> {
    /// Least room between two, points.
    const GAP: f64 = 3.0;
    let fits = |ticks: &Vec<Tick>| {
        ticks.windows(2).all(|pair| {
            let words = [&pair[0], &pair[1]].map(|tick| 0.5 * tick.label.width(TICK_SIZE, false));
            (pair[1].at - pair[0].at) * width >= words[0] + words[1] + GAP
        })
    };
    (2..=6).rev().map(|most| scale.ticks(most)).find(fits).unwrap_or_else(|| scale.ticks(2))
}

/// The names in place of a bar, as far as they occur.
fn named(
    field: &Field<'_>,
    names: &[(&str, &str)],
    panels: &Panels,
    svg: &mut Svg,
    [x, y]: [f64; 2],
    width: f64,
) -> f64 {
    let is = |place: usize, number: usize| {
        field.value(place).is_some_and(|value| field.tones.step(value, &field.scale) == number)
    };
    let counted = names.iter().enumerate().map(|(number, (words, fill))| {
        let count = (0..panels.instances.len()).filter(|place| is(*place, number)).count();
        (count, words, format!(r##"fill="{fill}" stroke="#000000" stroke-width="0.4""##))
    });
    let counted: Vec<_> = counted.filter(|(count, ..)| *count > 0).collect();
    let mut entries: Vec<(Text, Sample<'_>)> = counted
        .iter()
        .map(|(count, words, fill)| (Text::from(format!("{words} ({count})")), Sample::Area(fill)))
        .collect();
    entries.extend(remarks(field, panels));
    key::rows(svg, [x, y], width, LABEL_SIZE, &entries)
}

/// The entries that explain hatching and dots, as far as they occur.
fn remarks(field: &Field<'_>, panels: &Panels) -> Vec<(Text, Sample<'static>)> {
    let mut entries = Vec::new();
    if field.undefined > 0 {
        entries.push((Text::from(format!("undefined ({})", field.undefined)), Sample::Area(UNDEFINED)));
    }
    let doubtful = (0..panels.instances.len()).filter(|place| field.is_doubtful(*place)).count();
    if !field.basins().is_empty() {
        entries.extend(of_starts(field.basins(), doubtful));
    } else if doubtful > 0 {
        entries.push((Text::from(format!("not settled ({doubtful})")), Sample::Area(DOTTED)));
    }
    entries
}

/// How far fractions of starts can be trusted: their standard error, and the starts that are in none of them.
fn of_starts(basins: &[Option<Basin>], doubtful: usize) -> Vec<(Text, Sample<'static>)> {
    let sum = |of: fn(&Basin) -> u32| basins.iter().flatten().map(|basin| u64::from(of(basin))).sum::<u64>();
    let all = sum(|basin| basin.total()).max(1);
    let share = |count: u64| format!("{:.1} %", 100.0 * count as f64 / all as f64);
    let largest = basins.iter().flatten().filter_map(|basin| basin.standard_error(basin.oscillation));
    let largest = largest.fold(0.0, f64::max);
    let error = Text::from(format!("standard error at most {largest:.2}"));
    let mut entries = vec![(error, Sample::Nothing)];
    if doubtful > 0 {
        let (other, failed) = (share(sum(|basin| basin.other)), share(sum(|basin| basin.failed)));
        let words = format!(
            "with other ends ({doubtful}); of all starts {other} stuck or not settled, {failed} failed"
        );
        entries.push((Text::from(words), Sample::Area(DOTTED)));
    }
    entries
}
