//! The figure of a fit: friction against sliding velocity with the law at each temperature, and what it leaves of the points.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use crate::model::Param;
use crate::results::figure::look::Look;
use crate::study::fit::course::{Parameter, Shown};
use squealmap_figure::frame::{Frame, LABEL_SIZE, x_tick_room, y_tick_room, y_ticks};
use squealmap_figure::key::{self, Sample};
use squealmap_figure::letters;
use squealmap_figure::page::{MARGIN, SINGLE_COLUMN, title};
use squealmap_figure::plot::{Plot, ZERO};
use squealmap_figure::scale::{Scale, axis_unit, value_label};
use squealmap_figure::svg::{Anchor, Style, Svg};
use squealmap_figure::text::Text;
use squealmap_figure::words::number;

/// Heights of the panels of friction and of residuals, points.
const HEIGHTS: [f64; 2] = [120.0, 52.0];
/// Between the panels, points.
const GAP: f64 = 8.0;
/// Right of the panels, points.
const RIGHT: f64 = 8.0;
/// Margin above and below points, as a fraction of the panel.
const HEADROOM: f64 = 0.06;
/// An error below this is that of rounding, and so is scatter.
const KNOWN: f64 = 1e-9;
/// Points of one temperature are thinned to one in each square of this side, points.
const SQUARE: f64 = 1.2;
/// From the coldest to the hottest.
const COLOURS: [[u8; 3]; 4] = [[31, 63, 143], [62, 142, 137], [224, 160, 60], [176, 42, 26]];

/// The figure as an SVG document of single column width unless the look says otherwise.
#[must_use]
pub fn fit_svg(shown: &Shown, look: &Look<'_>) -> String {
    let heading = look.title(&shown.title);
    let name = if heading.is_empty() { "Friction against velocity" } else { heading };
    let panels = HEIGHTS[0] + HEIGHTS[1];
    look.fitted(name, panels, |part| draw(heading, shown, look, HEIGHTS.map(|height| part * height)))
}

/// The picture and its size, with panels of these heights.
fn draw(heading: &str, shown: &Shown, look: &Look<'_>, heights: [f64; 2]) -> (Svg, [f64; 2]) {
    let page = look.points().unwrap_or(SINGLE_COLUMN);
    let of_points = |which: usize| shown.points.iter().map(move |point| point[which]);
    let of_courses =
        |which: usize| shown.courses.iter().flat_map(|course| &course.points).map(move |at| at[which]);
    let x = Scale::spanning(of_points(0).chain(of_courses(0)).chain([0.0]));
    let friction = spanning(of_points(2).chain(of_courses(1)));
    let residual = spanning(of_points(3).chain([0.0]));
    let scales = [friction, residual];
    let ticks = [0, 1].map(|row| y_ticks(&scales[row], heights[row]));
    let room = ticks.iter().map(|ticks| y_tick_room(ticks)).fold(0.0, f64::max);
    let left = MARGIN + LABEL_SIZE + 6.0 + room;
    let width = page - left - RIGHT;
    let mut svg = Svg::new();
    let mut y = MARGIN + title(&mut svg, heading, page - 2.0 * MARGIN);
    y += legend(&mut svg, [left, y], width, shown) + 4.0;
    for (row, words) in ["Friction coefficient", "Residual"].into_iter().enumerate() {
        let frame = Frame { x: left, y, width, height: heights[row] };
        let plot = Plot { frame, x: &x, y: &scales[row] };
        if row == 1 {
            plot.curve(&mut svg, [0.0, x.value(1.0)].map(|speed| (speed, 0.0)), ZERO);
        }
        dots(&mut svg, &plot, shown, 2 + row);
        if row == 0 {
            for (place, course) in shown.courses.iter().enumerate() {
                let stroke = line(place, shown.courses.len());
                plot.curve(
                    &mut svg,
                    course.points.iter().map(|[speed, friction]| (*speed, *friction)),
                    &stroke,
                );
            }
        }
        frame.border(&mut svg);
        frame.x_ticks(&mut svg, &x.ticks(6), row == 1);
        frame.y_ticks(&mut svg, &ticks[row], true);
        let words = Text::from(words).then(axis_unit("", scales[row].exponent()));
        let short = Text::from(["Friction", "Residual"][row]).then(axis_unit("", scales[row].exponent()));
        letters::side(&mut svg, (row, 2), &frame, &[words, short]);
        y += heights[row] + GAP;
    }
    y += x_tick_room() + LABEL_SIZE + 1.0 - GAP;
    let words = Text::from("Sliding velocity").then(axis_unit("m/s", x.exponent()));
    svg.text(left + 0.5 * width, y, &words, Style::new(LABEL_SIZE, Anchor::Middle));
    (svg, [page, y + MARGIN + 2.0])
}

