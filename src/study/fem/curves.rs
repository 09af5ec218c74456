//! `fem.svg`: frequencies and growth rates of all modes against friction, as Figure 16 of the paper.

use std::f64::consts::TAU;

use crate::results::figure::look::Look;
use squealmap_figure::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_room, y_ticks};
use squealmap_figure::key::{self, Sample};
use squealmap_figure::letters;
use squealmap_figure::page::{MARGIN, SINGLE_COLUMN, title};
use squealmap_figure::plot::{CRITICAL, GROWS, Plot, SECOND, STABLE, ZERO};
use squealmap_figure::scale::{Scale, axis_unit, value_label};
use squealmap_figure::svg::{Anchor, Style, Svg, polyline};
use squealmap_figure::text::Text;

/// Height of a panel, points.
const HEIGHT: f64 = 130.0;
/// Between the two panels, points.
const GAP: f64 = 9.0;
/// Right of the panels, points.
const RIGHT: f64 = 10.0;
/// Margin above and below curves, as a fraction of the panel.
const HEADROOM: f64 = 0.06;
/// Height of a line of text, points.
const LINE: f64 = 10.0;
/// How many ticks the axis of friction has at most.
const X_TICKS: usize = 7;
/// Without damping, what rounding leaves of the growth of a stable mode is below this part of its eigenvalue.
const ROUNDING: f64 = 1e-6;

/// The modes of a study over friction.
#[derive(Clone, Debug, PartialEq)]
pub struct Curves {
    /// What stands above them.
    pub title: String,
    /// What they are over, with its unit, where that is not the coefficient of friction.
    pub over: Option<[String; 2]>,
    /// The coefficient of friction of all of them, where they are over something else.
    pub at: Option<f64>,
    /// Coefficients of friction, or values of what they are over, rising.
    pub mus: Vec<f64>,
    /// Whether anything damps.
    pub damped: bool,
    /// The modes.
    pub modes: Vec<Curve>,
    /// Where they begin and end to grow.
    pub transitions: Vec<Transition>,
}

/// A mode over friction.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its number, from 1.
    pub mode: usize,
    /// At each coefficient of friction.
    pub states: Vec<State>,
}

/// A mode at a coefficient of friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Hz.
    pub frequency: f64,
    /// 1/s.
    pub growth: f64,
    /// Whether it grows.
    pub grows: bool,
}

/// Where modes begin or end to grow.
#[derive(Clone, Debug, PartialEq)]
pub struct Transition {
    /// `coalescence`, `separation`, `onset` or `end`.
    pub event: String,
    /// The coefficient of friction.
    pub mu: f64,
    /// Hz.
    pub frequency: f64,
    /// The modes concerned, from 1.
    pub modes: Vec<usize>,
}

impl Transition {
    /// Whether growth begins here.
    #[must_use]
    pub fn begins(&self) -> bool {
        matches!(self.event.as_str(), "coalescence" | "divergence" | "onset")
    }

    /// Whether two modes become one here, or part.
    fn merges(&self) -> bool {
        matches!(self.event.as_str(), "coalescence" | "separation")
    }
}

impl Curves {
    /// The figure as an SVG document, or nothing where there is one coefficient of friction only.
    #[must_use]
    pub fn svg(&self, look: &Look<'_>) -> Option<String> {
        let name = look.title(&self.title);
        let name = if name.is_empty() { "Modes against friction" } else { name };
        (self.mus.len() > 1).then(|| look.fitted(name, 2.0 * HEIGHT, |part| page(self, look, part * HEIGHT)))
    }
}

/// In decades, where the values go over more than one.
fn scale(values: &[f64]) -> Scale {
    let (low, high) = (values[0], values[values.len() - 1]);
    if low > 0.0 && high > 20.0 * low {
        Scale::Log { low, high }
    } else {
        Scale::spanning(values.iter().copied())
    }
}

/// kHz.
fn frequency(state: &State) -> f64 {
    state.frequency / 1000.0
}

