//! A map as LaTeX source for pgfplots: panels as axes, classes as filled areas, the lines between them as paths.
//!
//! Everything is inlined, so that `plot.tex` compiles by itself; fonts and sizes are those of the document it is put in.

use std::fmt::Write as _;

use crate::results::error::{Error, Result};
use crate::results::figure::fills::unsettled;
use crate::results::figure::look::{Content, Look};
use crate::results::figure::map::computed;
use crate::results::figure::outline::shape;
use crate::results::figure::palette::Colouring;
use crate::results::figure::panels::{Panel, Panels};
use crate::results::figure::picture_axis::PictureAxis;
use crate::sweep::grid::Grid;
use crate::sweep::label::Label;
use crate::sweep::map::Map;
use squealmap_figure::boundaries::{Vertex, borders, outlines};
use squealmap_figure::frame::LABEL_SIZE;
use squealmap_figure::letters::letter;
use squealmap_figure::page::DOUBLE_COLUMN;
use squealmap_figure::scale::Scale;
use squealmap_figure::tex::escaped;
use squealmap_figure::text::Text;

/// Room for the labels of the vertical axis, points.
const LEFT: f64 = 36.0;
/// Between panels, points: room for half a tick label of each.
const GAP: f64 = 16.0;
/// The patterns of instances without a result, and of a response that has not settled.
const FAILED: &str = "pattern=crosshatch, pattern color=red";
const UNSETTLED: &str = "pattern=north east lines, pattern color=black!60";
/// A row holds no more panels than this.
const COLUMNS: usize = 5;
/// Panels are no larger than this, points.
const LARGEST: f64 = 200.0;

