//! `shapes.svg`: modes as deformed bodies, coloured by tangential and normal displacement, as Figure 17 of the paper.

use squealmap_fem::c64;
use squealmap_fem::output::{facets, isometric};
use squealmap_fem::study::Shape;

use crate::results::figure::look::Look;
use crate::study::fem::bodies::Bodies;
use crate::study::fem::painting::{AXIS, PIECE, Painting, arrow, triad};
use squealmap_figure::frame::{LABEL_SIZE, TICK_SIZE};
use squealmap_figure::letters;
use squealmap_figure::page::{DOUBLE_COLUMN, MARGIN, title};
use squealmap_figure::raster::between;
use squealmap_figure::scale::value_label;
use squealmap_figure::svg::{Anchor, Style, Svg};
use squealmap_figure::text::Text;
use squealmap_figure::words::number;

/// Height of a row of pictures, points: at most ...
const TALLEST: f64 = 190.0;
/// ... and at least, where another picture beside would make them smaller.
const FLATTEST: f64 = 90.0;
/// Between pictures, points.
const GAP: f64 = 8.0;
/// From one line of words to the next, points.
const LINE: f64 = LABEL_SIZE + 2.0;
/// Height of the words above a pair of pictures, points.
const HEAD: f64 = 14.0;
/// Height of the words below each picture, points.
const FOOT: f64 = 22.0;
/// The sine of a phase below which a mode is real: half a degree.
const REAL: f64 = 0.009;
/// The largest displacement of a mode, over the size of the mesh.
const SWING: f64 = 0.07;
/// Shapes of a figure at most: one page.
const MOST: usize = 6;
/// The colours of −1, 0 and 1: dark on both sides, so that a grey print shows where a body stands still.
const COLOURS: [[f32; 3]; 3] = [[31.0, 63.0, 143.0], [246.0, 246.0, 240.0], [213.0, 94.0, 0.0]];

impl Bodies {
    /// The pictures of modes, or nothing where no shape was computed.
    #[must_use]
    pub fn shapes_svg(&self, look: &Look<'_>) -> Option<String> {
        let shown = shown(self);
        let name = look.title(&self.title);
        let name = if name.is_empty() { "Mode shapes" } else { name };
        let pictures: Vec<[Shown; 2]> = shown.iter().map(|shape| both(self, shape)).collect();
        let rows = Rows::new(&pictures, look);
        let all = pictures.len().div_ceil(rows.columns) as f64 * rows.height;
        (!shown.is_empty()).then(|| {
            look.fitted(name, all, |part| {
                page(self, &shown, &pictures, look, &Rows { height: part * rows.height, ..rows })
            })
        })
    }
}

/// The shapes of a figure: those of modes with a transition where there are such, and of an unstable pair the one that grows.
fn shown(bodies: &Bodies) -> Vec<&Shape> {
    let concerned = |shape: &&Shape| bodies.concerned.contains(&shape.mode);
    let of_transitions: Vec<&Shape> = bodies.shapes.iter().filter(concerned).collect();
    let all = if of_transitions.is_empty() { bodies.shapes.iter().collect() } else { of_transitions };
    // Beside the one that grows, its twin looks the same.
    let decays = |shape: &Shape| !bodies.damped && shape.lambda.re < -1e-6 * shape.lambda.norm();
    all.into_iter().filter(|shape| !decays(shape)).take(MOST).collect()
}