fn page(curves: &Curves, look: &Look<'_>, height: f64) -> (Svg, [f64; 2]) {
    let width = look.points().unwrap_or(SINGLE_COLUMN);
    let mut svg = Svg::new();
    let mut y = MARGIN + title(&mut svg, look.title(&curves.title), width - 2.0 * MARGIN);
    let states = || curves.modes.iter().flat_map(|mode| &mode.states);
    let x = scale(&curves.mus);
    let frequencies = Scale::spanning(states().map(frequency)).widened(HEADROOM);
    let growths = Scale::spanning(states().map(|s| s.growth).chain([0.0])).widened(HEADROOM);
    let scales = [frequencies, growths];
    let ticks = scales.each_ref().map(|scale| y_ticks(scale, height));
    let left = MARGIN + LABEL_SIZE + 6.0 + ticks.iter().map(|ticks| y_tick_room(ticks)).fold(0.0, f64::max);
    let across = width - left - RIGHT;
    let unstable = if curves.damped { "unstable" } else { "unstable pair" };
    let mut entries = vec![(Text::from("stable"), STABLE)];
    if states().any(|state| state.grows) {
        entries.push((Text::from(unstable), GROWS));
    }
    if states().any(|state| course(curves, state) == Course::Decays) {
        entries.push((Text::from("decaying twin"), SECOND));
    }
    if curves.transitions.iter().any(|transition| !transition.begins()) {
        entries.push((Text::from("growth begins or ends"), CRITICAL));
    }
    let entries: Vec<(Text, Sample<'_>)> =
        entries.into_iter().map(|(words, stroke)| (words, Sample::Line(stroke))).collect();
    y += key::rows(&mut svg, [left, y], across, LABEL_SIZE, &entries) + 2.0;
    let marks: Vec<f64> = curves.transitions.iter().map(|transition| transition.mu).collect();
    if !marks.is_empty() {
        y += LINE;
    }
    let x_ticks = x.ticks(X_TICKS);
    for (row, scale) in scales.iter().enumerate() {
        let frame = Frame { x: left, y: y + row as f64 * (height + GAP), width: across, height };
        let plot = Plot { frame, x: &x, y: scale };
        if row == 1 {
            plot.curve(&mut svg, [curves.mus[0], curves.mus[curves.mus.len() - 1]].map(|mu| (mu, 0.0)), ZERO);
        }
        // What grows lies on top.
        for (stroke, wanted) in [(STABLE, Course::Stable), (SECOND, Course::Decays), (GROWS, Course::Grows)] {
            for mode in &curves.modes {
                let value = |state: &State| if row == 0 { frequency(state) } else { state.growth };
                plot.curve(&mut svg, along(curves, mode, wanted, value), stroke);
            }
        }
        frame.border(&mut svg);
        frame.x_ticks(&mut svg, &x_ticks, row == 1);
        frame.y_ticks(&mut svg, &ticks[row], true);
    }
    let both = Frame { x: left, y, width: across, height: 2.0 * height + GAP };
    critical(&mut svg, curves, &x, &both);
    let label =
        |words: &str, unit: &str, scale: &Scale| Text::from(words).then(axis_unit(unit, scale.exponent()));
    let labels = [label("Frequency", "kHz", &scales[0]), label("Growth rate", "1/s", &scales[1])];
    for (row, words) in labels.into_iter().enumerate() {
        let frame = Frame { x: left, y: y + row as f64 * (height + GAP), width: 0.0, height };
        letters::side(&mut svg, (row, 2), &frame, &[words]);
    }
    y += 2.0 * height + GAP + x_tick_room() + LABEL_SIZE + 1.0;
    let words = match &curves.over {
        None => Text::from("Coefficient of friction ").symbol("μ"),
        Some([what, unit]) => Text::from(what.as_str()).then(axis_unit(unit, x.exponent())),
    };
    let words = match curves.at {
        Some(mu) => words.plain(", at ").symbol("μ").plain(" = ").then(value_label(mu)),
        None => words,
    };
    svg.text(left + 0.5 * across, y, &words, Style::new(LABEL_SIZE, Anchor::Middle));
    (svg, [width, y + MARGIN + 2.0])
}

/// What a mode does.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Course {
    Stable,
    Grows,
    Decays,
}

fn course(curves: &Curves, state: &State) -> Course {
    let State { frequency, growth, grows } = *state;
    if grows {
        Course::Grows
    } else if !curves.damped && -growth > ROUNDING * growth.hypot(TAU * frequency) {
        Course::Decays
    } else {
        Course::Stable
    }
}

