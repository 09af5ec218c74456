//! The figure of measured signals, as the source paper shows a stroke: friction, velocity and temperature, accelerations,
//! spectrogram and phase stacked on one time axis with the verdict of each segment, and a few periods at chosen instants.

use crate::results::figure::look::Look;
use crate::study::error::Result;
use crate::study::identify::panels::{
    BAND, RIGHTWARDS, STROKES, band, bar, curve, ends, key_of_accelerations, key_of_phase, key_of_verdicts,
    nothing, over_time, phase, phase_scale, picture, places, rightwards, scale_of, spectrogram, zoom,
};
use crate::study::identify::shown::Shown;
use squealmap_figure::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_room, y_ticks};
use squealmap_figure::page::{DOUBLE_COLUMN, MARGIN, title};
use squealmap_figure::plot::Plot;
use squealmap_figure::scale::{Scale, Tick, axis_unit};
use squealmap_figure::svg::{Anchor, MM, Style, Svg};
use squealmap_figure::text::{Text, wrap};
use squealmap_figure::{key, letters};

/// A panel over the time of the record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Panel {
    Friction,
    Velocity,
    Accelerations,
    Spectrogram,
    Phase,
}

impl Panel {
    const ALL: [Panel; 5] =
        [Panel::Friction, Panel::Velocity, Panel::Accelerations, Panel::Spectrogram, Panel::Phase];

    /// Its height, points.
    fn height(self) -> f64 {
        match self {
            Panel::Friction => 66.0,
            Panel::Velocity => 44.0,
            Panel::Accelerations | Panel::Spectrogram => 84.0,
            Panel::Phase => 76.0,
        }
    }
}

/// Height of a zoom, points, and the least width that it takes with what stands beside it.
const ZOOM: [f64; 2] = [76.0, 105.0];
/// Between panels, points; names of curves stand there.
const GAP: f64 = TICK_SIZE + 8.0;
/// Right of the panels, where colour bars and other scales stand, points.
const RIGHT: f64 = 46.0;
/// Margin above and below curves, as a fraction of the panel.
const HEADROOM: f64 = 0.07;
/// Ticks of the time axis.
const TICKS: usize = 9;
/// A page lower than this, points, as a slide is, has neither velocity and temperature nor a close look.
const LOW: f64 = 350.0;
/// Ticks of the time axis of a panel that is narrower than `NARROW`, points.
const FEW_TICKS: usize = 5;
const NARROW: f64 = 250.0;

/// The figure as an SVG document, double column width unless the look says otherwise.
///
/// # Errors
/// When the spectrogram is too large for a picture.
pub fn identify_svg(found: &Shown, look: &Look<'_>) -> Result<String> {
    let tallest = look.height.map_or(f64::INFINITY, |mm| mm * MM / look.enlarged);
    let essentials = (tallest < LOW).then(|| found.essentials());
    let found = essentials.as_ref().unwrap_or(found);
    let picture = picture(&found.spectrogram)?;
    let name = look.title(&found.title);
    let name = if name.is_empty() { "Measured signals" } else { name };
    let panels = panels(found);
    let rows = zoom_rows(found, look.points().unwrap_or(DOUBLE_COLUMN)).len() as f64;
    let heights = panels.iter().map(|panel| panel.height()).sum::<f64>() + rows * ZOOM[0];
    let draw = |part: f64| draw(found, (&panels, &picture), look, part);
    Ok(look.fitted(name, heights, draw))
}

/// The panels of a record: velocity and temperature have one where one of them is recorded.
fn panels(found: &Shown) -> Vec<Panel> {
    let moves = found.course.iter().any(|at| at.velocity.is_some() || at.temperature.is_some());
    Panel::ALL.into_iter().filter(|panel| *panel != Panel::Velocity || moves).collect()
}

/// The zooms of each row on a page of this width, points.
fn zoom_rows(found: &Shown, page: f64) -> Vec<Vec<usize>> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few")]
    let each = (((page - 2.0 * MARGIN) / ZOOM[1]).floor() as usize).clamp(1, found.zooms.len().max(1));
    let numbers: Vec<usize> = (0..found.zooms.len()).collect();
    numbers.chunks(each).map(<[usize]>::to_vec).collect()
}

