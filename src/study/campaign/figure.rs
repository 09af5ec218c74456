//! The figure of a campaign: verdicts, frequency, amplitude and friction across its conditions.

use std::collections::BTreeMap;

use crate::results::figure::look::Look;
use crate::results::figure::panels::selection;
use crate::study::campaign::condition::{Condition, groups, median, together};
use crate::study::campaign::row::{DIRECTIONS, Said, VelocityLaw};
use crate::study::identify::panels::fill;
use crate::study::identify::shown::Colour;
use squealmap_figure::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_room, y_ticks};
use squealmap_figure::key::{self, Sample};
use squealmap_figure::letters;
use squealmap_figure::page::{DOUBLE_COLUMN, MARGIN, SINGLE_COLUMN, title};
use squealmap_figure::scale::{Scale, Tick, axis_unit, value_label};
use squealmap_figure::svg::{Anchor, Style, Svg, polyline};
use squealmap_figure::text::Text;

/// Height of a panel, points.
const HEIGHT: f64 = 74.0;
/// Between panels, points: one above the other, and side by side.
const GAP: f64 = 8.0;
const GAP_ACROSS: f64 = 10.0;
/// Right of the panels, points.
const RIGHT: f64 = 4.0;
/// A condition is no narrower than this, points, and in a figure of one column as wide as this or more.
const NARROWEST: f64 = 15.0;
const WIDE: f64 = 26.0;
/// The width of the longest word of a heading, points.
const HEADING: f64 = 38.0;
/// The part of the room of a condition that its bar takes, and its marks.
const BAR: f64 = 0.7;
/// Radius of a mark, points.
const RADIUS: f64 = 1.5;
/// Margin above and below marks, as a fraction of the panel.
const HEADROOM: f64 = 0.1;
/// Height of a line of words above the panels, points.
const LINE: f64 = 10.0;
/// Frequencies are in kHz from this one on, Hz.
const KILOHERTZ: f64 = 10e3;
/// Amplitudes with this ratio and more between them have a logarithmic scale.
const DECADES: f64 = 20.0;
/// Marks of strokes forward and back.
const MARKS: [&str; 2] = [r##"fill="#1F3F8F""##, r##"fill="#FFFFFF" stroke="#1F3F8F" stroke-width="0.7""##];
/// The line at the middle of the strokes of a condition.
const MEDIAN: &str = r##"fill="none" stroke="#D55E00" stroke-width="1.4""##;
/// The rim of a bar.
const RIM: &str = r##"fill="none" stroke="#000000" stroke-width="0.4""##;

/// A condition with its strokes.
struct Group<'a> {
    condition: Condition,
    strokes: Vec<&'a Said>,
}

/// The conditions of one law and speed, side by side in one column of panels.
struct Column<'a> {
    law: Option<VelocityLaw>,
    groups: Vec<Group<'a>>,
}

/// What a row of panels shows of a stroke.
struct Row {
    words: &'static str,
    /// What stands for the words where there is no room for them.
    symbol: &'static str,
    unit: &'static str,
    /// That unit in SI units.
    in_si: f64,
    of: fn(&Said) -> Option<f64>,
}

