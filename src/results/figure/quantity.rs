//! A number over the panels: cells or points by lightness (angles by colours that close a circle), and the bar that says how
//! much.

use crate::engine::record::Basin;
use crate::results::figure::fills::FAILED_FILL;
use crate::results::figure::look::Content;
use crate::results::figure::outline::{corner, shape, steps};
use crate::results::figure::panels::{Panel, Panels};
use crate::results::figure::points::{Marks, NOT_COMPUTED, contrast, positions};
use crate::results::figure::{points, words};
use crate::results::number::NumberColumn;
use crate::results::trust;
use crate::sweep::columns::Column;
use crate::sweep::grid::Grid;
use squealmap_figure::boundaries::{Vertex, outlines};
use squealmap_figure::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room};
use squealmap_figure::key::Sample;
use squealmap_figure::scale::{Scale, Tick, ZERO, axis_unit};
use squealmap_figure::svg::{Anchor, Style, Svg, polyline};
use squealmap_figure::text::Text;
use squealmap_figure::{cyclic, key, raster};

/// Steps of lightness: more than the eye tells apart, few enough for small files.
const STEPS: usize = 48;
/// Height of the bar, points.
const BAR: f64 = 7.0;
/// The bar is no longer than this, points.
const LONGEST: f64 = 220.0;
/// The samples of what is undefined and of what has not settled.
const UNDEFINED: &str = r##"fill="url(#not-computed)" stroke="#000000" stroke-width="0.4""##;
const DOTTED: &str = r##"fill="url(#dots-on-light)" stroke="#000000" stroke-width="0.4""##;
/// Radius of a dot on a small point, by that of the point.
const DOT: f64 = 0.4;
/// A mark in the bar: as a line of equal value, on a light casing.
const MARKS: [&str; 2] = [
    r##"fill="none" stroke="#FFFFFF" stroke-width="1.5""##,
    r##"class="level" fill="none" stroke="#000000" stroke-width="0.6""##,
];
/// What the bar of a fraction of starts says.
const STARTS: &str = "fraction of starts";
/// A side of zero that reaches less far than this part of the other is rounding.
const ROUNDING: f64 = 1e-9;

/// What a block shows: values of the places of its panels, and words.
pub(crate) struct Field<'a> {
    /// Whose values they are, where they stand in a column.
    column: Option<&'a NumberColumn>,
    /// Beside the bar; empty where the heading says it all.
    label: &'a str,
    scale: Scale,
    tones: Tones<'a>,
    /// Where lines of equal value are drawn.
    levels: &'a [f64],
    /// Where the starts of every place have ended; empty where the values are not of starts.
    basins: &'a [Option<Basin>],
    /// How many values are undefined.
    undefined: usize,
    /// The value of a place in [`Panels::instances`].
    value: Box<dyn Fn(usize) -> Option<f64> + 'a>,
    /// Whether that value is one of a response that has not settled.
    unsettled: Box<dyn Fn(usize) -> bool + 'a>,
}

