//! One block of a figure: heading, a grid of panels with shared axes, legend.

use crate::results::figure::beside::{gap_across, parted};
use crate::results::figure::curve_block::is_curve;
use crate::results::figure::field::Field;
use crate::results::figure::legend::Legend;
use crate::results::figure::look::Content;
use crate::results::figure::overlay::Overlay;
use crate::results::figure::palette::Colouring;
use crate::results::figure::panels::Panels;
use crate::results::figure::picture_axis::Direction;
use crate::results::figure::sides::Sides;
use crate::results::figure::{cells, colour_bar, curve_block, overlay};
use crate::sweep::grid::Grid;
use crate::sweep::label::Tally;
use crate::sweep::spec::Starts;
use squealmap_figure::frame::{Frame, LABEL_SIZE, TICK_SIZE, x_tick_room, y_tick_room};
use squealmap_figure::layout::Layout;
use squealmap_figure::letters;
use squealmap_figure::svg::{Anchor, Style, Svg};
use squealmap_figure::text::Text;

/// Between panels of a row, points; more, up to the second, where their labels would touch.
const GAP_ACROSS: [f64; 2] = [7.0, 15.0];
/// Between rows of panels, points.
const GAP_DOWN: f64 = 7.0;
/// Height of a line of text, points.
const LINE: f64 = 10.0;
/// Half a tick label may stand out to the right, points.
const RIGHT: f64 = 6.0;
/// A row of panels holds no more than this many.
const MOST_COLUMNS: usize = 6;
/// Panels are no narrower than this, points: the six of a row on two columns of a journal are a little wider.
const NARROWEST: f64 = 64.0;
/// On a page that would be too tall otherwise they may be as narrow as this.
const CROWDED: f64 = 44.0;
/// The labels of the vertical axis take about this much, points.
const LEFT: f64 = 34.0;
/// Preferred number of panels in a row when there are more than one row of them.
const COLUMNS: usize = 5;
/// A picture is no taller than this, points (75 mm).
const TALLEST: f64 = 213.0;
/// Heading, axis and legend of a block take about this much, points.
const AROUND: f64 = 72.0;
/// The panel of a curve is no flatter than this part of its usual height.
const FLATTEST_CURVE: f64 = 0.4;
/// Axis and letter of a block with a curve take about this much, points.
const CURVE_AROUND: f64 = 26.0;
/// Height of a picture without a vertical axis, points.
const STRIP: f64 = 24.0;
/// Height of a row of named cells, points.
const NAMED_ROW: f64 = 18.0;

/// One block to draw.
#[derive(Clone, Copy)]
pub(crate) struct Block<'a> {
    pub(crate) grid: &'a Grid,
    /// The counts of all instances, also of those that no panel shows.
    pub(crate) tally: &'a Tally,
    /// The counts of computed instances alone; `None` where every instance was computed. In a refined map the others have
    /// labels, too.
    pub(crate) computed: Option<&'a Tally>,
    pub(crate) panels: &'a Panels,
    pub(crate) content: Content<'a>,
    /// Lines over the panels.
    pub(crate) overlays: &'a [Overlay],
    /// The starts of every instance.
    pub(crate) starts: Starts,
    /// How many blocks the figure stacks, and how it arranges them.
    pub(crate) blocks: usize,
    pub(crate) layout: Layout,
    /// The number of the letter before the heading, when there are several blocks.
    pub(crate) letter: Option<usize>,
    /// The least room left of the panels, points. Panels of curves and strips that stand one below the other begin together.
    pub(crate) least_left: f64,
    /// Lines of headings beyond the first, of the one in its row that has most.
    pub(crate) more_lines: usize,
    /// Whether the height alone is asked for: nothing is drawn into the panels.
    pub(crate) measured: bool,
}