impl Row {
    fn new([words, symbol, unit]: [&'static str; 3], of: fn(&Said) -> Option<f64>) -> Row {
        Row { words, symbol, unit, in_si: 1.0, of }
    }

    fn value(&self, said: &Said) -> Option<f64> {
        (self.of)(said).map(|value| value / self.in_si)
    }
}

/// The rows below that of the verdicts, of what was recorded.
fn rows(all: &[Said]) -> Vec<Row> {
    let mut rows = vec![
        Row::new(["Frequency", "f", "Hz"], |said| said.vibration.map(|[frequency, _]| frequency)),
        Row::new(["Amplitude", "a", "m/s^2"], |said| said.vibration.map(|[_, amplitude]| amplitude)),
        Row::new(["Friction", "μ", ""], |said| said.friction),
    ];
    if all.iter().filter_map(|said| rows[0].value(said)).any(|frequency| frequency >= KILOHERTZ) {
        (rows[0].unit, rows[0].in_si) = ("kHz", 1e3);
    }
    rows.retain(|row| all.iter().any(|said| row.value(said).is_some()));
    rows
}

/// The figure of a campaign as an SVG document: of one column where its conditions have room in it, else of two.
#[must_use]
pub fn campaign_svg(heading: &str, all: &[Said], look: &Look<'_>) -> String {
    let columns = columns(all);
    let rows = rows(all);
    let heading = look.title(heading);
    let name = if heading.is_empty() { "Campaign" } else { heading };
    let panels = (1 + rows.len()) as f64 * HEIGHT;
    look.fitted(name, panels, |part| draw(heading, &columns, &rows, look, part * HEIGHT))
}

/// The conditions by law and speed; within, by temperature.
fn columns(all: &[Said]) -> Vec<Column<'_>> {
    let mut columns: BTreeMap<_, Vec<Group<'_>>> = BTreeMap::new();
    for ((_, column), strokes) in groups(all) {
        columns.entry(column).or_default().push(Group { condition: together(&strokes), strokes });
    }
    columns.into_iter().map(|((law, _), groups)| Column { law, groups }).collect()
}