/// The picture and its size, heights multiplied by `part`.
fn draw(found: &Shown, (panels, picture): (&[Panel], &str), look: &Look<'_>, part: f64) -> (Svg, [f64; 2]) {
    let mut svg = Svg::new();
    let page = look.points().unwrap_or(DOUBLE_COLUMN);
    let inner = page - 2.0 * MARGIN;
    let mut y = MARGIN + title(&mut svg, look.title(&found.title), inner);
    for line in wrap(&found.verdict, inner, LABEL_SIZE, false).into_iter().filter(|line| !line.is_empty()) {
        svg.text(MARGIN, y + LABEL_SIZE, &Text::from(line), Style::new(LABEL_SIZE, Anchor::Start));
        y += LABEL_SIZE + 3.0;
    }
    y += 4.0;
    let time = Scale::Linear { low: found.time[0], high: found.time[1] };
    let axes = Axes::new(found);
    let ticks: Vec<Vec<Tick>> =
        panels.iter().map(|panel| y_ticks(axes.scale(*panel), part * panel.height())).collect();
    let room = ticks.iter().map(|ticks| y_tick_room(ticks)).fold(0.0, f64::max);
    let left = MARGIN + LABEL_SIZE + 6.0 + room;
    let width = page - left - RIGHT;
    let x_ticks = time.ticks(if width < NARROW { FEW_TICKS } else { TICKS });
    if !found.segments.is_empty() {
        y += key_of_verdicts(&mut svg, [left, y], width, found) + 2.0;
        let strip = Frame { x: left, y, width, height: BAND };
        band(&mut svg, found, &time, &strip);
        y += BAND + 4.0;
    }
    let count = panels.len() + found.zooms.len();
    for (number, panel) in panels.iter().enumerate() {
        let frame = Frame { x: left, y, width, height: part * panel.height() };
        axes.draw(&mut svg, found, *panel, &time, picture, &frame);
        ends(&mut svg, found, &time, &frame);
        frame.border(&mut svg);
        frame.y_ticks(&mut svg, &ticks[number], true);
        frame.x_ticks(&mut svg, &x_ticks, number + 1 == panels.len());
        letters::side(&mut svg, (number, count), &frame, &axes.labels(*panel));
        y += frame.height + GAP;
    }
    let bottom = y - GAP;
    let label = Text::from("Time ").symbol("t").plain(" (s)");
    let mut base = bottom + x_tick_room() + LABEL_SIZE + 1.0;
    svg.text(left + 0.5 * width, base, &label, Style::new(LABEL_SIZE, Anchor::Middle));
    let rows = zoom_rows(found, page);
    let columns = rows.first().map_or(1, Vec::len);
    for row in rows {
        y = base + GAP + 6.0;
        let each = inner / columns as f64;
        for (place, number) in row.iter().enumerate() {
            let beside = 30.0;
            let frame = Frame {
                x: MARGIN + place as f64 * each + beside,
                y,
                width: each - beside - 6.0,
                height: part * ZOOM[0],
            };
            let clip = &found.zooms[*number];
            zoom(&mut svg, clip, (panels.len() + number, digits(found)), &frame);
        }
        base = y + part * ZOOM[0] + x_tick_room() + LABEL_SIZE + 1.0;
        let label = Text::from("Time from the middle (ms)");
        svg.text(
            MARGIN + 0.5 * each * row.len() as f64,
            base,
            &label,
            Style::new(LABEL_SIZE, Anchor::Middle),
        );
    }
    (svg, [page, base + 2.0 + MARGIN])
}

/// Digits of an instant of the record: a thousandth of it.
fn digits(found: &Shown) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 9")]
    let digits = (1e3 / (found.time[1] - found.time[0])).log10().ceil().clamp(0.0, 9.0) as usize;
    digits
}

/// The vertical axes.
struct Axes {
    friction: Scale,
    /// Velocity, or where it is not recorded the temperature.
    first: Scale,
    /// The temperature beside the velocity.
    second: Option<Scale>,
    velocity: bool,
    acceleration: Scale,
    frequency: Scale,
    frequency_unit: &'static str,
    phase: Scale,
}