/// The source before the panels.
const PREAMBLE: &str = r"\documentclass[border=2pt]{standalone}
\usepackage[utf8]{inputenc}
\usepackage[T1]{fontenc}
\usepackage{amsmath,pgfplots}
\usepgfplotslibrary{groupplots}
\usetikzlibrary{patterns}
\pgfplotsset{compat=1.16}
\newcommand{\swatch}[1]{\tikz\draw[line width=0.4pt,#1] (0,0) rectangle (3.6mm,2.2mm);}
";

/// The source of the classes of a map, in the width of the look.
///
/// # Errors
/// When the map is one of single points, or something else than classes is asked for.
pub fn map_tikz(map: &Map, look: &Look<'_>) -> Result<String> {
    let mut panels = Panels::new(&map.spec.grid);
    panels.add(0, &map.records);
    let refused = |why: &'static str| Err(Error::Tikz { why });
    let (Some(y), None, Grid::Axes(_)) = (&panels.y, panels.scatter, &map.spec.grid) else {
        return refused("the map has no panels of cells over two axes");
    };
    let contents =
        if look.contents.is_empty() { computed(map.spec.analysis, false) } else { look.contents.clone() };
    let mut colourings = Vec::new();
    for content in contents {
        match content {
            Content::Classes { colouring, .. } => colourings.push(colouring),
            Content::Basin | Content::LargeRegime | Content::Lines => {}
            Content::Quantity { .. } | Content::Named { .. } => {
                return refused("quantities are drawn as SVG, PDF and PNG only");
            }
        }
    }
    let mut out = format!("% {}\n", crate::version::program() + &look.made_by().replace('\n', " "));
    out += PREAMBLE;
    for class in colourings.iter().flat_map(|colouring| colouring.classes()) {
        let _ = writeln!(out, r"\definecolor{{{}}}{{HTML}}{{{}}}", colour(class.name), &class.fill[1..]);
    }
    out += "\\begin{document}\n\\small\n\\begin{tabular}{@{}l@{}}\n";
    let title = look.title(&map.spec.title);
    if !title.is_empty() {
        let _ = writeln!(out, r"\textbf{{{}}}\\[2mm]", escaped(title));
    }
    let width = look.points().unwrap_or(DOUBLE_COLUMN);
    let several = colourings.len() > 1;
    for (number, colouring) in colourings.into_iter().enumerate() {
        let letter = if several { format!(r"\textbf{{{}}} ", letter(number)) } else { String::new() };
        let heading = escaped(colouring.heading(map.spec.analysis.starts));
        let _ = writeln!(out, r"{letter}{heading}\\[1mm]");
        block(&mut out, &panels, y, colouring, width);
        legend(&mut out, &panels, colouring, width);
    }
    out += "\\end{tabular}\n\\end{document}\n";
    Ok(out)
}

/// The name of the colour of a class.
fn colour(class: &str) -> String {
    format!("class-{}", class.replace('_', "-"))
}

/// The panels of one colouring.
fn block(out: &mut String, panels: &Panels, y: &PictureAxis, colouring: Colouring, width: f64) {
    let columns = panels.all.len().clamp(1, COLUMNS);
    let rows = panels.all.len().div_ceil(columns).max(1);
    let side = ((width - LEFT - (columns - 1) as f64 * GAP) / columns as f64).min(LARGEST);
    let lines = panels.all.iter().map(|panel| panel.title.len()).max().unwrap_or(0);
    let down = GAP + 11.0 * lines as f64;
    let _ = write!(
        out,
        "\\begin{{tikzpicture}}\n\\begin{{groupplot}}[\n  group style={{group size={columns} by {rows}, \
         horizontal sep={GAP}pt, vertical sep={down}pt,\n    x descriptions at=edge bottom, y descriptions at=edge left}},\n  \
         scale only axis, width={side:.2}pt, height={side:.2}pt, enlargelimits=false, axis on top,\n  tick align=outside, \
         tick label style={{font=\\footnotesize}}, xtick pos=bottom, ytick pos=left, title style={{yshift=-1ex, align=center}},\n"
    );
    for (letter, axis) in [('x', &panels.x), ('y', y)] {
        let [low, high] = [0.0, 1.0].map(|at| axis.scale.value(at));
        let _ = writeln!(
            out,
            "  {letter}min={low}, {letter}max={high}, {letter}label={{{}}},",
            axis.label(side, LABEL_SIZE).tex()
        );
        match &axis.scale {
            Scale::Linear { .. } | Scale::Signed { .. } => {}
            Scale::Log { .. } => {
                let _ = writeln!(out, "  {letter}mode=log,");
            }
            Scale::Names(names) => {
                let at: Vec<String> = (0..names.len()).map(|k| k.to_string()).collect();
                let names: Vec<String> = names.iter().map(|name| escaped(name)).collect();
                let (at, names) = (at.join(","), names.join(","));
                let _ = writeln!(out, "  {letter}tick={{{at}}}, {letter}ticklabels={{{names}}},");
            }
        }
    }
    out.push_str("]\n");
    for panel in &panels.all {
        let title: Vec<String> = panel.title.iter().map(Text::tex).collect();
        let _ = writeln!(out, r"\nextgroupplot[title={{{}}}]", title.join(r"\\"));
        areas(out, panels, y, panel, colouring);
    }
    out.push_str("\\end{groupplot}\n\\end{tikzpicture}\\\\[1mm]\n");
}

/// The areas of a panel and the lines between them.
fn areas(out: &mut String, panels: &Panels, y: &PictureAxis, panel: &Panel, colouring: Colouring) {
    let Some([columns, rows]) = shape(panels, panel) else { return };
    let at = |(i, j): &Vertex| {
        format!("(axis cs:{},{})", panels.x.scale.value(panels.x.edges[*i]), y.scale.value(y.edges[*j]))
    };
    let path = |vertices: &[Vertex]| vertices.iter().map(at).collect::<Vec<_>>().join(" -- ");
    let label = |(i, j): Vertex| panels.labels[panel.cells.start + j * columns + i];
    let class = |cell: Vertex| colouring.class(label(cell));
    let mut fill = |style: &str, inside: &dyn Fn(Vertex) -> bool| {
        let loops = outlines(columns, rows, |i, j| inside((i, j)));
        if !loops.is_empty() {
            // The last vertex of a loop is the first again.
            let loops: Vec<String> =
                loops.iter().map(|vertices| path(&vertices[..vertices.len() - 1]) + " -- cycle").collect();
            let _ = writeln!(out, "\\fill[{style}, even odd rule] {};", loops.join(" "));
        }
    };
    for (k, look) in colouring.classes().iter().enumerate() {
        fill(&colour(look.name), &|cell| class(cell) == Some(k));
    }
    fill(FAILED, &|cell| class(cell).is_none());
    fill(UNSETTLED, &|cell| unsettled(label(cell), colouring));
    for line in borders(columns, rows, |a, b| class(a) != class(b)) {
        let _ = writeln!(out, "\\draw[line width=0.4pt] {};", path(&line));
    }
}

/// Writes the legend: the classes that occur, with their colours.
fn legend(out: &mut String, panels: &Panels, colouring: Colouring, width: f64) {
    let occurs = |k: usize| panels.labels.iter().any(|label: &Label| colouring.class(*label) == Some(k));
    let classes = colouring.classes().iter().enumerate().filter(|(k, _)| occurs(*k));
    let classes = classes.map(|(_, look)| (format!("fill={}", colour(look.name)), escaped(look.label)));
    let hatched = [
        (FAILED, "no result", panels.labels.iter().any(|label| colouring.class(*label).is_none())),
        (UNSETTLED, "not settled", panels.labels.iter().any(|label| unsettled(*label, colouring))),
    ];
    let hatched = hatched.into_iter().filter(|(.., occurs)| *occurs);
    let entries: Vec<String> = classes
        .chain(hatched.map(|(style, words, _)| (style.to_owned(), words.to_owned())))
        .map(|(style, words)| format!(r"\mbox{{\swatch{{{style}}}~{words}}}"))
        .collect();
    let _ = writeln!(out, "\\parbox{{{width:.2}pt}}{{\\raggedright {}}}\\\\[3mm]", entries.join("\\quad\n"));
}