fn page(
    bodies: &Bodies,
    shown: &[&Shape],
    pictures: &[[Shown; 2]],
    look: &Look<'_>,
    &Rows { width, columns, column, height }: &Rows,
) -> (Svg, [f64; 2]) {
    let mut svg = Svg::new();
    let mut y = MARGIN + title(&mut svg, look.title(&bodies.title), width - 2.0 * MARGIN);
    let whole = width - 2.0 * MARGIN;
    let pair = 2.0 * column + GAP;
    let captions: Vec<Vec<Text>> = shown
        .iter()
        .enumerate()
        .map(|(index, shape)| caption(bodies, shape).wrapped(pair - letters::width(index), LABEL_SIZE))
        .collect();
    let feet: Vec<[Vec<Text>; 2]> = pictures
        .iter()
        .map(|both| both.each_ref().map(|shown| wrapped(&shown.words, column + GAP - 2.0, TICK_SIZE)))
        .collect();
    let head = HEAD + LINE * (captions.iter().map(Vec::len).max().unwrap_or(1) - 1) as f64;
    let lines = feet.iter().flatten().map(Vec::len).max().unwrap_or(0);
    let foot = FOOT + (TICK_SIZE + 2.0) * lines.saturating_sub(2) as f64;
    for (row, captions) in captions.chunks(columns).enumerate() {
        for (place, caption) in captions.iter().enumerate() {
            let index = row * columns + place;
            let x = MARGIN + place as f64 * (pair + GAP);
            letters::draw_at(&mut svg, index, [x, y]);
            let from = x + letters::width(index);
            for (line, words) in caption.iter().enumerate() {
                let base = y + letters::ASCENT * LABEL_SIZE + LINE * line as f64;
                svg.text(from, base, words, Style::new(LABEL_SIZE, Anchor::Start));
            }
            for (side, picture) in pictures[index].iter().enumerate() {
                let left = x + side as f64 * (column + GAP);
                picture.picture.paint(&mut svg, [left, y + head, column, height], fill);
                for (line, words) in feet[index][side].iter().enumerate() {
                    let below = y + head + height + TICK_SIZE + 2.0 + line as f64 * (TICK_SIZE + 2.0);
                    svg.text(left + 0.5 * column, below, words, Style::new(TICK_SIZE, Anchor::Middle));
                }
            }
        }
        y += head + height + foot + 4.0;
    }
    // Axes and sliding stand left of the scale of colours.
    let below = y + 1.8 * AXIS;
    triad(&mut svg, [MARGIN + AXIS, y + 1.2 * AXIS]);
    let mut taken = 2.4 * AXIS;
    if let Some(contact) = bodies.sliding.filter(|contact| !contact.turns) {
        let at = [MARGIN + 3.8 * AXIS, y + 0.7 * AXIS];
        arrow(&mut svg, at, contact.direction);
        svg.text(at[0], below, &Text::from("sliding"), Style::new(TICK_SIZE, Anchor::Middle));
        taken = 4.8 * AXIS;
    }
    let has_phase = pictures.iter().any(|[_, normal]| normal.has_phase);
    y = bar(&mut svg, [MARGIN, y + 2.0], [whole, taken], below, has_phase).max(below + 2.0);
    (svg, [width, y + MARGIN])
}

/// How pairs of pictures stand on a page.
#[derive(Clone, Copy)]
struct Rows {
    /// Of the page, points.
    width: f64,
    /// Pairs beside one another.
    columns: usize,
    /// Width and height of a picture, points.
    column: f64,
    height: f64,
}

impl Rows {
    fn new(pictures: &[[Shown; 2]], look: &Look<'_>) -> Rows {
        let width = look.points().unwrap_or(DOUBLE_COLUMN);
        let whole = width - 2.0 * MARGIN;
        let aspect = pictures.iter().flatten().map(|shown| shown.picture.aspect()).fold(0.0, f64::max);
        let columns = columns(pictures.len(), aspect, whole);
        let column = ((whole + GAP) / columns as f64 - 2.0 * GAP) / 2.0;
        Rows { width, columns, column, height: (column / aspect).min(TALLEST) }
    }
}

/// How many pairs of pictures stand beside one another: as many as there are, as long as they do not become flatter than allowed.
fn columns(count: usize, aspect: f64, width: f64) -> usize {
    let tall = |columns: usize| {
        let pair = (width + GAP) / columns as f64 - GAP;
        (pair - GAP) / 2.0 / aspect >= FLATTEST
    };
    (1..=count).rev().find(|columns| tall(*columns)).unwrap_or(1)
}

/// Frequency, growth and friction of a shape.
fn caption(bodies: &Bodies, shape: &Shape) -> Text {
    let hertz = shape.lambda.im / std::f64::consts::TAU;
    let rounded = |value: f64, digits: usize| format!("{value:.digits$}").parse().unwrap_or(value);
    let text = Text::from(format!("mode {}, ", shape.mode + 1)).symbol("μ").plain(" = ");
    let text = text
        .then(value_label(shape.mu))
        .plain(": ")
        .then(value_label(rounded(hertz / 1000.0, 3)))
        .plain(" kHz");
    if bodies.damped || shape.lambda.re.abs() > 1e-6 * shape.lambda.norm() {
        text.plain(", ").then(value_label(rounded(shape.lambda.re, 1))).plain(" 1/s")
    } else {
        text
    }
}

/// One picture of a mode, and what stands below it.
struct Shown {
    picture: Painting,
    words: [Text; 2],
    /// Whether the words name a phase.
    has_phase: bool,
}

