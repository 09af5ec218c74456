//! The figure of measured signals: friction, acceleration and spectrogram stacked on one time axis.

use serde::{Deserialize, Serialize};
use serde_json::json;

use crate::results::figure::look::Look;
use crate::study::error::Result;
use crate::version::{COMMIT, VERSION};
use squealmap_figure::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_room, y_ticks};
use squealmap_figure::page::{DOUBLE_COLUMN, MARGIN, title};
use squealmap_figure::plot::Plot;
use squealmap_figure::raster::data_uri;
use squealmap_figure::scale::{Scale, axis_unit};
use squealmap_figure::svg::{Anchor, Style, Svg};
use squealmap_figure::text::{Text, wrap};
use squealmap_figure::words::number;
use squealmap_figure::{key, letters, raster};
use squealmap_identify::{Identification, Spectrogram, told};

/// Heights of friction, acceleration and each spectrogram, points.
const HEIGHTS: [f64; 4] = [70.0, 92.0, 100.0, 100.0];
/// Between panels, points; names of curves stand there.
const GAP: f64 = TICK_SIZE + 8.0;
/// Right of the panels, where the colour bars stand, points.
const RIGHT: f64 = 46.0;
/// Width of a colour bar and its distance, points.
const BAR: [f64; 2] = [8.0, 6.0];
/// Margin above and below curves, as a fraction of the panel.
const HEADROOM: f64 = 0.07;
/// Ticks of the time axis.
const TICKS: usize = 9;
/// Ticks of the time axis of a panel that is narrower than `NARROW`, points.
const FEW_TICKS: usize = 5;
const NARROW: f64 = 250.0;
/// The lower end of the scale of levels, dB: a careful measurement resolves about that much.
const FLOOR_DB: f32 = -60.0;
/// Strokes of tangential and normal acceleration.
const STROKES: [&str; 2] = [
    r##"fill="none" stroke="#1F3F8F" stroke-width="0.5" stroke-linejoin="round""##,
    r##"fill="none" stroke="#E08A3C" stroke-width="0.5" stroke-linejoin="round""##,
];
/// Fill of episodes: light enough for curves on top.
const EPISODE: &str = r##"fill="#F3E3B5""##;

/// Everything that the figure shows.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
pub struct Shown {
    /// The heading; may be empty.
    pub title: String,
    /// The verdict in words.
    pub verdict: String,
    /// Start and end of the record, s.
    pub time: [f64; 2],
    /// Tangential and normal acceleration, m/s²: the record is cut into columns side by side, and each has its lowest and
    /// highest value. Empty where not recorded.
    pub accelerations: [Vec<[f64; 2]>; 2],
    /// Start and end of the time over which the friction is known, s.
    pub friction_time: [f64; 2],
    /// The friction coefficient: lowest and highest value of each column, over that time.
    pub friction: Vec<[f64; 2]>,
    /// Start and end of every episode of growth, s.
    pub episodes: Vec<[f64; 2]>,
    /// The spectrogram, whose numbers stand in `spectrogram.nc`.
    pub spectrogram: Spectrogram,
}

impl Shown {
    /// The figure of an identification, with a heading.
    #[must_use]
    pub fn new(found: &Identification, title: &str) -> Shown {
        Shown {
            title: title.to_owned(),
            verdict: verdict_line(found),
            time: found.time,
            accelerations: found.envelopes.each_ref().map(|envelope| envelope.columns.clone()),
            friction_time: found.friction_time,
            friction: found.friction.columns.clone(),
            episodes: found.episodes.iter().map(|episode| episode.time).collect(),
            spectrogram: found.spectrogram.clone(),
        }
    }

    /// `figure.json`: all of it but the numbers of the spectrogram.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn document(&self) -> Result<Vec<u8>> {
        let program = json!({ "version": VERSION, "git_commit": COMMIT });
        let mut bytes = serde_json::to_vec(&json!({ "program": program, "figure": self }))
            .map_err(crate::results::error::Error::WriteManifest)?;
        bytes.push(b'\n');
        Ok(bytes)
    }
}

/// The figure as an SVG document, double column width unless the look says otherwise.
///
/// # Errors
/// When the spectrogram is too large for a picture.
pub fn identify_svg(found: &Shown, look: &Look<'_>) -> Result<String> {
    let pictures = [
        picture(&found.spectrogram, |s, k| s.normalised[k])?,
        picture(&found.spectrogram, |s, k| 1.0 - s.decibel[k] / FLOOR_DB)?,
    ];
    let name = look.title(&found.title);
    let name = if name.is_empty() { "Measured signals" } else { name };
    let draw = |part: f64| draw(found, &pictures, look, HEIGHTS.map(|height| part * height));
    Ok(look.fitted(name, HEIGHTS.iter().sum(), draw))
}