impl Block<'_> {
    /// Draws it with the upper left corner at `(x, y)` and returns its height.
    pub(crate) fn draw(&self, svg: &mut Svg, x: f64, y: f64, width: f64) -> f64 {
        let panels = self.panels;
        if is_curve(self.content, panels) {
            let left = self.left().max(self.least_left);
            let size = [width, self.curve_height(), left];
            return curve_block::draw(svg, panels, (self.content, self.letter), [x, y], size);
        }
        let mut heading = Style::new(LABEL_SIZE, Anchor::Start).bold();
        let mut words = x;
        if let Some(letter) = self.letter {
            let label = Text::from(letters::letter(letter));
            svg.text(x, y + LABEL_SIZE, &label, heading);
            words += letters::width(letter);
        }
        heading.bold = false;
        let field = Field::of(self.content, panels);
        let of_classes = field.is_none() && !matches!(self.content, Content::Lines);
        let sides = Sides::of(self.grid, panels).filter(|_| of_classes);
        let mut lines = self.heading(width);
        // Beside the heading what the shares are of takes no line of its own.
        let mut is_said = false;
        if let (Some(_), [line]) = (&sides, lines.as_mut_slice()) {
            let said = line.clone().plain("; ").then(Sides::heading());
            is_said = words - x + said.width(LABEL_SIZE, false) <= width;
            if is_said {
                *line = said;
            }
        }
        for (number, line) in lines.iter().enumerate() {
            svg.text(words, y + LABEL_SIZE + number as f64 * LINE, line, heading);
        }
        let top = y + LABEL_SIZE + self.more_lines as f64 * LINE + 6.0;

        let count = panels.all.len();
        let columns = self.columns(width);
        let rows = count.div_ceil(columns);
        let lines = self.title_lines() as f64;
        // The labels of the vertical axis need its height, which needs the width they leave: start from a guess.
        let mut left = LEFT;
        let mut size = self.panel_size(width - left - RIGHT, columns, GAP_ACROSS[0]);
        let gap = gap_across(&panels.x.ticks(size[0], Direction::Horizontal, TICK_SIZE), size[0], GAP_ACROSS);
        for _ in 0..2 {
            size = self.panel_size(width - left - RIGHT, columns, gap);
            left = self.left_room(size[1]);
        }
        let [panel_width, panel_height] = size;
        let ragged = rows > 1 && !count.is_multiple_of(columns);
        let below = if ragged { x_tick_room() } else { 0.0 };
        let pitch = lines * LINE + panel_height + GAP_DOWN + below;
        let x_ticks = panels.x.ticks(panel_width, Direction::Horizontal, TICK_SIZE);
        // The last label of a panel must not run into the first of the next.
        let inner_ticks = parted(&panels.x, panel_width, gap);
        let y_ticks = panels.y.as_ref().map(|axis| axis.ticks(panel_height, Direction::Vertical, TICK_SIZE));
        for (number, panel) in panels.all.iter().enumerate() {
            let (row, column) = (number / columns, number % columns);
            let frame = Frame {
                x: x + left + column as f64 * (panel_width + gap),
                y: top + row as f64 * pitch + lines * LINE,
                width: panel_width,
                height: panel_height,
            };
            for (line, title) in panel.title.iter().rev().enumerate() {
                let base = frame.y - 3.5 - line as f64 * LINE;
                svg.text(frame.across(0.5), base, title, Style::new(LABEL_SIZE, Anchor::Middle));
            }
            if !self.measured {
                cells::draw(svg, self.grid, panels, panel, self.content, &frame);
                overlay::draw(svg, self.grid, panels, panel, self.overlays, &frame);
            }
            frame.border(svg);
            let ticks = if column + 1 < columns { &inner_ticks } else { &x_ticks };
            frame.x_ticks(svg, ticks, ragged || row + 1 == rows);
            if let Some(ticks) = &y_ticks {
                frame.y_ticks(svg, ticks, column == 0);
            }
        }
        let plots = rows as f64 * pitch - GAP_DOWN - below;
        let across = columns as f64 * (panel_width + gap) - gap;
        if let Some(axis) = &panels.y {
            let room = plots - lines * LINE;
            let label = axis.label(room + lines * LINE, LABEL_SIZE);
            let middle = top + lines * LINE + 0.5 * room;
            svg.text(x + LABEL_SIZE, middle, &label, Style::new(LABEL_SIZE, Anchor::Middle).upwards());
        }
        let mut bottom = top + plots + x_tick_room();
        let label = panels.x.label(across, LABEL_SIZE);
        if label != Text::default() {
            bottom += LABEL_SIZE + 1.0;
            svg.text(x + left + 0.5 * across, bottom, &label, Style::new(LABEL_SIZE, Anchor::Middle));
        }
        bottom += 9.0;
        if let Some(field) = &field {
            bottom += colour_bar::draw(field, panels, svg, [x + left, bottom], width - left);
        }
        let sides = sides.as_ref().map(|sides| (sides, is_said));
        let legend = self.legend(sides, field.is_some()).with_lines(self.overlays);
        // Under the panels, or from the outer edge where that saves a line.
        let wide = legend.draw(None, x, bottom, width) < legend.draw(None, x + left, bottom, width - left);
        let indent = if wide { 0.0 } else { left };
        bottom + legend.draw(Some(svg), x + indent, bottom, width - indent) - y
    }

    /// The legend of the classes; that of a field is its bar.
    fn legend(&self, sides: Option<(&Sides, bool)>, is_field: bool) -> Legend {
        let (colouring, hatched) = match self.content {
            Content::Lines => return Legend::default(),
            Content::Classes { colouring, hatched } => (colouring, hatched),
            _ => (Colouring::Regime, false),
        };
        if is_field {
            return Legend::default();
        }
        let cells = self.panels.scatter.is_none();
        Legend::new((self.tally, self.computed), sides, colouring, [hatched, cells])
    }

    /// The heading above the panels, as lines for a block of this width. A curve has its words beside it and no heading.
    fn heading(&self, width: f64) -> Vec<Text> {
        let room = width - self.letter.map_or(0.0, letters::width);
        let lines = |words: &str| Text::from(words).wrapped(room, LABEL_SIZE);
        match self.content {
            content if is_curve(content, self.panels) => Vec::new(),
            Content::Classes { colouring, .. } => lines(colouring.heading(self.starts)),
            Content::LargeRegime => lines("Regime from the large start (time integration)"),
            Content::Lines => lines("Where limit cycles meet, change their stability, or are born"),
            content => Field::of(content, self.panels).map_or_else(Vec::new, |field| field.heading(room)),
        }
    }

    /// The lines of the heading beyond the first.
    pub(crate) fn lines_beyond_one(&self, width: f64) -> usize {
        self.heading(width).len().saturating_sub(1)
    }

    /// The height of the panel of a curve.
    fn curve_height(&self) -> f64 {
        let room = self.layout.page / self.blocks as f64 - CURVE_AROUND;
        room.clamp(self.layout.flattest.max(FLATTEST_CURVE) * curve_block::HEIGHT, curve_block::HEIGHT)
    }

    /// The room that a block of one panel without a picture takes left of it, points.
    pub(crate) fn left(&self) -> f64 {
        if is_curve(self.content, self.panels) {
            curve_block::left(self.content, self.panels, self.curve_height())
        } else {
            0.0
        }
    }

    fn title_lines(&self) -> usize {
        self.panels.all.iter().map(|panel| panel.title.len()).max().unwrap_or(0)
    }

    fn columns(&self, width: f64) -> usize {
        let count = self.panels.all.len().max(1);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive count")]
        let fit =
            |least: f64| ((width - LEFT - RIGHT + GAP_ACROSS[0]) / (least + GAP_ACROSS[0])).max(1.0) as usize;
        let [most, preferred] = [MOST_COLUMNS, COLUMNS].map(|columns| columns.min(fit(NARROWEST)));
        let usual = match self.panels.columns {
            // As many as a row of the table has, or as fit: of a slide they may be crowded.
            Some(columns) if (2..=fit(CROWDED).min(MOST_COLUMNS)).contains(&columns) => columns,
            _ if count <= most => count,
            _ => count.div_ceil(count.div_ceil(preferred)),
        };
        // A table of panels stays one: with other columns its rows would be broken.
        let more = if self.is_table() && !self.layout.broken { 0 } else { self.layout.more_columns };
        (usual + more).min(fit(CROWDED).max(usual)).min(count)
    }

    /// Whether rows and columns of panels are the values of two axes.
    fn is_table(&self) -> bool {
        self.panels.columns.is_some_and(|columns| (2..self.panels.all.len()).contains(&columns))
    }

    fn panel_size(&self, width: f64, columns: usize, gap: f64) -> [f64; 2] {
        let n = columns as f64;
        let panel = (width - (n - 1.0) * gap) / n;
        let height = match &self.panels.y {
            None => STRIP,
            Some(axis) if axis.is_named() => (NAMED_ROW * axis.len() as f64).clamp(2.0 * NAMED_ROW, TALLEST),
            Some(_) => {
                let count = self.panels.all.len();
                let titles = self.title_lines() as f64 * LINE + GAP_DOWN;
                let rows = count.div_ceil(columns).max(1) as f64;
                let room = (self.layout.page / self.blocks as f64 - AROUND) / rows - titles;
                room.clamp(self.layout.least_height(panel), panel).min(TALLEST)
            }
        };
        [panel, height]
    }

    fn left_room(&self, height: f64) -> f64 {
        match &self.panels.y {
            None => self.least_left.max(RIGHT),
            Some(axis) => LABEL_SIZE + 6.0 + y_tick_room(&axis.ticks(height, Direction::Vertical, TICK_SIZE)),
        }
    }
}