impl<'a> Field<'a> {
    /// The field of a content that has values; `None` for classes.
    pub(crate) fn of(content: Content<'a>, panels: &'a Panels) -> Option<Field<'a>> {
        match content {
            Content::Classes { .. } | Content::LargeRegime => None,
            Content::Quantity { column, levels } => {
                let value = |place: usize| column.values.get(panels.instances[place]).copied().flatten();
                let (scale, tones) = shade(column);
                Some(Field {
                    column: Some(column),
                    label: if is_fraction(column) { STARTS } else { "" },
                    scale,
                    tones,
                    levels,
                    basins: &[],
                    undefined: column.values.iter().filter(|value| value.is_none()).count(),
                    value: Box::new(value),
                    unsettled: if trust::is_of_the_window(column) {
                        Box::new(|place: usize| panels.labels[place].settled() == Some(false))
                    } else {
                        Box::new(|_| false)
                    },
                })
            }
            Content::Named { column, heading, names } => {
                let value = |place: usize| column.values.get(panels.instances[place]).copied().flatten();
                Some(Field {
                    column: None,
                    label: heading,
                    scale: FRACTION,
                    tones: Tones::Named(names),
                    levels: &[],
                    basins: &[],
                    undefined: column.values.iter().filter(|value| value.is_none()).count(),
                    value: Box::new(value),
                    unsettled: Box::new(|_| false),
                })
            }
            Content::Basin => {
                let basin = |place: usize| panels.basins.get(place).copied().flatten();
                let value = move |place: usize| basin(place).and_then(|one| one.fraction(one.oscillation));
                Some(Field {
                    column: None,
                    label: STARTS,
                    scale: FRACTION,
                    tones: Tones::Lightness,
                    levels: &[],
                    basins: &panels.basins,
                    undefined: (0..panels.instances.len()).filter(|place| value(*place).is_none()).count(),
                    value: Box::new(value),
                    unsettled: Box::new(move |place| {
                        basin(place).is_some_and(|one| one.other + one.failed > 0)
                    }),
                })
            }
        }
    }

    /// Whether a place has a value that is not to be trusted.
    pub(crate) fn is_doubtful(&self, place: usize) -> bool {
        (self.unsettled)(place) && (self.value)(place).is_some()
    }

    /// Where the starts of every place have ended; empty where the values are not of starts.
    pub(crate) fn basins(&self) -> &'a [Option<Basin>] {
        self.basins
    }

    /// The scale on which its values stand by themselves; `None` for one around them.
    pub(crate) fn own_scale(&self) -> Option<Scale> {
        (!self.basins.is_empty() || self.column.is_some_and(is_fraction)).then_some(FRACTION)
    }

    /// Whether its values grow or decay, by their sign.
    pub(crate) fn has_sign(&self) -> bool {
        self.column.is_some_and(has_sign)
    }

    /// Whether the values are angles.
    pub(crate) fn is_angle(&self) -> bool {
        self.tones == Tones::Circle
    }

    /// The value of a place; `None` where it is undefined.
    pub(crate) fn value(&self, place: usize) -> Option<f64> {
        (self.value)(place)
    }

    /// The label of an axis of this length, points, with a power of ten.
    pub(crate) fn axis_label(&self, exponent: i32, room: f64) -> Text {
        let of = |column| words::label(column, exponent, room, LABEL_SIZE);
        self.column.map_or_else(|| Text::from(words::capital(self.label)), of)
    }

    /// What stands above the block, in lines of this width, points.
    pub(crate) fn heading(&self, room: f64) -> Vec<Text> {
        if let Some(column) = self.column {
            return words::label(column, 0, room, LABEL_SIZE).wrapped(room, LABEL_SIZE);
        }
        if self.basins.is_empty() {
            return Text::from(self.label).wrapped(room, LABEL_SIZE);
        }
        let starts = starts(self.basins);
        let words = format!("Starts that end in a settled oscillation, of {starts} drawn from a box");
        Text::from(words).wrapped(room, LABEL_SIZE)
    }
}

/// The scale of a fraction.
const FRACTION: Scale = Scale::Linear { low: 0.0, high: 1.0 };

/// How many starts an instance has.
fn starts(basins: &[Option<Basin>]) -> u32 {
    basins.iter().flatten().map(|basin| basin.total()).max().unwrap_or(0)
}

/// Whether a column is a fraction of the starts from a box.
fn is_fraction(column: &NumberColumn) -> bool {
    column.row().is_some_and(Column::is_share)
}

/// Whether the sign of a column says what happens: growth or decay.
pub(crate) fn has_sign(column: &NumberColumn) -> bool {
    column.row().is_some_and(|row| row.has_sign)
}

/// The scale of the colours of a quantity, and the colours.
fn shade(column: &NumberColumn) -> (Scale, Tones<'static>) {
    if column.is_angle() {
        return (cyclic::scale(), Tones::Circle);
    }
    if is_fraction(column) {
        return (FRACTION, Tones::Lightness);
    }
    match scale(column) {
        Scale::Linear { low, high }
            if has_sign(column) && -low > ROUNDING * high && high > ROUNDING * -low && low < 0.0 =>
        {
            (Scale::Signed { low, high }, Tones::Sign)
        }
        scale => (scale, Tones::Lightness),
    }
}

/// The scale of a quantity over all panels: from its lowest to its highest value.
pub(crate) fn scale(quantity: &NumberColumn) -> Scale {
    Scale::spanning(quantity.values.iter().flatten().copied())
}

