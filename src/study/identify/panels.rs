//! What stands in the panels of the figure of measured signals.

use crate::results::figure::palette::{PALE, TYPES};
use crate::study::error::Result;
use crate::study::identify::shown::{Colour, Shown};
use squealmap_figure::frame::{Frame, TICK_LENGTH, TICK_SIZE, y_tick_room, y_ticks};
use squealmap_figure::key::{self, Sample};
use squealmap_figure::letters;
use squealmap_figure::plot::{Plot, ZERO};
use squealmap_figure::raster::{self, data_uri};
use squealmap_figure::scale::{Scale, axis_unit};
use squealmap_figure::svg::{Anchor, Style, Svg, polyline};
use squealmap_figure::text::Text;
use squealmap_figure::words::number;
use squealmap_identify::{Clip, Instant, Spectrogram};

/// Width of a colour bar and its distance, points.
const BAR: [f64; 2] = [8.0, 6.0];
/// Height of the band of verdicts, points.
pub(super) const BAND: f64 = 7.0;
/// Radius of a mark of the phase, points.
const MARK: f64 = 0.9;
/// Strokes of tangential and normal acceleration.
pub(super) const STROKES: [&str; 2] = [
    r##"fill="none" stroke="#1F3F8F" stroke-width="0.5" stroke-linejoin="round""##,
    r##"fill="none" stroke="#E08A3C" stroke-width="0.5" stroke-linejoin="round""##,
];
/// Those over a few periods.
const CLOSE: [&str; 2] = [
    r##"fill="none" stroke="#1F3F8F" stroke-width="0.9" stroke-linejoin="round""##,
    r##"fill="none" stroke="#E08A3C" stroke-width="0.9" stroke-dasharray="3.2 1.2" stroke-linejoin="round""##,
];
/// What has its scale on the right.
pub(super) const RIGHTWARDS: &str =
    r##"fill="none" stroke="#B0413E" stroke-width="0.8" stroke-dasharray="3.2 1.6" stroke-linejoin="round""##;
/// Fill of the marks of the phase.
const PHASE: &str = r##"fill="#1F3F8F""##;
/// Ends of segments.
const END: &str = r##"fill="none" stroke="#777777" stroke-width="0.4" stroke-dasharray="1.2 1.4""##;
const FRAME: &str = r##"fill="none" stroke="#000000" stroke-width="0.6""##;

