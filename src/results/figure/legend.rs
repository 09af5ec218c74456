//! The legend of a block: only what occurs, with shares or counts.

use crate::model::status::Status;
use crate::results::figure::fills::{FAILED_FILL, LIMIT, hatch, is_stable, not_computed, unsettled_fill};
use crate::results::figure::overlay::{Overlay, Stroke};
use crate::results::figure::palette::Colouring;
use crate::results::figure::sides::{COUNTED, Sides};
use crate::results::figure::{overlay, sides};
use crate::sweep::label::{Label, Tally};
use squealmap_figure::frame::LABEL_SIZE;
use squealmap_figure::svg::{Anchor, Style, Svg};
use squealmap_figure::text::Text;
use squealmap_figure::words::number;

/// Width and height of a swatch, points.
const SWATCH: [f64; 2] = [12.0, 7.5];
/// Between a swatch and its words, points.
const WORD_GAP: f64 = 3.5;
/// Between entries, points.
const ENTRY_GAP: f64 = 13.0;
/// Between base lines, points.
const LINE: f64 = 12.0;
/// The sample beside the words of an entry.
enum Swatch {
    Fill(&'static str, Option<String>),
    Unsettled,
    Failed,
    NotComputed,
    Limit,
    Equal,
    Line(Stroke),
}

/// The entries of a legend in order.
#[derive(Default)]
pub(crate) struct Legend(Vec<(Swatch, Text)>);

impl Legend {
    /// The legend of a sweep with these counts under a colouring; the second are those of what was computed, where the
    /// others have a label all the same. Of a picture with two sides it has a share of each, and says so unless that stands
    /// elsewhere.
    pub(crate) fn new(
        (tally, computed): (&Tally, Option<&Tally>),
        sides: Option<(&Sides, bool)>,
        colouring: Colouring,
        [hatched, cells]: [bool; 2],
    ) -> Legend {
        let share = |selects: &dyn Fn(Label) -> bool| match sides {
            None => share(tally.count(selects), tally.total()),
            Some((Sides(sides), _)) => {
                shares(sides.each_ref().map(|side| [side.count(selects), side.total()]))
            }
        };
        let class = |label: Label| colouring.class(label);
        let mut entries = Vec::new();
        for (k, look) in colouring.classes().iter().enumerate() {
            let of_class = |label: Label| class(label) == Some(k);
            if tally.count(of_class) > 0 {
                let hatch = hatch(k, look.dark).filter(|_| hatched && cells);
                entries.push((
                    Swatch::Fill(look.fill, hatch),
                    Text::from(format!("{} {}", look.label, share(&of_class))),
                ));
            }
        }
        if colouring == Colouring::Regime {
            let unsettled = |label: Label| label.settled() == Some(false);
            if computed.unwrap_or(tally).count(unsettled) > 0 {
                let text = match computed {
                    // No line follows what has settled: of what was not computed it is not known.
                    Some(some) => {
                        let (found, total) = (some.count(unsettled), some.total());
                        format!("unsettled {} of {total} computed", self::share(found, total))
                    }
                    None => format!("unsettled {}", share(&unsettled)),
                };
                entries.push((Swatch::Unsettled, Text::from(text)));
            }
        }
        let missing = |label: Label| not_computed(label, colouring);
        let failed = |label: Label| class(label).is_none() && !missing(label);
        if tally.count(failed) > 0 {
            let of = |status: Status| tally.count(|label| label.status() == status && class(label).is_none());
            let reasons: Vec<&str> = Status::ALL
                .into_iter()
                .filter(|status| *status != Status::Ok && of(*status) > 0)
                .map(reason)
                .collect();
            let reasons =
                if reasons.is_empty() { String::new() } else { format!(": {}", reasons.join(", ")) };
            entries.push((Swatch::Failed, Text::from(format!("no result{reasons} {}", share(&failed)))));
        }
        if tally.count(missing) > 0 {
            entries.push((Swatch::NotComputed, Text::from(format!("not computed {}", share(&missing)))));
        }
        let stable = |wanted| tally.count(|label| label.kind().map(is_stable) == Some(wanted)) > 0;
        if colouring != Colouring::Type && cells && stable(true) && stable(false) {
            entries.push((Swatch::Limit, Text::from("limit of linear stability")));
        }
        if matches!(sides, Some((_, false))) {
            entries.push((Swatch::Equal, Sides::words()));
        }
        Legend(entries)
    }