/// The picture and its size, with panels of these heights.
fn draw(found: &Shown, pictures: &[String; 2], look: &Look<'_>, heights: [f64; 4]) -> (Svg, [f64; 2]) {
    let mut svg = Svg::new();
    let page = look.points().unwrap_or(DOUBLE_COLUMN);
    let inner = page - 2.0 * MARGIN;
    let mut y = MARGIN + title(&mut svg, look.title(&found.title), inner);
    for line in wrap(&found.verdict, inner, LABEL_SIZE, false) {
        svg.text(MARGIN, y + LABEL_SIZE, &Text::from(line), Style::new(LABEL_SIZE, Anchor::Start));
        y += LABEL_SIZE + 3.0;
    }
    y += 4.0;
    let time = Scale::Linear { low: found.time[0], high: found.time[1] };
    let unit = kilo(found.spectrogram.frequency[1]);
    let frequency = Scale::Linear { low: 0.0, high: found.spectrogram.frequency[1] / unit.0 };
    let friction = Scale::spanning(found.friction.iter().flatten().copied()).widened(HEADROOM);
    let values = found.accelerations.iter().flatten().flatten().copied();
    let acceleration = Scale::spanning(values).widened(HEADROOM);
    let scales = [&friction, &acceleration, &frequency, &frequency];
    let ticks: [_; 4] = std::array::from_fn(|k| y_ticks(scales[k], heights[k]));
    let room = ticks.iter().map(|ticks| y_tick_room(ticks)).fold(0.0, f64::max);
    let left = MARGIN + LABEL_SIZE + 6.0 + room;
    let width = page - left - RIGHT;
    let x_ticks = time.ticks(if width < NARROW { FEW_TICKS } else { TICKS });
    let labels = labels(acceleration.exponent(), unit.1);
    for (number, height) in heights.into_iter().enumerate() {
        let frame = Frame { x: left, y, width, height };
        let plot = Plot { frame, x: &time, y: scales[number] };
        match number {
            0 => {
                episodes(&mut svg, found, &time, &frame);
                plot.curve(&mut svg, curve(&found.friction, found.friction_time), STROKES[0]);
                if found.friction.is_empty() {
                    nothing(&mut svg, &frame, "no windows, or forces not recorded");
                }
            }
            1 => {
                episodes(&mut svg, found, &time, &frame);
                for (envelope, stroke) in found.accelerations.iter().zip(STROKES) {
                    plot.curve(&mut svg, curve(envelope, found.time), stroke);
                }
                key(&mut svg, found, &frame);
            }
            _ => spectrogram(&mut svg, &found.spectrogram, &pictures[number - 2], &time, &frame),
        }
        frame.border(&mut svg);
        frame.y_ticks(&mut svg, &ticks[number], true);
        frame.x_ticks(&mut svg, &x_ticks, number + 1 == heights.len());
        letters::side(&mut svg, (number, heights.len()), &frame, &labels[number]);
        match number {
            2 => bar(&mut svg, &frame, ["0", "1"], ["re window maximum", "rel."]),
            3 => bar(&mut svg, &frame, ["−60", "0"], ["dB re record maximum", "dB"]),
            _ => {}
        }
        y += frame.height + GAP;
    }
    let bottom = y - GAP;
    let label = Text::from("Time ").symbol("t").plain(" (s)");
    let base = bottom + x_tick_room() + LABEL_SIZE + 1.0;
    svg.text(left + 0.5 * width, base, &label, Style::new(LABEL_SIZE, Anchor::Middle));
    (svg, [page, base + 2.0 + MARGIN])
}

/// `Verdict: 0.000 to 0.082 s no instability, to 0.250 s mode coupling`; of a record without segments that of the whole.
fn verdict_line(found: &Identification) -> String {
    if found.segments.is_empty() {
        let verdict = &found.verdict;
        return format!("Verdict: {} (confidence {:.2})", verdict.kind.words(), verdict.shown_confidence());
    }
    format!("Verdict: {}", told(&found.segments))
}