/// The power of ten that the bar of a quantity has beside it.
pub(crate) fn exponent(quantity: &NumberColumn) -> i32 {
    if quantity.is_angle() { 0 } else { scale(quantity).exponent() }
}

/// How values become colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tones<'a> {
    /// The larger the darker.
    Lightness,
    /// The same, in another hue below 0 than above.
    Sign,
    /// Angles around a circle.
    Circle,
    /// Names and their fills.
    Named(&'a [(&'a str, &'a str)]),
}

/// Below 0, from the lowest value to 0: lighter than what is above.
const BELOW: [[f32; 3]; 2] = [[255.0, 250.0, 235.0], [243.0, 214.0, 145.0]];
/// How light what is just above 0 is, of the colours of [`Tones::Lightness`].
const ABOVE: f32 = 0.25;
/// The first step that is not below 0.
const FIRST_ABOVE: usize = 18;
const _: () = assert!((FIRST_ABOVE as f64 - ZERO * STEPS as f64).abs() < 1e-9, "a step begins at 0");

impl Tones<'_> {
    /// The number of steps.
    fn steps(self) -> usize {
        match self {
            Tones::Lightness | Tones::Sign => STEPS,
            Tones::Circle => cyclic::STEPS,
            Tones::Named(names) => names.len(),
        }
    }

    /// The fill of a step.
    fn fill(self, step: usize) -> String {
        match self {
            Tones::Lightness => raster::fill(step as f32 / (STEPS - 1) as f32),
            Tones::Sign if step < FIRST_ABOVE => {
                let part = step as f32 / (FIRST_ABOVE - 1) as f32;
                raster::between(BELOW, part)
            }
            Tones::Sign => {
                let part = (step - FIRST_ABOVE) as f32 / (STEPS - 1 - FIRST_ABOVE) as f32;
                raster::fill(ABOVE + (1.0 - ABOVE) * part)
            }
            Tones::Circle => cyclic::fill(step).to_owned(),
            Tones::Named(names) => names.get(step).map_or(FAILED_FILL, |(_, fill)| fill).to_owned(),
        }
    }

    /// The step of a value on a scale.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the steps")]
    fn step(self, value: f64, scale: &Scale) -> usize {
        match self {
            Tones::Lightness | Tones::Sign => {
                (scale.position(value) * STEPS as f64).clamp(0.0, (STEPS - 1) as f64) as usize
            }
            Tones::Circle => cyclic::step(value),
            Tones::Named(_) => value.max(0.0) as usize,
        }
    }

    /// Whether dots on a step have to be white.
    fn is_dark(self, step: usize) -> bool {
        match self {
            Tones::Lightness => 2 * step > STEPS,
            Tones::Sign => step > STEPS / 2 + STEPS / 8,
            // Light around the middle, dark around both ends.
            Tones::Circle => !(STEPS / 4..3 * STEPS / 4).contains(&step),
            Tones::Named(_) => false,
        }
    }
}