impl Axes {
    fn new(found: &Shown) -> Axes {
        let (unit, frequency_unit) = kilo(found.spectrogram.frequency[1]);
        let values = found.accelerations.iter().flatten().flatten().copied();
        let (velocity, moves) = scale_of(&found.course, |at| at.velocity);
        let (temperature, heats) = scale_of(&found.course, |at| at.temperature);
        Axes {
            friction: Scale::spanning(found.friction.iter().flatten().copied()).widened(HEADROOM),
            first: if moves { velocity } else { temperature.clone() },
            second: (moves && heats).then_some(temperature),
            velocity: moves,
            acceleration: Scale::spanning(values).widened(HEADROOM),
            frequency: Scale::Linear { low: 0.0, high: found.spectrogram.frequency[1] / unit },
            frequency_unit,
            phase: phase_scale(),
        }
    }

    fn scale(&self, panel: Panel) -> &Scale {
        match panel {
            Panel::Friction => &self.friction,
            Panel::Velocity => &self.first,
            Panel::Accelerations => &self.acceleration,
            Panel::Spectrogram => &self.frequency,
            Panel::Phase => &self.phase,
        }
    }

    /// The label of a panel, and a shorter one for a flat panel.
    fn labels(&self, panel: Panel) -> [Text; 2] {
        match panel {
            Panel::Friction => {
                let coefficient = Text::default().symbol("T").plain("/").symbol("N");
                [Text::from("Friction ").then(coefficient.clone()), coefficient]
            }
            Panel::Velocity if self.velocity => {
                let unit = axis_unit("m/s", self.first.exponent());
                [Text::from("Velocity"), Text::default().symbol("V")].map(|text| text.then(unit.clone()))
            }
            Panel::Velocity => ["Temperature (°C)", "°C"].map(Text::from),
            Panel::Accelerations => {
                let unit = axis_unit("m/s^2", self.acceleration.exponent());
                [Text::from("Acceleration"), Text::default().symbol("a")].map(|text| text.then(unit.clone()))
            }
            Panel::Spectrogram => {
                let unit = format!(" ({})", self.frequency_unit);
                [Text::from("Frequency"), Text::default().symbol("f")].map(|text| text.plain(&unit))
            }
            Panel::Phase => ["Phase (°)", "°"].map(Text::from),
        }
    }

    /// What stands in a panel.
    fn draw(&self, svg: &mut Svg, found: &Shown, panel: Panel, time: &Scale, picture: &str, frame: &Frame) {
        let plot = Plot { frame: *frame, x: time, y: self.scale(panel) };
        match panel {
            Panel::Friction => {
                plot.curve(svg, curve(&found.friction, found.friction_time), STROKES[0]);
                if found.friction.is_empty() {
                    nothing(svg, frame, "no windows, or forces not recorded");
                }
            }
            Panel::Velocity => {
                let temperature = over_time(&found.course, |at| at.temperature);
                if !self.velocity {
                    plot.curve(svg, temperature, STROKES[0]);
                    return;
                }
                plot.curve(svg, over_time(&found.course, |at| at.velocity), STROKES[0]);
                if let Some(second) = &self.second {
                    let label = Text::default().symbol("ϑ").plain(" (°C)");
                    rightwards(svg, &Plot { y: second, ..plot }, &label, temperature);
                    let names = ["velocity", "temperature"].map(Text::from);
                    let entries: Vec<(Text, &str)> =
                        names.into_iter().zip([STROKES[0], RIGHTWARDS]).collect();
                    key::lines(svg, frame.x, frame.y - 4.0, TICK_SIZE, &entries);
                }
            }
            Panel::Accelerations => {
                for (envelope, stroke) in found.accelerations.iter().zip(STROKES) {
                    plot.curve(svg, curve(envelope, found.time), stroke);
                }
                key_of_accelerations(svg, found, frame);
                places(svg, found, time, frame);
            }
            Panel::Spectrogram => {
                spectrogram(svg, &found.spectrogram, picture, time, frame);
                bar(svg, frame);
            }
            Panel::Phase => {
                phase(svg, found, time, frame);
                key_of_phase(svg, frame);
            }
        }
    }
}

/// Hz or kHz, whichever gives short labels.
fn kilo(top: f64) -> (f64, &'static str) {
    if top >= 2000.0 { (1000.0, "kHz") } else { (1.0, "Hz") }
}