/// The values of a mode where it takes this course, nothing where it takes another. A piece begins at the transition, not at the
/// next value of friction.
fn along<'a>(
    curves: &'a Curves,
    mode: &'a Curve,
    wanted: Course,
    value: impl Fn(&State) -> f64 + 'a,
) -> Vec<(f64, f64)> {
    /// Pieces of a curve between a transition and the next value of friction.
    const PIECES: usize = 16;
    let course = |i: usize| course(curves, &mode.states[i]);
    let mut points = Vec::new();
    for i in 0..curves.mus.len() {
        let here = course(i) == wanted;
        let own = |i: usize| (curves.mus[i], value(&mode.states[i]));
        points.push(if here { own(i) } else { (f64::NAN, f64::NAN) });
        if i + 1 < curves.mus.len() && course(i) != course(i + 1) {
            let between = curves.mus[i]..curves.mus[i + 1];
            let met =
                curves.transitions.iter().find(|t| t.modes.contains(&mode.mode) && between.contains(&t.mu));
            let other = course(i + 1) == wanted;
            if met.is_none() && (here || other) {
                // Where it changes is not known: on a straight line through 0, or half-way, up to where what has no growth has none.
                let [from, to] = [mode.states[i], mode.states[i + 1]];
                let crosses = from.growth * to.growth < 0.0;
                let part = if crosses { from.growth / (from.growth - to.growth) } else { 0.5 };
                let between = |a: f64, b: f64| a + part * (b - a);
                let least = if from.growth.abs() < to.growth.abs() { from.growth } else { to.growth };
                let growth = if crosses { 0.0 } else { least };
                let state = State { frequency: between(from.frequency, to.frequency), growth, grows: here };
                let place = (between(curves.mus[i], curves.mus[i + 1]), value(&state));
                points.push(place);
                if here {
                    points.push((f64::NAN, f64::NAN));
                }
            }
            if let Some(t) = met.filter(|_| here || other) {
                let known = if here { i } else { i + 1 };
                let (from, state) = (curves.mus[known], mode.states[known]);
                // Near a coalescence eigenvalues go with the root of the distance.
                let power = if t.merges() { 0.5 } else { 1.0 };
                let between = |k: usize| {
                    let part = k as f64 / PIECES as f64;
                    let root = part.powf(power);
                    let frequency = t.frequency + (state.frequency - t.frequency) * root;
                    let between = State { frequency, growth: state.growth * root, ..state };
                    (t.mu + (from - t.mu) * part, value(&between))
                };
                if here {
                    points.extend((0..PIECES).rev().map(between));
                    points.push((f64::NAN, f64::NAN));
                } else {
                    points.extend((0..PIECES).map(between));
                }
            }
        }
    }
    points
}

/// A line through both panels at each transition, with the critical friction above the first of each.
fn critical(svg: &mut Svg, curves: &Curves, x: &Scale, frame: &Frame) {
    /// Digits of a critical value: more than a plot resolves, enough to compare.
    const DIGITS: usize = 3;
    let mut free = f64::MIN;
    for transition in &curves.transitions {
        let at = frame.across(x.position(transition.mu));
        svg.path(&polyline([(at, frame.y), (at, frame.bottom())]), CRITICAL);
        if !transition.begins() {
            continue;
        }
        let rounded = |value: f64| format!("{value:.DIGITS$e}").parse().unwrap_or(value);
        let text = Text::default()
            .symbol("μ_c")
            .plain(" = ")
            .then(value_label(rounded(transition.mu)))
            .plain(", ")
            .then(value_label(rounded(transition.frequency / 1000.0)))
            .plain(" kHz");
        let half = 0.5 * text.width(TICK_SIZE, false);
        let middle = at.clamp(frame.x + half, (frame.x + frame.width - half).max(frame.x + half));
        // Labels that would overlap are left out: the manifest has the values.
        if middle - half > free {
            svg.text(middle, frame.y - 3.0, &text, Style::new(TICK_SIZE, Anchor::Middle));
            free = middle + half + 2.0;
        }
    }
}