/// The fill of a verdict: that of the type in maps, lighter where another mechanism is not excluded.
pub(crate) fn fill(colour: Colour) -> String {
    let of = |name: &str| TYPES.iter().find(|class| class.name == name).map_or(PALE, |class| class.fill);
    let (fill, opacity) = match colour {
        Colour::NoInstability => (of("stable"), 1.0),
        Colour::NegativeSlope => (of("negative_slope"), 1.0),
        Colour::AnySlope => (of("negative_slope"), 0.5),
        Colour::ModeCoupling => (of("mode_coupling"), 1.0),
        Colour::AnyCoupling => (of("mode_coupling"), 0.5),
        Colour::Both => (of("coexistence"), 1.0),
        Colour::Undecided => ("#B9BCBB", 1.0),
    };
    if opacity < 1.0 {
        format!(r#"fill="{fill}" fill-opacity="{opacity}""#)
    } else {
        format!(r#"fill="{fill}""#)
    }
}

/// The verdicts of the segments as a band.
pub(super) fn band(svg: &mut Svg, found: &Shown, time: &Scale, frame: &Frame) {
    for piece in &found.segments {
        let [from, to] = piece.time.map(|t| frame.across(time.position(t).clamp(0.0, 1.0)));
        svg.rect([from, frame.y, to - from, frame.height], &fill(piece.verdict));
    }
    frame.border(svg);
}

/// The ends of segments through a panel.
pub(super) fn ends(svg: &mut Svg, found: &Shown, time: &Scale, frame: &Frame) {
    for piece in found.segments.iter().skip(1) {
        let x = frame.across(time.position(piece.time[0]).clamp(0.0, 1.0));
        svg.path(&polyline([(x, frame.y), (x, frame.bottom())]), END);
    }
}

/// The entries of the key of the verdicts that occur.
pub(super) fn verdicts(found: &Shown) -> Vec<(Text, String)> {
    let occurs = |colour: &Colour| found.segments.iter().any(|piece| piece.verdict == *colour);
    Colour::ALL.into_iter().filter(occurs).map(|colour| (Text::from(colour.words()), fill(colour))).collect()
}

/// The height of that key within `width`, or draws it from `[x, y]` on.
pub(super) fn key_of_verdicts(svg: &mut Svg, at: [f64; 2], width: f64, found: &Shown) -> f64 {
    let entries = verdicts(found);
    let entries: Vec<(Text, Sample<'_>)> =
        entries.iter().map(|(words, fill)| (words.clone(), Sample::Area(fill))).collect();
    key::rows(svg, at, width, TICK_SIZE, &entries)
}

/// Lowest and highest value of every column as one line.
pub(super) fn curve(columns: &[[f64; 2]], [start, end]: [f64; 2]) -> impl Iterator<Item = (f64, f64)> {
    let count = columns.len().max(1) as f64;
    columns.iter().enumerate().flat_map(move |(k, [low, high])| {
        let t = start + (end - start) * (k as f64 + 0.5) / count;
        [(t, *low), (t, *high)]
    })
}

/// A quantity over time; `NaN` where it is not known.
pub(super) fn over_time(
    course: &[Instant],
    of: impl Fn(&Instant) -> Option<f64>,
) -> impl Iterator<Item = (f64, f64)> {
    course.iter().map(move |instant| (instant.time, of(instant).unwrap_or(f64::NAN)))
}

/// The scale of a quantity over time, and whether there is any of it.
pub(super) fn scale_of(course: &[Instant], of: impl Fn(&Instant) -> Option<f64>) -> (Scale, bool) {
    let values: Vec<f64> = course.iter().filter_map(of).collect();
    let any = !values.is_empty();
    // From zero on: how much of itself a velocity or a temperature changes is seen at once.
    (Scale::spanning(values.into_iter().chain([0.0])).widened(0.07), any)
}

/// A quantity with its scale right of the panel.
pub(super) fn rightwards(
    svg: &mut Svg,
    plot: &Plot<'_>,
    label: &Text,
    points: impl IntoIterator<Item = (f64, f64)>,
) {
    plot.curve(svg, points, RIGHTWARDS);
    let frame = &plot.frame;
    let ticks = y_ticks(plot.y, frame.height);
    let right = frame.x + frame.width;
    let mut marks = String::new();
    for tick in ticks.iter().filter(|tick| (0.0..=1.0).contains(&tick.at)) {
        let y = frame.up(tick.at);
        marks.push_str(&polyline([(right, y), (right + TICK_LENGTH, y)]));
        let style = Style::new(TICK_SIZE, Anchor::Start);
        svg.text(right + TICK_LENGTH + 1.5, y + 0.36 * TICK_SIZE, &tick.label, style);
    }
    svg.path(&marks, FRAME);
    // A superscript stands nearer to the ticks than capitals.
    let x = right + y_tick_room(&ticks) + 1.4 * TICK_SIZE + 1.0;
    let middle = frame.y + 0.5 * frame.height;
    svg.text(x, middle, label, Style::new(TICK_SIZE, Anchor::Middle).upwards());
}

/// The phase as marks, and the coherence with its scale on the right.
pub(super) fn phase(svg: &mut Svg, found: &Shown, time: &Scale, frame: &Frame) {
    let scale = phase_scale();
    let plot = Plot { frame: *frame, x: time, y: &scale };
    plot.curve(svg, [(found.time[0], 0.0), (found.time[1], 0.0)], ZERO);
    let coherence = Scale::Linear { low: 0.0, high: 1.05 };
    let beside = Plot { frame: *frame, x: time, y: &coherence };
    rightwards(
        svg,
        &beside,
        &Text::from("Coherence ").symbol("γ").superscript("2"),
        over_time(&found.course, |instant| instant.coherence),
    );
    for instant in &found.course {
        let Some(value) = instant.phase else { continue };
        let (x, y) = (frame.across(time.position(instant.time)), frame.up(scale.position(value)));
        svg.circle(x, y, MARK, PHASE);
    }
    if found.course.iter().all(|instant| instant.phase.is_none()) {
        nothing(svg, frame, "no oscillation, or normal acceleration not recorded");
    }
}

/// The scale of a phase.
pub(super) fn phase_scale() -> Scale {
    Scale::Linear { low: -190.0, high: 190.0 }
}

/// The name of that panel's curves.
pub(super) fn key_of_phase(svg: &mut Svg, frame: &Frame) {
    let base = frame.y - 4.0;
    let entries = [
        (Text::from("phase"), Sample::Mark(1.6, PHASE)),
        (Text::from("coherence"), Sample::Line(RIGHTWARDS)),
    ];
    key::rows(svg, [frame.x, base - TICK_SIZE], frame.width, TICK_SIZE, &entries);
}

/// Draws the key of the accelerations.
pub(super) fn key_of_accelerations(svg: &mut Svg, found: &Shown, frame: &Frame) {
    let names = ["tangential", "normal"].map(Text::from);
    let drawn = found.accelerations.iter().zip(names.into_iter().zip(STROKES));
    let entries: Vec<(Text, &str)> =
        drawn.filter(|(columns, _)| !columns.is_empty()).map(|(_, entry)| entry).collect();
    key::lines(svg, frame.x, frame.y - 4.0, TICK_SIZE, &entries);
}

/// A few periods of both accelerations, over milliseconds from the middle.
pub(super) fn zoom(svg: &mut Svg, clip: &Clip, (number, digits): (usize, usize), frame: &Frame) {
    let middle = clip.middle();
    let ms = |k: usize| 1e3 * (clip.start + k as f64 * clip.step - middle);
    let count = clip.accelerations[0].len();
    let x = Scale::Linear { low: ms(0), high: ms(count.saturating_sub(1)).max(ms(0) + f64::MIN_POSITIVE) };
    let y = Scale::spanning(clip.accelerations.iter().flatten().copied()).widened(0.07);
    let plot = Plot { frame: *frame, x: &x, y: &y };
    for (values, stroke) in clip.accelerations.iter().zip(CLOSE) {
        plot.curve(svg, values.iter().enumerate().map(|(k, value)| (ms(k), *value)), stroke);
    }
    frame.border(svg);
    frame.x_ticks(svg, &x.ticks(5), true);
    frame.y_ticks(svg, &y_ticks(&y, frame.height), true);
    let exponent = y.exponent();
    letters::draw_at(svg, number, [frame.x, frame.y - TICK_SIZE - 5.0]);
    let words = Text::from(format!("at {middle:.digits$} s")).then(axis_unit("m/s^2", exponent));
    let left = frame.x + letters::width(number);
    svg.text(left, frame.y - 4.5, &words, Style::new(TICK_SIZE, Anchor::Start));
}

/// Marks below a panel where the zooms are.
pub(super) fn places(svg: &mut Svg, found: &Shown, time: &Scale, frame: &Frame) {
    let low = frame.bottom();
    for clip in &found.zooms {
        let x = frame.across(time.position(clip.middle()).clamp(0.0, 1.0));
        svg.path(
            &(polyline([(x - 2.2, low + 4.6), (x + 2.2, low + 4.6), (x, low + 0.6)]) + "Z"),
            r##"fill="#000000""##,
        );
    }
}

/// A spectrogram as an embedded picture.
pub(super) fn picture(found: &Spectrogram) -> Result<String> {
    Ok(data_uri(found.columns, found.rows, |k| found.normalised[k])?)
}

/// Draws the picture of a spectrogram.
pub(super) fn spectrogram(svg: &mut Svg, found: &Spectrogram, picture: &str, time: &Scale, frame: &Frame) {
    let [from, to] = found.time.map(|t| frame.across(time.position(t)));
    let [low, high] = found.frequency.map(|f| frame.up(f / found.frequency[1]));
    let [x, y, width, height] = [from, high, to - from, low - high].map(number);
    svg.open(r#"image-rendering="optimizeQuality""#);
    svg.image(&format!(
        r#"x="{x}" y="{y}" width="{width}" height="{height}" preserveAspectRatio="none" href="{picture}""#
    ));
    svg.close();
}

/// The colour bar of the spectrogram right of its panel; the second words are for a flat one.
pub(super) fn bar(svg: &mut Svg, frame: &Frame) {
    /// Steps of the bar: more than the eye tells apart.
    const STEPS: usize = 32;
    let [width, distance] = BAR;
    let x = frame.x + frame.width + distance;
    let height = frame.height / STEPS as f64;
    svg.open(r#"shape-rendering="crispEdges""#);
    for step in 0..STEPS {
        // Each reaches to the top and is covered by those that follow: no seams.
        svg.rect(
            [x, frame.y, width, frame.height - step as f64 * height],
            &format!(r#"fill="{}""#, raster::fill(step as f32 / (STEPS - 1) as f32)),
        );
    }
    svg.close();
    Frame { x, width, ..*frame }.border(svg);
    let beside = x + width + 2.0;
    for (end, y) in ["0", "1"].into_iter().zip([frame.bottom(), frame.y + 0.75 * TICK_SIZE]) {
        svg.text(beside, y, &Text::from(end), Style::new(TICK_SIZE, Anchor::Start));
    }
    let middle = frame.y + 0.5 * frame.height;
    let [long, short] = ["re window maximum", "rel."].map(Text::from);
    if long.width(TICK_SIZE, false) + 2.0 * TICK_SIZE <= frame.height {
        let upwards = Style::new(TICK_SIZE, Anchor::Middle).upwards();
        svg.text(beside + TICK_SIZE + 1.0, middle, &long, upwards);
    } else {
        svg.text(beside, middle + 0.35 * TICK_SIZE, &short, Style::new(TICK_SIZE, Anchor::Start));
    }
}

/// Words in an empty panel.
pub(super) fn nothing(svg: &mut Svg, frame: &Frame, words: &str) {
    let (x, y) = (frame.across(0.5), frame.up(0.5));
    svg.text(x, y, &Text::from(words), Style::new(TICK_SIZE, Anchor::Middle));
}