/// Draws the content of a panel into its frame.
pub(crate) fn draw(
    svg: &mut Svg,
    grid: &Grid,
    panels: &Panels,
    panel: &Panel,
    field: &Field<'_>,
    frame: &Frame,
) {
    let tones = field.tones;
    let of = |place: usize| (field.value)(place).map(|value| tones.step(value, &field.scale));
    let is_dark = |step| tones.is_dark(step);
    if panels.scatter.is_some() {
        return draw_points(svg, grid, panels, panel, field, frame);
    }
    let Some([columns, rows]) = shape(panels, panel) else { return };
    let at = |vertex: Vertex| corner(panels, frame, vertex);
    let place = |i: usize, j: usize| panel.cells.start + j * columns + i;
    let region = |inside: &dyn Fn(usize) -> bool| {
        let paths = outlines(columns, rows, |i, j| inside(place(i, j)));
        paths.iter().map(|path| steps(path, &at, true)).collect::<String>()
    };
    svg.open(r#"shape-rendering="crispEdges" fill-rule="evenodd""#);
    for number in 0..tones.steps() {
        svg.path(&region(&|place| of(place) == Some(number)), &format!(r#"fill="{}""#, tones.fill(number)));
    }
    svg.close();
    let missing = region(&|place| of(place).is_none());
    svg.path(&missing, &format!(r#"class="undefined" fill="{FAILED_FILL}""#));
    svg.path(&missing, r#"fill="url(#not-computed)" fill-rule="evenodd""#);
    for dark in [false, true] {
        let doubtful = region(&|place| field.is_doubtful(place) && of(place).map(is_dark) == Some(dark));
        svg.path(&doubtful, &dotted(dark));
    }
}

/// The same for scattered points. What has a value is on top of what has none.
fn draw_points(svg: &mut Svg, grid: &Grid, panels: &Panels, panel: &Panel, field: &Field<'_>, frame: &Frame) {
    let Some(scatter) = panels.scatter else { return };
    let (tones, radius) = (field.tones, points::radius(scatter, frame));
    let mut undefined = Vec::new();
    let mut defined = Vec::new();
    for place in panel.cells.clone() {
        let Some(at) = positions(grid, panels, panels.instances[place], frame) else { continue };
        match (field.value)(place) {
            Some(value) => defined.push((at, tones.step(value, &field.scale), field.is_doubtful(place))),
            None => undefined.push(at),
        }
    }
    if !points::outlined(radius) {
        return draw_small_points(svg, &undefined, &defined, tones, radius);
    }
    for [x, y] in undefined {
        svg.circle(x, y, radius, &format!(r#"class="undefined" fill="{FAILED_FILL}""#));
        svg.circle(x, y, radius, UNDEFINED);
    }
    for ([x, y], step, doubtful) in defined {
        let tone = tones.fill(step);
        svg.circle(x, y, radius, &format!(r##"fill="{tone}" stroke="#000000" stroke-width="0.5""##));
        if doubtful {
            svg.circle(x, y, radius, &dotted(tones.is_dark(step)));
        }
    }
}

/// The same for points too small for outlines: places, the steps of their values, and whether they have not settled.
fn draw_small_points(
    svg: &mut Svg,
    undefined: &[[f64; 2]],
    defined: &[([f64; 2], usize, bool)],
    tones: Tones<'_>,
    radius: f64,
) {
    Marks { radius, class: "undefined" }.backslashes(svg, undefined, NOT_COMPUTED);
    let mut of_step = vec![Vec::new(); tones.steps()];
    let mut doubtful = [Vec::new(), Vec::new()];
    for (at, step, open) in defined {
        of_step[*step].push(*at);
        if *open {
            doubtful[usize::from(tones.is_dark(*step))].push(*at);
        }
    }
    for (step, at) in of_step.iter().enumerate() {
        Marks { radius, class: "value" }.rims(svg, at, &tones.fill(step));
    }
    for (dark, at) in [(false, &doubtful[0]), (true, &doubtful[1])] {
        Marks { radius: DOT * radius, class: "unsettled" }.discs(svg, at, contrast(dark));
    }
}

/// The dots on what has not settled.
fn dotted(dark: bool) -> String {
    let tone = if dark { "dark" } else { "light" };
    format!(r#"class="unsettled" fill="url(#dots-on-{tone})" fill-rule="evenodd""#)
}

/// What hatching and dots mean, as far as they occur.
fn remarks(field: &Field<'_>, panels: &Panels) -> Vec<(Text, Sample<'static>)> {
    let mut entries = Vec::new();
    if field.undefined > 0 {
        entries.push((Text::from(format!("undefined ({})", field.undefined)), Sample::Area(UNDEFINED)));
    }
    let doubtful = (0..panels.instances.len()).filter(|place| field.is_doubtful(*place)).count();
    if !field.basins.is_empty() {
        entries.extend(of_starts(field.basins, doubtful));
    } else if doubtful > 0 {
        entries.push((Text::from(format!("not settled ({doubtful})")), Sample::Area(DOTTED)));
    }
    entries
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

/// Draws the bar from `(x, y)` downwards, what hatching and dots mean below it, and returns their height.
pub(crate) fn bar(field: &Field<'_>, panels: &Panels, svg: &mut Svg, [x, y]: [f64; 2], width: f64) -> f64 {
    if let Tones::Named(names) = field.tones {
        return named(field, names, panels, svg, [x, y], width);
    }
    let power =
        if field.scale.exponent() == 0 { Text::default() } else { axis_unit("", field.scale.exponent()) };
    let beside = power.plain(field.label);
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