/// Along the sliding and along the normal, each at the phase at which that displacement is largest.
fn both(bodies: &Bodies, shape: &Shape) -> [Shown; 2] {
    let mesh = &bodies.mesh;
    let size = mesh.extent();
    let along_axes = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let axes = bodies.sliding.map_or(along_axes, |contact| [contact.direction, contact.normal]);
    let length = |u: &[c64; 3]| u.iter().map(c64::norm_sqr).sum::<f64>().sqrt();
    let largest = shape.displacement.iter().map(length).fold(0.0, f64::max);
    let along = axes.map(|axis| {
        shape.displacement.iter().map(|u| (0..3).map(|i| u[i] * axis[i]).sum()).collect::<Vec<c64>>()
    });
    let peak = |values: &Vec<c64>| {
        values.iter().copied().max_by(|a, b| a.norm().total_cmp(&b.norm())).unwrap_or_default()
    };
    let peaks = along.each_ref().map(peak);
    // One of both may be zero: then there is no phase.
    let turned =
        if peaks.iter().all(|peak| peak.norm() > 0.0) { peaks[1].arg() - peaks[0].arg() } else { 0.0 };
    // All of a real mode moves at one time.
    let is_real = turned.sin().abs() < REAL;
    let names = ["along the sliding", "normal to the contact"];
    [0, 1].map(|side| {
        let peak = peaks[side];
        // Turned to where the peak is real.
        let at = if is_real && peaks[0].norm() > 0.0 { peaks[0] } else { peak };
        let turn = if at.norm() > 0.0 { at.conj() / at.norm() } else { c64::new(1.0, 0.0) };
        let moved: Vec<[f64; 3]> =
            shape.displacement.iter().map(|u| u.map(|z| (z * turn).re * SWING * size / largest)).collect();
        let values: Vec<f64> =
            along[side].iter().map(|z| (z * turn).re / peak.norm().max(f64::MIN_POSITIVE)).collect();
        let facets = facets(mesh, &moved, &values, &isometric(), PIECE * size);
        let share = Text::from(format!("largest {:.2}", peak.norm() / largest));
        let has_phase = side == 1 && !is_real;
        let share = if has_phase { share.plain(&format!(", phase {}°", phase(turned))) } else { share };
        Shown { picture: Painting::new(facets), words: [Text::from(names[side]), share], has_phase }
    })
}

/// An angle (rad) from −180 to 180°, as a whole number with a real minus sign.
fn phase(angle: f64) -> String {
    let degrees = angle.to_degrees();
    let whole = (degrees - 360.0 * (degrees / 360.0).round()).round();
    format!("{:.0}", whole + 0.0).replace('-', "−")
}

/// The colour of a value from −1 to 1.
fn fill(value: f64) -> String {
    #[expect(clippy::cast_possible_truncation, reason = "a part of a colour")]
    let part = value.clamp(-1.0, 1.0) as f32;
    if part < 0.0 {
        between([COLOURS[1], COLOURS[0]], -part)
    } else {
        between([COLOURS[1], COLOURS[2]], part)
    }
}

/// Texts as lines of this width, points.
fn wrapped(texts: &[Text], width: f64, size: f64) -> Vec<Text> {
    texts.iter().flat_map(|text| text.wrapped(width, size)).collect()
}

/// The scale of colours below the pictures, `below` the lower end of what takes so much of the width beside it; returns its lower end.
fn bar(svg: &mut Svg, [x, y]: [f64; 2], [width, taken]: [f64; 2], below: f64, has_phase: bool) -> f64 {
    const THICK: f64 = 6.0;
    const STEPS: usize = 70;
    /// The numbers at the ends stand out.
    const ENDS: f64 = 6.0;
    const LONGEST: f64 = 140.0;
    let mut words =
        vec![Text::from("displacement over its largest; its largest is given over that of the mode")];
    if has_phase {
        words.push(Text::from("phase: by how much the normal displacement leads that along the sliding"));
    }
    // In the middle of the page, where the words have room beside what is there; else beside it, and the words below both.
    let longest = words.iter().map(|words| words.width(LABEL_SIZE, false)).fold(0.0, f64::max);
    let middle = 0.5 * (width - longest) >= taken;
    let length = if middle { LONGEST } else { LONGEST.min(width - taken - 2.0 * ENDS) };
    let from = if middle { x + 0.5 * (width - length) } else { x + 0.5 * (taken + width - length) };
    for step in 0..STEPS {
        let part = (step as f64 + 0.5) / STEPS as f64;
        let colour = fill(2.0 * part - 1.0);
        let left = from + length * step as f64 / STEPS as f64;
        svg.rect([left, y, length / STEPS as f64 + 0.2, THICK], &format!(r#"fill="{colour}""#));
    }
    svg.rect([from, y, length, THICK], r##"fill="none" stroke="#000000" stroke-width="0.5""##);
    for (part, value) in [(0.0, -1.0), (0.5, 0.0), (1.0, 1.0)] {
        let at = from + part * length;
        svg.path(
            &format!("M{} {}v2", number(at), number(y + THICK)),
            r##"stroke="#000000" stroke-width="0.5""##,
        );
        svg.text(
            at,
            y + THICK + 4.0 + 0.716 * TICK_SIZE,
            &value_label(value),
            Style::new(TICK_SIZE, Anchor::Middle),
        );
    }
    let mut base = y + THICK + 6.0 + TICK_SIZE;
    if !middle {
        base = base.max(below + 2.0);
    }
    for line in wrapped(&words, width, LABEL_SIZE) {
        base += LABEL_SIZE;
        svg.text(x + 0.5 * width, base, &line, Style::new(LABEL_SIZE, Anchor::Middle));
        base += 2.0;
    }
    base - 2.0
}