/// The scale of some values; those that rounding alone tells apart are one.
fn spanning(values: impl Iterator<Item = f64>) -> Scale {
    match Scale::spanning(values) {
        Scale::Linear { low, high } if high - low < KNOWN => {
            Scale::spanning([(0.5 * (low + high) / KNOWN).round() * KNOWN])
        }
        other => other,
    }
    .widened(HEADROOM)
}

/// Each temperature with the values of its law, and those that all have in common; returns the height of the rows.
fn legend(svg: &mut Svg, at: [f64; 2], width: f64, shown: &Shown) -> f64 {
    let courses = &shown.courses;
    let strokes: Vec<String> = (0..courses.len()).map(|place| line(place, courses.len())).collect();
    let is_common = |parameter: &Parameter| {
        courses.len() > 1 && courses.iter().all(|course| course.parameters.contains(parameter))
    };
    let known = courses.iter().flat_map(|course| &course.parameters).any(|one| one.error.is_some());
    let brackets = if known { "; in brackets: standard errors of the last digits" } else { "" };
    let mut entries = vec![(Text::from(format!("law: {}{brackets}", shown.law)), Sample::Nothing)];
    for (course, stroke) in courses.iter().zip(&strokes) {
        let own = course.parameters.iter().filter(|parameter| !is_common(parameter));
        let start = value_label(course.temperature).plain(" °C");
        let words = own.fold(start, |words, parameter| words.plain("   ").then(said(parameter)));
        entries.push((words, Sample::Line(stroke)));
    }
    let common = courses.first().into_iter().flat_map(|course| &course.parameters);
    entries.extend(common.filter(|parameter| is_common(parameter)).map(|one| (said(one), Sample::Nothing)));
    key::rows(svg, at, width, LABEL_SIZE, &entries)
}

/// `μ_s = 0.5123(31)`: the last two digits may be off by as much as stands in brackets.
fn said(parameter: &Parameter) -> Text {
    let info = Param::from_name(&parameter.name).map(Param::info);
    let (symbol, unit) = info.map_or((parameter.name.as_str(), ""), |info| (info.symbol, info.unit));
    let text = Text::default().symbol(symbol).plain("\u{a0}=\u{a0}");
    let text = match parameter.error.filter(|error| *error > KNOWN) {
        Some(error) => {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 9")]
            let decimals = (1.0 - error.log10().floor()).clamp(0.0, 9.0) as usize;
            let digits = format!("{error:.decimals$}");
            let digits =
                if error < 1.0 { digits.replace('.', "").trim_start_matches('0').to_owned() } else { digits };
            text.plain(&format!("{:.decimals$}({digits})", parameter.value))
        }
        None => text.then(value_label(format!("{:.4e}", parameter.value).parse().unwrap_or(parameter.value))),
    };
    if unit.is_empty() { text } else { text.plain("\u{a0}").unit(unit) }
}

/// The points, each in the colour of the nearest temperature.
fn dots(svg: &mut Svg, plot: &Plot<'_>, shown: &Shown, which: usize) {
    let away = |place: usize, temperature: f64| (shown.courses[place].temperature - temperature).abs();
    let mut data = vec![String::new(); shown.courses.len()];
    let mut taken = BTreeSet::new();
    for point in &shown.points {
        let near = (0..shown.courses.len()).min_by(|a, b| away(*a, point[1]).total_cmp(&away(*b, point[1])));
        let Some(near) = near else { continue };
        let x = plot.frame.across(plot.x.position(point[0]));
        let y = plot.frame.up(plot.y.position(point[which]));
        #[expect(clippy::cast_possible_truncation, reason = "a place on a page")]
        let square = [x, y].map(|at| (at / SQUARE).floor() as i32);
        if taken.insert((near, square)) {
            let _ = write!(data[near], "M{} {}h0", number(x), number(y));
        }
    }
    for (place, data) in data.iter().enumerate() {
        let colour = colour(place, shown.courses.len());
        let attributes = format!(
            r#"class="point" fill="none" stroke="{colour}" stroke-width="1.6" stroke-opacity="0.45" stroke-linecap="round""#
        );
        svg.path(data, &attributes);
    }
}

/// The line of a temperature.
fn line(place: usize, of: usize) -> String {
    format!(r#"fill="none" stroke="{}" stroke-width="1.3" stroke-linejoin="round""#, colour(place, of))
}

/// The colour of a temperature: the coldest of several is blue, the hottest red.
fn colour(place: usize, of: usize) -> String {
    let at = place as f64 * (COLOURS.len() - 1) as f64 / of.saturating_sub(1).max(1) as f64;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "below the number of colours"
    )]
    let lower = (at as usize).min(COLOURS.len() - 2);
    let part = at - lower as f64;
    let mixed = [0, 1, 2].map(|k| {
        let [low, high] = [COLOURS[lower][k], COLOURS[lower + 1][k]].map(f64::from);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between two bytes")]
        let mixed = (low + part * (high - low)).round() as u8;
        mixed
    });
    format!("#{:02X}{:02X}{:02X}", mixed[0], mixed[1], mixed[2])
}