/// The labels of the panels, each with a shorter one for flat panels.
fn labels(exponent: i32, frequency_unit: &str) -> [[Text; 2]; 4] {
    let unit = format!(" ({frequency_unit})");
    let frequency = [Text::from("Frequency"), Text::default().symbol("f")].map(|text| text.plain(&unit));
    let coefficient = Text::default().symbol("T").plain("/").symbol("N");
    let acceleration = axis_unit("m/s^2", exponent);
    [
        [Text::from("Friction ").then(coefficient.clone()), coefficient],
        [Text::from("Acceleration"), Text::default().symbol("a")].map(|text| text.then(acceleration.clone())),
        frequency.clone(),
        frequency,
    ]
}

/// Hz or kHz, whichever gives short labels.
fn kilo(top: f64) -> (f64, &'static str) {
    if top >= 2000.0 { (1000.0, "kHz") } else { (1.0, "Hz") }
}

/// Shades the episodes.
fn episodes(svg: &mut Svg, found: &Shown, time: &Scale, frame: &Frame) {
    for episode in &found.episodes {
        let [from, to] = episode.map(|t| frame.across(time.position(t).clamp(0.0, 1.0)));
        svg.rect([from, frame.y, to - from, frame.height], EPISODE);
    }
}

/// Lowest and highest value of every column as one line.
fn curve(columns: &[[f64; 2]], [start, end]: [f64; 2]) -> impl Iterator<Item = (f64, f64)> {
    let count = columns.len().max(1) as f64;
    columns.iter().enumerate().flat_map(move |(k, [low, high])| {
        let t = start + (end - start) * (k as f64 + 0.5) / count;
        [(t, *low), (t, *high)]
    })
}

/// Draws the key, which says which curve is which, and what is shaded.
fn key(svg: &mut Svg, found: &Shown, frame: &Frame) {
    const SAMPLE: f64 = 12.0;
    let base = frame.y - 4.0;
    let names = ["tangential", "normal"].map(Text::from);
    let drawn = found.accelerations.iter().zip(names.into_iter().zip(STROKES));
    let entries: Vec<(Text, &str)> =
        drawn.filter(|(columns, _)| !columns.is_empty()).map(|(_, entry)| entry).collect();
    let x = key::lines(svg, frame.x, base, TICK_SIZE, &entries);
    if !found.episodes.is_empty() {
        svg.rect([x, base - 0.75 * TICK_SIZE, SAMPLE, 0.8 * TICK_SIZE], EPISODE);
        svg.text(x + SAMPLE + 3.0, base, &Text::from("grows"), Style::new(TICK_SIZE, Anchor::Start));
    }
}

/// A spectrogram as an embedded picture.
fn picture(found: &Spectrogram, value: impl Fn(&Spectrogram, usize) -> f32) -> Result<String> {
    Ok(data_uri(found.columns, found.rows, |k| value(found, k))?)
}

/// Draws the picture of a spectrogram.
fn spectrogram(svg: &mut Svg, found: &Spectrogram, picture: &str, time: &Scale, frame: &Frame) {
    let [from, to] = found.time.map(|t| frame.across(time.position(t)));
    let [low, high] = found.frequency.map(|f| frame.up(f / found.frequency[1]));
    let [x, y, width, height] = [from, high, to - from, low - high].map(number);
    svg.open(r#"image-rendering="optimizeQuality""#);
    svg.image(&format!(
        r#"x="{x}" y="{y}" width="{width}" height="{height}" preserveAspectRatio="none" href="{picture}""#
    ));
    svg.close();
}

/// A colour bar right of a panel; the second words are for a flat one.
fn bar(svg: &mut Svg, frame: &Frame, ends: [&str; 2], words: [&str; 2]) {
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
    for (end, y) in ends.into_iter().zip([frame.bottom(), frame.y + 0.75 * TICK_SIZE]) {
        svg.text(beside, y, &Text::from(end), Style::new(TICK_SIZE, Anchor::Start));
    }
    let middle = frame.y + 0.5 * frame.height;
    let [long, short] = words.map(Text::from);
    if long.width(TICK_SIZE, false) + 2.0 * TICK_SIZE <= frame.height {
        let upwards = Style::new(TICK_SIZE, Anchor::Middle).upwards();
        svg.text(beside + TICK_SIZE + 1.0, middle, &long, upwards);
    } else {
        svg.text(beside, middle + 0.35 * TICK_SIZE, &short, Style::new(TICK_SIZE, Anchor::Start));
    }
}

/// Words in an empty panel.
fn nothing(svg: &mut Svg, frame: &Frame, words: &str) {
    let (x, y) = (frame.across(0.5), frame.up(0.5));
    svg.text(x, y, &Text::from(words), Style::new(TICK_SIZE, Anchor::Middle));
}
