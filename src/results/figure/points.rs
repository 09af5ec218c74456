//! The content of a panel of scattered points.

use std::cmp::Reverse;
use std::fmt::Write as _;

use crate::results::figure::fills::{FAILED_FILL, not_computed, unsettled, unsettled_fill};
use crate::results::figure::palette::{Class, Colouring, PALE};
use crate::results::figure::panels::{Panel, Panels, Scatter};
use crate::sweep::grid::Grid;
use crate::sweep::label::Label;
use squealmap_figure::frame::Frame;
use squealmap_figure::svg::Svg;
use squealmap_figure::words::number;

/// Colours of crosses and of hatching.
const FAILED: &str = "#C00000";
pub(crate) const NOT_COMPUTED: &str = "#B4B4B4";
/// Largest and smallest radius of a point.
const RADII: [f64; 2] = [0.4, 3.2];
/// Radius by the distance of points that fill a panel evenly: neighbours leave half of its area free.
const PER_DISTANCE: f64 = 0.4;
/// Smaller points have no outline, which would be most of them.
const OUTLINED_FROM: f64 = 1.6;
/// Marks of one path: a renderer's time grows faster than the number in a single one.
const MARKS_OF_A_PATH: usize = 256;
/// The rim of small points is their colour in this lightness, and this part of the radius is within it.
const RIM: f64 = 0.7;
/// Small points that failed are larger by this factor, and no smaller than that.
const FAILED_SIZE: f64 = 1.5;
const LEAST_FAILED: f64 = 1.0;
/// Width of the strokes of small marks, by their radius.
const STROKE: f64 = 0.35;

/// The radius of all points of a figure, so small that those of its fullest panel can be told apart.
pub(crate) fn radius(scatter: Scatter, frame: &Frame) -> f64 {
    let distance = (frame.width * frame.height / scatter.fullest.max(1) as f64).sqrt();
    (PER_DISTANCE * distance).clamp(RADII[0], RADII[1])
}

/// Whether points of this radius have an outline; else they are drawn as [`Marks`].
pub(crate) fn outlined(radius: f64) -> bool {
    radius >= OUTLINED_FROM
}

/// Draws the points of a panel into its frame.
pub(crate) fn draw(
    svg: &mut Svg,
    grid: &Grid,
    panels: &Panels,
    panel: &Panel,
    colouring: Colouring,
    frame: &Frame,
) {
    let Some(scatter) = panels.scatter else { return };
    let radius = radius(scatter, frame);
    let at = |place: &usize| positions(grid, panels, panels.instances[*place], frame);
    let missing = |place: &usize| not_computed(panels.labels[*place], colouring);
    // Nothing that was computed is covered by a point that was not.
    let (missing, computed): (Vec<usize>, Vec<usize>) = panel.cells.clone().partition(missing);
    if !outlined(radius) {
        let of = |place: &usize| Some((at(place)?, panels.labels[*place]));
        let missing: Vec<_> = missing.iter().filter_map(at).collect();
        let computed: Vec<_> = computed.iter().filter_map(of).collect();
        return draw_dense(svg, &missing, &computed, colouring, radius);
    }
    for [x, y] in missing.iter().filter_map(at) {
        missing_point(svg, [x, y], radius);
    }
    for place in computed {
        let (Some([x, y]), label) = (at(&place), panels.labels[place]) else { continue };
        point(svg, [x, y], radius, colouring.class(label).map(|k| &colouring.classes()[k]));
        if unsettled(label, colouring) {
            let dark = colouring.class(label).is_some_and(|k| colouring.classes()[k].dark);
            svg.circle(x, y, radius, &format!(r#"class="unsettled" {}"#, unsettled_fill(dark)));
        }
    }
}

/// Draws points that are too small for outlines: first those that were not computed, then class by class with the rarest
/// last, and on top of them those without a class.
fn draw_dense(
    svg: &mut Svg,
    missing: &[[f64; 2]],
    computed: &[([f64; 2], Label)],
    colouring: Colouring,
    radius: f64,
) {
    let classes = colouring.classes();
    let mut members = vec![Vec::new(); classes.len()];
    let mut hatched = members.clone();
    let mut failed = Vec::new();
    for (at, label) in computed {
        let Some(k) = colouring.class(*label) else {
            failed.push(*at);
            continue;
        };
        members[k].push(*at);
        if unsettled(*label, colouring) {
            hatched[k].push(*at);
        }
    }
    let mut order: Vec<usize> = (0..classes.len()).collect();
    order.sort_by_key(|k| Reverse(members[*k].len()));
    let marks = Marks { radius, class: "not_computed" };
    marks.backslashes(svg, missing, NOT_COMPUTED);
    for k in order {
        let Class { name, fill, dark, .. } = classes[k];
        let marks = Marks { class: name, ..marks };
        if fill == PALE {
            marks.rims(svg, &members[k], fill);
        } else {
            marks.discs(svg, &members[k], fill);
        }
        Marks { class: "unsettled", ..marks }.slashes(svg, &hatched[k], contrast(dark));
    }
    let marks = Marks { radius: (FAILED_SIZE * radius).max(LEAST_FAILED), class: "failed" };
    marks.discs(svg, &failed, "#000000");
    Marks { radius: 0.85 * marks.radius, ..marks }.discs(svg, &failed, FAILED_FILL);
    marks.crosses(svg, &failed, FAILED);
}

/// The colour of marks that are seen on a dark or a light one.
pub(crate) fn contrast(dark: bool) -> &'static str {
    if dark { "#FFFFFF" } else { "#000000" }
}

/// How many small points are drawn: without outlines.
#[derive(Clone, Copy)]
pub(crate) struct Marks {
    pub(crate) radius: f64,
    /// Their class in the document.
    pub(crate) class: &'static str,
}

impl Marks {
    /// Discs: the round ends of lines of no length.
    pub(crate) fn discs(self, svg: &mut Svg, at: &[[f64; 2]], colour: &str) {
        self.draw(svg, at, &Stroke { colour, width: 2.0 * self.radius, shape: "h0.01" });
    }

    /// Discs with a rim in a darker shade, so that a light one is seen on the paper.
    pub(crate) fn rims(self, svg: &mut Svg, at: &[[f64; 2]], colour: &str) {
        self.discs(svg, at, &shade(colour));
        Marks { radius: RIM * self.radius, ..self }.discs(svg, at, colour);
    }

    /// Strokes in the direction of the hatching of what has not settled.
    pub(crate) fn slashes(self, svg: &mut Svg, at: &[[f64; 2]], colour: &str) {
        self.diagonals(svg, at, colour, ["", "-"]);
    }

    /// Strokes in the direction of the hatching of what has no result.
    pub(crate) fn backslashes(self, svg: &mut Svg, at: &[[f64; 2]], colour: &str) {
        self.diagonals(svg, at, colour, ["-", ""]);
    }

    /// Draws diagonal strokes through places. `before` is the sign of the height from a place to the start of its stroke,
    /// `along` the sign of the height from there to its end.
    fn diagonals(self, svg: &mut Svg, at: &[[f64; 2]], colour: &str, [before, along]: [&str; 2]) {
        let [arm, all] = [0.6 * self.radius, 1.2 * self.radius].map(number);
        let shape = format!("m-{arm} {before}{arm}l{all} {along}{all}");
        self.draw(svg, at, &Stroke { colour, width: STROKE * self.radius, shape: &shape });
    }

    /// Crosses.
    fn crosses(self, svg: &mut Svg, at: &[[f64; 2]], colour: &str) {
        let [arm, all] = [0.5 * self.radius, self.radius].map(number);
        let shape = format!("m-{arm} {arm}l{all} -{all}m-{all} 0l{all} {all}");
        self.draw(svg, at, &Stroke { colour, width: STROKE * self.radius, shape: &shape });
    }

    /// Draws one stroke at every place.
    fn draw(self, svg: &mut Svg, at: &[[f64; 2]], stroke: &Stroke<'_>) {
        let (class, Stroke { colour, shape, .. }) = (self.class, stroke);
        let width = number(stroke.width);
        let look = format!(
            r#"class="{class}" fill="none" stroke="{colour}" stroke-width="{width}" stroke-linecap="round""#
        );
        for points in at.chunks(MARKS_OF_A_PATH) {
            let mut data = String::new();
            for [x, y] in points {
                let _ = write!(data, "M{} {}{shape}", number(*x), number(*y));
            }
            svg.path(&data, &look);
        }
    }
}

/// A line from a place on.
struct Stroke<'a> {
    colour: &'a str,
    width: f64,
    /// The rest of its path.
    shape: &'a str,
}