/// The picture and its size, with panels of this height.
fn draw(
    heading: &str,
    columns: &[Column<'_>],
    rows: &[Row],
    look: &Look<'_>,
    height: f64,
) -> (Svg, [f64; 2]) {
    let total: usize = columns.iter().map(|column| column.groups.len()).sum();
    let usual = if total as f64 * WIDE > SINGLE_COLUMN - 50.0 { DOUBLE_COLUMN } else { SINGLE_COLUMN };
    let page = look.points().unwrap_or(usual);
    let strokes = || columns.iter().flat_map(|column| &column.groups).flat_map(|group| &group.strokes);
    let scales: Vec<Scale> = rows.iter().map(|row| scale(row, strokes().copied())).collect();
    let parts = Scale::Linear { low: 0.0, high: 1.0 };
    let ticks: Vec<Vec<Tick>> =
        std::iter::once(&parts).chain(&scales).map(|scale| y_ticks(scale, height)).collect();
    let left = MARGIN + LABEL_SIZE + 6.0 + ticks.iter().map(|ticks| y_tick_room(ticks)).fold(0.0, f64::max);
    let mut svg = Svg::new();
    let mut y = MARGIN + title(&mut svg, heading, page - 2.0 * MARGIN);
    y += legend(&mut svg, [left, y], page - left - RIGHT, columns) + 3.0;
    let across = page - left - RIGHT;
    let (shown, each) = chosen(columns, across);
    let heads: Vec<Vec<Text>> =
        shown.iter().map(|(column, some)| head(column, some, each * weight(some.len()))).collect();
    y += heads.iter().map(Vec::len).max().unwrap_or(0) as f64 * LINE + TICK_SIZE + 2.0;
    let mut x = left;
    for (place, (_, some)) in shown.iter().enumerate() {
        let width = each * weight(some.len());
        for (line, words) in heads[place].iter().rev().enumerate() {
            let base = y - TICK_SIZE - 4.0 - line as f64 * LINE;
            svg.text(x + 0.5 * width, base, words, Style::new(LABEL_SIZE, Anchor::Middle));
        }
        let names = some.iter().map(|group| degrees(&group.condition)).collect();
        let below = spaced(Scale::Names(names).ticks(some.len()), width);
        for row in 0..=rows.len() {
            let frame = Frame { x, y: y + row as f64 * (height + GAP), width, height };
            if row == 0 {
                bars(&mut svg, &frame, some);
            } else {
                marks(&mut svg, &frame, some, &rows[row - 1], &scales[row - 1]);
            }
            frame.border(&mut svg);
            frame.x_ticks(&mut svg, &below, row == rows.len());
            frame.y_ticks(&mut svg, &ticks[row], place == 0);
        }
        x += width + GAP_ACROSS;
    }
    let labels = rows.iter().zip(&scales).map(|(row, scale)| {
        let unit = || axis_unit(row.unit, scale.exponent());
        vec![Text::from(row.words).then(unit()), Text::default().symbol(row.symbol).then(unit())]
    });
    let time = vec![Text::from("Part of the time"), Text::from("Time")];
    let labels = std::iter::once(time).chain(labels);
    for (row, labels) in labels.enumerate() {
        let frame = Frame { x: left, y: y + row as f64 * (height + GAP), width: 0.0, height };
        letters::side(&mut svg, (row, 1 + rows.len()), &frame, &labels);
    }
    y += (1 + rows.len()) as f64 * (height + GAP) - GAP + x_tick_room() + LABEL_SIZE + 1.0;
    let words = Text::from("Temperature (°C)");
    svg.text(left + 0.5 * across, y, &words, Style::new(LABEL_SIZE, Anchor::Middle));
    let drawn: usize = shown.iter().map(|(_, some)| some.len()).sum();
    if drawn < total {
        y += LABEL_SIZE + 6.0;
        let note = format!("{drawn} of {total} conditions shown; the table holds all.");
        svg.text(MARGIN, y, &Text::from(note), Style::new(LABEL_SIZE, Anchor::Start));
    }
    (svg, [page, y + MARGIN + 2.0])
}

/// Columns of panels with the conditions that they show.
type Chosen<'a> = Vec<(&'a Column<'a>, Vec<&'a Group<'a>>)>;

/// The columns that have room, an even choice of all, and the width of a condition: each has all of its conditions; only where one
/// has no room for them, it has an even choice.
fn chosen<'a>(columns: &'a [Column<'a>], across: f64) -> (Chosen<'a>, f64) {
    let room = |count: usize| across - count.saturating_sub(1) as f64 * GAP_ACROSS;
    let each = |shown: &Chosen<'_>| {
        room(shown.len()) / shown.iter().map(|(_, some)| weight(some.len())).sum::<f64>().max(1.0)
    };
    for count in (1..=columns.len()).rev() {
        let all = selection(columns.len(), count).map(|place| &columns[place]);
        let shown: Chosen<'_> = all.map(|column| (column, column.groups.iter().collect())).collect();
        let width = each(&shown);
        if width >= NARROWEST {
            return (shown, width);
        }
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive count")]
    let most = (across / NARROWEST).max(1.0) as usize;
    let few = |column: &'a Column<'a>| {
        let some = selection(column.groups.len(), most).map(|place| &column.groups[place]);
        (column, some.collect())
    };
    let shown: Chosen<'_> = columns.first().map(few).into_iter().collect();
    let width = each(&shown);
    (shown, width)
}

/// The width of a column of so many conditions, in conditions: that of its heading at least.
fn weight(conditions: usize) -> f64 {
    (conditions as f64).max(HEADING / NARROWEST)
}

/// The verdicts and marks that occur; returns the height that their rows take.
fn legend(svg: &mut Svg, at: [f64; 2], width: f64, columns: &[Column<'_>]) -> f64 {
    let all = || columns.iter().flat_map(|column| &column.groups);
    let occurs = |colour: &Colour| all().any(|group| group.condition.shares[*colour as usize] > 0.0);
    let fills: Vec<(Colour, String)> =
        Colour::ALL.into_iter().filter(occurs).map(|colour| (colour, fill(colour))).collect();
    let mut entries: Vec<(Text, Sample<'_>)> =
        fills.iter().map(|(colour, fill)| (Text::from(colour.words()), Sample::Area(fill))).collect();
    for (place, name) in DIRECTIONS.into_iter().enumerate() {
        let forward = place == 0;
        if all().any(|group| group.strokes.iter().any(|said| said.forward == forward)) {
            entries.push((Text::from(format!("stroke {name}")), Sample::Mark(RADIUS, MARKS[place])));
        }
    }
    entries.push((Text::from("median"), Sample::Line(MEDIAN)));
    key::rows(svg, at, width, LABEL_SIZE, &entries)
}

/// The words above a column of panels.
fn head(column: &Column<'_>, some: &[&Group<'_>], width: f64) -> Vec<Text> {
    let law = column.law.map_or("velocity not recorded".to_owned(), |law| format!("{} velocity", law.name()));
    let mut words = Text::from(law).wrapped(width + 0.5 * GAP_ACROSS, LABEL_SIZE);
    let speeds = || some.iter().filter_map(|group| group.condition.speed);
    let count = speeds().count();
    if count > 0 {
        let mean = speeds().sum::<f64>() / count as f64;
        let mean: f64 = format!("{mean:.1e}").parse().unwrap_or(mean);
        words.push(value_label(mean).plain(" ").unit("m/s"));
    }
    words
}

/// `500`, or a dash where the temperature was not recorded.
fn degrees(condition: &Condition) -> String {
    condition.temperature.map_or("–".to_owned(), |temperature| format!("{temperature:.0}"))
}

/// The labels that have room beside one another; the marks stay.
fn spaced(mut ticks: Vec<Tick>, width: f64) -> Vec<Tick> {
    let mut free = f64::MIN;
    for tick in &mut ticks {
        let half = 0.5 * tick.label.width(TICK_SIZE, false);
        if tick.at * width - half < free {
            tick.label = Text::default();
        } else {
            free = tick.at * width + half + 2.0;
        }
    }
    ticks
}

/// The scale of a row of marks.
fn scale<'a>(row: &Row, strokes: impl Iterator<Item = &'a Said>) -> Scale {
    match Scale::spanning(strokes.filter_map(|said| row.value(said))) {
        Scale::Linear { low, high } if low > 0.0 && high > DECADES * low => Scale::Log { low, high },
        other => other,
    }
    .widened(HEADROOM)
}

/// The left end and the width of what belongs to a condition.
fn room(frame: &Frame, place: usize, of: usize) -> [f64; 2] {
    let each = frame.width / of as f64;
    [frame.x + (place as f64 + 0.5 * (1.0 - BAR)) * each, BAR * each]
}

/// The verdicts of each condition by their part of the time, one above the other, and the number of its strokes.
fn bars(svg: &mut Svg, frame: &Frame, some: &[&Group<'_>]) {
    for (place, Group { condition, strokes }) in some.iter().enumerate() {
        let [x, width] = room(frame, place, some.len());
        let mut below = 0.0;
        for colour in Colour::ALL {
            let part = condition.shares[colour as usize];
            if part > 0.0 {
                let top = (below + part).min(1.0);
                svg.rect([x, frame.up(top), width, (top - below) * frame.height], &fill(colour));
                below = top;
            }
        }
        svg.rect([x, frame.up(below), width, below * frame.height], RIM);
        let long = Text::from(format!("n = {}", strokes.len()));
        let fits = long.width(TICK_SIZE, false) < width / BAR - 2.0;
        let words = if fits { long } else { Text::from(strokes.len().to_string()) };
        let base = frame.y - 2.5;
        svg.text(x + 0.5 * width, base, &words, Style::new(TICK_SIZE, Anchor::Middle));
    }
}

/// A mark of each stroke and a line at their middle.
fn marks(svg: &mut Svg, frame: &Frame, some: &[&Group<'_>], row: &Row, scale: &Scale) {
    for (place, Group { strokes, .. }) in some.iter().enumerate() {
        let [x, width] = room(frame, place, some.len());
        let values: Vec<f64> = strokes.iter().filter_map(|said| row.value(said)).collect();
        if values.is_empty() {
            continue;
        }
        let up = frame.up(scale.position(median(values)));
        svg.path(&polyline([(x, up), (x + width, up)]), MEDIAN);
        for (number, said) in strokes.iter().enumerate() {
            if let Some(value) = row.value(said) {
                let across = x + width * (number as f64 + 0.5) / strokes.len() as f64;
                let up = frame.up(scale.position(value));
                svg.circle(across, up, RADIUS, MARKS[usize::from(!said.forward)]);
            }
        }
    }
}