    /// The same with the kinds of these lines.
    pub(crate) fn with_lines(mut self, lines: &[Overlay]) -> Legend {
        let entry = |stroke: Stroke| (Swatch::Line(stroke), Text::from(stroke.words));
        self.0.extend(overlay::strokes(lines).into_iter().map(entry));
        self
    }

    /// Draws it from `(x, y)` downwards into a width and returns its height; `svg` is `None` to measure only. Words that are
    /// wider go on in the next line.
    pub(crate) fn draw(&self, mut svg: Option<&mut Svg>, x: f64, y: f64, width: f64) -> f64 {
        let (mut left, mut line) = (x, 0.0);
        for (swatch, text) in &self.0 {
            let before = SWATCH[0] + WORD_GAP;
            let lines = text.wrapped(width - before, LABEL_SIZE);
            let entry = before + lines.iter().map(|text| text.width(LABEL_SIZE, false)).fold(0.0, f64::max);
            if left > x && left + entry > x + width {
                left = x;
                line += 1.0;
            }
            if let Some(svg) = svg.as_deref_mut() {
                draw_swatch(svg, swatch, left, y + line * LINE);
                for (number, text) in lines.iter().enumerate() {
                    let base = y + (line + number as f64) * LINE + SWATCH[1] - 1.0;
                    svg.text(left + before, base, text, Style::new(LABEL_SIZE, Anchor::Start));
                }
            }
            line += lines.len().saturating_sub(1) as f64;
            left += entry + ENTRY_GAP;
        }
        if self.0.is_empty() { 0.0 } else { line * LINE + SWATCH[1] + 2.0 }
    }
}

fn draw_swatch(svg: &mut Svg, swatch: &Swatch, x: f64, y: f64) {
    let area = [x, y, SWATCH[0], SWATCH[1]];
    let border = r##"fill="none" stroke="#000000" stroke-width="0.5""##;
    match swatch {
        Swatch::Fill(fill, hatch) => {
            svg.rect(area, &format!(r#"fill="{fill}""#));
            if let Some(hatch) = hatch {
                svg.rect(area, hatch);
            }
        }
        Swatch::Unsettled => svg.rect(area, unsettled_fill(false)),
        Swatch::Failed => {
            svg.rect(area, &format!(r#"fill="{FAILED_FILL}""#));
            svg.rect(area, r#"fill="url(#failed)""#);
        }
        Swatch::NotComputed => {
            svg.rect(area, &format!(r#"fill="{FAILED_FILL}""#));
            svg.rect(area, r#"fill="url(#not-computed)""#);
        }
        Swatch::Limit | Swatch::Equal | Swatch::Line(_) => {
            let line = format!("M{} {}h{}", number(x), number(y + 0.5 * SWATCH[1]), number(SWATCH[0]));
            let stroke = match swatch {
                Swatch::Line(Stroke { rim: Some(rim), attributes, .. }) => {
                    let [x, y] = [x + 0.5 * SWATCH[0], y + 0.5 * SWATCH[1]].map(number);
                    for dot in [rim, attributes] {
                        svg.path(&format!("M{x} {y}h0.01"), dot);
                    }
                    return;
                }
                Swatch::Line(stroke) => stroke.attributes,
                Swatch::Limit => LIMIT[1],
                _ => sides::STROKES[1],
            };
            svg.path(&line, stroke);
            return;
        }
    }
    svg.rect(area, border);
}

/// A status in words.
fn reason(status: Status) -> &'static str {
    match status {
        Status::Unwritten | Status::NotComputed => "not computed",
        Status::Ok => "ok",
        Status::InvalidLaw => "invalid law",
        Status::NoEquilibrium => "no equilibrium",
        Status::Painleve => "Painlevé",
        Status::EventLimit => "event limit",
        Status::StepTooLarge => "step too large",
        Status::NonFinite => "not finite",
    }
}

/// Smaller shares, in percent, would print as 0.0 %.
const LEAST: f64 = 0.05;

/// `(n = 3)` of few instances, `12.3 %` of many.
fn share(n: usize, total: usize) -> String {
    let percent = 100.0 * n as f64 / total.max(1) as f64;
    if total <= COUNTED || percent < LEAST { format!("(n = {n})") } else { format!("{percent:.1} %") }
}

/// `12.3 | 0 %` of two sides, each of its own instances.
fn shares(sides: [[usize; 2]; 2]) -> String {
    let [one, other] = sides.map(|[n, total]| match 100.0 * n as f64 / total.max(1) as f64 {
        _ if n == 0 => "0".to_owned(),
        percent if percent < LEAST => format!("< {}", 2.0 * LEAST),
        percent => format!("{percent:.1}"),
    });
    format!("{one} | {other} %")
}