/// A colour `#RRGGBB` in the lightness [`RIM`].
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a part of a byte")]
fn shade(colour: &str) -> String {
    let channel = |i: usize| u8::from_str_radix(colour.get(i..i + 2).unwrap_or("00"), 16).unwrap_or(0);
    let [r, g, b] = [1, 3, 5].map(|i| (f64::from(channel(i)) * RIM) as u8);
    format!("#{r:02X}{g:02X}{b:02X}")
}

/// Where a scattered point stands in a frame, points; `None` where the panels hold cells.
pub(crate) fn positions(grid: &Grid, panels: &Panels, instance: usize, frame: &Frame) -> Option<[f64; 2]> {
    let scatter = panels.scatter?;
    let coordinates = grid.coordinates(instance);
    let x = coordinates.get(scatter.x).map_or(0.5, |value| panels.x.position(value));
    let up = match (&panels.y, scatter.y) {
        (Some(axis), Some(column)) => axis.position(coordinates[column]),
        _ => 0.5,
    };
    Some([frame.across(x), frame.up(up)])
}

/// One point; without a class a white one with a cross.
fn point(svg: &mut Svg, [x, y]: [f64; 2], radius: f64, class: Option<&Class>) {
    /// Edge of a cross inside the circle, by its radius.
    const ARM: f64 = 0.7;
    let (name, fill) = class.map_or(("failed", FAILED_FILL), |look| (look.name, look.fill));
    svg.circle(
        x,
        y,
        radius,
        &format!(r##"class="{name}" fill="{fill}" stroke="#000000" stroke-width="0.5""##),
    );
    if class.is_none() {
        svg.path(
            &squealmap_figure::key::cross((x, y), ARM * radius),
            &format!(r#"fill="none" stroke="{FAILED}" stroke-width="0.9""#),
        );
    }
}

/// A point that was not computed: hatched, in a thin grey line.
fn missing_point(svg: &mut Svg, [x, y]: [f64; 2], radius: f64) {
    svg.circle(x, y, radius, &format!(r#"class="not_computed" fill="{FAILED_FILL}""#));
    let hatch = format!(r#"fill="url(#not-computed)" stroke="{NOT_COMPUTED}" stroke-width="0.5""#);
    svg.circle(x, y, radius, &hatch);
}
