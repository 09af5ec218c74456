//! The line `μ_s = μ_d` in a picture over both coefficients. On one side of it friction falls with the speed, as that of
//! brakes does; on the other it rises, which few materials do. Shares of the whole picture would mix the two.

use crate::model::Param;
use crate::results::figure::panels::Panels;
use crate::results::figure::picture_axis::PictureAxis;
use crate::sweep::grid::{AxisKey, Grid, Value};
use crate::sweep::label::Tally;
use squealmap_figure::frame::Frame;
use squealmap_figure::scale::Scale;
use squealmap_figure::svg::Svg;
use squealmap_figure::text::Text;
use squealmap_figure::words::number;

/// The light line and the dark one on it: drawn over classes of any colour.
pub(crate) const STROKES: [&str; 2] = [
    r##"fill="none" stroke="#FFFFFF" stroke-width="1.5""##,
    r##"class="equal_coefficients" fill="none" stroke="#000000" stroke-width="0.6""##,
];

/// Up to this many instances the legend counts; above it gives percentages.
pub const COUNTED: usize = 200;

/// The instances with `μ_s ≥ μ_d` and those below, counted.
pub(crate) struct Sides(pub(crate) [Tally; 2]);

impl Sides {
    /// The sides of a picture over both coefficients, as far as it shows the instances.
    pub(crate) fn of(grid: &Grid, panels: &Panels) -> Option<Sides> {
        across(panels)?;
        let mut sides = [Tally::default(), Tally::default()];
        for (instance, label) in panels.instances.iter().zip(&panels.labels) {
            sides[usize::from(rises(grid, *instance))].add_label(*label);
        }
        Some(Sides(sides))
    }

    /// What the shares of a legend are of: short, for the narrowest figure.
    pub(crate) fn words() -> Text {
        relation(" ≥ ").plain(" | ").then(relation(" < "))
    }

    /// What the shares of a legend are of, in the words of a heading, with the line named.
    pub(crate) fn heading() -> Text {
        Text::from("line ").then(relation(" = ")).plain(", shares of ").then(Sides::words())
    }

    /// Draws the line into a panel.
    pub(crate) fn draw(svg: &mut Svg, panels: &Panels, frame: &Frame) {
        let Some([from, to]) = across(panels) else { return };
        let Some(y) = &panels.y else { return };
        let at =
            |value: f64| [frame.across(panels.x.scale.position(value)), frame.up(y.scale.position(value))];
        let ([x0, y0], [x1, y1]) = (at(from), at(to));
        let line = format!("M{} {}L{} {}", number(x0), number(y0), number(x1), number(y1));
        for stroke in STROKES {
            svg.path(&line, stroke);
        }
    }
}

/// `μ_s` and `μ_d` with a sign between them.
fn relation(sign: &str) -> Text {
    Text::default().symbol("μ_s").plain(sign).symbol("μ_d")
}

/// The values between which the line crosses a picture over both coefficients, of more instances than a legend counts.
fn across(panels: &Panels) -> Option<[f64; 2]> {
    let (x, y) = (&panels.x, panels.y.as_ref()?);
    let is = |axis: &PictureAxis, param| axis.key() == Some(AxisKey::Param(param));
    let both = is(x, Param::MuS) && is(y, Param::MuD) || is(x, Param::MuD) && is(y, Param::MuS);
    let linear = |axis: &PictureAxis| matches!(axis.scale, Scale::Linear { .. });
    if !both || panels.scatter.is_some() || panels.instances.len() <= COUNTED || !linear(x) || !linear(y) {
        return None;
    }
    let end = |at: f64| [x.scale.value(at), y.scale.value(at)];
    let ([x0, y0], [x1, y1]) = (end(0.0), end(1.0));
    let (from, to) = (x0.max(y0), x1.min(y1));
    (from < to).then_some([from, to])
}

/// Whether friction rises with the speed: `μ_s < μ_d`.
fn rises(grid: &Grid, instance: usize) -> bool {
    let mut coefficients = [0.0; 2];
    grid.each(instance, |key, value| {
        if let (AxisKey::Param(param), Value::Number(number)) = (key, value) {
            match param {
                Param::MuS => coefficients[0] = *number,
                Param::MuD => coefficients[1] = *number,
                _ => {}
            }
        }
    });
    coefficients[0] < coefficients[1]
}
